//! The force of a spring as a scalar law of the span Δ between its two points, and of the rate of the span. A span is smooth along a
//! motion where the distance |Δ| is not: at its zeros, and beside them. Two points that pass each other within a step are as far
//! apart at its ends as if they had never met; the range of the distance follows from those of the components of the span.
//!
//! ```text
//! ℓ = |Δ|,      ℓ̇ = Δ·Δ̇/ℓ,      |ℓ̇| ≤ |Δ̇|
//! ```

use lissom_motion::Vector3;

use super::force_law::ForceLaw;
use crate::law::{EVERYTHING, Enclosure, Interval, ScalarLaw, hull, inverse, product, scaled, square, sum};

/// The law of a spring between two points.
pub(super) struct LawOfDistance<'l> {
    pub(super) law: &'l ForceLaw,
    /// Free length [m].
    pub(super) length: f64,
}

/// Arguments: the components of the span [m], and their rates [m/s].
pub(super) fn arguments(span: &Vector3, rate: &Vector3) -> [f64; 6] {
    [span[0], span[1], span[2], rate[0], rate[1], rate[2]]
}

/// Sum over the components of a function of component k.
fn total(of: impl Fn(usize) -> Interval) -> Interval {
    (1..3).fold(of(0), |all, k| sum(all, of(k)))
}

fn root(u: Interval) -> Interval {
    u.map(f64::sqrt)
}

impl ScalarLaw for LawOfDistance<'_> {
    fn value(&self, time: f64, arguments: &[f64]) -> f64 {
        let (span, rate) =
            (Vector3::from_column_slice(&arguments[..3]), Vector3::from_column_slice(&arguments[3..]));
        let length = span.norm().max(f64::MIN_POSITIVE);
        self.law.value(time, &[length - self.length, span.dot(&rate) / length])
    }

    fn is_smooth(&self) -> bool {
        self.law.is_smooth()
    }

    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval> {
        let (span, rates) = arguments.split_at(3);
        let length = root(total(|k| square(span[k])));
        let fastest = total(|k| square(rates[k]))[1].sqrt();
        let rate = product(total(|k| product(span[k], rates[k])), inverse(length));
        let rate = hull(&[rate[0].max(-fastest), rate[1].min(fastest)]);
        // The force at any distance is bounded if that of any elongation is: the largest compression is not a measure of the forces
        // of a motion.
        let elongation =
            if length[1].is_finite() { length.map(|length| length - self.length) } else { EVERYTHING };
        self.law.bounds(time, &[elongation, rate])
    }

    fn enclosure(&self, time: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        let (span, rates) = arguments.split_at(3);
        let all = |of: &dyn Fn(usize) -> Enclosure| of(0).plus(&of(1)).plus(&of(2));
        let squared = |u: &Enclosure| u.through([square(u.value), scaled(2.0, u.value), [2.0; 2]]);
        let squares = all(&|k| squared(&span[k]));
        let length = root(squares.value);
        let one = inverse(length);
        let cube = product(one, square(one));
        let distance = squares.through([length, scaled(0.5, one), scaled(-0.25, cube)]);
        let rate = if self.law.depends_on_rate() {
            let fifth = product(cube, square(one));
            let reciprocal = squares.through([one, scaled(-0.5, cube), scaled(0.75, fifth)]);
            all(&|k| span[k].times(&rates[k])).times(&reciprocal)
        } else {
            Enclosure::of_constant(EVERYTHING)
        };
        self.law.enclosure(time, &[distance.plus(&Enclosure::of_constant([-self.length; 2])), rate])
    }
}

#[cfg(test)]
#[path = "../../tests/unit/elements/law_of_distance.rs"]
mod tests;
