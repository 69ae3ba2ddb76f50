//! Start from static equilibrium: positions at which the model would remain at rest under its initial loads. Given velocities are kept.

use crate::kinematics::Subject;
use crate::round_off;
use std::sync::Arc;

use lissom_solver::SolverKind;

use super::relaxation::{may_help, relax};
use crate::errors::InitialError;
use crate::errors::Warning;
use crate::linearized::{LinearModel, has_forces};
use crate::scaling::Representative;
use crate::schemes::statics;
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::system::{State, System};

/// Initialises load steps. If loads act at once and are balanced by constraints only, the state is an equilibrium: its multipliers are
/// computed, reported, and included in the work. Otherwise returns the energy that the unbalanced forces release until equilibrium, by
/// the linear model [J].
pub(crate) fn hold_start(
    system: &System,
    state: &mut State,
    representative: &Representative,
    solver: &SolverKind,
) -> f64 {
    let is_at_rest = state.kinematics.coordinates.iter().all(|motion| motion.rate == 0.0);
    if is_at_rest && !has_forces(system, state, representative) {
        state.multipliers.fill(0.0);
        return 0.0;
    }
    let mut still = state.clone();
    for node in &mut still.kinematics.nodes {
        node.twist.fill(0.0);
    }
    let Ok(model) = LinearModel::of(system, &still, solver) else { return 0.0 };
    if model.imbalance() > round_off::EQUILIBRIUM
        || !model.multipliers().iter().all(|value| value.is_finite())
    {
        return model.released_energy();
    }
    state.multipliers.copy_from_slice(model.multipliers());
    0.0
}

/// Moves a motion's start into equilibrium if this is requested.
///
/// # Errors
/// As [`at_rest`], and if the equilibrium is not unique because a part can move freely.
pub(crate) fn start_at_rest(
    system: Arc<System>,
    state: State,
    settings: &Settings,
    warnings: &mut Vec<Warning>,
) -> Result<(Arc<System>, State), InitialError> {
    if !(settings.from_equilibrium && settings.scheme.dynamic) {
        return Ok((system, state));
    }
    let (system, state, doubts) = at_rest(system, state, settings)?;
    // The position of a free part, and whether it seems to be unstable, is determined by round-off.
    if let Some(free) = free_motion(&system, &state, settings.solver) {
        return Err(InitialError::Free { free });
    }
    warnings.extend(doubts);
    Ok((system, state))
}

/// Names of the parts that can move freely at the positions of `state`.
pub(super) fn free_motion(system: &System, state: &State, solver: &SolverKind) -> Option<Subject> {
    let mut still = state.clone();
    for node in &mut still.kinematics.nodes {
        node.twist.fill(0.0);
    }
    for coordinate in &mut still.kinematics.coordinates {
        coordinate.rate = 0.0;
    }
    LinearModel::of(system, &still, solver).ok()?.free_motion()
}

/// Moves the positions of `state` into equilibrium, in one load step or, if that has no solution, by relaxation. Warns if it is unstable,
/// and if it was found by relaxation.
///
/// # Errors
/// If neither finds one, for example because a part is not constrained.
pub fn at_rest(
    system: Arc<System>,
    state: State,
    settings: &Settings,
) -> Result<(Arc<System>, State, Vec<Warning>), InitialError> {
    let time = state.kinematics.time;
    let mut moved = state.clone();
    // Loads have their values at the end of the load step, which is the start of the motion.
    let step_size = 1.0;
    moved.kinematics.time -= step_size;
    for node in &mut moved.kinematics.nodes {
        node.twist.fill(0.0);
    }
    let settings = Settings {
        scheme: statics::statics(),
        step_size,
        control: None,
        from_equilibrium: false,
        ..settings.clone()
    };
    let mut simulation = Simulation::new(system, moved, settings.clone())?;
    simulation.origin.may_relax = false;
    let stepped = simulation.step();
    let doubts =
        simulation.warnings().iter().filter(|warning| matches!(warning, Warning::Unstable { .. })).cloned();
    let doubts = doubts.collect();
    let (system, reached) = simulation.into_parts();
    let (reached, doubts) = match stepped {
        Ok(_) => (reached, doubts),
        Err(error) => {
            let relaxed = may_help(&error, &system, &state, settings.solver)
                .then(|| relax(&system, &state, &settings, time, &mut 0))
                .flatten();
            relaxed.ok_or_else(|| match free_motion(&system, &state, settings.solver) {
                Some(free) => InitialError::Free { free },
                None => InitialError::NoEquilibrium(Box::new(error)),
            })?
        }
    };
    let mut state = state;
    for (node, reached) in state.kinematics.nodes.iter_mut().zip(&reached.kinematics.nodes) {
        node.frame = reached.frame;
    }
    for (own, reached) in state.kinematics.coordinates.iter_mut().zip(&reached.kinematics.coordinates) {
        own.value = reached.value;
    }
    state.position_remainders = reached.position_remainders;
    Ok((system, state, doubts))
}
