//! Joints whose equations have lost rank since the start, for example a `constant_velocity` joint that is bent by half a turn: the
//! gradient of its third rotation vanishes there. No step across such a pose has a solution, however short.
//!
//! The criterion is the smallest singular value of the gradient by the relative motion and the joint's own
//! coordinates, over its value at the start.

use nalgebra::DMatrix;

use crate::joints::MAX_COORDINATES;
use crate::joints::attached::AttachedJoint;
use crate::kinematics::{Kinematics, Quantity};
use crate::system::System;

/// A joint has almost lost a constraint if the smallest singular value is less than this fraction of that at the start:
/// for the rotation of a `constant_velocity` joint, within 26 degrees of half a turn.
const RANK_LOSS: f64 = 0.05;

/// A joint close to a pose in which one of its equations vanishes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RankLoss {
    pub(crate) joint: String,
    pub(crate) kind: &'static str,
    /// The equation with the largest component in the singular direction.
    pub(crate) equation: &'static str,
    /// Angle of the relative rotation of its two frames [rad].
    pub(crate) angle: f64,
}

/// The joint closest to losing rank at a configuration, compared with the start of the motion; none if no joint is.
/// Lengths are compared with angles through `length` [m].
pub(crate) fn rank_loss(
    system: &System,
    start: &Kinematics,
    at: &Kinematics,
    length: f64,
) -> Option<RankLoss> {
    let length = if length > 0.0 { length } else { 1.0 };
    let mut least: Option<(f64, RankLoss)> = None;
    for joint in system.joints().iter().filter(|joint| joint.equations() > 0) {
        let Some(((before, _), (now, equation))) =
            smallest_singular_value(joint, start, length).zip(smallest_singular_value(joint, at, length))
        else {
            continue;
        };
        let ratio = now / before;
        if ratio < RANK_LOSS && least.as_ref().is_none_or(|(smallest, _)| ratio < *smallest) {
            let found = RankLoss {
                joint: joint.name.clone(),
                kind: joint.kind,
                equation: joint.joint().equations()[equation],
                angle: joint.relative_motion(at).rotation.logarithm().norm(),
            };
            least = Some((ratio, found));
        }
    }
    least.map(|(_, found)| found)
}

/// The joint that has crossed a pose in which one of its equations vanishes: the gradient of an equation rotates by more than a
/// right angle, or the step ends on a branch of solutions that the joint cannot reach.
pub(crate) fn crossed(system: &System, start: &Kinematics, end: &Kinematics) -> Option<RankLoss> {
    system.joints().iter().find_map(|joint| {
        let branch = joint.joint().branch()?;
        let poses = [start, end].map(|at| joint.evaluate_absolute(at));
        let [before, after] = poses.each_ref().map(|pose| joint.own_gradient(pose));
        let turned = |&row: &usize| {
            let relative = before.relative.row(row).dot(&after.relative.row(row));
            relative + before.own.row(row).dot(&after.own.row(row)) < 0.0
        };
        let reversed = (0..joint.equations()).find(turned);
        if branch(&poses[1].0) >= 0.0 && reversed.is_none() {
            return None;
        }
        let equations = joint.joint().equations();
        let least =
            || smallest_singular_value(joint, end, 1.0).map_or(equations.len() - 1, |(_, equation)| equation);
        Some(RankLoss {
            joint: joint.name.clone(),
            kind: joint.kind,
            equation: equations[reversed.unwrap_or_else(least)],
            angle: joint.relative_motion(start).rotation.logarithm().norm(),
        })
    })
}

/// Smallest singular value of a joint's gradient, with the equation that has the largest component; angles count as
/// arcs at `length`. None if values are not finite.
fn smallest_singular_value(joint: &AttachedJoint, at: &Kinematics, length: f64) -> Option<(f64, usize)> {
    let gradient = joint.own_gradient(&joint.evaluate_absolute(at));
    let row_size = |row: usize| match joint.joint().equation_quantity(row) {
        Quantity::Angle => length,
        Quantity::Length | Quantity::State => 1.0,
    };
    let own = joint.joint().coordinates();
    let count = joint.equations();
    let matrix = DMatrix::from_fn(count, 6 + MAX_COORDINATES, |row, column| {
        let (value, unit) = match column {
            0..3 => (gradient.relative[(row, column)], 1.0),
            3..6 => (gradient.relative[(row, column)], length),
            _ => {
                let is_angle = own.get(column - 6).is_some_and(|own| own.quantity == Quantity::Angle);
                (gradient.own[(row, column - 6)], if is_angle { length } else { 1.0 })
            }
        };
        value * row_size(row) / unit
    });
    if matrix.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let values = matrix.svd(true, false);
    let (index, smallest) = values.singular_values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    let share = values.u.as_ref()?.column(index).into_owned();
    Some((*smallest, share.iamax())).filter(|(smallest, _)| *smallest >= 0.0)
}

#[cfg(test)]
#[path = "../../tests/unit/judge/degenerate_joint.rs"]
mod tests;
