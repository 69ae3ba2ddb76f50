//! Velocities, accelerations and multipliers that agree with places, of motions that drives prescribe.
//!
//! A scheme holds the constraints themselves at the end of a step; what it leaves of their derivatives falls with the step in a
//! lower order, and with Radau IIA multipliers are of first order alone [Hairer and Wanner 1996, VII.4]. Steps are chosen by errors
//! of places. A place that drives prescribe has none, however long the step, so that nothing bounds what its velocities and
//! accelerations miss. They follow from the places, though:
//!
//! ```text
//! [M + hD, Bᵀ; B 0] [Δv; ·] = [0; -(B v + ∂c/∂t)],      [M Bᵀ; B 0] [v̇; λ] = [-f; -(Ḃ v + ∂²c/∂t²)]
//! ```
//!
//! The damping D over the step h keeps neighbours of a driven node in a damped beam together: with the mass alone, the change of
//! a light node would make a force in the damper beside it.

use super::initial_conditions::ConsistentInitialConditions;
use super::simulation::Simulation;
use crate::integrator::pivoting_unless_augmented;
use crate::system::{State, System};

/// Makes states of driven motions consistent, for what is recorded. The motion itself does not change.
pub struct ConsistentRates {
    initial: ConsistentInitialConditions,
}

impl ConsistentRates {
    /// Of a motion of rigid parts that may be driven: with drives, or relations, which may name the time. None where steps were given for a
    /// scheme that has forces of constraints of second order: their errors are those of its velocities.
    pub fn of(simulation: &Simulation) -> Option<Self> {
        let (system, settings) = (simulation.system(), simulation.settings());
        // Accelerations M⁻¹ f of light nodes of stiff beams would multiply what Newton's method leaves; their vibrations make steps short.
        let is_rigid = system.max_relative_rotation(&simulation.state().kinematics).is_none();
        let may_be_driven = system.may_have_driven_constraint();
        // With steps of a size that was given, all schemes but Radau IIA have forces of constraints of second order.
        let is_radau = settings.scheme.tableau.is_none() && settings.scheme.stages.len() > 1;
        let is_coarse = settings.control.is_some() || is_radau;
        let new = || {
            let solver = pivoting_unless_augmented(settings);
            ConsistentInitialConditions::repeated(
                system,
                simulation.state(),
                simulation.representative(),
                solver,
            )
        };
        (settings.scheme.dynamic && may_be_driven && is_rigid && is_coarse).then(|| Self { initial: new() })
    }

    /// The state with such rates, where a step of `step` [s] led to it; none where nothing drives it, where errors of positions show
    /// what rates miss, and where they are not found, as in a singular position.
    pub fn state(&mut self, system: &System, state: &State, step: f64) -> Option<State> {
        if !is_driven(system, state, step) {
            return None;
        }
        let mut consistent = state.clone();
        self.initial.rates(system, &mut consistent, step).ok()?;
        Some(consistent)
    }
}

/// Whether constraints depend on the time, at this instant or a step before or after, for their rate may pass through zero.
fn is_driven(system: &System, state: &State, step: f64) -> bool {
    let mut at = state.kinematics.clone();
    let now = at.time;
    [0.0, -1.0, 1.0].into_iter().any(|steps| {
        at.time = now + steps * step;
        system.has_driven_constraint(&at)
    })
}
