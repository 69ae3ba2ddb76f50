//! Relaxation: inertia resists each step, which starts from rest; velocities after it are zero.
//!
//! With zero velocity and q'' = z a step minimises ½ zᵀMz + V over the positions, V the potential [proximal point method,
//! Rockafellar 1976]. The potential decreases in every step, and a step without motion is an equilibrium. The inertia makes the
//! tangent definite where the stiffness is not, such as that of a slack cable.

use super::scheme::{Combination, Coupling, Scheme, Stage, Weights};
use super::statics::statics;

/// The scheme with zero velocity and the increment as acceleration.
pub fn relaxation() -> Scheme {
    let statics = statics();
    let acceleration = Combination::of_increments(&[1.0]);
    Scheme {
        name: "relaxation".to_owned(),
        stages: vec![Stage { acceleration, ..statics.stages[0] }],
        coupling: Coupling::single(Weights { acceleration: 1.0, ..Weights::AT_REST }),
        ..statics
    }
}
