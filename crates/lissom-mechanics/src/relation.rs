//! Equations between coordinates and time, which couple joints.

use std::fmt::Debug;

use crate::law::{Enclosure, Interval, ScalarLaw};

/// Maximum number of coordinates of a relation.
pub const MAX_COUPLED: usize = 16;

/// One value per coordinate; unused ones are zero.
pub type Coupled = [f64; MAX_COUPLED];

/// An instant: time [s] and coordinates [rad, m]; or a direction in both.
pub type RelationPoint<'a> = (f64, &'a [f64]);

/// An equation between coordinates and time.
pub trait Relation: Send + Sync + Debug {
    /// Value, and first and second derivative along a direction.
    fn jet(&self, at: RelationPoint<'_>, direction: RelationPoint<'_>) -> [f64; 3];

    /// Whether it depends explicitly on time. Default: it may.
    fn depends_on_time(&self) -> bool {
        true
    }

    /// Values of the first coordinate for which it was specified, if what is beyond was not chosen. Default: all.
    fn domain(&self) -> Option<Interval> {
        None
    }

    /// Bounds of the value over intervals of time [s] and of the coordinates. Default: none are known, and no features are
    /// searched for.
    fn bounds(&self, _time: Interval, _coordinates: &[Interval]) -> Option<Interval> {
        None
    }

    /// Bounds of the value and of its derivatives along a path, given those of time and of the coordinates. Default: none are known.
    fn enclosure(&self, _time: &Enclosure, _coordinates: &[Enclosure]) -> Option<Enclosure> {
        None
    }

    /// Change from one instant to another without cancellation, `elapsed` [s] and `change` later. Default: the
    /// difference of the values, or for small changes, where that is round-off, the integral of the derivative.
    fn change(&self, from: RelationPoint<'_>, elapsed: f64, change: &[f64]) -> f64 {
        let (time, start) = from;
        let at = |share: f64| {
            let mut there = Coupled::default();
            for (k, (start, change)) in start.iter().zip(change).enumerate() {
                there[k] = start + share * change;
            }
            self.jet((time + share * elapsed, &there[..start.len()]), (elapsed, change))
        };
        let slope = |x: f64| at(0.5 + 0.5 * x)[1];
        // Three Gauss points.
        let offset = 0.6_f64.sqrt();
        let integral = (5.0 * (slope(-offset) + slope(offset)) + 8.0 * slope(0.0)) / 18.0;
        let ([before, ..], [after, ..]) = (at(0.0), at(1.0));
        let difference = after - before;
        // Round-off of values, and that due to the rounding of their arguments.
        let by_arguments: f64 = (0..start.len())
            .map(|k| {
                let mut unit = Coupled::default();
                unit[k] = start[k];
                self.jet(from, (0.0, &unit[..start.len()]))[1].abs()
            })
            .sum();
        let by_time = self.jet(from, (time, &Coupled::default()[..start.len()]))[1].abs();
        let rounding = 4.0 * f64::EPSILON * (before.abs() + after.abs() + by_arguments + by_time);
        if (integral - difference).abs() <= rounding { integral } else { difference }
    }
}

impl ScalarLaw for &(dyn Relation + '_) {
    fn value(&self, time: f64, coordinates: &[f64]) -> f64 {
        let still = Coupled::default();
        self.jet((time, coordinates), (0.0, &still[..coordinates.len()]))[0]
    }

    fn bounds(&self, time: Interval, coordinates: &[Interval]) -> Option<Interval> {
        Relation::bounds(*self, time, coordinates)
    }

    fn enclosure(&self, time: &Enclosure, coordinates: &[Enclosure]) -> Option<Enclosure> {
        Relation::enclosure(*self, time, coordinates)
    }
}
