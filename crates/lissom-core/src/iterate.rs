//! Corrections of iterates far from equilibrium, where the stresses of the geometric stiffness are predicted over the correction.
//!
//! Such a correction may be as large as the model, and is right to first order in its rows. Two properties make the second order small:
//!
//! - A node moves along its axes before it turns, x' = x + R ξ_x, R' = R exp ξ_θ. On the screw exp ξ the rotation of a node would turn
//!   its way too, and neighbours with different rotations would be torn apart.
//! - The rows of a node are linearised in axes that do not turn with it. Those of the body axes contain the unbalanced forces, which turn
//!   with the node, as -[r]x; they vanish at the solution only. They are the skew part of the node's diagonal block: its forces by its
//!   rotation become the transpose of its moments by its translation, which has none.

use lissom_motion::{Motion, Rotation, Vector6};
use lissom_solver::Pattern;

use crate::kinematics::{LOCKED, Layout, split};

/// Motion of a node by a correction along its axes: first along, then about them. The way back from one is the other way round.
pub(crate) fn correction(xi: &Vector6, is_back: bool) -> Motion {
    let (along, about) = split(xi);
    let rotation = Rotation::exponential(&about);
    let way = if is_back { rotation.apply(&along) } else { along };
    Motion::new(rotation, way)
}

/// Subtracts `share` of corrections by row from increments since the start of the step. A negative share is the way back.
pub(crate) fn subtract_corrections(
    layout: &Layout,
    (corrections, share): (&[f64], f64),
    increments: &mut [f64],
) {
    for own in &layout.node_rows {
        let pick = |values: &[f64]| {
            Vector6::from_fn(|k, _| if own[k] == LOCKED { 0.0 } else { values[own[k] as usize] })
        };
        let xi = pick(corrections);
        if xi == Vector6::zeros() {
            continue;
        }
        let moved = correction(&(-share * xi), share < 0.0);
        let reached = Motion::exponential(&pick(increments)) * moved;
        let total = reached.logarithm();
        for k in (0..6).filter(|&k| own[k] != LOCKED) {
            increments[own[k] as usize] = total[k];
        }
    }
    for &row in &layout.coordinate_rows {
        increments[row as usize] -= share * corrections[row as usize];
    }
}

/// Removes from a tangent what unbalanced forces contribute by turning with the nodes.
pub(crate) fn hold_unbalanced_forces(layout: &Layout, pattern: &Pattern, values: &mut [f64]) {
    for own in &layout.node_rows {
        for i in 0..6 {
            for j in 0..i {
                if j < 3 && i < 3 || own[i] == LOCKED || own[j] == LOCKED {
                    continue;
                }
                let (row, column) = (own[i] as usize, own[j] as usize);
                let (Some(below), Some(above)) =
                    (pattern.position(row, column), pattern.position(column, row))
                else {
                    continue;
                };
                // Moments by translations are free of it, half of moments by rotations have either sign.
                if j >= 3 {
                    values[below] = 0.5 * (values[below] + values[above]);
                }
                values[above] = values[below];
            }
        }
    }
}

#[cfg(test)]
#[path = "../tests/unit/iterate.rs"]
mod tests;
