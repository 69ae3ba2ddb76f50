//! Tests of `expression::formula`, a module of it.

use super::*;

fn parse(text: &str) -> Result<Formula, ExpressionError> {
    Formula::parse(text, &BTreeMap::from([("k".to_owned(), 200.0)]))
}

#[test]
fn names_are_arguments_and_derivatives_are_theirs() {
    let formula = parse("-k*(arm.rotation - 0.5*sin(t)) - 10*arm.rate^2 + arm.rotation*command").unwrap();
    let names: Vec<&str> = formula.arguments().iter().map(|name| name.text.as_str()).collect();
    assert_eq!(names, ["arm.rotation", "arm.rate", "command"]);
    let arguments = [0.3, -0.2, 1.5];
    let value = formula.value(0.7, &arguments, &[]);
    let wanted = -200.0 * (0.3 - 0.5 * 0.7_f64.sin()) - 10.0 * 0.04 + 0.3 * 1.5;
    assert!((value - wanted).abs() < 1e-13);
    let mut gradient = [0.0; 3];
    formula.gradient(0.7, &arguments, &[], &mut gradient);
    for (found, wanted) in gradient.iter().zip([-198.5, 4.0, 0.3]) {
        assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
    }
}

#[test]
fn functions_are_continued_from_known_sides() {
    let formula = parse("max(0, a) + 10*abs(b) + 100*step(a)").unwrap();
    assert_eq!(formula.switch_count(), 3);
    let (value, mut gradient) = (|sides: &[f64]| formula.value(0.0, &[2.0, -3.0], sides), [0.0; 2]);
    assert_eq!(value(&[]), 132.0);
    assert_eq!(value(&[0.0; 3]), 132.0);
    // 0 - a above zero: the contact has not begun; b is taken for positive.
    assert_eq!(value(&[1.0, 1.0, -1.0]), -30.0);
    formula.gradient(0.0, &[2.0, -3.0], &[1.0, 1.0, 1.0], &mut gradient);
    assert_eq!(gradient, [0.0, 10.0]);
    let mut switches = Vec::new();
    formula.switches(0.0, &[2.0, -3.0], &[1.0, 1.0, -1.0], &mut switches);
    assert_eq!(switches, [-2.0, -3.0, 2.0].map(Switch::from));
}

/// Beyond the switch of `max` a root of its argument is continued as an odd function; elsewhere it is not a number.
#[test]
fn roots_are_continued_beyond_switches() {
    for text in ["max(0, a)^1.5", "sqrt(max(0, a))^3", "if(a > 0, a^1.5, 7)"] {
        let (formula, mut gradient) = (parse(text).unwrap(), [0.0]);
        let above = if text.contains('>') { [1.0] } else { [-1.0] };
        for a in [-1e-14, -0.25, 0.25] {
            let value = formula.value(0.0, &[a], &above);
            let wanted = f64::abs(a).powf(1.5).copysign(a);
            assert!((value - wanted).abs() <= 1e-15 * wanted.abs(), "{text} at {a}: {value}");
            formula.gradient(0.0, &[a], &above, &mut gradient);
            let slope = 1.5 * f64::abs(a).sqrt();
            assert!((gradient[0] - slope).abs() <= 1e-12 * slope, "{text} at {a}: {gradient:?}");
        }
    }
    let negative = parse("max(0, a)*b^1.5").unwrap();
    assert!(negative.value(0.0, &[1.0, -1.0], &[-1.0]).is_nan());
}

/// Functions of three numbers fill the stack with the fewest steps.
#[test]
fn deep_expressions_have_a_stack_that_is_large_enough() {
    let mut text = "a".to_owned();
    for depth in 1..14 {
        text = format!("if(1 - a, {depth}, {text})");
        let formula = parse(&text).unwrap();
        assert_eq!(formula.value(0.0, &[1.0], &[]), 1.0, "{text}");
        assert_eq!(formula.value(0.0, &[0.5], &[]), f64::from(depth), "{text}");
    }
}

#[test]
fn a_name_is_not_a_function() {
    assert!(parse("tip.u1(3)").unwrap_err().message.contains("unknown function"));
    assert!(parse("a.").is_err());
    assert_eq!(parse("2*k").unwrap().arguments(), []);
}
