//! Clamp: two nodes, or a node and the ground, share position and rotation.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Vector3};

use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, coincident, coincident_gradient, coincident_hessian};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{
    ConstraintHessian, Equations, Gradient, Joint, JointCoordinates, MAX_CONSTANTS, MAX_COORDINATES,
    MAX_EQUATIONS, Relative,
};
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "clamp",
    summary: "Locks all six relative degrees of freedom.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Clamp))),
};

/// No relative motion.
#[derive(Clone, Copy, Debug)]
pub struct Clamp;

pub(super) const EQUATIONS: [&str; 6] =
    ["position 1", "position 2", "position 3", "rotation 1", "rotation 2", "rotation 3"];

impl Joint for Clamp {
    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS
    }

    fn violation(&self, relative: &Relative, _: &JointCoordinates) -> Equations {
        let mut out = Equations::default();
        coincident(relative, 0, &mut out);
        JointRotation::none(0.0).matches(relative, 3, &mut out);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        JointRotation::none(increment.place.x).held_change(increment)
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        JointRotation::none(mu[0]).held_wrench(increment, mu)
    }

    fn gradient(&self, relative: &Relative, _: &JointCoordinates, out: &mut Gradient) {
        coincident_gradient(relative, 0, out);
        JointRotation::none(0.0).matches_gradient(relative, 3, out);
    }

    fn constraint_hessian(
        &self,
        relative: &Relative,
        _: &JointCoordinates,
        mu: &Equations,
        out: &mut ConstraintHessian,
    ) {
        coincident_hessian(relative, &Vector3::new(mu[0], mu[1], mu[2]), out);
        JointRotation::none(0.0).matches_hessian(relative, &Vector3::new(mu[3], mu[4], mu[5]), out);
    }
}
