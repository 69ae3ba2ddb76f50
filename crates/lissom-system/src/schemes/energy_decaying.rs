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
#[path = "../../tests/unit/schemes/energy_decaying.rs"]
mod tests;
