//! Bounds of an expression over intervals of its variable and its arguments, by interval arithmetic [Moore 1966]: never too
//! narrow except for round-off, and wider than necessary if one of them occurs more than once.

use std::f64::consts::{PI, TAU};

use lissom_mechanics::law::{EVERYTHING, Interval, hull, inverse, product, square, sum};

use super::jet::Function;
use super::noise;
use super::number::Number;

const TRUTH: Interval = [0.0, 1.0];

impl Number for Interval {
    fn constant(value: f64) -> Self {
        [value; 2]
    }

    fn plus(self, other: Self) -> Self {
        sum(self, other)
    }

    fn minus(self, other: Self) -> Self {
        valid([self[0] - other[1], self[1] - other[0]])
    }

    fn times(self, other: Self) -> Self {
        product(self, other)
    }

    fn over(self, other: Self) -> Self {
        product(self, inverse(other))
    }

    fn to_the(self, exponent: Self) -> Self {
        power(self, exponent)
    }

    fn square(self) -> Self {
        square(self)
    }

    fn of(self, function: Function) -> Self {
        valid(of_one(function, self))
    }

    fn of_two(self, function: Function, other: Self) -> Self {
        valid(of_two(function, self, other))
    }

    fn choose(self, one: Self, other: Self) -> Self {
        match self {
            [0.0, 0.0] => other,
            [low, high] if low > 0.0 || high < 0.0 => one,
            _ => [one[0].min(other[0]), one[1].max(other[1])],
        }
    }
}

/// What is not a number bounds nothing.
fn valid(bounds: Interval) -> Interval {
    if bounds[0] <= bounds[1] { bounds } else { EVERYTHING }
}

fn power(base: Interval, exponent: Interval) -> Interval {
    let [n, other] = exponent;
    if n != other {
        let logarithm = of_one(Function::Ln, base);
        return of_one(Function::Exp, product(exponent, logarithm));
    }
    if n < 0.0 {
        return inverse(power(base, [-n; 2]));
    }
    let ends = base.map(|value| value.powf(n));
    let is_even = n % 2.0 == 0.0;
    match base {
        // Even powers, and 0 of an exponent that is no whole number, are smallest there.
        [low, high] if is_even && low < 0.0 && high > 0.0 => [0.0, ends[0].max(ends[1])],
        _ => hull(&ends),
    }
}

fn of_one(function: Function, [low, high]: Interval) -> Interval {
    let ends = [low.of(function), high.of(function)];
    match function {
        Function::Sin => wave([low, high]),
        Function::Cos => wave([low + 0.5 * PI, high + 0.5 * PI]),
        // Between two poles it ascends.
        Function::Tan if ((low / PI + 0.5).floor() - (high / PI + 0.5).floor()).abs() > 0.0 => EVERYTHING,
        Function::Abs | Function::Cosh if low < 0.0 && high > 0.0 => [0.0.of(function), ends[0].max(ends[1])],
        // The others ascend, or descend, wherever they are defined.
        _ => hull(&ends),
    }
}

/// Bounds of the sine.
fn wave([low, high]: Interval) -> Interval {
    if !(low.is_finite() && high.is_finite()) || high - low >= TAU {
        return [-1.0, 1.0];
    }
    // Whether a point `peak` + 2π k lies between.
    let has = |peak: f64| ((high - peak) / TAU).floor() > ((low - peak) / TAU).floor();
    let [from, to] = hull(&[low.sin(), high.sin()]);
    [if has(-0.5 * PI) { -1.0 } else { from }, if has(0.5 * PI) { 1.0 } else { to }]
}

/// Bounds of atan2(u, v): those of the corners, unless the half-line at which it jumps meets the rectangle.
fn angle(u: Interval, v: Interval) -> Interval {
    let is_met = v[0] <= 0.0 && u[0] <= 0.0 && u[1] >= 0.0;
    if is_met {
        return [-PI, PI];
    }
    hull(&[u[0].atan2(v[0]), u[0].atan2(v[1]), u[1].atan2(v[0]), u[1].atan2(v[1])])
}

fn of_two(function: Function, u: Interval, v: Interval) -> Interval {
    let decided = |is_true: bool, is_false: bool| match (is_true, is_false) {
        (true, _) => [1.0; 2],
        (_, true) => [0.0; 2],
        _ => TRUTH,
    };
    match function {
        Function::Min => [u[0].min(v[0]), u[1].min(v[1])],
        Function::Max => [u[0].max(v[0]), u[1].max(v[1])],
        Function::Less => decided(u[1] < v[0], u[0] >= v[1]),
        Function::LessOrEqual => decided(u[1] <= v[0], u[0] > v[1]),
        Function::Greater => decided(u[0] > v[1], u[1] <= v[0]),
        Function::GreaterOrEqual => decided(u[0] >= v[1], u[1] < v[0]),
        Function::Hypot => {
            let [a, b] = [u, v].map(|side| of_one(Function::Abs, side));
            [a[0].hypot(b[0]), a[1].hypot(b[1])]
        }
        Function::Atan2 => angle(u, v),
        Function::Mod if v[0] == v[1] && (u[0] / v[0]).floor() == (u[1] / v[0]).floor() => {
            hull(&u.map(|value| value.rem_euclid(v[0])))
        }
        Function::Mod => [0.0, v[0].abs().max(v[1].abs())],
        Function::Random | Function::Normal if u[0] == u[1] && noise::is_one(v) => {
            [u[0].of_two(function, v[0]); 2]
        }
        Function::Random => TRUTH,
        Function::Normal => [-noise::MAX_NORMAL, noise::MAX_NORMAL],
        _ => EVERYTHING,
    }
}

#[cfg(test)]
#[path = "../../tests/unit/expression/bounds.rs"]
mod tests;
