//! Telescopic rod: a massless rod of variable length between two points, c = |x| - d - ℓ₀ + d₀. The displacement d is an algebraic
//! coordinate, so that drives, springs, stops, friction, latches and forces may act on it. Its multiplier is the tension.
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::kind::{Build, JointKind};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{Coordinate, EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::{DISPLACEMENT_AT_START, ParameterError, VELOCITY_AT_START};

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "telescopic_rod",
    summary: "A massless rod of variable length between two points, otherwise as `distance`; the displacement is a coordinate.",
    sample: "",
    parameters: &[DISPLACEMENT_AT_START, VELOCITY_AT_START],
    ports: Ports::TWO_LOCATIONS,
    build: Build::Relative(|parameters, geometry| {
        if geometry.span.norm() == 0.0 {
            return Err(ParameterError::new(
                "tip",
                "is at the same position as `base`: the rod has no direction",
            ));
        }
        Ok(Box::new(TelescopicRod { span: geometry.span, displacement: parameters.number("displacement")? }))
    }),
};

/// A rod of variable length between two points.
#[derive(Clone, Copy, Debug)]
pub struct TelescopicRod {
    /// From base to tip at the start [m].
    span: Vector3,
    /// d₀ [m].
    displacement: f64,
}

impl Joint for TelescopicRod {
    const COORDINATES: &'static [Coordinate] = &[Coordinate::displacement("displacement")];
    const EQUATIONS: EquationCount = EquationCount { lengths: 1, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &["distance"]
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([self.displacement, 0.0], Motion::new(Rotation::identity(), self.span))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        own: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        // |x| - |x₀| = Δ·(2 x - Δ)/(|x| + |x₀|), in the tip's axes
        let (place, change) = (increment.place, increment.place_change);
        let start = place - change;
        let lengths = place.dot(place).square_root() + start.dot(start).square_root();
        let elongation = change.dot(place + start) / lengths;
        let zero = elongation.like(0.0);
        [elongation - own.change[0], zero, zero, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        _: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let place = increment.place;
        let force = place * (mu[0] / place.dot(place).square_root());
        let zero = mu[0].like(0.0);
        (Screw::new(force, Triple::new(zero, zero, zero)), [-mu[0], zero])
    }
}
