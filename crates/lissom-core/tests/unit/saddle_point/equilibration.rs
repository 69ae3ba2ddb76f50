//! Tests of `saddle_point::equilibration`, a module of it.

use super::*;

#[test]
fn powers_are_those_next_to_the_inverse_root() {
    for exponent in -1000..1000 {
        for fraction in [1.0001, 1.3, 1.5, 1.9999] {
            let square = fraction * 2.0_f64.powi(exponent);
            let nearest = (-0.5 * square.log2()).round().exp2();
            assert_eq!(power_of_two(square), nearest, "{fraction} 2^{exponent}");
        }
    }
    for nothing in [0.0, -1.0, f64::INFINITY, f64::NAN, 1e-310] {
        assert_eq!(power_of_two(nothing), 1.0);
    }
}

#[test]
fn factors_are_the_nearest_powers_of_two() {
    for square in [1e-300, 3e-17, 0.4, 0.6, 1.1, 2.1, 3.9, 4.1, 7.9, 8.1, 5e9, 1e300] {
        let factor = power_of_two(square);
        let steps = (factor * square.sqrt()).log2().abs();
        assert!(steps <= 0.5 + 1e-12 && factor.log2().fract() == 0.0, "{square}: {factor}");
    }
    for nothing in [0.0, f64::INFINITY, f64::NAN, -1.0] {
        assert_eq!(power_of_two(nothing), 1.0);
    }
}

#[test]
fn units_do_not_show_in_the_equilibrated_tangent() {
    let pattern = Pattern::from_cliques(3, [&[0, 1, 2][..]]);
    let tangent = [4.0, 1.0, 0.5, 1.0, 9.0, 0.25, 0.5, 0.25, 0.0];
    let factors = [1024.0, 1.0 / 64.0, 16.0];
    let mut plain = tangent;
    let mut other: Vec<f64> = (0..9).map(|k| tangent[k] * factors[k / 3] * factors[k % 3]).collect();
    Equilibration::new(3, 2).apply(&pattern, &mut plain);
    Equilibration::new(3, 2).apply(&pattern, &mut other);
    assert_eq!(plain.as_slice(), other.as_slice());
    assert!(plain[..2].iter().chain(&plain[4..5]).all(|value| (0.1..=2.0).contains(value)), "{plain:?}");
}
