//! Relaxation: inertia resists each step, which starts from rest; velocities after it are zero.
//!
//! With zero velocity and q'' = z a step minimises ½ zᵀMz + V over the positions, V the potential [proximal point method,
//! Rockafellar 1976]. The potential decreases in every step, and a step without motion is an equilibrium. The inertia makes the
//! tangent definite where the stiffness is not, such as that of a slack cable.

use super::scheme::{Combination, Coupling, Parametrization, Scheme, Stage, Weights};

/// The scheme with zero velocity and the increment as acceleration.
pub fn relaxation() -> Scheme {
    Scheme {
        name: "relaxation".to_owned(),
        stages: vec![Stage {
            abscissa: 1.0,
            velocity: Combination::default(),
            acceleration: Combination::of_increments(&[1.0]),
            prediction: Combination::default(),
        }],
        algorithmic: Combination::default(),
        parametrization: Parametrization::FromStart,
        coupling: Coupling::single(Weights { acceleration: 1.0, ..Weights::AT_REST }),
        tableau: None,
        memory_delay: 0.0,
        order: 1,
        errors: Vec::new(),
        planned_share: 0.0,
        quadrature: Vec::new(),
        dense: None,
        dynamic: false,
    }
}
