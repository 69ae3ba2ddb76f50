//! Tests of `schemes::energy_decaying`, a module of it.

use num_complex::Complex64;

use super::*;

#[test]
fn coefficients_are_consistent_and_algebraically_stable() {
    for alpha in [0.0, 0.3, 1.0] {
        let t = tableau(alpha);
        let (a, b, c) = (t.stages, t.end, [1.0 / 3.0, 1.0]);
        let mut third = 0.0;
        for i in 0..2 {
            assert!((a[i][0] + a[i][1] - c[i]).abs() < 1e-15);
            let reached = b[0] * t.inverse[0][i] + b[1] * t.inverse[1][i];
            assert!((t.reached[i] - reached).abs() < 1e-14, "{alpha}");
            for j in 0..2 {
                let unit = a[i][0] * t.inverse[0][j] + a[i][1] * t.inverse[1][j];
                assert!((unit - f64::from(u8::from(i == j))).abs() < 1e-14);
                let m = b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j];
                let expected = if i == j { alpha / 16.0 } else { -alpha / 16.0 };
                assert!((m - expected).abs() < 1e-15, "{alpha}: {m}");
                third += b[i] * a[i][j] * c[j];
            }
        }
        assert!((third - 1.0 / 6.0).abs() < 1e-15, "third order");
    }
}

/// 1 + z bᵀ (1 - z A)⁻¹ 1.
fn amplification(alpha: f64, z: Complex64) -> Complex64 {
    let t = tableau(alpha);
    let m: [[Complex64; 2]; 2] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j)) - z * t.stages[i][j]));
    let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let first = (m[1][1] - m[0][1]) / determinant;
    let second = (m[0][0] - m[1][0]) / determinant;
    1.0 + z * (t.end[0] * first + t.end[1] * second)
}

#[test]
fn spectral_radius_is_one_when_preserving_and_vanishes_when_annihilating() {
    for frequency in [0.1, 1.0, 10.0, 1e3] {
        let z = Complex64::new(0.0, frequency);
        assert!((amplification(0.0, z).norm() - 1.0).abs() < 1e-12, "{frequency}");
        assert!(amplification(0.4, z).norm() < 1.0);
    }
    let stiff = Complex64::new(0.0, 1e6);
    assert!(amplification(1.0, stiff).norm() < 1e-5);
    for alpha in [0.2, 0.7] {
        let expected = (1.0 - alpha) / (1.0 + alpha);
        assert!((amplification(alpha, stiff).norm() - expected).abs() < 1e-5);
    }
}
