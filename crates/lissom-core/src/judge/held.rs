//! Joints whose equations hold less than at the start: a `constant_velocity` joint that is bent by half a turn, whose
//! third rotation vanishes there with its gradient. No step across such a place has a solution, however short.
//!
//! Seen is the smallest singular value of the gradient by the relative motion and the joint's own coordinates, over
//! what it was at the start.

use nalgebra::DMatrix;

use crate::joints::attached::AttachedJoint;
use crate::joints::{MOST_COORDINATES, Relative};
use crate::kinematics::{Kinematics, Quantity};
use crate::system::System;

/// A joint holds nearly nothing in one direction where the smallest singular value is less than this part of that at the
/// start: for the rotation of a `constant_velocity` joint, 26 degrees beside half a turn.
const LOST: f64 = 0.05;

/// A joint close to a place where one of its equations vanishes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LostHold {
    pub(crate) joint: String,
    pub(crate) kind: &'static str,
    /// The equation that takes most part in what vanishes.
    pub(crate) equation: &'static str,
    /// Angle of the relative rotation of its two frames [rad].
    pub(crate) angle: f64,
}

/// The joint that holds least at a configuration, compared with where the motion began; none where all hold well.
/// Lengths are compared with angles through `length` [m].
pub(crate) fn lost(system: &System, start: &Kinematics, at: &Kinematics, length: f64) -> Option<LostHold> {
    let length = if length > 0.0 { length } else { 1.0 };
    let mut least: Option<(f64, LostHold)> = None;
    for joint in system.joints().iter().filter(|joint| joint.equations() > 0) {
        let Some(((before, _), (now, equation))) = hold(joint, start, length).zip(hold(joint, at, length))
        else {
            continue;
        };
        let ratio = now / before;
        if ratio < LOST && least.as_ref().is_none_or(|(smallest, _)| ratio < *smallest) {
            let found = LostHold {
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

/// The joint that a step has led to a branch of solutions that it cannot reach: across a pose in which one of its equations vanishes.
pub(crate) fn on_another_branch(system: &System, end: &Kinematics) -> Option<LostHold> {
    system.joints().iter().find_map(|joint| {
        let branch = joint.joint().branch()?;
        let relative = Relative::at_start(&joint.relative_motion(end));
        if branch(&relative) >= 0.0 {
            return None;
        }
        let equations = joint.joint().equations();
        let equation = hold(joint, end, 1.0).map_or(equations.len() - 1, |(_, equation)| equation);
        Some(LostHold {
            joint: joint.name.clone(),
            kind: joint.kind,
            equation: equations[equation],
            angle: joint.relative_motion(end).rotation.logarithm().norm(),
        })
    })
}

/// Smallest singular value of a joint's gradient, with the equation that takes most part in it; angles count as arcs at
/// `length`. None where numbers are not finite.
fn hold(joint: &AttachedJoint, at: &Kinematics, length: f64) -> Option<(f64, usize)> {
    let gradient = joint.own_gradient(&joint.outright(at));
    let row_size = |row: usize| match joint.joint().equation_quantity(row) {
        Quantity::Angle => length,
        Quantity::Length | Quantity::State => 1.0,
    };
    let own = joint.joint().coordinates();
    let count = joint.equations();
    let matrix = DMatrix::from_fn(count, 6 + MOST_COORDINATES, |row, column| {
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
mod tests {
    use std::f64::consts::PI;

    use lissom_motion::{Motion, Rotation, Vector3};

    use super::*;
    use crate::joints::KINDS;
    use crate::kinematics::Freedoms;
    use crate::registry::Parameters;
    use crate::system::{Builder, Placement};

    /// Shafts bent by 160 degrees, with the output at the angle of the input and half a turn beside it: both satisfy the equation.
    #[test]
    fn a_step_across_half_a_turn_ends_on_another_branch() {
        let mut builder = Builder::new();
        let tip = builder.add_node("tip", Motion::identity(), Freedoms::Full);
        let kind = KINDS.iter().find(|kind| kind.name == "constant_velocity").expect("there");
        let (at, axis) = (Vector3::zeros(), Some(Vector3::z()));
        let placement =
            Placement { nodes: [builder.ground(), tip], at, at_tip: None, axis, second_axis: None };
        builder.add_joint("j", kind, &placement, &Parameters::new()).expect("valid");
        let (system, state) = builder.build(0.0).expect("valid");
        for (beside, is_other) in [(0.0, false), (0.3, false), (PI, true), (PI - 0.3, true)] {
            let mut at = state.kinematics.clone();
            let axes = state.kinematics.nodes[tip].frame.rotation;
            let bent = Rotation::exponential(&Vector3::new(160.0_f64.to_radians(), 0.0, 0.0));
            at.nodes[tip].frame.rotation =
                axes * bent * Rotation::exponential(&Vector3::new(0.0, 0.0, beside));
            assert_eq!(on_another_branch(&system, &at).is_some(), is_other, "{beside}");
        }
    }
}
