//! Tests of `schemes::generalized_alpha`, a module of it.

use super::*;
use crate::schemes::{Decoupled, StageSystem};

#[test]
fn constants_are_those_of_the_papers() {
    let scheme = hht(-0.3).expect("in range");
    let [StageSystem::Real(Decoupled { weights, .. })] = scheme.coupling.systems[..] else {
        panic!("one stage")
    };
    assert!((weights.velocity - 0.8 / 0.4225).abs() < 1e-14);
    assert!((weights.acceleration - 1.0 / (0.4225 * 0.7)).abs() < 1e-14);
    // A spectral radius of 1 is the trapezoidal rule.
    let scheme = with_spectral_radius(1.0).expect("in range");
    let [StageSystem::Real(Decoupled { weights, .. })] = scheme.coupling.systems[..] else {
        panic!("one stage")
    };
    assert!((weights.velocity - 2.0).abs() < 1e-14 && (weights.acceleration - 4.0).abs() < 1e-14);
}

#[test]
fn parameters_out_of_range_are_refused() {
    assert!(hht(-0.34).is_err() && hht(0.01).is_err() && hht(f64::NAN).is_err());
    assert!(with_spectral_radius(-0.1).is_err() && with_spectral_radius(1.1).is_err());
}
