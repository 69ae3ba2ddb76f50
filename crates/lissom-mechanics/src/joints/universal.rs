//! Universal joint: two nodes share a point; the tip rotates about an axis of the base, then about an axis of its
//! own. Both angles are algebraic coordinates.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Vector3};

use super::clamp::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, coincident, coincident_gradient, coincident_hessian};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{
    ConstraintHessian, Coordinate, Equations, Gradient, Joint, JointCoordinates, MAX_CONSTANTS,
    MAX_COORDINATES, MAX_EQUATIONS, Relative,
};
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

impl Joint for Universal {
    const COORDINATES: &'static [Coordinate] =
        &[Coordinate::rotation("first angle"), Coordinate::rotation("second angle")];

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn violation(&self, relative: &Relative, own: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)])
            .matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        JointRotation::about_first_and_second_axis(&own.angles).held_change(increment)
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        JointRotation::about_first_and_second_axis(&own.angles).held_wrench(increment, mu)
    }

    fn gradient(&self, relative: &Relative, own: &JointCoordinates, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)])
            .matches_gradient(relative, 3, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        own: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        coincident_hessian(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::about_first_and_second_axis(&[own.angle(0), own.angle(1)]).matches_hessian(
            relative,
            &Vector3::new(mu[3], mu[4], mu[5]),
            out,
        );
    }
}
