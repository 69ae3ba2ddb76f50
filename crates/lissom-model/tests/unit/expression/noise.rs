//! Tests of `expression::noise`, a module of it.

use super::*;

const COUNT: u32 = 100_000;

/// Mean, variance, and the correlation of neighbours.
fn moments(of: impl Fn(f64) -> f64) -> [f64; 3] {
    let all: Vec<f64> = (0..COUNT).map(|k| of(f64::from(k))).collect();
    let count = f64::from(COUNT);
    let mean = all.iter().sum::<f64>() / count;
    let variance = all.iter().map(|own| (own - mean).powi(2)).sum::<f64>() / count;
    let next = all.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum::<f64>() / count;
    [mean, variance, next / variance]
}

/// Within four standard deviations of the estimates.
#[test]
fn numbers_have_the_moments_of_their_distribution() {
    let allowed = 4.0 / f64::from(COUNT).sqrt();
    for seed in [0.0, 1.0, -7.0, 2.5] {
        let [mean, variance, next] = moments(|k| uniform(seed, k));
        assert!(
            (mean - 0.5).abs() < 0.29 * allowed && (variance - 1.0 / 12.0).abs() < 0.08 * allowed,
            "{seed}"
        );
        assert!(next.abs() < allowed, "{seed}: {next}");
        let [mean, variance, next] = moments(|k| normal(seed, k));
        assert!(mean.abs() < allowed && (variance - 1.0).abs() < 1.5 * allowed, "{seed}: {mean} {variance}");
        assert!(next.abs() < allowed, "{seed}: {next}");
    }
    let between = (0..COUNT).map(|k| (uniform(1.0, f64::from(k)) - 0.5) * (uniform(2.0, f64::from(k)) - 0.5));
    assert!((12.0 * between.sum::<f64>() / f64::from(COUNT)).abs() < allowed, "seeds depend on each other");
}

/// The numbers are part of the format of models: a run of last year must be repeated. They are those of another program, in Python.
#[test]
fn numbers_do_not_change() {
    let found = [uniform(1.0, 0.0), uniform(1.0, 1.0), uniform(-3.0, 1e9), normal(1.0, 0.0)];
    let known =
        [0.839_373_754_502_453_1, 0.259_458_925_230_147_4, 0.371_298_497_332_785, 0.476_277_695_435_303_3];
    // The last one is rounded by the library of the machine.
    assert_eq!(found[..3], known[..3]);
    assert!((found[3] - known[3]).abs() < 1e-15, "{}", found[3]);
    assert_eq!(uniform(0.0, -0.0), uniform(-0.0, 0.0));
    assert!(uniform(f64::NAN, 1.0).is_nan() && normal(1.0, f64::INFINITY).is_nan());
    assert!(normal(4.0, 2.0).abs() < MAX_NORMAL && (-2.0 * (0.5 * UNIT).ln()).sqrt() < MAX_NORMAL);
}
