//! Revolute joint: two nodes share a point and an axis; the relative rotation about the axis is an algebraic
//! coordinate, which springs, drives and outputs can use.

use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, RATE_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "revolute",
    summary: "The tip rotates about an axis through a common point; the relative rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| Ok(Box::new(Revolute { angle: parameters.number("angle")? }))),
};

/// A shared point and axis.
#[derive(Clone, Copy, Debug)]
pub struct Revolute {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Product for Revolute {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const TURN: Turn = Turn::AboutThirdAxis;

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.angle, 0.0]
    }
}
