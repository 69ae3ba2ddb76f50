//! Tests of `functions::remembered`, a module of it.

use std::collections::BTreeMap;

use super::*;

fn read(text: &str) -> Remembered {
    Remembered::new(Expression::parse(text, Some("t"), &BTreeMap::new()).unwrap())
}

/// Many functions and times, which share slots.
#[test]
fn values_are_those_of_the_function_at_that_time() {
    let functions: Vec<Remembered> = (1..40).map(|k| read(&format!("{k}*t^3"))).collect();
    for _ in 0..2 {
        for i in 0..50 {
            let time = 0.1 * f64::from(i);
            for (k, function) in functions.iter().enumerate() {
                let factor = k as f64 + 1.0;
                let [value, first, second] = function.jet(time);
                assert_eq!(function.value(time), value);
                assert!((value - factor * time.powi(3)).abs() < 1e-9);
                assert!((first - 3.0 * factor * time.powi(2)).abs() < 1e-9);
                assert!((second - 6.0 * factor * time).abs() < 1e-9);
            }
        }
    }
}
