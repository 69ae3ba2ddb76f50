//! Interface of a monitor, and its input.

use std::any::Any;

use crate::energy_balance::EnergyBalance;
use crate::errors::StepError;
use crate::errors::Warning;
use crate::integrator::Integrator;
use crate::kinematics::Kinematics;
use crate::scaling::Representative;
use crate::settings::Problem;
use crate::system::State;

/// Errors of forces above this fraction of the largest one are reported, and phase shifts above this [rad].
pub(super) const NOTEWORTHY: f64 = 0.01;
/// A force or moment below this fraction of the largest one is measured against that fraction.
pub(super) const MIN_FORCE: f64 = 0.05;

/// A simulation at its start.
#[derive(Clone, Copy)]
pub(crate) struct Beginning<'b> {
    pub(crate) problem: Problem<'b>,
    pub(crate) state: &'b State,
    pub(crate) representative: &'b Representative,
    /// Energy that the first load step releases because its start is not in equilibrium [J].
    pub(crate) released: f64,
}

impl Beginning<'_> {
    /// Whether this is a motion with steps of planned size.
    pub(super) fn is_planned_motion(&self) -> bool {
        self.problem.settings.scheme.dynamic && self.problem.settings.control.is_none()
    }
}

/// A step that is being accepted.
pub(crate) struct Accepted<'s> {
    pub(crate) problem: Problem<'s>,
    pub(crate) integrator: &'s mut Integrator,
    /// Configuration at the beginning of the first step.
    pub(crate) origin: &'s Kinematics,
    pub(crate) start: &'s State,
    pub(crate) end: &'s State,
    /// Before and after the step.
    pub(crate) energy_balance: [&'s EnergyBalance; 2],
    /// Largest violation of a constraint at the end, relative to the representative length, or in radians.
    pub(crate) violation: f64,
    /// Error of the prediction of the step's increments [scaled].
    pub(crate) prediction_error: f64,
    /// Size of the step as a fraction of the planned step that contains it.
    pub(crate) fraction: f64,
    /// Whether forces have switched at its start.
    pub(crate) has_switched: bool,
}

/// Checks every accepted step.
pub(crate) trait Monitor: Any + Send + Sync {
    /// Checks a step, and adds, updates or withdraws warnings.
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>);

    /// Why a step from this state has no solution however short, if this monitor has detected a cause. `time` is that of the
    /// failure [s].
    fn cause(&mut self, problem: Problem<'_>, at: &Kinematics, time: f64) -> Option<StepError> {
        let _ = (problem, at, time);
        None
    }

    /// Serialises the monitor's state; empty if it has none.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Restores the result of [`save`](Self::save). Whether it could be read.
    fn restore(&mut self, saved: &[u8]) -> bool {
        saved.is_empty()
    }
}
