//! Spherical joint: two nodes share a point and rotate freely about it.

use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "spherical",
    summary: "The tip rotates freely about a common point of both nodes.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Spherical))),
};

/// A shared point.
#[derive(Clone, Copy, Debug)]
pub struct Spherical;

impl Product for Spherical {
    const TURN: Turn = Turn::Free;
}
