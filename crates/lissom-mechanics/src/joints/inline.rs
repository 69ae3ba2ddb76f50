//! In-line: the tip's point remains on a line of the base, x·e₁ = x·e₂ = 0.

use super::generic::locking;
use super::kind::{Build, JointKind};
use crate::ports::Ports;

/// Registry entry: the generic joint that locks two translations. Unlike `point_on_line` it has no coordinate.
pub const KIND: JointKind = JointKind {
    name: "inline",
    summary: "The tip's point moves along a line fixed in the base; like `point_on_line`, but without a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[],
    ports: Ports::AXIS,
    build: Build::Relative(|_, _| Ok(locking([true, true, false, false, false, false]))),
};
