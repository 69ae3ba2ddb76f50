//! A system on its way through time: its state, and what takes it to the next one.

pub mod accumulated;
mod arc;
pub(crate) mod breakpoints;
pub(crate) mod cause;
pub mod conditioning;
pub mod dynamics;
pub mod equilibrium;
mod event_detector;
mod events;
mod held_values;
mod laws;
mod recovery;
pub(crate) mod relaxation;
mod samples;
mod sequence;
mod snapshot;
pub(crate) mod snapshot_parts;
mod stops;

pub(crate) use arc::ArcControl;
pub use conditioning::{Condition, ConditionMethod};
pub(crate) use event_detector::{EventDetector, EventState};
pub use held_values::InputError;
pub use recovery::{Need, Recovered, Recovery};
pub use snapshot::{Snapshot, SnapshotError};
pub(crate) use stops::Stops;

use std::sync::Arc;

use lissom_solver::FactorReport;

use super::settings::Settings;
use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::control::Control;
use crate::energy_balance::EnergyBalance;
use crate::errors::Warning;
use crate::integrator::{Attempt, Integrator};
use crate::kinematics::Kinematics;
use crate::monitors::Monitors;
use crate::monitors::stability::{Stability, unstable_directions};
use crate::scaling::{Representative, Scaled};
use crate::settings::Problem;
use crate::settings::Totals;
use crate::simulation::accumulated::{Accumulated, Accumulation};
use crate::system::{State, System};

/// A system on its way through time.
pub struct Simulation {
    pub(crate) system: Arc<System>,
    pub(crate) settings: Settings,
    /// The state after the last step, and the one before it, which is the same before the first step.
    pub(crate) state: State,
    pub(crate) previous: State,
    /// Energy and work up to the state.
    pub(crate) energy_balance: EnergyBalance,
    /// Where and how the simulation began.
    pub(crate) origin: Origin,
    /// Solves steps.
    pub(crate) integrator: Integrator,
    /// The last attempt at a step.
    pub(crate) attempt: Attempt,
    /// Decides how long steps are.
    pub(crate) control: Box<dyn Control>,
    /// Instants at which steps end that are known before the step.
    pub(crate) stops: Stops,
    /// Those that are found within it.
    pub(crate) events: EventDetector,
    /// For held values that change between steps.
    pub(crate) held_values: Option<ConsistentInitialConditions>,
    /// Numbers that depend on the whole motion.
    pub(crate) accumulation: Accumulation,
    pub(crate) monitors: Monitors,
    /// Warnings about the motion up to the state.
    pub(crate) warnings: Vec<Warning>,
    pub(crate) totals: Totals,
    /// Whether the integrator still holds the step that led to the state.
    pub(crate) is_last_step_known: bool,
}

/// Where and how a simulation began.
pub(crate) struct Origin {
    /// Where the first step began.
    pub(crate) kinematics: Kinematics,
    /// Largest change made to the given initial twists to satisfy the constraints [m/s, rad/s].
    pub(crate) velocity_correction: f64,
    /// Whether a first load step without solution is looked for by relaxation, which takes load steps itself.
    pub(crate) may_relax: bool,
}

impl Simulation {
    /// System and state, given back.
    pub(crate) fn into_parts(self) -> (Arc<System>, State) {
        (self.system, self.state)
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The model with the settings of its solution.
    pub(crate) fn problem(&self) -> Problem<'_> {
        Problem { system: &self.system, settings: &self.settings }
    }

    /// How long the last step was [s]; 0 before the first.
    pub fn last_step(&self) -> f64 {
        self.state.kinematics.time - self.previous.kinematics.time
    }

    /// How long the step was from which velocities, accelerations and multipliers of the state follow [s]; 0 where they were made
    /// consistent since, as after an event.
    pub fn step_of_rates(&self) -> f64 {
        // A side that was not known before is no change.
        let first_side = self.system.signals().first_side();
        let is_jump = |(index, (now, before)): (usize, (&f64, &f64))| {
            now != before && (index < first_side || *before != 0.0)
        };
        let held = self.state.kinematics.held.iter().zip(&self.previous.kinematics.held);
        let has_jumped = held.enumerate().any(is_jump);
        if has_jumped { 0.0 } else { self.last_step() }
    }

    /// A shared handle on the system.
    pub fn shared_system(&self) -> Arc<System> {
        Arc::clone(&self.system)
    }

    /// The state after the last step.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Energy of the model, and work of loads and drives since the start.
    pub fn energy_balance(&self) -> &EnergyBalance {
        &self.energy_balance
    }

    /// Warnings about the motion up to the state, each kind once.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Stability of the equilibria of load steps: from which load parameter on [s] they are unstable in how many
    /// directions; none where that cannot be determined.
    pub fn stability(&self) -> &[(f64, Option<usize>)] {
        self.monitors.get::<Stability>().map_or(&[], |stability| &stability.changes)
    }

    /// Directions in which the equilibrium that was reached last is unstable; none where that cannot be determined: in motion,
    /// where the stiffness is singular, and where it belongs to no energy, as with loads that turn with the model.
    pub fn unstable_directions(&self) -> Option<usize> {
        unstable_directions(self.problem(), &self.state)
    }

    /// Accumulates numbers from here on, from zero: [`State::accumulated`] has them in this order.
    pub fn accumulate(&mut self, numbers: Vec<Arc<dyn Accumulated>>) {
        let Attempt { converted, end, .. } = &mut self.attempt;
        for state in [&mut self.previous, &mut self.state, end, converted] {
            state.accumulated = vec![0.0; numbers.len()];
        }
        self.accumulation = Accumulation::new(numbers, self);
    }

    /// Sums over all steps.
    pub fn totals(&self) -> &Totals {
        &self.totals
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Representative mass, damping, stiffness and length.
    pub fn representative(&self) -> &Representative {
        &self.integrator.representative
    }

    /// The scaling in force.
    pub fn scaled(&self) -> &Scaled {
        &self.integrator.scaled
    }

    /// Stored numbers of the tangent's factors.
    pub fn factor_entries(&self) -> usize {
        self.integrator.work.tangent.matrices.entries()
    }

    /// Largest change made to the given initial twists to satisfy the constraints [m/s, rad/s].
    pub fn velocity_correction(&self) -> f64 {
        self.origin.velocity_correction
    }

    /// Smallest pivot over largest diagonal entry of the tangent factored last.
    pub fn relative_pivot(&self) -> Option<f64> {
        self.integrator.work.tangent.report().map(FactorReport::relative_pivot)
    }
}
