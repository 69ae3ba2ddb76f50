//! Tests of `expression`, a module of it.

use proptest::prelude::*;

use super::*;

fn parse(text: &str) -> Result<Expression, ExpressionError> {
    let parameters = BTreeMap::from([("T".to_owned(), 1.6), ("rate".to_owned(), -2.0)]);
    Expression::parse(text, Some("t"), &parameters)
}

fn value(text: &str, t: f64) -> f64 {
    parse(text).unwrap().jet(t).value
}

/// Functions that are smooth together are so where their parts have kinks.
#[test]
fn parts_that_meet_have_derivatives_that_add_up() {
    for text in ["max(t - 1, 0) + min(t, 1)", "0.5*(abs(t - 1) + t + 1) - max(t - 1, 0) + max(t, 1) - 1"] {
        for t in [0.5, 1.0, 2.0] {
            let jet = parse(text).unwrap().jet(t);
            let wanted = if text.starts_with('m') { 1.0 } else { f64::from(u8::from(t > 1.0)) };
            let wanted = if t == 1.0 && !text.starts_with('m') { 0.5 } else { wanted };
            assert_eq!(jet.first, wanted, "{text} at {t}");
        }
    }
}

#[test]
fn precedence_is_that_of_mathematics() {
    for (text, wanted) in [
        ("-t^2", -9.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("-2^2", -4.0),
        ("1 - 2 - 3", -4.0),
        ("8/4/2", 1.0),
        ("2*-t", -6.0),
        ("2 + 3*4", 14.0),
        ("(2 + 3)*4", 20.0),
        ("1e-3*1E3", 1.0),
        (".5 + 1.", 1.5),
        ("--t", 3.0),
        ("rate*T", -3.2),
        ("rate^2", 4.0),
        ("min(t, 2) + max(t, 2, 5)", 7.0),
        ("step(t - 3) + step(2 - t)", 1.0),
        ("smoothstep(t) + smoothstep(-t) + smoothstep(0.5)", 1.5),
        ("atan2(1, -1)", 0.75 * std::f64::consts::PI),
        ("cbrt(-8) + hypot(3, 4) + sign(-2)", 2.0),
        ("clamp(t, 0, 2) + 10*clamp(-t, 0, 2) + 100*clamp(t, 0, 5)", 302.0),
        ("if(t > 2, 1, 5) + if(t >= 3, 10, 50) + if(t < 3, 100, 500) + if(t <= 3, 1000, 5000)", 1511.0),
        ("if(t - 3, sqrt(-1), 2) + 3*(1 < 2)", 5.0),
        ("mod(7.5, t) + mod(-1, t) + ceil(1.2) + round(2.6)", 8.5),
        ("abs(-t) + exp(ln(2)) + log10(100)", 7.0),
    ] {
        let found = value(text, 3.0);
        assert!((found - wanted).abs() < 1e-14 * wanted.abs().max(1.0), "{text}: {found}");
    }
}

#[test]
fn constants_are_found_and_folded() {
    assert_eq!(parse("2*pi/T").unwrap().constant(), Some(std::f64::consts::TAU / 1.6));
    assert_eq!(parse("t - t").unwrap().constant(), None);
    assert_eq!(parse("1-cos(2*pi*t/T)").unwrap().jet(0.0).value, 0.0);
}

#[test]
fn derivatives_are_finite_where_the_function_is_smooth() {
    for (text, first, second) in
        [("t^1", 1.0, 0.0), ("t^2", 0.0, 2.0), ("t^0", 0.0, 0.0), ("t^3", 0.0, 0.0), ("t*t^1", 0.0, 2.0)]
    {
        let jet = parse(text).unwrap().jet(0.0);
        assert_eq!((jet.first, jet.second), (first, second), "{text}");
    }
}

#[test]
fn kinks_are_found_where_arguments_are_straight_lines() {
    for (text, wanted) in [
        ("step(t - 3)", vec![3.0]),
        ("step(10 - 2*t)*sin(t) + abs(t/2 + 1)", vec![-2.0, 5.0]),
        ("smoothstep((t - 1)/4)", vec![1.0, 5.0]),
        ("min(2*t, 6) + max(t, T)", vec![1.6, 3.0]),
        ("sign(-(t - 2))*step(t - 2)", vec![2.0]),
        ("clamp(2*t, 2, 6) + if(t < 5, t, 5)", vec![1.0, 3.0, 5.0]),
        ("sin(t)*t^2 + step(1)", vec![]),
        // The root of a curved argument is not looked for.
        ("abs(sin(t))", vec![]),
    ] {
        let found = parse(text).unwrap().breakpoints();
        assert_eq!(found.len(), wanted.len(), "{text}: {found:?}");
        assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-14), "{text}: {found:?}");
    }
}

#[test]
fn errors_point_at_the_offender() {
    for (text, range, words) in [
        ("1 + * 2", 4..5, "expected a value"),
        ("(1 + t", 6..6, "parenthesis"),
        ("1 + t)", 5..6, "unexpected"),
        ("sin t", 4..5, "parenthes"),
        ("sin + 1", 4..5, "parenthes"),
        ("2t", 1..2, "unexpected"),
        ("t ** 2", 3..4, "expected a value"),
        ("x + 1", 0..1, "unknown name `x`"),
        ("foo(t)", 0..3, "unknown function `foo`"),
        ("atan2(1)", 0..8, "takes 2"),
        ("sin(1, 2)", 0..9, "takes 1"),
        ("1 $ 2", 2..3, "`$`"),
        ("3.5.2", 3..5, "unexpected"),
        ("1e", 0..2, "number"),
        ("", 0..0, "empty"),
        ("t(2)", 1..2, "unexpected"),
        ("é", 0..2, "`é`"),
    ] {
        let error = parse(text).unwrap_err();
        assert_eq!(error.range, range, "{text}: {error}");
        assert!(error.message.contains(words), "{text}: {error}");
    }
    assert!(parse("cso(t)").unwrap_err().help.unwrap().contains("cos"));
    assert!(parse(&"(".repeat(100_000)).is_err());
    assert!(parse(&"-".repeat(100_000)).is_err());
    assert!(parse(&format!("{}1", "1^".repeat(100_000))).is_err());
    assert!(parse(&format!("{}t", "t+".repeat(10_000))).is_ok());
}

const SMOOTH: [&str; 25] = [
    "sin(3*t) + t^3 - 2/t",
    "exp(-t^2)*cos(t/T)",
    "sqrt(t + 2)*ln(t + 1)",
    "tan(t/2) + tanh(t) - sinh(t)/cosh(t)^2",
    "asin(t/4) + acos(t/5) - atan(3*t)",
    "atan2(t, 1 + t^2)",
    "hypot(t, 2)",
    "cbrt(t)*log10(t)",
    "t^t",
    "2^t",
    "t^-1.5",
    "(t - 5)^3",
    "abs(t - 5)*t",
    "min(t^2, 100) + max(t^3, -1)",
    "smoothstep(t/4)",
    "asinh(t) + acosh(t + 1) + atanh(t/5)",
    "step(t)*t^2",
    "sin(cos(sin(t)))",
    "(1 + t)/(2 - t/8)^2",
    "rate^3*t^2",
    "sign(t)*t^2/(1 + t)",
    "-t^2/2 + floor(0.5)*t",
    "clamp(t^2, -1, 100)*t + clamp(t, t^2 + 10, 200)",
    "if(t > 0, sin(t), cos(t))*if(t^2 < 0, 1, t^3)",
    "mod(t^2, 50) + t*mod(40, t/t + 45)",
];

proptest! {
    #[test]
    fn jets_agree_with_differences(t in 0.3..3.0_f64, index in 0..SMOOTH.len()) {
        let expression = parse(SMOOTH[index]).unwrap();
        let h = 1e-4;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k: f64| expression.jet(t + k * h));
        let jet = expression.jet(t);
        // Fourth-order central differences of value and first derivative.
        let first = (a.value - 8.0 * b.value + 8.0 * c.value - d.value) / (12.0 * h);
        let second = (a.first - 8.0 * b.first + 8.0 * c.first - d.first) / (12.0 * h);
        prop_assert!((jet.first - first).abs() < 1e-8 * (1.0 + jet.first.abs()), "{}", SMOOTH[index]);
        prop_assert!((jet.second - second).abs() < 1e-8 * (1.0 + jet.second.abs()), "{}", SMOOTH[index]);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[-+*/^(), .0-9eEtTa-z]{0,40}") {
        if let Ok(expression) = parse(&text) {
            expression.jet(0.7);
        }
    }

    #[test]
    fn any_unicode_is_read_or_refused(text in any::<String>()) {
        if let Err(error) = parse(&text) {
            prop_assert!(text.get(error.range).is_some());
        }
    }
}
