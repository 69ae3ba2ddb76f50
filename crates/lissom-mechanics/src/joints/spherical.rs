//! Spherical joint: two nodes share a point and rotate freely about it.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Real, Screw, Triple};

use super::kind::{Build, JointKind};
use super::primitives::{POINT_EQUATIONS, coincident_change, coincident_wrench};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "spherical",
    summary: "The tip rotates freely about a common point of both nodes.",
    sample: "",
    parameters: &[],
    ports: Ports::POINT,
    build: Build::Relative(|_, _| Ok(Box::new(Spherical))),
};

/// A shared point.
#[derive(Clone, Copy, Debug)]
pub struct Spherical;

impl Joint for Spherical {
    const EQUATIONS: EquationCount = EquationCount { lengths: 3, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &POINT_EQUATIONS
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let [a, b, c] = coincident_change(increment);
        let zero = a.like(0.0);
        [a, b, c, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let wrench = coincident_wrench(increment, Triple::new(mu[0], mu[1], mu[2]));
        (wrench, [mu[0].like(0.0); MAX_COORDINATES])
    }
}
