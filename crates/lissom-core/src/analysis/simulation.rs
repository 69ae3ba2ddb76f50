//! A system on its way through time: its state, what the next step needs, and what is known of the motion so far.

use std::sync::Arc;

use lissom_solver::FactorReport;

use super::accumulated::Accumulation;
use super::initial_conditions::ConsistentInitialConditions;
use super::projection::Projection;
use super::settings::Settings;
use super::totals::Totals;
use super::workspace::Workspace;
use crate::judge::rates::ConstraintRates;
use crate::judge::singular::SingularPositions;
use crate::judge::{EnergyBalance, Warning};
use crate::kinematics::Kinematics;
use crate::newton::JacobianState;
use crate::scaling::{Representative, Scaled};
use crate::stepping::breakpoints::Breakpoint;
use crate::stepping::{
    Controller, EventDetector, Impacts, IntegratorHistory, LoadControl, Resolution, StepBisection,
    TimeFunctions,
};
use crate::system::{State, System};

/// A system on its way through time.
pub struct Simulation {
    pub(crate) system: Arc<System>,
    /// Where the first step began.
    pub(crate) origin: Kinematics,
    /// Before the last step; the same as `state` before the first.
    pub(crate) previous: State,
    pub(crate) state: State,
    /// Where the attempt at the next step has come.
    pub(crate) next: State,
    pub(crate) settings: Settings,
    pub(crate) representative: Representative,
    /// The scaling of the tangent in use, for the size of the present attempt.
    pub(crate) scaled: Scaled,
    pub(crate) work: Box<Workspace>,
    /// For schemes whose velocities leave the constraints a little.
    pub(crate) projection: Option<Projection>,
    /// For held values that change between steps.
    pub(crate) held_values: Option<ConsistentInitialConditions>,
    pub(crate) jacobian_state: JacobianState,
    /// For schemes that remember what belongs to the step size.
    pub(crate) integrator_history: Option<IntegratorHistory>,
    /// Where in a planned step it stands, and the size of the next attempt.
    pub(crate) step_bisection: StepBisection,
    pub(crate) controller: Option<Controller>,
    /// Size of the next load step, where it is chosen.
    pub(crate) load_control: Option<LoadControl>,
    /// When functions of time are not smooth: steps of motions, and load steps of chosen size, do not cross it.
    pub(crate) breakpoints: Vec<Breakpoint>,
    /// How far any node has moved since the start, for the error estimate [-].
    pub(crate) farthest: f64,
    pub(crate) totals: Totals,
    pub(crate) velocity_correction: f64,
    /// Energy and work up to the state.
    pub(crate) energy_balance: EnergyBalance,
    /// The same up to where the attempt at the next step has come.
    pub(crate) next_energy_balance: EnergyBalance,
    /// Largest violation of a constraint at the end of the last attempt, relative to the representative length, or in radians.
    pub(crate) next_violation: f64,
    /// Reasons to doubt the motion up to the state.
    pub(crate) warnings: Vec<Warning>,
    /// Positions in which constraints of loops repeat each other.
    pub(crate) singular: SingularPositions,
    /// The last load parameter at which the equilibrium was stable, in statics [s].
    pub(crate) stable_at: Option<f64>,
    /// From which load parameter on [s] an equilibrium is unstable in how many directions; none where that cannot be
    /// determined.
    pub(crate) stability: Vec<(f64, Option<usize>)>,
    /// Numbers that may change their sign within a step.
    pub(crate) event_detector: EventDetector,
    /// How fast forces switch in steps of planned size.
    pub(crate) impacts: Impacts,
    /// Whether steps of planned size resolve the motion.
    pub(crate) resolution: Resolution,
    pub(crate) constraint_rates: ConstraintRates,
    /// What is known of functions of time.
    pub(crate) time_functions: TimeFunctions,
    /// What is accumulated along the way.
    pub(crate) accumulation: Accumulation,
    /// Whether the workspace still holds the step that led to the state.
    pub(crate) is_last_step_known: bool,
    /// Energy that the first load step releases because its start is no equilibrium [J].
    pub(crate) released: f64,
    /// Whether a first load step without solution is looked for by relaxation, which takes load steps itself.
    pub(crate) may_relax: bool,
}

impl Simulation {
    /// System and state, given back.
    pub(super) fn into_parts(self) -> (Arc<System>, State) {
        (self.system, self.state)
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// How long the last step was [s]; 0 before the first.
    pub fn last_step(&self) -> f64 {
        self.state.kinematics.time - self.previous.kinematics.time
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

    /// Reasons to doubt the motion up to the state, each kind once.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Stability of the equilibria of load steps: from which load parameter on [s] they are unstable in how many
    /// directions; none where that cannot be determined.
    pub fn stability(&self) -> &[(f64, Option<usize>)] {
        &self.stability
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
        &self.representative
    }

    /// The scaling in force.
    pub fn scaled(&self) -> &Scaled {
        &self.scaled
    }

    /// Stored numbers of the tangent's factors.
    pub fn factor_entries(&self) -> usize {
        self.work.factorization.entries()
    }

    /// Largest change made to the given initial twists to satisfy the constraints [m/s, rad/s].
    pub fn velocity_correction(&self) -> f64 {
        self.velocity_correction
    }

    /// Smallest pivot over largest diagonal entry of the tangent factored last.
    pub fn relative_pivot(&self) -> Option<f64> {
        self.work.report.as_ref().map(FactorReport::relative_pivot)
    }
}

/// Adds a warning unless there is one of its kind.
pub(crate) fn warn(warnings: &mut Vec<Warning>, warning: Warning) {
    if warnings.iter().all(|known| known.code() != warning.code()) {
        warnings.push(warning);
    }
}
