//! Planar joint: the tip moves in a plane of the base and rotates about its normal, x·e₃ = 0 and R = Q(φ). The
//! rotation is an algebraic coordinate.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::base_axes::force_wrench;
use super::kind::{Build, JointKind};
use super::primitives::{JointRotation, elementary};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
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

impl Joint for Planar {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::rotation("angle")];
    const EQUATIONS: EquationCount = EquationCount { lengths: 1, angles: 3 };

    fn equations(&self) -> &'static [&'static str] {
        &["position 3", "rotation 1", "rotation 2", "rotation 3"]
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
        [increment.position_change.z, a, b, c, zero, zero]
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
        let (moment, own) = rotation.matches_moments(increment, Triple::new(mu[1], mu[2], mu[3]));
        let mut wrench = force_wrench(increment, Triple::new(zero, zero, mu[0]));
        wrench.rotation = wrench.rotation + moment;
        (wrench, own)
    }
}
