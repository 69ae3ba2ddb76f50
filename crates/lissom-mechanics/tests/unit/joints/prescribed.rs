//! Tests of `joints::prescribed`, a module of it.

use std::sync::Arc;

use super::*;
use crate::registry::TimeFunction;

#[derive(Debug)]
struct Sine;

impl TimeFunction for Sine {
    fn value(&self, time: f64) -> f64 {
        time.sin()
    }
    fn first_derivative(&self, time: f64) -> f64 {
        time.cos()
    }
    fn second_derivative(&self, time: f64) -> f64 {
        -time.sin()
    }
}

#[test]
fn short_changes_keep_their_digits_and_long_ones_are_exact() {
    let function: Function = Arc::new(Sine);
    let from = 0.7_f64;
    for exponent in 1..10 {
        let to = from + 10.0_f64.powi(-exponent);
        let width = to - from;
        // sin b - sin a = 2 cos((a + b)/2) sin((b - a)/2)
        let exact = 2.0 * (0.5 * (from + to)).cos() * (0.5 * width).sin();
        let change = function_change(&function, to, width);
        let allowed = if exponent < 3 { 1e-13 } else { 1e-15 };
        assert!((change - exact).abs() <= allowed * exact.abs().max(1e-2 * allowed), "{exponent}");
    }
}
