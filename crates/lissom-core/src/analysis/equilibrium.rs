//! Start from static equilibrium: places at which the model would stay at rest under its loads at the first instant.
//! Velocities that were given stay.

use std::sync::Arc;

use super::dynamics::{Settings, Simulation};
use super::initial::InitialError;
use crate::judge::Warning;
use crate::schemes::statics;
use crate::system::{State, System};

/// Moves the places of `state` into equilibrium, in one load step. Tells if it is unstable.
///
/// # Errors
/// If the load step has no solution, as where a part is not held.
pub fn at_rest(
    system: Arc<System>,
    state: State,
    settings: &Settings,
) -> Result<(Arc<System>, State, Option<Warning>), InitialError> {
    let mut moved = state.clone();
    // Loads act as they are at the end of the load step, which is the start of the motion.
    let step_size = 1.0;
    moved.kinematics.time -= step_size;
    for node in &mut moved.kinematics.nodes {
        node.twist.fill(0.0);
    }
    let settings =
        Settings { scheme: statics::statics(), step_size, from_equilibrium: false, ..settings.clone() };
    let mut simulation = Simulation::new(system, moved, settings)?;
    simulation.step().map_err(|error| InitialError::NoEquilibrium(Box::new(error)))?;
    let doubt =
        simulation.warnings().iter().find(|warning| matches!(warning, Warning::Unstable { .. })).cloned();
    let (system, reached) = simulation.into_parts();
    let mut state = state;
    for (node, reached) in state.kinematics.nodes.iter_mut().zip(&reached.kinematics.nodes) {
        node.frame = reached.frame;
    }
    for (own, reached) in state.kinematics.coordinates.iter_mut().zip(&reached.kinematics.coordinates) {
        own.value = reached.value;
    }
    state.position_remainders = reached.position_remainders;
    Ok((system, state, doubt))
}
