//! Rigid link: two nodes at different positions move as one body.

use super::clamp::Clamp;
use super::kind::{Build, JointKind};
use crate::ports::Ports;

/// Registry entry. The joint frames of a clamp may be anywhere: here, at the tip node.
pub const KIND: JointKind = JointKind {
    name: "rigid_link",
    summary: "Connects two nodes at different positions by a massless rigid link.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Clamp))),
};
