//! Tests of `expression::enclosure`, a module of it.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::super::Expression;

fn parse(text: &str) -> Expression {
    Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap()
}

#[test]
fn derivatives_are_bounded_where_nothing_switches() {
    let enclosure = parse("3*max(t - 1, 0) + 2*min(t, 1)").enclosure(1.5, 2.0);
    assert_eq!((enclosure.first, enclosure.second), ([3.0, 3.0], [0.0, 0.0]));
    for kinked in
        ["abs(t - 1.7)", "max(t, 1.7)", "if(t < 1.7, t, 2*t)", "floor(t*2)", "mod(t, 1.7)", "tan(t)"]
    {
        assert_eq!(parse(kinked).enclosure(1.5, 2.0).second, [f64::NEG_INFINITY, f64::INFINITY], "{kinked}");
    }
}

proptest! {
    #[test]
    fn no_derivative_is_beyond_them(from in -4.0_f64..4.0, size in 0.0_f64..1.5, part in 0.0_f64..1.0) {
        for text in [
            "t*sin(3*t) - cos(t^2)/(2 + sin(t))", "exp(-t^2)*t", "abs(t - 1)^1.5", "2^t - t^3 + 1/t", "atan2(t, 1 - t)",
            "mod(t, 0.7)*sign(t)", "sqrt(t) + ln(t + 5)", "hypot(t, 1 - t)", "acos(t/8)*cosh(t) - tanh(t)", "t^t",
            "smoothstep(t)*clamp(t, 0, 2) + min(t, t^2) - max(t, 1/t)", "if(t < 1, t, 3 - t)", "tan(t)*floor(3*t)",
            "asin(t/5) + atan(t) + sinh(t)", "asinh(t) + acosh(t + 6)*atanh(t/7) + log10(t + 8) + cbrt(t)",
            "t^-2 + (t + 5)^0.3", "abs(t)*step(t - 1)*round(t)", "hypot(t, 0)",
        ] {
            let expression = parse(text);
            let jet = expression.jet(from + part * size);
            let found = expression.enclosure(from, from + size);
            for (value, [low, high]) in
                [(jet.value, found.value), (jet.first, found.first), (jet.second, found.second)]
            {
                let slack = 1e-10 * (1.0 + value.abs());
                prop_assert!(value.is_nan() || (low - slack <= value && value <= high + slack), "{text}: {low} {value} {high}");
            }
        }
    }
}
