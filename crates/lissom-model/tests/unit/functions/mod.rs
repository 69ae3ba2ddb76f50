//! Tests of `functions`, a module of it.

use std::collections::BTreeMap;

use super::*;

#[test]
fn a_constant_expression_becomes_a_constant() {
    let read = |text| of_expression(Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap());
    assert_eq!(format!("{:?}", read("2*3")), "Constant(6.0)");
    let drive = read("1.6*(1-cos(2*pi*t/1.6))");
    let rate = std::f64::consts::TAU / 1.6;
    // The tip-crank drive starts with the angular acceleration 1.6 (2π/1.6)² = 24.67 rad/s².
    assert!((drive.second_derivative(0.0) - 1.6 * rate * rate).abs() < 1e-12);
    assert!((drive.second_derivative(0.0) - 24.67).abs() < 5e-3);
    assert_eq!(drive.first_derivative(0.0), 0.0);
}
