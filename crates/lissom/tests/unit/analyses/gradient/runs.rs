//! Tests of `analyses::gradient::runs`, a module of it.

use super::*;

#[test]
fn smooth_measures_have_a_derivative() {
    let found = by_runs("x", 2.0, 1.0, &mut |x| Ok(x.sin())).unwrap();
    assert!((found.value - 2.0_f64.cos()).abs() < 1e-9, "{}", found.value);
    let still = by_runs("x", 2.0, 1.0, &mut |_| Ok(1.0)).unwrap();
    assert_eq!(still.value, 0.0);
}

#[test]
fn jumps_and_noise_have_none() {
    let refused = by_runs("x", 2.0, 1.0, &mut |x| Ok(if x > 2.0 { 1.0 } else { 0.0 }));
    assert!(matches!(refused, Err(GradientError::NotSmooth { .. })));
    let rough = by_runs("x", 2.0, 1.0, &mut |x| Ok((1e12 * x).sin()));
    assert!(matches!(rough, Err(GradientError::NotSmooth { .. })));
}
