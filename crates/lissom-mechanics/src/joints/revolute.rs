//! Revolute joint: two nodes share a point and an axis; the relative rotation about the axis is an algebraic
//! coordinate, which springs, drives and outputs can use.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, coincident, coincident_gradient, coincident_hessian, elementary};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{
    ConstraintHessian, Coordinate, Equations, Gradient, Joint, JointCoordinates, MAX_CONSTANTS,
    MAX_COORDINATES, MAX_EQUATIONS, Relative,
};
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

impl Joint for Revolute {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = lissom_motion::Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, Vector3::zeros()))
    }

    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_third_axis(&own.angle(0)).matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        JointRotation::about_third_axis(&own.angles[0]).held_change(increment)
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        JointRotation::about_third_axis(&own.angles[0]).held_wrench(increment, mu)
    }

    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_third_axis(&own.angle(0)).matches_gradient(relative, 3, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        coincident_hessian(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_third_axis(&own.angle(0)).matches_hessian(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
