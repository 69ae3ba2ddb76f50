//! Parallel axes: an axis of the tip remains parallel to one of the base, R = Q(φ). The rotation about it is an
//! algebraic coordinate; the tip's point moves freely.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::held::EQUATIONS;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, elementary};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
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

impl Joint for ParallelAxes {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const EQUATIONS: EquationCount = EquationCount { lengths: 0, angles: 3 };

    fn equations(&self) -> &'static [&'static str] {
        &EQUATIONS[3..]
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let rotation = Rotation::from_matrix(&elementary(2, self.angle));
        ([self.angle, 0.0], Motion::new(rotation, Vector3::zeros()))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let [a, b, c] = JointRotation::about_third_axis(&own.angles[0]).matches_change(increment);
        let zero = a.like(0.0);
        [a, b, c, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let zero = mu[0].like(0.0);
        let rotation = JointRotation::about_third_axis(&own.angles[0]);
        let (moment, own) = rotation.matches_moments(increment, Triple::new(mu[0], mu[1], mu[2]));
        (Screw::new(Triple::new(zero, zero, zero), moment), own)
    }
}
