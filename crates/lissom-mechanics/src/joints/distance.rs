//! Distance: a massless rod of constant length between two points, c = (x·x - ℓ²) / (2 ℓ).
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3};

use super::kind::{Build, JointKind};
use super::relative_increment::{CoordinateIncrement, RelativeIncrement};
use super::{EquationCount, Joint, MAX_CONSTANTS, MAX_COORDINATES, MAX_EQUATIONS};
use crate::ports::Ports;
use crate::registry::ParameterError;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "distance",
    summary: "Keeps the distance of two points constant: a massless rod with spherical joints at its ends.",
    sample: "",
    parameters: &[],
    ports: Ports::TWO_LOCATIONS,
    build: Build::Relative(|_, geometry| {
        let length = geometry.span.norm();
        if length == 0.0 {
            return Err(ParameterError::new(
                "tip",
                "is at the same position as `base`: the rod has no length",
            ));
        }
        Ok(Box::new(Distance { span: geometry.span, length }))
    }),
};

/// A rod between two points.
#[derive(Clone, Copy, Debug)]
pub struct Distance {
    /// From base to tip at the start [m].
    span: Vector3,
    /// Length [m].
    length: f64,
}

impl Joint for Distance {
    const EQUATIONS: EquationCount = EquationCount { lengths: 1, angles: 0 };

    fn equations(&self) -> &'static [&'static str] {
        &["distance"]
    }

    /// The inverse of the length.
    fn constants(&self) -> [f64; MAX_CONSTANTS] {
        let mut constants = [0.0; MAX_CONSTANTS];
        constants[0] = 1.0 / self.length;
        constants
    }

    fn initial(&self) -> ([f64; MAX_COORDINATES], Motion) {
        ([0.0; 2], Motion::new(Rotation::identity(), self.span))
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
    ) -> [R; MAX_EQUATIONS] {
        // x·x - x₀·x₀ = Δ·(2 x - Δ), in the tip's axes
        let change = increment.place_change.dot(increment.place.scaled(2.0) - increment.place_change);
        let zero = change.like(0.0);
        [change * constants[0].scaled(0.5), zero, zero, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        increment: &RelativeIncrement<R>,
        _: &CoordinateIncrement<R>,
        constants: &[R; MAX_CONSTANTS],
        mu: &[R; MAX_EQUATIONS],
    ) -> (Screw<R>, [R; MAX_COORDINATES]) {
        let force = increment.place * (mu[0] * constants[0]);
        let zero = mu[0].like(0.0);
        (Screw::new(force, Triple::new(zero, zero, zero)), [zero; MAX_COORDINATES])
    }
}
