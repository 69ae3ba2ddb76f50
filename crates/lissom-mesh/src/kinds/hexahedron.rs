//! Hexahedra.

use lissom_motion::Vector3;

use super::SolidKind;
use super::functions::Natural;
use super::points::on_line;
use crate::mesh::MeshShape;

/// The row of the table.
pub(super) static KIND: SolidKind = SolidKind {
    word: "hexahedron",
    shapes: [MeshShape::Hexahedron8, MeshShape::Hexahedron20],
    abaqus: [
        &["C3D8", "C3D8R", "C3D8I", "C3D8H", "C3D8RH", "C3D8IH"],
        &["C3D20", "C3D20R", "C3D20H", "C3D20RH"],
    ],
    gmsh: [5, 17],
    gmsh_edges: &[
        [0, 1],
        [0, 3],
        [0, 4],
        [1, 2],
        [1, 5],
        [2, 3],
        [2, 6],
        [3, 7],
        [4, 5],
        [4, 7],
        [5, 6],
        [6, 7],
    ],
    corners: &[
        [-1.0, -1.0, -1.0],
        [1.0, -1.0, -1.0],
        [1.0, 1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [1.0, -1.0, 1.0],
        [1.0, 1.0, 1.0],
        [-1.0, 1.0, 1.0],
    ],
    edges: &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
    faces: &[
        &[0, 3, 2, 1, 11, 10, 9, 8],
        &[4, 5, 6, 7, 12, 13, 14, 15],
        &[0, 1, 5, 4, 8, 17, 12, 16],
        &[1, 2, 6, 5, 9, 18, 13, 17],
        &[2, 3, 7, 6, 10, 19, 14, 18],
        &[3, 0, 4, 7, 11, 16, 15, 19],
    ],
    functions,
    points: (point, 21),
    fine: (fine, 27),
    stress_points: (|k| KIND.corners[k].map(|sign| gauss() * sign), 8),
    stress_share,
};

/// Serendipity functions: Π(1 + r rᵢ) (Σ r rᵢ - 2)/8 at corners, Π(1 + r rᵢ) (1 - r²)/4 at edges, r along the edge.
pub(super) fn functions(place: Natural, values: &mut [f64], slopes: &mut [Vector3]) {
    for i in 0..20 {
        let node = KIND.node(i);
        // A factor of each direction with its slope.
        let along = |k: usize| node[k] == 0.0;
        let factor = |k: usize| if along(k) { 1.0 - place[k] * place[k] } else { 1.0 + node[k] * place[k] };
        let slope = |k: usize| if along(k) { -2.0 * place[k] } else { node[k] };
        let factors = [factor(0), factor(1), factor(2)];
        let product: f64 = factors.iter().product();
        let others = |k: usize| factors[(k + 1) % 3] * factors[(k + 2) % 3];
        let (scale, sum) =
            if i < 8 { (0.125, (0..3).map(|k| node[k] * place[k]).sum::<f64>() - 2.0) } else { (0.25, 1.0) };
        values[i] = scale * product * sum;
        slopes[i] = Vector3::from_fn(|k, _| {
            let of_sum = if i < 8 { product * node[k] } else { 0.0 };
            scale * (slope(k) * others(k) * sum + of_sum)
        });
    }
}

/// 21 points: eight near those of Gauss, which alone have modes without energy that join across elements in layers of one element, and
/// thirteen with small weights, which give these modes a stiffness. Like those of Gauss they integrate products of third order in each
/// coordinate exactly, so that distorted elements with straight edges pass the patch test.
///
/// ```text
/// (±b, ±b, ±b) with t³, b² = 1/(3 t),      (±e, ±e, 0) and alike with D = (1 - t²)(1 + t)/2, e² = 2/(3 + 3 t),
/// the centre with 8 - 8 t³ - 12 D,         t = 0.95;  t = 1 are the points of Gauss
/// ```
fn point(point: usize) -> (Natural, f64) {
    let t = 0.95_f64;
    let [corner, along] = [1.0 / (3.0 * t), 2.0 / (3.0 + 3.0 * t)].map(f64::sqrt);
    let [of_corner, of_edge] = [t.powi(3), 0.5 * (1.0 - t * t) * (1.0 + t)];
    // Corners, then the middles of the edges, which are nodes of the element.
    match point {
        0..8 => (KIND.node(point).map(|sign| corner * sign), of_corner),
        8..20 => (KIND.node(point).map(|sign| along * sign), of_edge),
        _ => ([0.0; 3], 8.0 - 8.0 * of_corner - 12.0 * of_edge),
    }
}

/// 27 points of Gauss.
pub(super) fn fine(k: usize) -> (Natural, f64) {
    let line = on_line();
    let [x, y, z] = [line[k / 9], line[k / 3 % 3], line[k % 3]];
    ([x.0, y.0, z.0], x.1 * y.1 * z.1)
}

fn gauss() -> f64 {
    (1.0_f64 / 3.0).sqrt()
}

/// Trilinear between 2 x 2 x 2 points of Gauss.
fn stress_share(point: usize, place: Natural) -> f64 {
    let sign = KIND.corners[point];
    (0..3).map(|k| 0.5 * (1.0 + sign[k] * place[k] / gauss())).product()
}
