//! Tests of `expression::bounds`, a module of it.

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
