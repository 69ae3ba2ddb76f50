//! Tests of `judge::degenerate_joint`, a module of it.

use std::f64::consts::PI;

use lissom_motion::{Motion, Rotation, Vector3};

use super::*;
use crate::joints::KINDS;
use crate::kinematics::Freedoms;
use crate::registry::Parameters;
use crate::system::{Builder, Placement};

/// A joint without parts of its own, and the motion with its tip bent about an axis across the shaft, then rotated about its
/// own.
fn bent(angle: f64, beside: f64) -> (System, Kinematics) {
    let mut builder = Builder::new();
    let tip = builder.add_node("tip", Motion::identity(), Freedoms::Full);
    let kind = KINDS.iter().find(|kind| kind.name == "constant_velocity").expect("there");
    let (at, axis) = (Vector3::zeros(), Some(Vector3::z()));
    let placement = Placement { nodes: [builder.ground(), tip], at, at_tip: None, axis, second_axis: None };
    builder.add_joint("j", kind, &placement, &Parameters::new()).expect("valid");
    let (system, state) = builder.build(0.0).expect("valid");
    let mut at = state.kinematics;
    let bend = Rotation::exponential(&Vector3::new(angle.to_radians(), 0.0, 0.0));
    let rotation = at.nodes[tip].frame.rotation;
    at.nodes[tip].frame.rotation = rotation * bend * Rotation::exponential(&Vector3::new(0.0, 0.0, beside));
    (system, at)
}

/// Shafts bent by 160 degrees, with the output at the angle of the input and half a turn from it: both satisfy the equation.
#[test]
fn a_step_across_half_a_turn_ends_on_another_branch() {
    let (system, start) = bent(160.0, 0.0);
    for (beside, is_other) in [(0.0, false), (0.3, false), (PI, true), (PI - 0.3, true)] {
        assert_eq!(crossed(&system, &start, &bent(160.0, beside).1).is_some(), is_other, "{beside}");
    }
}

/// Beyond half a turn the shafts are bent in the opposite direction.
#[test]
fn a_step_through_half_a_turn_is_seen() {
    let (system, start) = bent(178.0, 0.0);
    assert!(crossed(&system, &start, &bent(179.5, 0.0).1).is_none());
    assert!(crossed(&system, &start, &bent(181.0, 0.0).1).is_some());
}
