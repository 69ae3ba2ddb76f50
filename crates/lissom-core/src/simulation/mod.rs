//! Time stepping of a system: the state, and the solution of steps.

mod accumulated;
mod arc;
pub(crate) mod breakpoints;
pub(crate) mod cause;
mod converged_tangents;
pub mod dynamics;
pub mod equilibrium;
mod event_detector;
mod events;
mod held_values;
pub mod joint_space;
mod laws;
mod newton_trial;
mod recovery;
pub(crate) mod relaxation;
mod rigid_contacts;
mod samples;
mod sequence;
mod signal_history;
mod snapshot;
pub(crate) mod snapshot_parts;
mod stops;
mod units;

pub use crate::system::Need;
pub(crate) use arc::ArcControl;
pub(crate) use event_detector::{EventDetector, EventState};
pub use held_values::InputError;
pub use newton_trial::NewtonTrial;
pub use recovery::{Recovered, Recovery};
pub use snapshot::{Snapshot, SnapshotError};
pub(crate) use stops::Stops;

use std::sync::Arc;

use lissom_solver::FactorReport;
use serde::{Deserialize, Serialize};

use super::settings::Settings;
use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::consistent::redundancy::Redundancy;
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
use crate::simulation::accumulated::Accumulation;
use crate::system::accumulated::Accumulated;
use crate::system::{State, System};

/// A system and its state, which is advanced step by step.
pub struct Simulation {
    pub(crate) system: Arc<System>,
    pub(crate) settings: Settings,
    /// The state after the last step, and the one before it, which is the same before the first step.
    pub(crate) state: State,
    pub(crate) previous: State,
    /// Start of the simulation.
    pub(crate) origin: Origin,
    /// Solves steps.
    pub(crate) integrator: Integrator,
    /// The last attempt at a step.
    pub(crate) attempt: Attempt,
    /// Determines the length of steps.
    pub(crate) control: Box<dyn Control>,
    /// Ends of steps that are known in advance.
    pub(crate) stops: Stops,
    /// Ends of steps that are detected within them.
    pub(crate) events: EventDetector,
    /// Solver for jumps of accelerations where held values change between steps.
    pub(crate) held_values: Option<ConsistentInitialConditions>,
    /// Quantities that depend on the whole motion.
    pub(crate) accumulation: Accumulation,
    /// Models of other programs.
    pub(crate) units: Vec<units::RunningUnit>,
    pub(crate) monitors: Monitors,
    pub(crate) report: RunReport,
}

/// What is reported of a run up to its state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RunReport {
    pub(crate) energy_balance: EnergyBalance,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) totals: Totals,
}

/// Start of a simulation.
pub(crate) struct Origin {
    /// Motion at the start of the first step.
    pub(crate) kinematics: Kinematics,
    /// Largest change made to the given initial twists to satisfy the constraints [m/s, rad/s].
    pub(crate) velocity_correction: f64,
    /// Whether a first load step without solution is solved by relaxation, which takes load steps itself.
    pub(crate) may_relax: bool,
}

impl Simulation {
    /// Returns system and state.
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

    /// Duration of the last step [s]; 0 before the first.
    pub fn last_step(&self) -> f64 {
        self.state.kinematics.time - self.previous.kinematics.time
    }

    /// Size of the step from which velocities, accelerations and multipliers of the state result [s]; 0 if they have been made
    /// consistent since, for example after an event.
    pub fn step_of_rates(&self) -> f64 {
        // A branch that becomes known is no change, nor is the past of delayed signals.
        let graph = self.system.signals();
        let first_side = graph.first_side();
        let is_jump = |(index, (now, before)): (usize, (&f64, &f64))| {
            now != before && (index < first_side || *before != 0.0) && !graph.is_of_window(index)
        };
        let held = self.state.kinematics.held.iter().zip(&self.previous.kinematics.held);
        let windows = [&*self.previous.kinematics.held, &self.state.kinematics.held];
        let has_jumped = held.enumerate().any(is_jump)
            || graph.delays().iter().any(|delay| delay.jumps(self.state.kinematics.time, windows));
        if has_jumped { 0.0 } else { self.last_step() }
    }

    /// A shared reference to the system.
    pub fn shared_system(&self) -> Arc<System> {
        Arc::clone(&self.system)
    }

    /// The state after the last step.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Energy of the model, and work of loads and drives since the start.
    pub fn energy_balance(&self) -> &EnergyBalance {
        &self.report.energy_balance
    }

    /// Warnings about the motion up to the state, each kind once.
    pub fn warnings(&self) -> &[Warning] {
        &self.report.warnings
    }

    /// Stability of the equilibria of load steps: load parameters [s] from which they have this number of unstable directions; none if
    /// it cannot be determined.
    pub fn stability(&self) -> &[(f64, Option<usize>)] {
        self.monitors.get::<Stability>().map_or(&[], |stability| &stability.changes)
    }

    /// Number of unstable directions of the last equilibrium; none if it cannot be determined: in motion, with a singular stiffness,
    /// and with forces that have no potential, such as loads that rotate with the model.
    pub fn unstable_directions(&self) -> Option<usize> {
        unstable_directions(self.problem(), &self.state)
    }

    /// Accumulates quantities from zero from now on: [`State::accumulated`] contains them in this order.
    pub fn accumulate(&mut self, numbers: Vec<Arc<dyn Accumulated>>) {
        let Attempt { converted, end, .. } = &mut self.attempt;
        for state in [&mut self.previous, &mut self.state, end, converted] {
            state.accumulated = vec![0.0; numbers.len()];
        }
        self.accumulation = Accumulation::new(numbers, self);
    }

    /// Sums over all steps.
    pub fn totals(&self) -> &Totals {
        &self.report.totals
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Representative mass, damping, stiffness and length.
    pub fn representative(&self) -> &Representative {
        &self.integrator.representative
    }

    /// Redundant constraints at the present state.
    pub(crate) fn redundancy(&self) -> &Redundancy {
        &self.integrator.work.redundancy
    }

    /// The present scaling.
    pub fn scaled(&self) -> &Scaled {
        &self.integrator.scaled
    }

    /// Number of stored entries of the tangent's factors.
    pub fn factor_entries(&self) -> usize {
        self.integrator.work.tangent.matrices.entries()
    }

    /// Number of patterns of touching parts that this simulation has analysed.
    pub fn pattern_analyses(&self) -> usize {
        self.integrator.work.contacts.as_ref().map_or(0, |contacts| contacts.pattern.analyses)
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
