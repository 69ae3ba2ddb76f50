//! Point in plane: the tip's point remains in a plane of the base, x·e₃ = 0.

use super::generic::locking;
use super::kind::{Build, JointKind};
use crate::ports::Ports;

/// Registry entry: the generic joint that locks only the translation along the third axis.
pub const KIND: JointKind = JointKind {
    name: "point_in_plane",
    summary: "The tip's point moves in the base's plane perpendicular to `axis`; the tip rotates freely.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[],
    ports: Ports::AXIS,
    build: Build::Relative(|_, _| Ok(locking([false, false, true, false, false, false]))),
};
