//! Tests of `schemes::radau_iia`, a module of it.

use super::*;
use crate::schemes::Combination;

#[test]
fn coefficients_are_those_of_the_literature() {
    let two = differentiation(&abscissae::<2>());
    let three = abscissae::<3>();
    let root = 6.0_f64.sqrt();
    for (found, wanted) in two.iter().flatten().zip([1.5, 0.5, -4.5, 2.5]) {
        assert!((found - wanted).abs() < 1e-14, "{two:?}");
    }
    for (found, wanted) in three.iter().zip([(4.0 - root) / 10.0, (4.0 + root) / 10.0, 1.0]) {
        assert!((found - wanted).abs() < 1e-15, "{three:?}");
    }
    // [Hairer and Wanner 1999, table of abscissae].
    for (found, wanted) in abscissae::<5>().iter().zip([
        0.057_104_196_114_517_68,
        0.276_843_013_638_123_8,
        0.583_590_432_368_916_8,
        0.860_240_135_656_219_4,
        1.0,
    ]) {
        assert!((found - wanted).abs() < 1e-15, "{found}");
    }
}

/// Powers up to the number of stages have exact derivatives at the stages.
#[test]
fn powers_have_exact_derivatives() {
    for scheme in [two_stages(), three_stages(), five_stages(), seven_stages()] {
        let count = scheme.stages.len();
        for power in 2..=count {
            let n = power as f64;
            let increments: Vec<f64> = scheme.stages.iter().map(|stage| stage.abscissa.powf(n)).collect();
            let combine = |c: &Combination| -> f64 {
                c.increments.iter().zip(&increments).map(|(weight, value)| weight * value).sum()
            };
            for stage in &scheme.stages {
                let rate = n * stage.abscissa.powf(n - 1.0);
                assert!((combine(&stage.velocity) - rate).abs() < 1e-11, "{} {power}", scheme.name);
                if power < count {
                    let curvature = n * (n - 1.0) * stage.abscissa.powf(n - 2.0);
                    let found = combine(&stage.acceleration);
                    assert!((found - curvature).abs() < 1e-9, "{} {power}: {found}", scheme.name);
                }
            }
        }
    }
}
