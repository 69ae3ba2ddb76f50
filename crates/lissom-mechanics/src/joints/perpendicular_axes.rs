//! Perpendicular axes: an axis of the base and one of the tip remain at a right angle, -R_12 = 0.

use super::generic::locking;
use super::kind::{Build, JointKind};
use crate::ports::Ports;

/// Registry entry: the generic joint that locks only the rotation about the third axis.
pub const KIND: JointKind = JointKind {
    name: "perpendicular_axes",
    summary: "Keeps `axis`, fixed in the base, perpendicular to `second_axis`, fixed in the tip.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 1.0, 0.0]",
    parameters: &[],
    ports: Ports::TWO_AXES,
    build: Build::Relative(|_, _| Ok(locking([false, false, false, false, false, true]))),
};
