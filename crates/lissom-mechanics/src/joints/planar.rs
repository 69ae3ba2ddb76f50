//! Planar joint: the tip moves in a plane of the base and rotates about its normal, x·e₃ = 0 and R = Q(φ). The
//! rotation is an algebraic coordinate.

use super::kind::{Build, JointKind};
use super::product::{Place, Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, RATE_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "planar",
    summary: "The tip translates in the plane perpendicular to `axis` and rotates about it; the rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| Ok(Box::new(Planar { angle: parameters.number("angle")? }))),
};

/// A shared plane.
#[derive(Clone, Copy, Debug)]
pub struct Planar {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Product for Planar {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const PLACE: Place = Place::Plane;
    const TURN: Turn = Turn::AboutThirdAxis;

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.angle, 0.0]
    }
}
