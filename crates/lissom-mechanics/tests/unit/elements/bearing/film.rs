//! Tests of `elements::bearing::film`, a module of it.

use super::*;

/// ∫ sin u (cos u, sin u)/h³ du by the midpoint rule.
fn quadrature(a: f64, b: f64) -> [f64; 2] {
    let count = 200_000;
    let width = std::f64::consts::PI / f64::from(count);
    let mut sum = [0.0; 2];
    for k in 0..count {
        let (sine, cosine) = ((f64::from(k) + 0.5) * width).sin_cos();
        let weight = width * sine / (1.0 - a * cosine - b * sine).powi(3);
        sum[0] += weight * cosine;
        sum[1] += weight * sine;
    }
    sum
}

#[test]
fn closed_forms_are_the_integrals() {
    for (a, b) in [(0.0, 0.0), (0.4, 0.3), (-0.2, 0.7), (0.6, -0.5), (-0.9, 0.1), (0.05, -0.93)] {
        let (found, wanted) = (integrals(a, b), quadrature(a, b));
        for k in 0..2 {
            assert!(
                (found[k] - wanted[k]).abs() < 1e-7 * (1.0 + wanted[k].abs()),
                "{a} {b}: {found:?} {wanted:?}"
            );
        }
    }
}

/// Load and attitude of a journal at rest under a constant load [Ocvirk 1952]: along and across the eccentricity
/// κ s (2 ε²/(1 - ε²)²) and κ s π ε/(2 (1 - ε²)^(3/2)).
#[test]
fn a_journal_that_only_spins_has_the_forces_of_the_short_bearing() {
    let film = |is_full| Film { clearance: 1.0, factor: 1.0, is_full };
    for ratio in [0.1_f64, 0.5, 0.9] {
        let speed = 3.0;
        let rest = 1.0 - ratio * ratio;
        let radial = speed * 2.0 * ratio * ratio / rest.powi(2);
        let across = speed * std::f64::consts::FRAC_PI_2 * ratio / rest.powf(1.5);
        let [along, turned] = film(false).force([ratio, 0.0, 0.0, 0.0, speed]);
        assert!((along - radial).abs() < 1e-12 * radial, "{along} {radial}");
        assert!((turned.abs() - across).abs() < 1e-12 * across, "{turned} {across}");
        // A forward whirl is driven: the force on the bushing is opposite to that on the journal.
        assert!(turned < 0.0);
        let [along, turned] = film(true).force([ratio, 0.0, 0.0, 0.0, speed]);
        assert!(along.abs() < 1e-12 * radial && (turned + 2.0 * across).abs() < 1e-12 * across);
    }
}
