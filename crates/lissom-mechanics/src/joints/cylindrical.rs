//! Cylindrical joint: the tip slides along an axis of the base and rotates about it. Rotation and displacement are
//! algebraic coordinates: x = d e₃ in the joint frame, R = Q(φ).

use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, DISPLACEMENT_AT_START, RATE_AT_START, VELOCITY_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "cylindrical",
    summary: "The tip slides along an axis and rotates about it; rotation and displacement are coordinates.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START, DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(Cylindrical {
            angle: parameters.number("angle")?,
            displacement: parameters.number("displacement")?,
        }))
    }),
};

/// A cylindrical joint.
#[derive(Clone, Copy, Debug)]
pub struct Cylindrical {
    /// Relative rotation at the start [rad].
    angle: f64,
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Product for Cylindrical {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("angle"), Coordinate::displacement("displacement")];
    const TURN: Turn = Turn::AboutThirdAxis;
    const SLIDE: Option<usize> = Some(1);

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.angle, self.displacement]
    }
}
