//! Universal joint: two nodes share a point; the tip rotates about an axis of the base, then about an axis of its
//! own. Both angles are algebraic coordinates.

use super::Coordinate;
use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "universal",
    summary: "Two nodes share a point; two perpendicular axes, one fixed in each; both rotations are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]\nsecond_axis = [0.0, 1.0, 0.0]",
    parameters: &[],
    ports: Ports::TWO_AXES,
    build: Build::Relative(|_, _| Ok(Box::new(Universal))),
};

/// A shared point and a cross.
#[derive(Clone, Copy, Debug)]
pub struct Universal;

impl Product for Universal {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("first angle"), Coordinate::rotation("second angle")];
    const TURN: Turn = Turn::Cross;
}
