//! Statics: equilibrium without inertia and velocities at the end of each load step.

use super::scheme::{Combination, Coupling, Parametrization, Scheme, Stage, Weights};

/// The scheme with zero velocity and acceleration.
pub fn statics() -> Scheme {
    Scheme {
        name: "statics".to_owned(),
        stages: vec![Stage {
            abscissa: 1.0,
            velocity: Combination::default(),
            acceleration: Combination::default(),
            prediction: Combination::default(),
        }],
        algorithmic: Combination::default(),
        parametrization: Parametrization::FromStart,
        coupling: Coupling::single(Weights::AT_REST),
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
