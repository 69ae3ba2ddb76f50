//! Generalized-α and HHT-α on Lie groups [Chung and Hulbert 1993; Hilber, Hughes and Taylor 1977; Arnold
//! and Brüls 2007; Brüls, Cardona and Arnold 2012].
//!
//! Legend: v velocity, v̇ acceleration, a the algorithmic acceleration, z increment.
//!
//! ```text
//! z = v_n + (½ - β) a_n + β a_{n+1},      v_{n+1} = v_n + (1 - γ) a_n + γ a_{n+1}
//! (1 - α_m) a_{n+1} + α_m a_n = (1 - α_f) v̇_{n+1} + α_f v̇_n
//! ```
//!
//! Equilibrium and constraints hold at the end of the step.

use super::scheme::{
    Combination, ContactSolution, Coupling, ErrorEstimate, Parametrization, Scheme, SchemeError, SchemeKind,
    Stage, Weights, within,
};
use lissom_mechanics::registry::{ParameterType, unitless};

/// Range of α in which HHT-α is unconditionally stable and of second order.
const ALPHAS: (f64, f64) = (-1.0 / 3.0, 0.0);

/// Registry entry of generalized-α.
pub const KIND: SchemeKind = SchemeKind {
    name: "generalized-alpha",
    summary: "Generalized-α: second order, numerical damping set by the spectral radius.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[unitless(
        "spectral_radius",
        ParameterType::Between(0.0, 1.0),
        "Spectral radius at infinite frequency.",
    )
    .or_number(0.8)],
    build: with_spectral_radius,
};

/// Registry entry of HHT-α.
pub const HHT_KIND: SchemeKind = SchemeKind {
    name: "hht",
    summary: "HHT-α: second order, numerical damping set by α in -1/3 … 0.",
    tolerance: None,
    contacts: ContactSolution::Elements,
    parameters: &[
        unitless("alpha", ParameterType::Between(ALPHAS.0, ALPHAS.1), "Numerical damping.").or_number(-0.1)
    ],
    build: hht,
};

/// Second order with the spectral radius `rho` in 0 … 1 at infinite frequency.
///
/// # Errors
/// If `rho` is out of range.
pub fn with_spectral_radius(rho: f64) -> Result<Scheme, SchemeError> {
    let rho = within("spectral_radius", rho, (0.0, 1.0))?;
    Ok(new(
        format!("generalized-alpha (spectral radius {rho})"),
        (2.0 * rho - 1.0) / (rho + 1.0),
        rho / (rho + 1.0),
    ))
}

/// HHT-α with `alpha` in -1/3 … 0.
///
/// # Errors
/// If `alpha` is out of range.
pub fn hht(alpha: f64) -> Result<Scheme, SchemeError> {
    let alpha = within("alpha", alpha, ALPHAS)?;
    Ok(new(format!("hht (alpha {alpha})"), 0.0, -alpha))
}

fn new(name: String, alpha_m: f64, alpha_f: f64) -> Scheme {
    // These two give second order and, for given (α_m, α_f), the largest damping of high frequencies.
    let gamma = 0.5 + alpha_f - alpha_m;
    let beta = 0.25 * (gamma + 0.5).powi(2);
    // a_{n+1} = (z - (½ - β) a_n) / β with the departure z = ψ - v_n
    let memory =
        Combination { algorithmic: -(0.5 - beta) / beta, ..Combination::of_increments(&[1.0 / beta]) };
    let old = Combination { algorithmic: 1.0, ..Combination::default() };
    let velocity = old.times(1.0 - gamma).plus(&memory.times(gamma));
    let acceleration = memory
        .times((1.0 - alpha_m) / (1.0 - alpha_f))
        .plus(&old.times(alpha_m / (1.0 - alpha_f)))
        .plus(&Combination { acceleration: -alpha_f / (1.0 - alpha_f), ..Combination::default() });
    let prediction = Combination { algorithmic: 0.5, ..Combination::default() };
    // Legend: j third derivative, a_n acceleration at t_n + α_m - α_f. The error of the prediction is β j, that of the scheme
    // (β - 1/6 + (α_m - α_f)/2) j.
    let of_oscillation = beta - 1.0 / 6.0 + 0.5 * (alpha_m - alpha_f);
    let missed = Combination::of_increments(&[1.0]).plus(&prediction.times(-1.0));
    let error = ErrorEstimate { combination: missed.times(of_oscillation / beta), order: 3, of_oscillation };
    Scheme {
        name,
        coupling: Coupling::single(Weights::of_motion(velocity.increments[0], acceleration.increments[0])),
        tableau: None,
        stages: vec![Stage { abscissa: 1.0, velocity, acceleration, prediction }],
        algorithmic: memory,
        parametrization: Parametrization::FromStart,
        memory_delay: alpha_m - alpha_f,
        order: 2,
        errors: vec![error],
        planned_share: 0.8,
        quadrature: Vec::new(),
        dense: None,
        dynamic: true,
    }
}

#[cfg(test)]
#[path = "../../tests/unit/schemes/generalized_alpha.rs"]
mod tests;
