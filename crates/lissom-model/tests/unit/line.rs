//! Tests of `line`, a module of it.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;

fn circle() -> Line {
    let read = |text| Expression::parse(text, Some("s"), &BTreeMap::new()).unwrap();
    Line::Curve(Box::new([read("100*sin(pi/4*s)"), read("100*(1-cos(pi/4*s))"), read("0")]))
}

#[test]
fn an_arc_and_the_same_curve_agree() {
    let curve = circle();
    let arc = Line::arc(curve.position(0.0), curve.position(0.3), curve.position(1.0)).unwrap();
    for i in 0..=10 {
        let s = f64::from(i) / 10.0;
        assert!((arc.position(s) - curve.position(s)).norm() < 1e-10);
        assert!((arc.derivative(s) - curve.derivative(s)).norm() < 1e-10);
    }
    assert!((arc.length() - 25.0 * std::f64::consts::PI).abs() < 1e-10);
    assert!((curve.length() - arc.length()).abs() < 1e-9);
}

#[test]
fn an_arc_may_be_more_than_half_a_circle() {
    let (x, y) = (Vector3::x(), Vector3::y());
    let arc = Line::arc(x, -x, -y).unwrap();
    assert!((arc.length() - 1.5 * std::f64::consts::PI).abs() < 1e-12);
    assert_eq!(Line::arc(x, 2.0 * x, 3.0 * x), Err(NoCircle));
    assert_eq!(Line::arc(x, y, x), Err(NoCircle));
}

#[test]
fn default_up_avoids_the_line() {
    let to = |to| Line::Straight { from: Vector3::zeros(), to };
    assert_eq!(to(Vector3::x()).default_up(), Vector3::z());
    assert_eq!(to(Vector3::z()).default_up(), Vector3::y());
    assert!(to(Vector3::zeros()).fault().is_some());
    assert!(circle().fault().is_none());
}

proptest! {
    #[test]
    fn frames_are_rotations_that_lean_to_up(s in 0.0..1.0_f64, twist in -0.5..0.5_f64) {
        let up = Vector3::new(0.3, -0.2, 1.0);
        let frame = circle().frame(s, &up, twist);
        prop_assert!((frame.transpose() * frame - Matrix3::identity()).norm() < 1e-14);
        prop_assert!((frame.determinant() - 1.0).abs() < 1e-14);
        let untwisted = circle().frame(s, &up, 0.0);
        prop_assert!(untwisted.column(1).dot(&up).abs() < 1e-14 && untwisted.column(2).dot(&up) > 0.0);
        // Positive twist turns axis 2 towards axis 3.
        prop_assert!((untwisted.column(2).dot(&frame.column(1)) - twist.sin()).abs() < 1e-14);
    }
}
