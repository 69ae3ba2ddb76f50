//! Distance: a massless rod of constant length between two points, c = (x·x - ℓ²) / (2 ℓ).
#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use lissom_motion::{Motion, Real, Rotation, Screw, Triple, Vector3, skew};

use super::kind::{Build, Frames, JointKind};
use super::moved::{Moved, OwnMoved};
use super::{
    Curvature, Equations, Gradient, Joint, MOST_COORDINATES, MOST_EQUATIONS, MOST_NUMBERS, Own, Relative,
};
use crate::registry::ParameterError;

/// Registry entry.
pub const KIND: JointKind = JointKind {
    name: "distance",
    summary: "Keeps the distance of two points: a massless rod with a ball at each end.",
    sample: "",
    parameters: &[],
    build: Build::Relative(Frames::Span, |_, geometry| {
        let length = geometry.span.norm();
        if length == 0.0 {
            return Err(ParameterError::new("tip", "is at the same place as `base`: the rod has no length"));
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
    const MOST: usize = 1;

    fn equations(&self) -> &'static [&'static str] {
        &["distance"]
    }

    /// One over the length.
    fn numbers(&self) -> [f64; MOST_NUMBERS] {
        let mut numbers = [0.0; MOST_NUMBERS];
        numbers[0] = 1.0 / self.length;
        numbers
    }

    fn initial(&self) -> ([f64; MOST_COORDINATES], Motion) {
        ([0.0; 2], Motion::new(Rotation::identity(), self.span))
    }

    fn violation(&self, relative: &Relative, _: &Own) -> Equations {
        let distance = relative.position.norm();
        let mut out = Equations::default();
        out[0] = (distance - self.length) * (distance + self.length) / (2.0 * self.length);
        out
    }

    #[inline(always)]
    fn violation_change<R: Real>(
        moved: &Moved<R>,
        _: &OwnMoved<R>,
        numbers: &[R; MOST_NUMBERS],
    ) -> [R; MOST_EQUATIONS] {
        // x·x - x₀·x₀ = Δ·(2 x - Δ), in the tip's axes
        let change = moved.place_change.dot(moved.place.scaled(2.0) - moved.place_change);
        let zero = change.like(0.0);
        [change * numbers[0].scaled(0.5), zero, zero, zero, zero, zero]
    }

    #[inline(always)]
    fn wrench<R: Real>(
        moved: &Moved<R>,
        _: &OwnMoved<R>,
        numbers: &[R; MOST_NUMBERS],
        mu: &[R; MOST_EQUATIONS],
    ) -> (Screw<R>, [R; MOST_COORDINATES]) {
        let force = moved.place * (mu[0] * numbers[0]);
        let zero = mu[0].like(0.0);
        (Screw::new(force, Triple::new(zero, zero, zero)), [zero; MOST_COORDINATES])
    }

    fn gradient(&self, relative: &Relative, _: &Own, out: &mut Gradient) {
        let row = relative.rotation.tr_mul(&relative.position) / self.length;
        out.relative.fixed_view_mut::<1, 3>(0, 0).copy_from(&row.transpose());
    }

    fn curvature(&self, relative: &Relative, _: &Own, mu: &Equations, out: &mut Curvature) {
        // δ(Rᵀ x) = η_u + (Rᵀ x)~ η_θ
        let factor = mu[0] / self.length;
        let turning = factor * skew(&relative.rotation.tr_mul(&relative.position));
        for i in 0..3 {
            out[(i, i)] += factor;
            for j in 0..3 {
                out[(i, 3 + j)] += turning[(i, j)];
            }
        }
    }
}
