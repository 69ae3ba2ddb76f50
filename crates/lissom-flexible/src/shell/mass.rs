//! Consistent mass of a shell element. The velocity is bilinear with the parabolas along the edges that follow from the rotations of the nodes,
//! as of a thin plate: without them bending waves would have too little mass, by (k h)²/6 for a wave number k and elements of length h.
//! Where a prestress N holds the surface more than its bending stiffness D, edges between nodes are straight, and a parabola has the share
//! 1/(1 + N h²/(10 D)). With the whole parabolas directors of a taut membrane would vibrate slowly, each for itself.
//!
//! Legend: N_I bilinear functions, B_e = (1 - r²)(1 ± s)/2 or (1 - s²)(1 ± r)/2 of the edge from node I to node J, c_e the vector from I to J
//! as each of the two nodes carries it.
//!
//! ```text
//! v = Σ N_I v_I - Σ B_e (ω_J × c_e - ω_I × c_e)/8,      ω_I × c_e = v(x_I + c_e) - v_I
//! ```

use lissom_motion::Vector3;

use super::quadrilateral::{EDGES, NODES, bilinear};
use super::reference::Reference;
use super::section::ShellLaw;
use lissom_mechanics::elements::quadrature::gauss_legendre;

/// Points whose velocities determine that of the element: the nodes, and for each edge its vector at both nodes.
pub(super) const POINTS: usize = NODES + 2 * EDGES.len();

/// Nodes of the points.
pub(super) fn nodes() -> [usize; POINTS] {
    std::array::from_fn(|k| match k.checked_sub(NODES) {
        None => k,
        Some(of_edge) if of_edge % 2 == 0 => EDGES[of_edge / 2].0,
        Some(of_edge) => EDGES[of_edge / 2].1,
    })
}

/// The functions of the points, with a share of the parabolas.
fn functions(r: f64, s: f64, share: f64) -> [f64; POINTS] {
    let mut all = [0.0; POINTS];
    all[..NODES].copy_from_slice(&bilinear(r, s)[0]);
    let (along, across) = (0.5 * (1.0 - r * r), 0.5 * (1.0 - s * s));
    let bubbles = [along * (1.0 - s), along * (1.0 + s), across * (1.0 - r), across * (1.0 + r)];
    for (e, ((i, j), bubble)) in EDGES.into_iter().zip(bubbles).enumerate() {
        let part = 0.125 * share * bubble;
        all[i] -= part;
        all[j] += part;
        all[NODES + 2 * e] = part;
        all[NODES + 2 * e + 1] = -part;
    }
    all
}

/// Share of the parabolas in an element under a tension per length [N/m].
pub(super) fn share_of_parabolas(reference: &Reference, law: &ShellLaw, tension: f64) -> f64 {
    let bending = 0.5 * (law.stiffness[(3, 3)] + law.stiffness[(4, 4)]);
    // Four areas per r and s are that of the element.
    1.0 / (1.0 + tension * 4.0 * reference.axes(0.0, 0.0).area / (10.0 * bending))
}

/// Integrals of products of two functions [m²].
pub(super) fn area_matrix(reference: &Reference, share: f64) -> Box<[[f64; POINTS]; POINTS]> {
    let mut matrix = Box::new([[0.0; POINTS]; POINTS]);
    for &(r, of_r) in gauss_legendre(3) {
        for &(s, of_s) in gauss_legendre(3) {
            let area = of_r * of_s * reference.axes(r, s).area;
            let functions = functions(r, s, share);
            for (row, value) in matrix.iter_mut().zip(functions) {
                row.iter_mut().zip(functions).for_each(|(sum, other)| *sum += area * value * other);
            }
        }
    }
    matrix
}

/// The points relative to their nodes, global axes, of masses at `centers` relative to the nodes.
pub(super) fn points(positions: &[Vector3; NODES], centers: &[Vector3; NODES]) -> [Vector3; POINTS] {
    let nodes = nodes();
    std::array::from_fn(|k| {
        let own = centers[nodes[k]];
        let Some(of_edge) = k.checked_sub(NODES) else { return own };
        let (i, j) = EDGES[of_edge / 2];
        own + (positions[j] + centers[j]) - (positions[i] + centers[i])
    })
}
