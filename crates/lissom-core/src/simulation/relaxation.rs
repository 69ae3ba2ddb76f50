//! Relaxation: computes an equilibrium if Newton's method fails, by steps of increasing length that are damped by inertia, each from
//! rest.
//!
//! A cable without tension has nearly no transverse stiffness, so that the first correction of a load step is far too large however
//! small the load. Steps of [`relaxation`] decrease the energy instead, under the loads and drives of one instant, until a step without
//! inertia ends near its start.

use std::sync::Arc;

use lissom_solver::SolverKind;

use super::equilibrium::free_motion;
use crate::elements::{LimitKind, Validity};
use crate::errors::StepError;
use crate::errors::Warning;
use crate::errors::step_error::LOADS_BEFORE_DRIVES;
use crate::errors::warn;
use crate::kinematics::Kinematics;
use crate::newton::JacobianState;
use crate::scaling::Representative;
use crate::schemes::relaxation::relaxation;
use crate::schemes::statics;
use crate::settings::Problem;
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::solver_features::SolverFeature;
use crate::system::{State, System};
use crate::tuning::MAX_ITERATIONS;

/// Maximum number of steps.
const MAX_STEPS: usize = 300;
/// Displacement of a step, relative to the representative length, below which one without inertia is tried.
const SHORT_STEP: f64 = 0.03;
/// Largest displacement of that step if it is the equilibrium.
const SETTLED_LENGTH: f64 = 0.1;
/// A failed step without inertia is repeated if steps have become longer by this factor, or after this number of steps: it is as
/// expensive as several others, and fails as long as inertia and not the stiffness limits the steps.
const RETRY_LENGTH: f64 = 4.0;
const RETRY_STEPS: usize = 16;
/// Displacement of a model that is not constrained, relative to the representative length.
const MAX_TRAVEL: f64 = 1e3;
/// The first step, in units of the time √(m/k) of the stiffest parts.
const FIRST: f64 = 10.0;
/// Maximum number of iterations of a step before it is shortened.
const ITERATIONS: usize = 15;

/// Whether relaxation may find the equilibrium after a load step with this failure.
pub(crate) fn may_help(error: &StepError, system: &System, state: &State, solver: &SolverKind) -> bool {
    match error {
        StepError::NotConverged { .. } | StepError::NotFinite { .. } | StepError::TurnsTooFar { .. } => true,
        // Nothing resists ropes without tension: inertia holds what hangs on them until they are taut. Other mechanisms are rejected;
        // what bends may be singular in an iterate far from the start without being one.
        StepError::ZeroPivot { .. } => {
            let at = [&state.kinematics; 2];
            let is_rope = |own: &dyn Validity| own.limit(LimitKind::Slack, at).is_some();
            system.elements_with_limit(LimitKind::Slack).any(is_rope)
                || system.elements_with(|own| own.deformation).next().is_some()
                    && free_motion(system, state, solver).is_none()
        }
        _ => false,
    }
}

/// The equilibrium of lower energy near the positions of `state`, under the loads and drives at `time` [s], and its warnings; none if it
/// is not found. Adds Newton's iterations to `iterations`.
pub(crate) fn relax(
    system: &Arc<System>,
    state: &State,
    settings: &Settings,
    time: f64,
    iterations: &mut usize,
) -> Option<(State, Vec<Warning>)> {
    let mut settings =
        Settings { scheme: relaxation(), control: None, from_equilibrium: false, ..settings.clone() };
    // A shorter step is cheaper than iterations of a long one that do not converge, and than its subdivision.
    settings.limits.max_iterations = settings.limits.max_iterations.min(ITERATIONS);
    settings.limits.disabled = settings.limits.disabled.and(SolverFeature::StepBisection);
    let mut reached = state.clone();
    let mut failures = 0;
    let unloaded = system.linearization_at(&state.kinematics);
    let representative = Representative::of(system, &state.kinematics, &unloaded);
    let length = representative.length;
    let shortest = (representative.mass / representative.stiffness).sqrt();
    let mut step_size = if shortest.is_finite() && shortest > 0.0 { FIRST * shortest } else { 1e-3 };
    // Index and size of the next step after which one without inertia is tried.
    let (mut next_try, mut long_enough) = (0, 0.0);
    for step in 0..MAX_STEPS {
        settings.scheme = relaxation();
        settings.step_size = step_size;
        let mut simulation = begin(system, &reached, &settings, &representative, time)?;
        let outcome = simulation.step();
        *iterations += simulation.totals().newton_iterations;
        let Ok(_) = outcome else {
            // Far shorter than the next longer step, so that several follow without a failure.
            step_size *= 0.125;
            failures += 1;
            if failures > MAX_ITERATIONS {
                return None;
            }
            continue;
        };
        let moved = distance(&reached.kinematics, &simulation.state().kinematics);
        if distance(&state.kinematics, &simulation.state().kinematics) >= MAX_TRAVEL * length {
            return None;
        }
        reached.clone_from(simulation.state());
        let is_due = step >= next_try || step_size >= long_enough || step + 1 == MAX_STEPS;
        let taken = step_size;
        step_size *= 2.0;
        if moved > SHORT_STEP * length || !is_due {
            continue;
        }
        (next_try, long_enough) = (step + RETRY_STEPS, RETRY_LENGTH * taken);
        settings.scheme = statics::statics();
        settings.step_size = 1.0;
        let mut last = begin(system, &reached, &settings, &representative, time)?;
        let outcome = last.step();
        *iterations += last.totals().newton_iterations;
        if outcome.is_ok()
            && distance(&reached.kinematics, &last.state().kinematics) <= SETTLED_LENGTH * length
        {
            let distance = distance(&state.kinematics, &last.state().kinematics);
            let is_instability = |warning: &&Warning| matches!(warning, Warning::Unstable { .. });
            let mut warnings: Vec<Warning> = last.warnings().iter().filter(is_instability).cloned().collect();
            warnings.push(Warning::Relaxed { time, distance });
            return Some((last.state().clone(), warnings));
        }
    }
    None
}

impl Simulation {
    /// Stores the equilibrium found by relaxation, a step of `size` [s] after the start, as the last attempt. The first load step
    /// failed with `error`.
    pub(crate) fn relax_first_step(&mut self, size: f64, error: &StepError) -> Result<(), StepError> {
        let is_first = self.report.totals.steps == 0 && !self.settings.scheme.dynamic;
        if !(self.origin.may_relax
            && is_first
            && may_help(error, &self.system, &self.state, self.settings.solver))
        {
            return Err(error.clone());
        }
        let time = self.state.kinematics.time + size;
        let mut iterations = 0;
        let found = relax(&self.system, &self.state, &self.settings, time, &mut iterations);
        self.report.totals.newton_iterations += iterations;
        let Some((reached, doubts)) = found else {
            let mut error = error.clone();
            if let StepError::NotConverged { hint, .. } = &mut error
                && !self.system.drives().is_empty()
            {
                *hint = LOADS_BEFORE_DRIVES;
            }
            return Err(error);
        };
        let problem = Problem { system: &self.system, settings: &self.settings };
        self.integrator.resize(problem, size);
        self.integrator.jacobian_state = JacobianState::default();
        (self.attempt.size, self.attempt.is_converted, self.attempt.end) = (size, false, reached);
        // The time of a step of unit length has lost digits.
        self.attempt.end.kinematics.time = time;
        self.judge_attempt()?;
        for doubt in doubts {
            warn(&mut self.report.warnings, doubt);
        }
        Ok(())
    }
}

/// Starts a step of the settings' size from rest that ends at `time` [s].
fn begin(
    system: &Arc<System>,
    state: &State,
    settings: &Settings,
    representative: &Representative,
    time: f64,
) -> Option<Simulation> {
    let mut state = state.clone();
    state.kinematics.time = time - settings.step_size;
    state.time_remainder = 0.0;
    for node in &mut state.kinematics.nodes {
        node.twist.fill(0.0);
        node.acceleration.fill(0.0);
    }
    for coordinate in &mut state.kinematics.coordinates {
        (coordinate.rate, coordinate.acceleration) = (0.0, 0.0);
    }
    let mut simulation =
        Simulation::start(Arc::clone(system), state, settings.clone(), Some(representative)).ok()?;
    simulation.origin.may_relax = false;
    Some(simulation)
}

/// Largest displacement of a node [m].
fn distance(from: &Kinematics, to: &Kinematics) -> f64 {
    let ways = from.nodes.iter().zip(&to.nodes).map(|(a, b)| (b.frame.position - a.frame.position).norm());
    ways.fold(0.0, |most, way| if way.is_finite() { most.max(way) } else { f64::INFINITY })
}
