//! Screw joint: the tip rotates about an axis of the base and moves along it by `lead` per revolution. The rotation
//! is an algebraic coordinate: x = (lead/2π) φ e₃ in the joint frame, R = Q(φ).
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use std::f64::consts::TAU;

use lissom_motion::{Motion, Real, Rotation, Screw as Wrench, Vector3};

use super::held::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, elementary};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
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

impl Joint for Screw {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let mut constants = [0.0; MAX_CONSTANTS];
        constants[0] = self.pitch;
        constants
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, self.pitch * self.angle * Vector3::z()))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let mut change = JointRotation::about_third_axis(&own.angles[0]).held_change(increment);
        change[2] = change[2].minus_product(constants[0], own.change[0]);
        change
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Wrench<R>, [R; MAX_COORDINATES]) {
        let (wrench, mut own) = JointRotation::about_third_axis(&own.angles[0]).held_wrench(increment, mu);
        own[0] = own[0].minus_product(constants[0], mu[2]);
        (wrench, own)
    }
}
