//! Tests of `monitors::energy_drift`, a module of it.

use super::*;

/// Last estimate for a motion of amplitude 1 and energy 1 that has lost `lost` of it after a path `s`.
fn shift(lost: impl Fn(f64) -> f64) -> f64 {
    let mut drift = EnergyDrift { farthest: 1.0, ..EnergyDrift::default() };
    let shifts = (0..100_000).filter_map(|_| {
        drift.path += 0.5;
        drift.shift(lost(drift.path), 1.0)
    });
    shifts.last().unwrap()
}

#[test]
fn a_steady_loss_shifts_the_phase_and_a_damped_vibration_does_not() {
    let steady = shift(|path| 1e-9 * path);
    assert!((0.5..1.0).contains(&(steady / (0.25e-9 * 50_000.0_f64.powi(2)))), "{steady}");
    assert!(shift(|path| 0.1 * (1.0 - (-0.01 * path).exp())) < 1e-9);
}
