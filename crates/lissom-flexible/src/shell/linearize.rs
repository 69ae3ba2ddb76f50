//! Derivatives of a shell element's forces, over one number or several lanes.
//!
//! Legend: G derivatives of the strains with respect to body-frame variations, M_IJ = R_Iᵀ R_J, a_IJ and b_iIJ the factors of x_J and t_iJ in
//! f_I, w_iI = R_Iᵀ v_iI, y edge terms; see `forces` for f, v and T.
//!
//! ```text
//! K = Gᵀ D G + ...
//! F_I by u_J      a_IJ M_IJ
//! F_I by θ_J      -M_IJ [Σ_i b_iIJ T_iJ]x            + [F_I]x for J = I
//! M_J by u_I      [Σ_i b_iIJ T_iJ]x M_JI
//! M_I by θ_I      Σ_i (w_iI T_iIᵀ - (w_iI·T_iI) 1)
//! ```
//!
//! These are the derivatives of the forces in the axes of the nodes, which are symmetric where the nodes are in equilibrium.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Pose, Real, Screw, Square, Triple};

use super::constants::{Constants, SHAPES};
use super::forces::stress;
use super::quadrilateral::{EDGES, NODES, POINTS, STRAINS};
use super::strains::{BY_NODE, Deformed};

/// Local unknowns.
pub(super) const SIZE: usize = 6 * NODES;
/// Derivatives of the strains.
pub(super) type Gradient<R> = [[R; SIZE]; STRAINS];
/// Derivatives of the forces.
pub(super) type Matrix<R> = [[R; SIZE]; SIZE];

/// Adds a vector to three columns of a row.
#[inline(always)]
fn add<R: Real>(row: &mut [R; SIZE], first: usize, vector: Triple<R>) {
    row[first] = row[first] + vector.x;
    row[first + 1] = row[first + 1] + vector.y;
    row[first + 2] = row[first + 2] + vector.z;
}

/// Adds a 3 x 3 block.
#[inline(always)]
fn add_block<R: Real>(matrix: &mut Matrix<R>, (row, column): (usize, usize), block: Square<R>) {
    for k in 0..3 {
        add(&mut matrix[row + k], column, block.rows[k]);
    }
}

/// Derivatives of an edge's c·(d_J - d_I)/4 and of q.
#[derive(Clone, Copy)]
pub(super) struct EdgeGradients<R> {
    pub(super) bending: [R; SIZE],
    pub(super) square: [R; SIZE],
}

/// Derivatives of the strains with respect to body-frame variations of the nodes.
#[inline(always)]
pub(super) fn gradient<R: Real, C: Constants<R>>(
    constants: &C,
    frames: &[Pose<R>; NODES],
    deformed: &Deformed<R>,
) -> (Gradient<R>, [EdgeGradients<R>; 4]) {
    let zero = frames[0].position.x.like(0.0);
    let mut g = [[zero; SIZE]; STRAINS];
    let mut of_edges = [EdgeGradients { bending: [zero; SIZE], square: [zero; SIZE] }; 4];
    for k in 0..4 {
        let (i, j) = EDGES[k];
        let edge = &deformed.edges[k];
        let own = &mut of_edges[k];
        for (node, other, sign) in [(i, j, -0.25), (j, i, 0.25)] {
            let rotation = frames[node].rotation;
            let first = 6 * node;
            let director = constants.director(node, 2);
            let chord = rotation.apply_inverse(edge.chord);
            add(&mut g[k], first, chord.scaled(sign));
            add(&mut own.bending, first, rotation.apply_inverse(edge.difference).scaled(sign));
            add(&mut g[10 + k], first, rotation.apply_inverse(edge.sum).scaled(sign));
            let moment = director.cross(chord);
            add(&mut own.bending, first + 3, moment.scaled(sign));
            add(&mut g[10 + k], first + 3, moment.scaled(0.25));
            let facing = director.cross(rotation.apply_inverse(deformed.triads[other][2]));
            add(&mut own.square, first + 3, facing.scaled(-2.0));
        }
        let turned = edge.bending * edge.arc[1];
        for column in 0..SIZE {
            g[5 + k][column] = (own.bending[column] * edge.arc[0]).plus_product(turned, own.square[column]);
        }
    }
    let [x_r, x_s] = deformed.position;
    let [d_r, d_s] = deformed.director;
    for i in 0..NODES {
        let rotation = frames[i].rotation;
        let (a, b) = BY_NODE[i];
        let (a, b) = (0.5 * a, 0.5 * b);
        let across = rotation.apply_inverse(x_s.scaled(a) + x_r.scaled(b));
        add(&mut g[4], 6 * i, across);
        add(&mut g[9], 6 * i, rotation.apply_inverse(d_s.scaled(a) + d_r.scaled(b)));
        add(&mut g[9], 6 * i + 3, constants.director(i, 2).cross(across));
        let (first, second) = (constants.director(i, 0), constants.director(i, 1));
        for p in 0..POINTS {
            let point = &deformed.points[p];
            let [by_1, by_2] = point.by_node[i];
            let force = (point.triad[0] * by_2).plus_scaled(point.triad[1], -by_1);
            add(&mut g[14 + p], 6 * i, rotation.apply_inverse(force));
            let moment = first
                .cross(rotation.apply_inverse(point.slopes[1]))
                .plus_cross(rotation.apply_inverse(point.slopes[0]), second);
            add(&mut g[14 + p], 6 * i + 3, moment.scaled(SHAPES[p][2][i]));
        }
    }
    (g, of_edges)
}

/// Stresses at `frames`, predicted linearly from `from`: a rotation stretches nothing to first order. The way is that of a correction of
/// statics, along the axes of a node and then about them.
#[inline(always)]
pub(super) fn predicted<R: Real, C: Constants<R>>(
    constants: &C,
    from: &[Pose<R>; NODES],
    frames: &[Pose<R>; NODES],
) -> [R; STRAINS] {
    let deformed = Deformed::at(constants, from);
    let mut way = [Screw::zero(frames[0].position.x); NODES];
    for i in 0..NODES {
        let step = frames[i].relative_to(from[i]);
        way[i] = Screw::new(step.position, step.rotation.logarithm());
    }
    let (mut strains, rates) = (deformed.strains(constants), deformed.rates(constants, from, &way));
    for k in 0..STRAINS {
        strains[k] = strains[k] + rates[k];
    }
    stress(constants, &strains)
}

/// Derivatives of the elastic forces at `frames`, with these stresses in the geometric stiffness.
#[inline(always)]
pub(super) fn linearize<R: Real, C: Constants<R>>(
    constants: &C,
    frames: &[Pose<R>; NODES],
    stress: &[R; STRAINS],
    out: &mut Matrix<R>,
) {
    let zero = frames[0].position.x.like(0.0);
    let deformed = Deformed::at(constants, frames);
    let (g, of_edges) = gradient(constants, frames, &deformed);
    let mut dg = [[zero; SIZE]; STRAINS];
    constants.stiffness_times(&g, &mut dg);
    for i in 0..SIZE {
        for j in 0..=i {
            let mut sum = zero;
            for k in 0..STRAINS {
                sum = sum.plus_product(g[k][i], dg[k][j]);
            }
            out[i][j] = sum;
        }
    }
    stressed(constants, (frames, &deformed), &of_edges, stress, out);
}

/// Adds the terms with stresses to a symmetric matrix of which the lower half is given, and completes its upper half.
#[inline(always)]
pub(super) fn stressed<R: Real, C: Constants<R>>(
    constants: &C,
    (frames, deformed): (&[Pose<R>; NODES], &Deformed<R>),
    of_edges: &[EdgeGradients<R>; 4],
    stress: &[R; STRAINS],
    out: &mut Matrix<R>,
) {
    let zero = stress[0].like(0.0);
    for k in 0..4 {
        let edge = &deformed.edges[k];
        let own = &of_edges[k];
        let (slope, curvature) = (stress[5 + k] * edge.arc[1], stress[5 + k] * edge.bending * edge.arc[2]);
        let half = curvature.scaled(0.5);
        let (first, second) = EDGES[k];
        let mut mixed = [zero; SIZE];
        for i in 0..SIZE {
            mixed[i] = (own.bending[i] * slope).plus_product(own.square[i], half);
        }
        for node in [first, second] {
            for other in [first, second] {
                for i in 6 * node..6 * node + 6 {
                    for j in 6 * other..6 * other + 6 {
                        if j <= i {
                            out[i][j] = out[i][j]
                                .plus_product(own.square[i], mixed[j])
                                .plus_product(mixed[i], own.square[j]);
                        }
                    }
                }
            }
        }
    }
    for i in 0..SIZE {
        for j in 0..i {
            out[j][i] = out[i][j];
        }
    }
    geometric(constants, frames, deformed, stress, out);
}

/// Adds the terms with stresses that are no products of gradients.
#[inline(always)]
fn geometric<R: Real, C: Constants<R>>(
    constants: &C,
    frames: &[Pose<R>; NODES],
    deformed: &Deformed<R>,
    stress: &[R; STRAINS],
    out: &mut Matrix<R>,
) {
    let zero = stress[0].like(0.0);
    let mut a = [[zero; NODES]; NODES];
    let mut b = [[[zero; 3]; NODES]; NODES];
    // Moments of an edge about one node by the rotation of the other.
    let mut facing = [[zero; NODES]; NODES];
    for k in 0..4 {
        let (i, j) = EDGES[k];
        let edge = &deformed.edges[k];
        let membrane = stress[k].scaled(0.25);
        a[i][i] = a[i][i] + membrane;
        a[j][j] = a[j][j] + membrane;
        a[i][j] = a[i][j] - membrane;
        a[j][i] = a[j][i] - membrane;
        let bending = (stress[5 + k] * edge.arc[0]).scaled(0.25);
        let shear = stress[10 + k].scaled(0.25);
        b[i][i][2] = b[i][i][2] + bending - shear;
        b[j][j][2] = b[j][j][2] + bending + shear;
        b[i][j][2] = b[i][j][2] - bending - shear;
        b[j][i][2] = b[j][i][2] - bending + shear;
        let turned = (stress[5 + k] * edge.bending * edge.arc[1]).scaled(2.0);
        facing[i][j] = turned;
        facing[j][i] = turned;
    }
    for i in 0..NODES {
        for j in 0..NODES {
            let ((r, s), (r_other, s_other)) = (BY_NODE[i], BY_NODE[j]);
            let product = 0.5 * (r * s_other + s * r_other);
            a[i][j] = a[i][j] + stress[4].scaled(product);
            b[i][j][2] = b[i][j][2] + stress[9].scaled(product);
            for p in 0..POINTS {
                let [by_1, by_2] = deformed.points[p].by_node[i];
                let own = stress[14 + p].scaled(SHAPES[p][2][j]);
                b[i][j][0] = b[i][j][0].plus_product(own, by_2);
                b[i][j][1] = b[i][j][1].minus_product(own, by_1);
            }
        }
    }
    let conjugate = deformed.conjugate(stress);
    for i in 0..NODES {
        let rotation = frames[i].rotation;
        for j in 0..NODES {
            let relative = (rotation.inverse() * frames[j].rotation).matrix();
            let carried = constants.director(j, 0) * b[i][j][0];
            let carried = carried.plus_scaled(constants.director(j, 1), b[i][j][1]);
            let carried = Square::skew(carried.plus_scaled(constants.director(j, 2), b[i][j][2]));
            add_block(out, (6 * i, 6 * j), relative * a[i][j]);
            let across = relative.times(carried);
            add_block(out, (6 * i, 6 * j + 3), -across);
            add_block(out, (6 * j + 3, 6 * i), -across.transposed());
            if i != j {
                let (own, other) = (constants.director(i, 2), constants.director(j, 2));
                let turned = Square::skew(own).times(relative).times(Square::skew(other));
                add_block(out, (6 * i + 3, 6 * j + 3), turned * facing[i][j]);
            }
        }
        add_block(out, (6 * i, 6 * i + 3), Square::skew(rotation.apply_inverse(conjugate.positions[i])));
        for k in 0..3 {
            let w = rotation.apply_inverse(conjugate.vectors[i][k]);
            let director = constants.director(i, k);
            let block = Square::outer(w, director) - Square::diagonal(w.dot(director));
            add_block(out, (6 * i + 3, 6 * i + 3), block);
        }
    }
}
