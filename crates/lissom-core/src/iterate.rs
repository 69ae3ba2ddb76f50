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
mod tests {
    use super::*;

    #[test]
    fn a_correction_is_undone_exactly() {
        let xi = Vector6::from([3.0, -1.0, 2.0, 0.4, 1.5, -0.7]);
        let there_and_back = correction(&xi, false) * correction(&-xi, true);
        assert!(there_and_back.logarithm().norm() < 1e-15);
        let layout = Layout {
            node_rows: vec![[LOCKED; 6], [0, 1, 2, 3, 4, 5]],
            coordinate_rows: vec![6],
            ..Layout::default()
        };
        let before = vec![0.3, 0.1, -0.2, 0.5, -0.4, 0.1, 2.0];
        let corrections = [0.2, -0.1, 0.4, 0.1, 0.3, -0.6, 0.5];
        let mut increments = before.clone();
        subtract_corrections(&layout, (&corrections, 1.0), &mut increments);
        assert!((increments[6] - 1.5).abs() < 1e-15);
        subtract_corrections(&layout, (&corrections, -1.0), &mut increments);
        assert!(increments.iter().zip(&before).all(|(now, then)| (now - then).abs() < 1e-15));
    }

    #[test]
    fn the_tangent_of_a_force_without_balance_becomes_symmetric() {
        let layout = Layout { node_rows: vec![[0, 1, 2, 3, 4, 5]], ..Layout::default() };
        let pattern = Pattern::from_cliques(6, [&[0, 1, 2, 3, 4, 5][..]]);
        // A force r at a node that turns: its components vary by r x θ.
        let r = [1.0, 2.0, 3.0];
        let mut values = vec![0.0; 36];
        for (row, column, value) in [(0, 1, -r[2]), (0, 2, r[1]), (1, 2, -r[0])] {
            for (row, column, value) in [(row, column, value), (column, row, -value)] {
                values[pattern.position(row, 3 + column).expect("in the clique")] = value;
                values[pattern.position(3 + row, 3 + column).expect("in the clique")] = value;
            }
        }
        hold_unbalanced_forces(&layout, &pattern, &mut values);
        assert!(values.iter().all(|value| *value == 0.0), "{values:?}");
    }
}
