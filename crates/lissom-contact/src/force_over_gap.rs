//! The elastic normal force of a contact as a scalar law of positions: steps that may miss a contact are shorter. Solids that pass each
//! other within a step are as far apart at its ends as if they had never met; the range of the gap follows from those of its arguments.
//!
//! Legend: g gap, k stiffness, n exponent, n normal of a plane, r distance from the origin.
//!
//! ```text
//! f(g) = k max(0, -g)ⁿ
//! ```

use lissom_motion::{Matrix3, Vector3};

use crate::geometry::gap::Pair;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::law::{Enclosure, Interval, ScalarLaw, scaled, sum};

/// Depth [m]: penetrations below a hundredth of it may be missed in a contact that has not occurred yet.
const SMALL_DEPTH: f64 = 1e-6;

/// The law whose force is the penetration.
pub(crate) const PENETRATION: Compliance = Compliance { stiffness: 1.0, exponent: 1.0 };
/// That of a contact which cannot be missed.
pub(crate) const NOTHING: Compliance = Compliance { stiffness: 0.0, exponent: 1.0 };

/// A distance as a function of numbers.
pub(crate) trait Distance {
    /// Value of the distance.
    fn at(&self, arguments: &[f64]) -> f64;
    /// Bounds, given those of the arguments.
    fn range(&self, arguments: &[Interval]) -> Interval;
    /// n of g = n·x - r, if it is such a function of three numbers.
    fn slope(&self) -> Option<Vector3> {
        None
    }
}

impl Distance for &dyn Pair {
    fn at(&self, arguments: &[f64]) -> f64 {
        self.gap_at(arguments)
    }
    fn range(&self, arguments: &[Interval]) -> Interval {
        (**self).range(arguments)
    }
    /// Normal of the plane, for a point above a plane.
    fn slope(&self) -> Option<Vector3> {
        self.is_linear().then(|| self.gap(&Vector3::zeros(), &Matrix3::identity()).normal)
    }
}

/// The force over a gap.
pub(crate) struct ForceOverGap<G> {
    pub(crate) gap: G,
    pub(crate) compliance: Compliance,
}

impl<G: Distance> ForceOverGap<G> {
    fn force(&self, gap: f64) -> f64 {
        if gap < 0.0 { self.compliance.force(-gap, 0.0, 0.0)[0] } else { 0.0 }
    }
}

impl<G: Distance> ScalarLaw for ForceOverGap<G> {
    fn value(&self, _: f64, arguments: &[f64]) -> f64 {
        if self.compliance == NOTHING { 0.0 } else { self.force(self.gap.at(arguments)) }
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn bounds(&self, _: Interval, arguments: &[Interval]) -> Option<Interval> {
        if self.compliance == NOTHING {
            return Some([0.0; 2]);
        }
        if arguments.iter().all(|ends| !ends[0].is_finite()) {
            return None;
        }
        if arguments.iter().flatten().any(|end| !end.is_finite()) {
            // The force of the deepest penetration is not a measure of the forces of a motion.
            return Some([0.0, self.force(-SMALL_DEPTH)]);
        }
        let [low, high] = self.gap.range(arguments);
        Some([self.force(high), self.force(low)])
    }

    /// The bounds of the force of separate solids are zero.
    fn has_enclosure(&self) -> bool {
        self.gap.slope().is_some()
    }

    fn enclosure(&self, _: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        if self.compliance == NOTHING {
            return Some(Enclosure::of_constant([0.0; 2]));
        }
        let n = self.gap.slope()?;
        let [low, high] = self.gap.range(&[0, 1, 2].map(|k| arguments[k].value));
        if low > 0.0 {
            return Some(Enclosure::of_constant([0.0; 2]));
        }
        if high >= 0.0 {
            return None;
        }
        // In contact.
        let along = |of: fn(&Enclosure) -> Interval| {
            (0..3).fold([0.0; 2], |all, k| sum(all, scaled(n[k], of(&arguments[k]))))
        };
        let gap =
            Enclosure { value: [low, high], first: along(|own| own.first), second: along(|own| own.second) };
        let Compliance { stiffness, exponent } = self.compliance;
        let of = |power: f64, factor: f64| {
            let [one, other] = [-high, -low].map(|depth| factor * depth.powf(power));
            [one.min(other), one.max(other)]
        };
        let slope = of(exponent - 1.0, -stiffness * exponent);
        let bend = of(exponent - 2.0, stiffness * exponent * (exponent - 1.0));
        Some(gap.through([of(exponent, stiffness), slope, bend]))
    }
}

#[cfg(test)]
#[path = "../tests/unit/force_over_gap.rs"]
mod tests;
