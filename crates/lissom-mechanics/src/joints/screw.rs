//! Screw joint: the tip rotates about an axis of the base and moves along it by `lead` per revolution. The rotation
//! is an algebraic coordinate: x = (lead/2π) φ e₃ in the joint frame, R = Q(φ).

use std::f64::consts::TAU;

use super::kind::{Build, JointKind};
use super::product::{Product, Turn};
use super::{Coordinate, MAX_COORDINATES};
use crate::ports::Ports;
use crate::registry::ParameterType::Number;
use crate::registry::{ANGLE_AT_START, RATE_AT_START, required};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "screw",
    summary: "The tip rotates about an axis and moves along it in proportion; the rotation is a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]\nlead = 5e-3",
    parameters: &[
        required(
            "lead",
            Number,
            "m",
            "Displacement along `axis` per revolution; negative for a left-handed thread.",
        ),
        ANGLE_AT_START,
        RATE_AT_START,
    ],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(Screw { pitch: parameters.number("lead")? / TAU, angle: parameters.number("angle")? }))
    }),
};

/// A nut on a thread.
#[derive(Clone, Copy, Debug)]
pub struct Screw {
    /// Displacement per radian [m/rad].
    pitch: f64,
    /// Relative rotation at the start [rad].
    angle: f64,
}

impl Product for Screw {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const TURN: Turn = Turn::AboutThirdAxis;
    const SLIDE: Option<usize> = Some(0);

    fn values(&self) -> [f64; MAX_COORDINATES] {
        [self.angle, 0.0]
    }

    fn pitch(&self) -> Option<f64> {
        Some(self.pitch)
    }
}
