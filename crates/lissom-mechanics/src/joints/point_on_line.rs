//! Point on a line: the tip's point slides along a line of the base and the tip rotates freely. The displacement
//! along the line is an algebraic coordinate: x = d e₃ in the base's axes.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::base_axes::force_wrench;
use super::kind::{Build, JointKind};
use super::primitives::POINT_EQUATIONS;
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::{DISPLACEMENT_AT_START, VELOCITY_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "point_on_line",
    summary: "The tip's point slides along a line fixed in the base; the tip rotates freely; the displacement is a coordinate.",
    sample: "axis = [1.0, 0.0, 0.0]",
    parameters: &[DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::AXIS,
    build: Build::Relative(|parameters, _| {
        Ok(Box::new(PointOnLine { displacement: parameters.number("displacement")? }))
    }),
};

/// A point on a line.
#[derive(Clone, Copy, Debug)]
pub struct PointOnLine {
    /// Relative displacement at the start [m].
    displacement: f64,
}

impl Joint for PointOnLine {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::displacement("displacement")];
    const EQUATIONS: EquationCount = EquationCount { lengths: 3, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &POINT_EQUATIONS
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        let place = Motion::new(Rotation::identity(), self.displacement * Vector3::z());
        ([self.displacement, 0.0], place)
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        let Triple { x, y, z } = increment.position_change;
        let zero = x.like(0.0);
        [x, y, z - own.change[0], zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        (force_wrench(increment, Triple::new(mu[0], mu[1], mu[2])), [-mu[2], mu[2].like(0.0)])
    }
}
