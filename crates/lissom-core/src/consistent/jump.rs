//! Jumps of accelerations and multipliers where held values change between two steps.
//!
//! Legend: r left-hand sides of the equations of motion, g̈ accelerations of the violations, both before and after the change.
//!
//! ```text
//! [M Bᵀ; B 0] [Δa; Δλ] = -[Δr; Δg̈]
//! ```

use super::initial_conditions::{ConsistentInitialConditions, Inertias, without_accelerations};
use crate::errors::InitialError;
use crate::system::{State, System};

impl ConsistentInitialConditions {
    /// Jump of accelerations and multipliers, by row, at a change to the held values `held`. The rows of first-order states contain the
    /// change of their rates.
    ///
    /// # Errors
    /// If there are no consistent accelerations.
    pub(crate) fn acceleration_jump(
        &mut self,
        system: &System,
        state: &State,
        held: &[f64],
    ) -> Result<Vec<f64>, InitialError> {
        let mut after = state.clone();
        after.kinematics.held.copy_from_slice(held);
        if !system.sees_multipliers() {
            let mut jump = self.left_side(system, &state.kinematics, &state.multipliers);
            let left_side = self.left_side(system, &after.kinematics, &state.multipliers);
            jump.iter_mut().zip(&left_side).for_each(|(before, after)| *before -= after);
            self.solve_at(system, &after, &mut jump)?;
            return Ok(jump);
        }
        self.factor(system, state, Inertias::All)?;
        let mut at = without_accelerations(system.layout(), state);
        let before = self.repeated(system, at.clone())?;
        at.held.copy_from_slice(held);
        let mut jump = self.repeated(system, at)?;
        jump.iter_mut().zip(&before).for_each(|(after, before)| *after -= before);
        Ok(jump)
    }
}
