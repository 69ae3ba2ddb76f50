//! Settings of a simulation.

use lissom_solver::SolverKind;

use crate::newton::Limits;
use crate::scaling::ScalingChoice;
use crate::schemes::Scheme;
use crate::stepping::StepControl;

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
    /// Whether a motion with much more energy than anything put in fails.
    pub energy_check: bool,
}
