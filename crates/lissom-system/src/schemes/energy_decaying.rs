//! Energy-decaying scheme: a Runge-Kutta method that is algebraically stable [Burrage and Butcher 1979], applied
//! to velocities and strains as variables of their own.
//!
//! Legend: A, b Runge-Kutta coefficients, α dissipation, ρ spectral radius at infinite frequency:
//!
//! ```text
//! A = [5/12 -1/12; 3/4 1/4] - (1 - α) [1/24 -1/24; -1/8 1/8],   b = (3/4, 1/4),   c = (1/3, 1)
//! b_i a_ij + b_j a_ji - b_i b_j = α/16 [1 -1; -1 1] ≥ 0,        ρ = (1 - α)/(1 + α)
//! ```
//!
//! α = 1 is Radau IIA's matrix, α = 0 a symplectic one. On linear problems the family is that of the
//! time-discontinuous schemes [Bauchau and Theron 1996; Bauchau, Bottasso and Trainelli 2003]. The proof that the
//! energy never grows is in `docs/theory/energy-decaying.md`.

use super::collocation::collocation;
use super::scheme::{ContactSolution, Scheme, SchemeError, SchemeKind, Tableau, within};
use lissom_mechanics::registry::{ParameterType, unitless};

/// The energy is bounded for the exact solution of the equations: with 1e-9 a free beam gains 9e-12 of its energy in a step
/// of 0.1 ms.
const TOLERANCE: f64 = 1e-12;

/// Registry entry.
pub const KIND: SchemeKind = SchemeKind {
    name: "energy-decaying",
    summary: "Energy decaying: third order, energy never increases, damping set by the spectral radius.",
    tolerance: Some(TOLERANCE),
    contacts: ContactSolution::Elements,
    parameters: &[unitless(
        "spectral_radius",
        ParameterType::Between(0.0, 1.0),
        "Spectral radius at infinite frequency: 1 preserves energy, 0 annihilates.",
    )
    .or_number(0.0)],
    build: with_spectral_radius,
};

/// The scheme with spectral radius `rho` at infinite frequency: 1 preserves energy, 0 annihilates.
///
/// # Errors
/// If `rho` is outside 0 … 1.
pub fn with_spectral_radius(rho: f64) -> Result<Scheme, SchemeError> {
    let rho = within("spectral_radius", rho, (0.0, 1.0))?;
    let tableau = tableau((1.0 - rho) / (1.0 + rho));
    let name = format!("energy-decaying (spectral radius {rho})");
    let quadrature = Vec::new();
    let of_stages = collocation(name, [1.0 / 3.0, 1.0], tableau.inverse);
    Ok(Scheme { tableau: Some(tableau), quadrature, dense: None, ..of_stages })
}

/// The coefficients for dissipation α. det A = (1 + α)/12.
fn tableau(dissipation: f64) -> Tableau {
    let q = 1.0 - dissipation;
    let stages = [[5.0 / 12.0 - q / 24.0, -1.0 / 12.0 + q / 24.0], [0.75 + q / 8.0, 0.25 - q / 8.0]];
    let factor = 12.0 / (1.0 + dissipation);
    let inverse = [[1.5, 0.5], [-factor * stages[1][0], factor * stages[0][0]]];
    let beyond = 0.5 * q / (1.0 + dissipation);
    Tableau { stages, end: [0.75, 0.25], inverse, reached: [-3.0 * beyond, 1.0 + beyond], dissipation }
}

#[cfg(test)]
mod tests {
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
        let m: [[Complex64; 2]; 2] = std::array::from_fn(|i| {
            std::array::from_fn(|j| f64::from(u8::from(i == j)) - z * t.stages[i][j])
        });
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
}
