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
#[path = "../../tests/unit/sections/shear.rs"]
mod tests;
