//! Scalar laws: numbers that a model computes from time and from arguments that the motion determines, such as the force of a
//! spring over its elongation and rate, a signal over its measurements, or a relation over its coordinates. Step-size control
//! evaluates them between the stages of a step, and bounds their values by interval arithmetic [Moore 1966].

/// Lower and upper bound.
pub type Interval = [f64; 2];

/// Every number.
pub const EVERYTHING: Interval = [f64::NEG_INFINITY, f64::INFINITY];

/// A scalar law of time and of arguments.
pub trait ScalarLaw {
    /// Value at `time` [s], on the side of each of its switches that the arguments determine.
    fn value(&self, time: f64, arguments: &[f64]) -> f64;

    /// Whether it has neither kinks nor jumps. Default: it has none.
    fn is_smooth(&self) -> bool {
        true
    }

    /// Bounds of the value over intervals of time [s] and of the arguments; none if none are known.
    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval>;
}

/// Receives a law with its arguments at a configuration.
pub type VisitLaw<'v> = dyn FnMut(&dyn ScalarLaw, &[f64]) + 'v;

/// The narrowest interval that contains these values; every number if one of them is none.
pub fn hull(values: &[f64]) -> Interval {
    if values.iter().any(|value| value.is_nan()) {
        return EVERYTHING;
    }
    let extend = |[low, high]: Interval, &value: &f64| [low.min(value), high.max(value)];
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], extend)
}

/// Sum of two intervals.
pub fn sum(u: Interval, v: Interval) -> Interval {
    [u[0] + v[0], u[1] + v[1]]
}

/// Product of a number and an interval; zero times an infinite bound is zero.
pub fn scaled(factor: f64, u: Interval) -> Interval {
    if factor == 0.0 { [0.0; 2] } else { hull(&u.map(|value| factor * value)) }
}
