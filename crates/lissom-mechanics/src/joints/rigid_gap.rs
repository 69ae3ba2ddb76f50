//! The penetration of two rigid solids that are apart, as a law of their relative position: steps that may miss a contact are shorter.
//!
//! Legend: g gap, x position and R rotation of the tip's frame in the base's.
//!
//! ```text
//! max(0, -g(x, R))
//! ```

use lissom_motion::{Matrix3, Vector3};

use crate::contact::gap::{MAX_ARGUMENTS, Pair};
use crate::law::{Enclosure, Interval, ScalarLaw, scaled, sum};

/// Of a contact that has not occurred yet, penetrations below a hundredth of this may be missed [m].
const SMALL_DEPTH: f64 = 1e-6;

/// The penetration of a pair.
pub(super) struct Penetration<'p> {
    pub(super) pair: &'p dyn Pair,
    /// Whether they are apart; otherwise there is no penetration.
    pub(super) is_apart: bool,
}

impl ScalarLaw for Penetration<'_> {
    fn value(&self, _: f64, arguments: &[f64]) -> f64 {
        if self.is_apart { (-self.pair.gap_at(arguments)).max(0.0) } else { 0.0 }
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn bounds(&self, _: Interval, arguments: &[Interval]) -> Option<Interval> {
        if !self.is_apart {
            return Some([0.0; 2]);
        }
        if arguments.iter().all(|ends| !ends[0].is_finite()) {
            return None;
        }
        if arguments.iter().flatten().any(|end| !end.is_finite()) {
            // The deepest penetration is not a measure of those of a motion.
            return Some([0.0, SMALL_DEPTH]);
        }
        let [low, high] = self.pair.range(arguments);
        Some([(-high).max(0.0), (-low).max(0.0)])
    }

    /// Of a point above a plane; the bounds of a separate pair's penetration are zero.
    fn has_enclosure(&self) -> bool {
        self.pair.is_linear()
    }

    fn enclosure(&self, _: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        if !self.is_apart {
            return Some(Enclosure::of_constant([0.0; 2]));
        }
        let ranges: [Interval; MAX_ARGUMENTS] =
            std::array::from_fn(|k| arguments.get(k).map_or([0.0; 2], |own| own.value));
        let [low, high] = self.pair.range(&ranges[..arguments.len()]);
        if low > 0.0 {
            return Some(Enclosure::of_constant([0.0; 2]));
        }
        if high >= 0.0 || !self.pair.is_linear() {
            return None;
        }
        let n = self.pair.gap(&Vector3::zeros(), &Matrix3::identity()).normal;
        let along = |of: fn(&Enclosure) -> Interval| {
            (0..3).fold([0.0; 2], |all, k| sum(all, scaled(-n[k], of(&arguments[k]))))
        };
        let (first, second) = (along(|own| own.first), along(|own| own.second));
        Some(Enclosure { value: [-high, -low], first, second })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pairs::PointOnSurface;
    use crate::contact::surfaces::{HalfSpace, Rod};
    use std::sync::Arc;

    /// Values of a box of positions are within the bounds.
    #[test]
    fn bounds_contain_all_values() {
        let rod = PointOnSurface { rounding: 0.1, surface: Arc::new(Rod { half_length: 0.0, radius: 0.2 }) };
        let plane = PointOnSurface { rounding: 0.1, surface: Arc::new(HalfSpace) };
        for pair in [&rod, &plane] {
            let law = Penetration { pair, is_apart: true };
            let ends = [[-0.3, 0.1], [0.0, 0.05], [-0.02, 0.3]];
            let [low, high] = law.bounds([0.0; 2], &ends).expect("they are known");
            for k in 0..1000 {
                let share = |factor: f64| (f64::from(k) * factor).fract();
                let at: [f64; 3] = std::array::from_fn(|i| {
                    ends[i][0] + share([0.754_877, 0.569_840, 0.430_159][i]) * (ends[i][1] - ends[i][0])
                });
                let value = law.value(0.0, &at);
                assert!(low <= value && value <= high, "{at:?}: {value} not in {low} … {high}");
            }
            assert!(law.value(0.0, &[0.0; 3]) > 0.0);
            let closed = Penetration { pair, is_apart: false };
            assert_eq!(closed.value(0.0, &[0.0; 3]), 0.0);
        }
    }
}
