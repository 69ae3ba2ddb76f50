//! Bounds of an expression over intervals of its variable and its arguments, by interval arithmetic [Moore 1966]: never too
//! narrow except for round-off, and wider than necessary if one of them occurs more than once.

use std::f64::consts::{PI, TAU};

use lissom_mechanics::law::{EVERYTHING, Interval, hull, inverse, product, square, sum};

use super::jet::Function;
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
        _ => EVERYTHING,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::super::Expression;

    fn bounds(text: &str, from: f64, to: f64) -> [f64; 2] {
        Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap().bounds(from, to)
    }

    #[test]
    fn bounds_are_those_of_the_function_where_the_variable_stands_once() {
        for (text, from, to, wanted) in [
            ("3 - 2*t", 0.0, 2.0, [-1.0, 3.0]),
            ("t^2", -1.0, 2.0, [0.0, 4.0]),
            ("t^3", -1.0, 2.0, [-1.0, 8.0]),
            ("t^-2", 1.0, 2.0, [0.25, 1.0]),
            ("2/t", -1.0, 1.0, [f64::NEG_INFINITY, f64::INFINITY]),
            ("sin(t)", 0.0, 2.0, [0.0, 1.0]),
            ("cos(t)", 3.0, 3.5, [-1.0, 3.5_f64.cos()]),
            ("sin(t)", 0.0, 100.0, [-1.0, 1.0]),
            ("tan(t)", 1.0, 2.0, [f64::NEG_INFINITY, f64::INFINITY]),
            ("abs(t)", -1.0, 0.5, [0.0, 1.0]),
            ("step(t - 1)", 0.0, 0.9, [0.0, 0.0]),
            ("mod(t, 1)", 2.25, 2.5, [0.25, 0.5]),
            ("mod(t, 1)", 2.25, 3.5, [0.0, 1.0]),
            ("clamp(t, -1, 1)", -3.0, 0.5, [-1.0, 0.5]),
            ("if(t > 1, 5, 2)", 0.0, 0.5, [2.0, 2.0]),
            ("if(t > 1, 5, 2)", 0.0, 1.5, [2.0, 5.0]),
            ("hypot(3, t)", -4.0, 1.0, [3.0, 5.0]),
            ("atan2(t, 1)", -1.0, 1.0, [-0.25 * PI, 0.25 * PI]),
            ("atan2(1, t)", -1.0, 1.0, [0.25 * PI, 0.75 * PI]),
            ("atan2(t, -1)", -1.0, 1.0, [-PI, PI]),
            ("0*exp(t)", 0.0, 1e4, [0.0, 0.0]),
            ("exp(-((t - 1)/1e-4)^2)", 0.0, 2.0, [0.0, 1.0]),
        ] {
            assert_eq!(bounds(text, from, to), wanted, "{text}");
        }
    }

    proptest! {
        #[test]
        fn no_value_is_beyond_them(from in -4.0_f64..4.0, size in 0.0_f64..3.0, part in 0.0_f64..1.0) {
            for text in [
                "t*sin(3*t) - cos(t^2)/(2 + sin(t))", "exp(-t^2)*t", "abs(t - 1)^1.5", "2^t - t^3 + 1/t", "atan2(t, 1 - t)",
                "mod(t, 0.7)*sign(t)", "sqrt(t) + ln(t + 5)", "hypot(t, 1 - t)", "acos(t/8)*cosh(t) - tanh(t)", "t^t",
                "smoothstep(t)*clamp(t, 0, 2) + min(t, t^2) - max(t, 1/t)", "if(t < 1, t, 3 - t)", "tan(t)*floor(3*t)",
            ] {
                let expression = Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap();
                let value = expression.jet(from + part * size).value;
                let [low, high] = expression.bounds(from, from + size);
                let slack = 1e-12 * (1.0 + value.abs());
                prop_assert!(value.is_nan() || (low - slack <= value && value <= high + slack), "{text}: {low} {value} {high}");
            }
        }
    }
}
