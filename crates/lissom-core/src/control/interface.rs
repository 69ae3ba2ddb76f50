//! What a control of the step length consists of.

use crate::analysis::Problem;
use crate::integrator::{Attempt, Integrator};
use crate::judge::EnergyBalance;
use crate::kinematics::Kinematics;
use crate::system::State;
use crate::tuning::Tuning;

/// An attempt that was solved, for review.
pub(crate) struct Review<'r> {
    pub(crate) problem: Problem<'r>,
    pub(crate) integrator: &'r mut Integrator,
    pub(crate) attempt: &'r Attempt,
    /// Where the first step began.
    pub(crate) origin: &'r Kinematics,
    pub(crate) start: &'r State,
    /// Duration of the step before [s].
    pub(crate) last_size: f64,
    /// Energy and work up to the start.
    pub(crate) energy_balance: &'r EnergyBalance,
    /// Whether forces have switched at the start.
    pub(crate) has_switched: bool,
}

/// Decides how long steps are.
pub(crate) trait Control: Send + Sync {
    /// The longest step [s]: instants are the same if they differ by round-off of it.
    fn longest(&self) -> f64;

    /// Changes the size of planned steps [s]; sizes that are chosen do not change.
    fn set_planned(&mut self, size: f64) {
        let _ = size;
    }

    /// Duration of the next step where nothing within it ends it and `rest` [s] remain: that of a planned step. It is then taken
    /// to its end, in as many parts as it needs.
    fn planned(&self) -> Option<f64>;

    /// Size of the next step as its error would have it [s], where errors are estimated.
    fn by_error(&self) -> Option<f64> {
        None
    }

    /// The next attempts lead to an instant that is `distance` [s] away, in steps no longer than `bound` [s].
    fn aim(&mut self, distance: f64, bound: f64);

    /// Size of the next attempt [s].
    fn propose(&mut self) -> f64;

    /// Whether an attempt that has a solution can be accepted.
    fn review(&mut self, review: Review<'_>) -> bool {
        let _ = review;
        true
    }

    /// An attempt of `size` [s] has no solution, or was not accepted. Whether a shorter one is to be made.
    fn shorten(&mut self, size: f64, has_solution: bool) -> bool;

    /// An attempt is accepted. Whether the instant at which it was aimed is reached.
    fn accept(&mut self, attempt: &Attempt, tuning: &Tuning) -> bool;

    /// The step failed, and the next begins anew.
    fn restart(&mut self) {}

    /// Whether attempts as short as help have been made.
    fn has_tried_shortest(&self) -> bool {
        true
    }

    /// Whether the first failure of a step is more specific than those of shorter attempts.
    fn prefers_first_failure(&self) -> bool {
        true
    }

    /// Size of an attempt over that of the planned step of which it is a part.
    fn fraction(&self, attempt: &Attempt) -> f64 {
        let _ = attempt;
        1.0
    }

    /// Estimated error of the attempt reviewed last over the tolerance, where errors are estimated [-].
    fn error(&self) -> Option<f64> {
        None
    }

    /// What was learned from the steps so far.
    fn save(&self) -> Vec<u8>;

    /// Goes back to what [`save`](Self::save) returned. Whether it could be read.
    fn restore(&mut self, saved: &[u8]) -> bool;
}
