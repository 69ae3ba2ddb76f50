//! Tests of `sections::shear`, a module of it.

use super::*;

#[test]
fn published_values() {
    let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-4, "{found} {wanted}");
    close(ShearTheory::Cowper.rectangle(1.0, 2.0, 0.3), 13.0 / 15.3);
    close(ShearTheory::Cowper.ring(0.0, 0.3), 7.8 / 8.8);
    // A thin tube: Cowper 2(1+ν)/(4+3ν), Renton 1/2 for any ν.
    close(ShearTheory::Cowper.ring(1.0, 0.3), 2.6 / 4.9);
    close(ShearTheory::Renton.ring(1.0, 0.3), 0.5);
    // Solid circle after Renton: 6(1+ν)²/(7+14ν+8ν²).
    close(ShearTheory::Renton.ring(0.0, 0.3), 6.0 * 1.69 / (7.0 + 4.2 + 0.72));
    // Without Poisson effect both agree with the parabola of elementary theory.
    close(ShearTheory::Renton.rectangle(1.0, 3.0, 0.0), 5.0 / 6.0);
    close(ShearTheory::Cowper.rectangle(1.0, 3.0, 0.0), 5.0 / 6.0);
    // Deep and narrow: no effect of Poisson's ratio.
    close(ShearTheory::Renton.rectangle(10.0, 0.1, 0.3), 5.0 / 6.0);
}

/// The energy by solving `∇²φ = y` on the rectangle |x| ≤ 1, |y| ≤ b with finite differences.
#[test]
fn the_series_is_the_energy_of_the_flexure_problem() {
    for b in [0.5, 1.0, 2.0] {
        let n = 60;
        let (dx, dy) = (2.0 / n as f64, 2.0 * b / n as f64);
        let mut phi = vec![vec![0.0; n + 1]; n + 1];
        for _ in 0..2500 {
            for i in 1..n {
                for j in 1..n {
                    let y = -b + dy * j as f64;
                    let x_part: f64 = (phi[i - 1][j] + phi[i + 1][j]) / (dx * dx);
                    let y_part: f64 = (phi[i][j - 1] + phi[i][j + 1]) / (dy * dy);
                    let next = (x_part + y_part - y) / (2.0 / (dx * dx) + 2.0 / (dy * dy));
                    // Successive over-relaxation.
                    phi[i][j] += 1.9 * (next - phi[i][j]);
                }
            }
        }
        let work: f64 = (1..n)
            .flat_map(|i| (1..n).map(move |j| (i, j)))
            .map(|(i, j)| -phi[i][j] * (-b + dy * j as f64) * dx * dy)
            .sum();
        // Times A/I² for unit force: A = 4b, I = 4b/3.
        let wanted = work * 4.0 * b / (4.0 * b / 3.0_f64).powi(2);
        let found = rectangle_breadth_effect(b);
        assert!((found / wanted - 1.0).abs() < 3e-3, "{b}: {found} {wanted}");
    }
}
