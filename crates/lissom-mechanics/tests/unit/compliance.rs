//! Tests of `compliance`, a module of it.

use super::{Compliance, relative_dissipation};

/// Penetrating, departing with a force, and departing so fast that the force vanishes.
#[test]
fn derivatives_of_damped_forces_are_those_of_differences() {
    let of = |depth, rate| Compliance { stiffness: 3.0, exponent: 1.5 }.damped_force(depth, rate, [0.2, 0.7]);
    let (depth, step) = (0.4, 1e-6);
    for (rate, is_pushing) in [(0.5, true), (-0.5, true), (-3.0, false)] {
        let [force, by_depth, by_rate] = of(depth, rate);
        let elastic = 3.0 * depth.powf(1.5);
        let wanted = (elastic * (1.0 + 0.2 * rate) + 0.7 * rate).max(0.0);
        assert!((force - wanted).abs() < 1e-12, "{rate}: {force}");
        assert_eq!(force > 0.0, is_pushing, "{rate}");
        let slopes = [
            (of(depth + step, rate)[0] - of(depth - step, rate)[0]) / (2.0 * step),
            (of(depth, rate + step)[0] - of(depth, rate - step)[0]) / (2.0 * step),
        ];
        assert!((slopes[0] - by_depth).abs() < 1e-8 && (slopes[1] - by_rate).abs() < 1e-8, "{rate}");
    }
}

#[test]
fn dissipation_follows_from_restitution() {
    for restitution in [0.05, 0.1, 0.5, 0.8, 0.99] {
        let a = relative_dissipation(restitution);
        let residual = a * (1.0 + restitution) - ((1.0 + a) / (1.0 - restitution * a)).ln();
        assert!(residual.abs() < 1e-9 * (1.0 + a) && a > 0.0, "{restitution}: {a} {residual:e}");
    }
    // 1/e, to all digits.
    assert!((relative_dissipation(0.01) - 100.0).abs() < 1e-9);
    // For small losses: 3 (1 - e)/2.
    assert!((relative_dissipation(0.999) - 1.5e-3).abs() < 5e-6);
    assert_eq!(relative_dissipation(1.0), 0.0);
}
