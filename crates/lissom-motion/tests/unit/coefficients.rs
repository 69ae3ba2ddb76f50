//! Tests of `coefficients`, a module of it.

use super::*;
use crate::wide::Wide;

/// `Σ_j (j+m)!/j! a_(j+m) xʲ` over extended precision: the `m`-th derivative of `Σ a_j xʲ`, where `a_j` is
/// `(-1)ʲ numerator(j)/(2j + k)!`.
fn long_series(x: f64, m: usize, k: usize, numerator: impl Fn(usize) -> f64) -> Wide {
    let mut inverse_factorial = Wide::new(1.0);
    let mut power = Wide::new(1.0);
    let mut sum = Wide::default();
    for n in 1..=k {
        inverse_factorial = inverse_factorial / Wide::new(n as f64);
    }
    for j in 0..120 {
        if j >= m {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let weight = Wide::new(sign * falling_product(j, m)) * Wide::new(numerator(j));
            sum = sum + weight * inverse_factorial * power;
            power = power * Wide::new(x);
        }
        inverse_factorial = inverse_factorial / Wide::new(((2 * j + k + 1) * (2 * j + k + 2)) as f64);
    }
    sum
}

/// Dense in `q` from underflow to beyond a whole turn, with values on both sides of every switch.
fn squares() -> Vec<f64> {
    let mut squares = vec![0.0, f64::MIN_POSITIVE, 1e-200, 1e-16, 1e-8, 1e-4];
    squares.extend((1..4000).map(|i| f64::from(i) * 0.0125));
    for switch in [TINY, SMALL, CLOSED_VALUES_FROM, CLOSED_SLOPES_FROM, CLOSED_FROM] {
        squares.extend([switch * (1.0 - f64::EPSILON), switch, switch * (1.0 + f64::EPSILON)]);
    }
    squares
}

/// Largest error of each derivative of `b` and `c`, relative to its own value and to `floor` of its value at 0.
fn worst_errors<const ORDERS: usize>(range: std::ops::Range<f64>, floor: f64) -> [f64; ORDERS] {
    let mut worst = [0.0_f64; ORDERS];
    for q in squares().into_iter().filter(|q| range.contains(q)) {
        let computed = exponential_coefficients::<f64, ORDERS>(q);
        for m in 0..ORDERS {
            for k in 0..2 {
                let reference = long_series(q, m, k + 2, |_| 1.0).value();
                let error = (Wide::new(computed[m][k]) - Wide::new(reference)).value().abs();
                worst[m] = worst[m].max(error / reference.abs().max(floor * SERIES[0][m][k].abs()));
            }
        }
    }
    worst
}

#[test]
fn exponential_coefficients_are_their_long_series() {
    let ranges =
        [(0.0..1.0, 3e-16), (1.0..9.0, 5e-16), (9.0..22.0, 2e-15), (22.0..39.0, 5e-14), (39.0..50.0, 2e-13)];
    for (range, tolerance) in ranges {
        let below = |errors: &[f64]| errors.iter().all(|&error| error < tolerance);
        assert!(below(&worst_errors::<1>(range.clone(), 1e-3)), "{range:?}");
        assert!(below(&worst_errors::<2>(range.clone(), 1e-3)), "{range:?}");
        assert!(below(&worst_errors::<3>(range.clone(), 1e-3)), "{range:?}");
        assert!(below(&worst_errors::<4>(range.clone(), 1e-3)), "{range:?}");
    }
}

#[test]
fn values_with_a_known_half_angle_are_the_same() {
    for q in squares() {
        let [values] = exponential_coefficients::<f64, 1>(q);
        assert_eq!(exponential_values(q, HalfAngle::from_square(q)), values, "{q}");
    }
}

#[test]
fn half_angle_is_on_the_circle() {
    for q in squares() {
        let half = HalfAngle::from_square(q);
        let one = half.cosine.powi(2) + q * half.sine_by_angle.powi(2);
        assert!((one - 1.0).abs() < 5e-16, "{q}: {one}");
        assert!((half.cosine - (0.5 * q.sqrt()).cos()).abs() < 3e-16, "{q}");
    }
}

#[test]
fn inverse_coefficients_agree_beyond_a_whole_turn() {
    for q in [45.0, POLES_UP_TO] {
        let (poles, closed) = (inverse_coefficients::<f64, 4>(q), inverse_closed_form::<4>(q));
        for m in 0..4 {
            assert!((poles[m] - closed[m]).abs() < 1e-12 * closed[m].abs(), "{poles:?} {closed:?}");
        }
    }
    assert!(inverse_coefficients::<f64, 4>(POLES[0]).iter().all(|value| value.is_finite()));
}

#[test]
fn inverse_coefficients_are_a_quotient_of_long_series() {
    // With h = q/4: e = (S_1(h) - S_0(h))/(q S_1(h)), and S_1 - S_0 = h Σ_j (-h)ʲ (2j + 2)/(2j + 3)!.
    let mut worst = [0.0_f64; 4];
    for q in squares().into_iter().filter(|&q| q < 0.99 * POLES[0]) {
        let h = 0.25 * q;
        let factor = [1.0, 1.0, 0.5, 1.0 / 6.0];
        let mut quotient = [Wide::default(); 4];
        let computed = inverse_coefficients::<f64, 4>(q);
        for m in 0..4 {
            let numerator = |j: usize| (2 * j + 2) as f64;
            let mut rest = long_series(h, m, 3, numerator) / Wide::new(falling_product(m, m));
            for i in 1..=m {
                let denominator = long_series(h, i, 1, |_| 1.0) / Wide::new(falling_product(i, i));
                rest = rest - denominator * quotient[m - i];
            }
            quotient[m] = rest / long_series(h, 0, 1, |_| 1.0);
            let reference = quotient[m] * Wide::new(falling_product(m, m) * 0.25 / 4.0_f64.powf(m as f64));
            let error = (Wide::new(computed[m]) - reference).value().abs() / reference.value();
            worst[m] = worst[m].max(error * (POLES[0] - q) / POLES[0] * factor[m]);
        }
    }
    assert!(worst.iter().all(|&error| error < 1e-15), "{worst:?}");
}
