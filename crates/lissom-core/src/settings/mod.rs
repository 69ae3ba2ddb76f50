//! Settings of a simulation, and what is counted and timed in it.

mod phase;
mod totals;

pub use phase::{Phase, Stopwatch, Unwatched};
pub use totals::{StepReport, Totals};

use lissom_solver::SolverKind;

use crate::newton::Limits;
use crate::scaling::ScalingChoice;
use crate::schemes::Scheme;
use crate::system::System;

/// Settings of a simulation, besides system and state.
#[derive(Clone)]
pub struct Settings {
    /// Time scheme.
    pub scheme: Scheme,
    /// Step size [s], with step-size control that of the first step; in statics, the step of the load parameter.
    pub step_size: f64,
    /// Step-size control; none for steps of one size.
    pub control: Option<StepControl>,
    /// Scaling and augmented term.
    pub scaling: ScalingChoice,
    /// When Newton's iterations stop.
    pub limits: Limits,
    /// Linear solver.
    pub solver: &'static SolverKind,
    /// Threads that evaluate elements and joints of a large system. Results do not depend on it.
    pub threads: usize,
    /// Whether a motion starts from the static equilibrium under the loads of the first instant.
    pub from_equilibrium: bool,
    /// Whether flexible parts without given velocities start with those that deform them least, instead of those with the least
    /// kinetic energy, if drives or joints set them in motion.
    pub follow_drives: bool,
    /// Whether a motion with much more energy than anything put in fails.
    pub energy_check: bool,
}

/// What the user asks of step-size control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// Error to be expected of places at the end, relative to how far the model has moved, see `integrator/error_estimate` [-].
    pub relative_tolerance: f64,
    /// Largest step [s].
    pub max_step: f64,
    /// What the tolerance applies to.
    pub of: Controlled,
}

/// Whose errors determine adaptive steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Controlled {
    /// Those of positions, velocities and states.
    #[default]
    Positions,
    /// Those of accelerations and forces too, relative to the largest acceleration: steps resolve every vibration that
    /// contributes to them.
    Forces,
}

/// A model with the settings of its solution.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'p> {
    pub(crate) system: &'p System,
    pub(crate) settings: &'p Settings,
}
