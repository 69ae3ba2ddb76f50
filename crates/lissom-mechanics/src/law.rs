//! Scalar laws: numbers that a model computes from time and from arguments that the motion determines, such as the force of a
//! spring over its elongation and rate, a signal over its measurements, or a relation over its coordinates. Step-size control
//! evaluates them between the stages of a step, and bounds their values by interval arithmetic [Moore 1966].

/// Lower and upper bound.
pub type Interval = [f64; 2];

/// If bounds over an interval exceed the values at its points by less than this fraction of the largest value, no feature is missed
/// between them. Otherwise the interval is bisected.
pub const NARROW_BOUNDS: f64 = 0.1;

/// Every number.
pub const EVERYTHING: Interval = [f64::NEG_INFINITY, f64::INFINITY];

/// Bounds of a function of a parameter σ, and of its first and second derivative, over an interval of σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure {
    /// Bounds of the value.
    pub value: Interval,
    /// Bounds of the first derivative.
    pub first: Interval,
    /// Bounds of the second derivative; every number where there may be a kink or a jump.
    pub second: Interval,
}

impl Enclosure {
    /// A constant, which is within these bounds.
    pub fn of_constant(value: Interval) -> Self {
        Self { value, first: [0.0; 2], second: [0.0; 2] }
    }

    /// A straight line between two values, with its slope.
    pub fn of_line(ends: Interval, slope: f64) -> Self {
        Self { value: hull(&ends), first: [slope; 2], second: [0.0; 2] }
    }

    /// Whether it is constant over the interval.
    pub fn is_constant(&self) -> bool {
        self.first == [0.0; 2] && self.second == [0.0; 2]
    }

    /// The chain rule, given bounds of f, f' and f'' where f is applied to it.
    pub fn through(&self, [f, f1, f2]: [Interval; 3]) -> Self {
        Self {
            value: f,
            first: product(f1, self.first),
            second: sum(product(f2, square(self.first)), product(f1, self.second)),
        }
    }

    /// u v.
    pub fn times(&self, other: &Self) -> Self {
        let value = product(self.value, other.value);
        let by = |constant: &Self, u: &Self| Self {
            value,
            first: product(constant.value, u.first),
            second: product(constant.value, u.second),
        };
        match [self.is_constant(), other.is_constant()] {
            [true, true] => Self::of_constant(value),
            [true, _] => by(self, other),
            [_, true] => by(other, self),
            _ => Self {
                value,
                first: sum(product(self.first, other.value), product(self.value, other.first)),
                second: sum(
                    sum(product(self.second, other.value), product(self.value, other.second)),
                    scaled(2.0, product(self.first, other.first)),
                ),
            },
        }
    }

    /// c u.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let Self { value, first, second } = *self;
        Self { value: scaled(factor, value), first: scaled(factor, first), second: scaled(factor, second) }
    }

    /// u + v.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            value: sum(self.value, other.value),
            first: sum(self.first, other.first),
            second: sum(self.second, other.second),
        }
    }
}

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

    /// Whether bounds of derivatives may be known: if not, they are not requested.
    fn has_enclosure(&self) -> bool {
        true
    }

    /// Bounds of the value and its derivatives along a path, given those of time and of the arguments. Default: none are known.
    fn enclosure(&self, _time: &Enclosure, _arguments: &[Enclosure]) -> Option<Enclosure> {
        None
    }
}

/// Receives a law with its arguments at a configuration.
pub type VisitLaw<'v> = dyn FnMut(&dyn ScalarLaw, &[f64]) + 'v;

/// The narrowest interval that contains these values; every number if one of them is none.
#[inline]
pub fn hull(values: &[f64]) -> Interval {
    let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
    for &value in values {
        if value.is_nan() {
            return EVERYTHING;
        }
        low = if value < low { value } else { low };
        high = if value > high { value } else { high };
    }
    [low, high]
}

/// Sum of two intervals.
pub fn sum(u: Interval, v: Interval) -> Interval {
    let [low, high] = [u[0] + v[0], u[1] + v[1]];
    // What is not a number bounds nothing.
    if low <= high { [low, high] } else { EVERYTHING }
}

/// Product of two intervals; zero times an infinite bound is zero.
pub fn product(u: Interval, v: Interval) -> Interval {
    let of = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
    hull(&[of(u[0], v[0]), of(u[0], v[1]), of(u[1], v[0]), of(u[1], v[1])])
}

/// Square of an interval.
pub fn square(u: Interval) -> Interval {
    let [low, high] = u.map(|value| value * value);
    if u[0] < 0.0 && u[1] > 0.0 { [0.0, low.max(high)] } else { hull(&[low, high]) }
}

/// Reciprocal of an interval; every number if it contains zero.
pub fn inverse(u: Interval) -> Interval {
    if u[0] > 0.0 || u[1] < 0.0 { [1.0 / u[1], 1.0 / u[0]] } else { EVERYTHING }
}

/// Product of a number and an interval; zero times an infinite bound is zero.
pub fn scaled(factor: f64, u: Interval) -> Interval {
    if factor == 0.0 { [0.0; 2] } else { hull(&u.map(|value| factor * value)) }
}
