//! Interface of a step-length control.

use crate::energy_balance::EnergyBalance;
use crate::integrator::{Attempt, Integrator};
use crate::kinematics::Kinematics;
use crate::settings::Problem;
use crate::system::State;
use crate::tuning::Tuning;

/// A solved attempt, for review.
pub(crate) struct Review<'r> {
    pub(crate) problem: Problem<'r>,
    pub(crate) integrator: &'r mut Integrator,
    pub(crate) attempt: &'r Attempt,
    /// Configuration at the beginning of the first step.
    pub(crate) origin: &'r Kinematics,
    pub(crate) start: &'r State,
    /// Energy and work up to the start.
    pub(crate) energy_balance: &'r EnergyBalance,
    /// Whether forces have switched at the start.
    pub(crate) has_switched: bool,
}

/// Determines the step length.
pub(crate) trait Control: Send + Sync {
    /// The longest step [s]: instants that differ by round-off of it are equal.
    fn longest(&self) -> f64;

    /// Changes the size of planned steps [s]; adaptive sizes do not change.
    fn set_planned(&mut self, size: f64) {
        let _ = size;
    }

    /// Duration of a planned step, if nothing ends it earlier and `rest` [s] remain. It is then completed in as many parts as
    /// necessary.
    fn planned(&self) -> Option<f64>;

    /// Size of the next step by the estimated error [s], if errors are estimated.
    fn by_error(&self) -> Option<f64> {
        None
    }

    /// Sets the target of the next attempts, `distance` [s] away, to be reached in steps no longer than `bound` [s].
    fn aim(&mut self, distance: f64, bound: f64);

    /// Limits the size of the next attempts at this step [s], for a reason other than the estimated error. Default: nothing.
    fn limit(&mut self, _size: f64) {}

    /// Size of the next attempt [s].
    fn propose(&mut self) -> f64;

    /// Whether a solved attempt can be accepted.
    fn review(&mut self, review: Review<'_>) -> bool {
        let _ = review;
        true
    }

    /// Records that an attempt of `size` [s] has no solution, or was not accepted. Whether a shorter one is to be
    /// made.
    fn shorten(&mut self, size: f64, has_solution: bool) -> bool;

    /// Records an accepted attempt. Whether its target is reached.
    fn accept(&mut self, attempt: &Attempt, tuning: &Tuning) -> bool;

    /// Records that the step failed, and that the next begins anew.
    fn restart(&mut self) {}

    /// Whether attempts as short as useful have been made.
    fn has_tried_shortest(&self) -> bool {
        true
    }

    /// Whether the first failure of a step is more specific than those of shorter attempts.
    fn prefers_first_failure(&self) -> bool {
        true
    }

    /// Size of an attempt as a fraction of the planned step that contains it.
    fn fraction(&self, attempt: &Attempt) -> f64 {
        let _ = attempt;
        1.0
    }

    /// Estimated error of the last reviewed attempt over the tolerance, if errors are estimated [-].
    fn error(&self) -> Option<f64> {
        None
    }

    /// Serialises the data of the steps so far.
    fn save(&self) -> Vec<u8>;

    /// Restores the result of [`save`](Self::save). Whether it could be read.
    fn restore(&mut self, saved: &[u8]) -> bool;
}
