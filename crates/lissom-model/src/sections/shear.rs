//! Shear coefficients: which part of the area carries the shear stiffness `k G A`.
//!
//! Cowper 1966 (The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33) averages displacements
//! of the elastic solution; Renton 1991 (Generalized beam theory applied to shear stiffness, Int. J. Solids
//! Struct. 27) equates the elastic energy of shear: `V²/(2kGA) = ∫ (τ₁² + τ₂²)/(2G) dA`.

use std::f64::consts::PI;

/// A theory of the shear coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShearTheory {
    /// Cowper 1966.
    Cowper,
    /// Renton 1991.
    Renton,
}

impl ShearTheory {
    /// Coefficient of a solid rectangle sheared along its side `depth`, with the other side `breadth`.
    pub(super) fn rectangle(self, depth: f64, breadth: f64, poisson: f64) -> f64 {
        let nu = poisson;
        match self {
            Self::Cowper => 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu),
            Self::Renton => {
                1.0 / (1.2 + (nu / (1.0 + nu)).powi(2) * rectangle_breadth_effect(breadth / depth))
            }
        }
    }

    /// Coefficient of a circular ring with `ratio` of inner to outer radius, 0 for the solid circle.
    pub(super) fn ring(self, ratio: f64, poisson: f64) -> f64 {
        let (m2, nu) = (ratio * ratio, poisson);
        let sum = (1.0 + m2).powi(2);
        match self {
            Self::Cowper => 6.0 * (1.0 + nu) * sum / ((7.0 + 6.0 * nu) * sum + (20.0 + 12.0 * nu) * m2),
            // The stress function of flexure between two circles,
            //   φ = (κr³/8 + g(a² + b²)r - g a²b²/r) sin θ + r³/(24I) sin 3θ,  κ = ν/((1+ν)I),
            //   g = (3+2ν)/(8I(1+ν)), for unit force, integrated over the ring.
            Self::Renton => {
                let solid = 7.0 + 14.0 * nu + 8.0 * nu * nu;
                let hole = 34.0 + 68.0 * nu + 32.0 * nu * nu;
                6.0 * (1.0 + nu).powi(2) * sum / (solid * (1.0 + m2 * m2) + hole * m2)
            }
        }
    }
}

/// The part of `1/k` that grows with Poisson's ratio, for `aspect` = breadth/depth.
///
/// With half sides a (depth) and b (breadth), St-Venant's flexure gives for unit force a stress function with
/// `∇²φ = ν/(1+ν) y/I`, zero on the border; its energy, by a double Fourier series, is
/// `(144/π⁶)(b/a)⁴ Σ_{m≥0, n≥1} 1/((2m+1)² n² [(2m+1)² (b/2a)² + n²])`. The sum over m is closed:
/// `Σ_m = (1/n²)[π²/8 - (π p/(4n)) tanh(πn/(2p))]`, p = b/(2a).
fn rectangle_breadth_effect(aspect: f64) -> f64 {
    let p = aspect / 2.0;
    let term = |n: u32| {
        let n = f64::from(n);
        (PI * PI / 8.0 - PI * p / (4.0 * n) * (PI * n / (2.0 * p)).tanh()) / n.powi(4)
    };
    let series: f64 = (1..=4000).rev().map(term).sum();
    144.0 / PI.powi(6) * aspect.powi(4) * series
}

#[cfg(test)]
mod tests {
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
}
