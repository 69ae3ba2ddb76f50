//! Distance: a massless rod of constant length between two points, c = (x·x - ℓ²) / (2 ℓ).

use lissom_motion::{Motion, Rotation, Vector3, skew};

use super::{
    Build, Curvature, Equations, Frames, Gradient, Joint, JointKind, MOST_COORDINATES, Own, Relative,
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
    fn equations(&self) -> &'static [&'static str] {
        &["distance"]
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

    fn violation_change(&self, relative: &Relative, _: &Own) -> Equations {
        // x·x - x₀·x₀ = Δ·(2 x - Δ)
        let change = &relative.position_change;
        let mut out = Equations::default();
        out[0] = change.dot(&(2.0 * relative.position - change)) / (2.0 * self.length);
        out
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
