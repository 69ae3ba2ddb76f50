//! A joint's gradient over an interval: linear in the increments, it gives exactly the change of the
//! equations, so that constraint forces do no work when violations do not change.
//!
//! ```text
//! B̄ = B + δ wᵀ / (w·σ),   δ = ΔC - B σ,   B̄ σ = ΔC            [after Gonzalez 1999]
//! ```
//!
//! with B the mean of three Gauss points, σ the increments and w their weighted relative part: zero for rigid motion.

use nalgebra::SVector;

use super::attached::{AttachedJoint, LOCAL, LocalGradient};
use super::{Equations, MOST_EQUATIONS, Own, Relative};
use crate::elements::interval::{ALONG, Interval, above_round_off};

/// Changes of violations are free of cancellation; this is their round-off [m, rad].
const ROUND_OFF: f64 = 1e-14;

/// Joints smaller than this have no size of their own [m].
const SMALLEST: f64 = 1e-6;

impl AttachedJoint {
    /// Mean gradient over `interval`, with rows that give `change` for its increments.
    pub fn mean_gradient(&self, interval: &Interval<'_>, change: &Equations) -> LocalGradient {
        let middle = self.on_the_way(interval, 0.5);
        let mut rows = LocalGradient::zeros();
        for (tau, weight) in ALONG {
            rows += weight * self.gradient_at(&self.on_the_way(interval, tau));
        }
        let mut increments = SVector::<f64, LOCAL>::zeros();
        for (side, frame) in self.frames.iter().enumerate() {
            increments.fixed_rows_mut::<6>(6 * side).copy_from(&interval.increments[frame.node]);
        }
        let mut square = 0.0;
        let mut weights = SVector::<f64, LOCAL>::zeros();
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            let change = interval.coordinate_increments[coordinate];
            increments[12 + k] = change;
            weights[12 + k] = change;
            square += change * change;
        }
        let variation = self.variation(&middle.0);
        let relative = variation * increments.fixed_rows::<12>(0);
        // Translations count in units of the joint's own size.
        let size = middle.0.position.norm()
            + self.frames.iter().map(|frame| frame.offset.position.norm()).sum::<f64>();
        let size = if size > SMALLEST { size } else { 1.0 };
        let mut weighted = relative;
        for k in 0..3 {
            weighted[k] /= size * size;
        }
        square += relative.dot(&weighted);
        let moved = variation.tr_mul(&weighted);
        for k in 0..12 {
            weights[k] += moved[k];
        }
        if square > 0.0 {
            let mut missed = SVector::<f64, MOST_EQUATIONS>::from_column_slice(change) - rows * increments;
            missed.apply(|value| *value *= above_round_off(value.abs(), ROUND_OFF));
            rows += missed * weights.transpose() / square;
        }
        rows
    }

    /// Relative motion and own coordinates on the way through an interval.
    fn on_the_way(&self, interval: &Interval<'_>, tau: f64) -> (Relative, Own) {
        let [base, tip] = self.frames.map(|frame| interval.frame(frame.node, tau) * frame.offset);
        let mut own = Own::default();
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            own.value[k] = interval.from.coordinates[coordinate].value
                + tau * interval.coordinate_increments[coordinate];
        }
        (Relative::at_start(&tip.relative_to(&base)), own)
    }
}
