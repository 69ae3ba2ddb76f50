//! The implicit Euler method. Of first order; it damps every vibration that steps do not resolve, and gains energy in none of them.
//!
//! ```text
//! v_{n+1} = v_n + h v̇_{n+1},      x_{n+1} = x_n + h v_{n+1},      R_{n+1} = R_n exp(h ω_{n+1})
//! ```
//!
//! Velocities are those in inertial axes: a part that spins in free flight keeps its momentum.

use super::scheme::{
    Combination, ContactSolution, Coupling, ErrorEstimate, Parametrization, Scheme, SchemeKind, Stage,
    Weights,
};

/// Registry entry.
pub const KIND: SchemeKind = SchemeKind {
    name: "backward-euler",
    summary: "Implicit Euler: first order, strongly damping; solves for all contacts of a step at once, for many parts that touch.",
    tolerance: Some(1e-6),
    contacts: ContactSolution::Set,
    parameters: &[],
    build: |_| Ok(backward_euler()),
};

/// The scheme.
pub fn backward_euler() -> Scheme {
    let increment = Combination::of_increments(&[1.0]);
    // Of the increment h² v̇ beyond the extrapolated position half is the error.
    let error = ErrorEstimate { combination: increment.times(0.5), order: 2, of_oscillation: 0.5 };
    Scheme {
        name: "backward-euler".to_owned(),
        stages: vec![Stage {
            abscissa: 1.0,
            velocity: increment,
            acceleration: increment,
            prediction: Combination::default(),
        }],
        algorithmic: Combination::default(),
        parametrization: Parametrization::Inertial,
        coupling: Coupling::single(Weights::of_motion(1.0, 1.0)),
        tableau: None,
        memory_delay: 0.0,
        order: 1,
        errors: vec![error],
        planned_share: 1.0,
        quadrature: Vec::new(),
        dense: None,
        dynamic: true,
    }
}
