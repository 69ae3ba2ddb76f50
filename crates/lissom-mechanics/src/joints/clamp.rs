//! Clamp: two nodes, or a node and the ground, share position and rotation.

use super::kind::{Build, JointKind};
use super::product::Product;
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "clamp",
    summary: "Locks all six relative degrees of freedom.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Clamp))),
};

/// No relative motion.
#[derive(Clone, Copy, Debug)]
pub struct Clamp;

impl Product for Clamp {}
