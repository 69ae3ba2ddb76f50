//! The size of the next step from the estimated error of the last one. Knows no system.
//!
//! ```text
//! factor = 0.8 ε^(-1/3)        for estimates of order h³ [Hairer, Nørsett and Wanner 1993, II.4]
//! ```
//!
//! ε is the estimated error over the tolerance. The size is kept where it could change a little only.

use serde::{Deserialize, Serialize};

use crate::tuning::{Tuning, TuningParameter};

/// Order of the estimate in the step size.
const ORDER: f64 = 3.0;

/// What the user asks of step-size control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// Error to be expected of places at the end, relative to how far the model has moved, see `error_estimate` [-].
    pub relative_tolerance: f64,
    /// Largest step [s].
    pub max_step: f64,
}

/// The controller between two steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Controller {
    /// Size of the next step [s].
    size: f64,
    /// Whether the last attempt failed: then the step does not grow at once.
    has_failed: bool,
}

impl Controller {
    /// At the start, with a first step of `size` [s].
    pub(crate) fn new(size: f64) -> Self {
        Self { size, has_failed: false }
    }

    /// Size of the next step [s].
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// The next attempt is shorter than the control would have it, to end where it must: the size is kept for later.
    pub(crate) fn propose(&self, rest: f64) -> f64 {
        if self.size >= rest * (1.0 - 1e-9) {
            rest
        } else if 2.0 * self.size > rest {
            // Two steps of one size rather than a long and a very short one.
            0.5 * rest
        } else {
            self.size
        }
    }

    /// A step of `taken` [s] had an estimated error of `error` times the tolerance, and is accepted.
    pub(crate) fn accept(&mut self, taken: f64, error: f64, max_step: f64, tuning: &Tuning) {
        let largest = if self.has_failed { 1.0 } else { tuning.of(TuningParameter::Growth) };
        let factor = (tuning.of(TuningParameter::Safety) * error.powf(-1.0 / ORDER)).min(largest);
        self.has_failed = false;
        let kept = tuning.of(TuningParameter::Kept);
        let wanted = taken * if (1.0 / kept..kept).contains(&factor) { 1.0 } else { factor };
        // A step cut short to end where it must says that at least its size is possible.
        self.size = if taken < self.size { wanted.max(self.size.min(taken * factor)) } else { wanted };
        self.size = self.size.min(max_step);
    }

    /// A step of `taken` [s] had an estimated error of `error` times the tolerance, above 1, and is rejected.
    pub(crate) fn reject(&mut self, taken: f64, error: f64, tuning: &Tuning) {
        if error.is_finite() {
            self.size = taken * tuning.of(TuningParameter::Safety) * error.powf(-1.0 / ORDER);
            self.has_failed = true;
        } else {
            self.fail(taken);
        }
    }

    /// A step of `taken` [s] has no solution.
    pub(crate) fn fail(&mut self, taken: f64) {
        self.size = 0.25 * taken;
        self.has_failed = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps over an interval where the error of a step h is (h/h₀(t))³.
    fn sizes(of: impl Fn(f64) -> f64, end: f64) -> (Vec<f64>, usize) {
        let mut controller = Controller::new(1.0);
        let (mut time, mut rejected, mut taken) = (0.0, 0, Vec::new());
        while time < end {
            let size = controller.propose(end - time);
            let error = (size / of(time)).powi(3);
            if error > 1.0 {
                controller.reject(size, error, &Tuning::default());
                rejected += 1;
            } else {
                controller.accept(size, error, 10.0, &Tuning::default());
                time += size;
                taken.push(size);
            }
            assert!(rejected + taken.len() < 10_000);
        }
        (taken, rejected)
    }

    #[test]
    fn steps_settle_below_what_is_allowed_and_end_where_they_must() {
        let (taken, rejected) = sizes(|_| 0.01, 2.0);
        assert!(rejected <= 6, "{rejected}");
        assert!((taken.iter().sum::<f64>() - 2.0).abs() < 1e-12);
        let settled = taken[taken.len() / 2];
        assert!((0.006..0.01).contains(&settled), "{settled}");
        // A constant task is done with one size.
        assert!(taken[20..taken.len() - 3].iter().all(|size| *size == settled), "{taken:?}");
    }

    #[test]
    fn bursts_are_met_with_few_rejected_steps() {
        let burst = |time: f64| if (1.0..1.1).contains(&(time % 2.0)) { 1e-4 } else { 0.05 };
        let (taken, rejected) = sizes(burst, 10.0);
        // Five bursts of some 1000 to 1300 steps each.
        assert!(taken.len() < 8000, "{}", taken.len());
        assert!(rejected < 60, "{rejected}");
    }
}
