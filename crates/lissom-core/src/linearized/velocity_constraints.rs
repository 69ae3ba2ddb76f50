//! Constraints of velocities in a linear model: rolling wheels and engaged latches.
//!
//! Legend: μ forces, B rows of the constraints, η displacements, N = ∂(B v)/∂η.
//!
//! ```text
//! M η̈ + D η̇ + K η + Bᵀ μ = 0,    B η̇ + N η = 0
//! ```
//!
//! At rest N = 0, and B η̇ = 0 is replaced by B η = 0: earlier rolling of a wheel or sliding of a latch is a constant offset. So
//! the model remains symmetric, and its modes can be counted. A contact that rolls steadily has N ≠ 0 and both terms.

use super::model::LinearError;
use crate::system::{Linearization, System};

/// Moves the rows B from the constraints to the damping, for a moving state.
pub(super) fn move_to_rates(system: &System, parts: &mut Linearization) {
    let pattern = system.pattern();
    for row in system.layout().velocity_rows() {
        for position in pattern.column(row).iter().filter_map(|&column| pattern.position(row, column)) {
            parts.damping[position] = std::mem::take(&mut parts.constraint[position]);
        }
    }
}

/// Rejects constraints of velocities, for analyses that consider positions only.
pub(super) fn refuse(system: &System) -> Result<(), LinearError> {
    if let Some(joint) = system.joints().iter().find(|joint| joint.rolls()) {
        return Err(LinearError::Rolls { joint: joint.name.clone() });
    }
    let coordinate =
        |latch: &crate::joints::latch::Latch| LinearError::Latched { coordinate: latch.name.clone() };
    system.latches().first().map_or(Ok(()), |latch| Err(coordinate(latch)))
}
