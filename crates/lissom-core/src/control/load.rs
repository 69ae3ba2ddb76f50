//! Adaptive load steps: as long as Newton's method contracts well and the work of the loads is stored as energy.
//!
//! The error of a load step is the part of its work, by the trapezoidal rule, that is not stored as energy. On a smooth
//! path of equilibria it is of third order in the step; where the model jumps it is the whole work. A part that does not
//! decrease with the step is due to a jump or to dissipation, and does not require shorter steps.

use serde::{Deserialize, Serialize};

use super::interface::{Control, Review};
use crate::bytes::{from_bytes, to_bytes};
use crate::integrator::Attempt;
use crate::settings::StepControl;
use crate::tuning::{MAX_HALVINGS, Tuning, TuningParameter};

/// Iterations of a step of suitable length: few tangents serve several steps.
const EASY: f64 = 15.0;
/// Smallest and largest ratio of consecutive steps.
const CHANGE: (f64, f64) = (0.3, 2.0);
/// If halving a step leaves more than this fraction of the unexplained work of the whole step, its length is not the
/// cause.
const UNEXPLAINED_SHARE: f64 = 0.7;

/// Control of load steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LoadSteps {
    control: StepControl,
    length: LoadControl,
    /// Change of the load parameter to the target of the steps [s].
    distance: f64,
    attempts: Attempts,
    /// The step length before them.
    before: LoadControl,
    /// Fraction of its work that the last attempt left unexplained.
    missing: f64,
}

impl LoadSteps {
    /// At the start, with a first step of `size` [s].
    pub(crate) fn new(control: StepControl, size: f64) -> Self {
        let length = LoadControl::new(size);
        Self { control, length, distance: size, attempts: Attempts::default(), before: length, missing: 0.0 }
    }
}

impl Control for LoadSteps {
    fn longest(&self) -> f64 {
        self.control.max_step
    }

    fn planned(&self) -> Option<f64> {
        None
    }

    fn aim(&mut self, distance: f64, _: f64) {
        self.distance = distance;
        (self.attempts, self.before) = (Attempts::default(), self.length);
    }

    fn propose(&mut self) -> f64 {
        self.length.propose(self.distance, self.control.max_step)
    }

    fn review(&mut self, review: Review<'_>) -> bool {
        self.missing = review.attempt.energy_balance.missing_work(review.energy_balance);
        let (size, tolerance) = (review.attempt.size, self.control.relative_tolerance);
        !self.length.refuses(size, self.missing, tolerance, &mut self.attempts)
    }

    fn shorten(&mut self, size: f64, has_solution: bool) -> bool {
        if has_solution {
            return true;
        }
        self.attempts = Attempts::default();
        self.length.halve(size)
    }

    fn accept(&mut self, attempt: &Attempt, tuning: &Tuning) -> bool {
        let missed = (self.missing, self.control.relative_tolerance);
        self.length.accept(attempt.size, attempt.outcome.iterations, missed, tuning);
        attempt.size == self.distance
    }

    fn restart(&mut self) {
        self.length = self.before;
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&self.length)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        from_bytes(saved, &mut self.length)
    }
}

/// The length of the next load step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct LoadControl {
    size: f64,
    /// Steps are not shorter than this.
    least: f64,
}

/// The attempts of one step.
#[derive(Clone, Copy, Debug, Default)]
struct Attempts {
    /// Fraction of its work that the last attempt left unexplained, if it had a solution.
    missing: Option<f64>,
}

impl LoadControl {
    /// With the length of the first step.
    fn new(size: f64) -> Self {
        Self { size, least: size / f64::from(1_u32 << MAX_HALVINGS) }
    }

    /// The next step, if `rest` remains of the range.
    fn propose(&self, rest: f64, most: f64) -> f64 {
        let size = self.size.min(most);
        // Two steps of equal length rather than one with a short remainder.
        if rest <= size * (1.0 + 1e-9) {
            rest
        } else if rest < 2.0 * size {
            0.5 * rest
        } else {
            size
        }
    }

    /// Whether a step that left the fraction `missing` of its work unexplained is to be repeated with half its
    /// length.
    fn refuses(&mut self, size: f64, missing: f64, tolerance: f64, attempts: &mut Attempts) -> bool {
        let helps = attempts.missing.is_none_or(|before| missing < UNEXPLAINED_SHARE * before);
        attempts.missing = Some(missing);
        missing > tolerance && helps && self.halve(size)
    }

    /// Records that a step had no solution. Whether half of it may be tried.
    fn halve(&mut self, size: f64) -> bool {
        self.size = 0.5 * size;
        self.size >= self.least
    }

    /// Records a step of that length, accepted after this number of iterations.
    fn accept(&mut self, size: f64, iterations: usize, (missing, tolerance): (f64, f64), tuning: &Tuning) {
        let ease = EASY / iterations.max(1) as f64;
        // The missing fraction grows with the square of the length.
        let error = if missing > 0.0 {
            tuning.of(TuningParameter::Safety) * (tolerance / missing).sqrt()
        } else {
            CHANGE.1
        };
        let error = if missing > tolerance { 1.0 } else { error };
        self.size = (size * ease.min(error).clamp(CHANGE.0, CHANGE.1)).max(self.least);
    }
}

#[cfg(test)]
#[path = "../../tests/unit/control/load.rs"]
mod tests;
