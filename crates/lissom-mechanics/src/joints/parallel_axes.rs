//! Parallel axes: an axis of the tip remains parallel to one of the base, R = Q(φ). The rotation about it is an
//! algebraic coordinate; the tip's point moves freely.

use super::kind::{Build, JointKind};
use super::product::{Place, Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::{ANGLE_AT_START, RATE_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "parallel_axes",
    summary: "The tip rotates only about `axis` and translates freely; the relative rotation is a coordinate.",
    sample: "axis = [0.0, 0.0, 1.0]",
    parameters: &[ANGLE_AT_START, RATE_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| Ok(Box::new(ParallelAxes { angle: parameters.number("angle")? }))),
};

/// A shared direction.
#[derive(Clone, Copy, Debug)]
pub struct ParallelAxes {
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Product for ParallelAxes {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const PLACE: Place = Place::Free;
    const TURN: Turn = Turn::AboutThirdAxis;

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.angle, 0.0]
    }
}
