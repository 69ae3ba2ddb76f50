//! Velocity constraints in a linear model: rolling wheels and engaged latches.
//!
//! Legend: Λ impulses, coordinates without mass whose rates μ = Λ̇ are the forces, b rows of the velocity
//! constraints, η displacements.
//!
//! ```text
//! M η̈ + D η̇ + K η + bᵀ Λ̇ = 0,    b η̇ + N η = 0        ->        M η̈ + D η̇ + K η + bᵀ μ = 0
//! ```
//!
//! The forces are the unknowns instead of the impulses; otherwise each impulse would add two zero eigenvalues without a motion.
//! At rest N = 0, and b η̇ = 0 is replaced by b η = 0: earlier rolling of a wheel or sliding of a latch is a constant offset. So
//! the model remains symmetric, and its modes can be counted. A contact that rolls steadily has N ≠ 0 and both terms.

use super::model::LinearError;
use crate::system::{Linearization, System};

/// Replaces impulses by forces as unknowns.
pub(super) fn take_forces(system: &System, parts: &mut Linearization, is_at_rest: bool) {
    let pattern = system.pattern();
    for (impulse, _) in system.layout().impulses() {
        let others = || (0..pattern.size()).filter(|&other| other != impulse);
        let own = pattern.position(impulse, impulse);
        let is_open = own.is_some_and(|own| parts.damping[own] != 0.0);
        if let Some(own) = own.filter(|_| is_open) {
            // A latch that is open: μ = 0. The sign is that of a multiplier's pivot.
            (parts.stiffness[own], parts.damping[own]) = (-1.0, 0.0);
        }
        for position in others().filter_map(|row| pattern.position(row, impulse)) {
            let force = std::mem::take(&mut parts.damping[position]);
            if !is_open {
                parts.stiffness[position] += force;
            }
        }
        if is_at_rest {
            for position in others().filter_map(|column| pattern.position(impulse, column)) {
                parts.stiffness[position] += std::mem::take(&mut parts.damping[position]);
            }
        }
    }
}

/// Rejects velocity constraints, for analyses that consider positions only.
pub(super) fn refuse(system: &System) -> Result<(), LinearError> {
    if let Some(joint) = system.joints().iter().find(|joint| !joint.impulses.is_empty()) {
        return Err(LinearError::Rolls { joint: joint.name.clone() });
    }
    match system.layout().impulses().next() {
        None => Ok(()),
        Some((_, impulse)) => {
            let coordinate = system.layout().coordinate_name(impulse).to_owned();
            Err(LinearError::Latched { coordinate })
        }
    }
}
