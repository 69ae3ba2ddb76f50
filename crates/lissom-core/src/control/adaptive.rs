//! Steps as long as their estimated error allows: the size of the next one follows from the error of the last one.
//!
//! ```text
//! factor = 0.8 ε^(-1/3)        for estimates of order h³ [Hairer, Nørsett and Wanner 1993, II.4]
//! ```
//!
//! ε is the estimated error over the tolerance. The size is kept if it would change only slightly.

use serde::{Deserialize, Serialize};

use super::interface::{Control, Review};
use crate::analysis::{Controlled, Problem, StepControl};
use crate::bytes::{from_bytes, to_bytes};
use crate::instants::SAME;
use crate::integrator::Attempt;
use crate::integrator::error_estimate::{ErrorOrder, MIN_ERROR, MIN_REFERENCE, driven, excursion};
use crate::kinematics::CoordinateId;
use crate::tuning::{Tuning, TuningParameter};

/// Largest growth of a step.
const MAX_GROWTH: f64 = 5.0;
/// Fraction of the tolerance allowed for a step whose estimate is of lower order than its scheme: such steps are few.
const FIRST: f64 = 0.1;
/// Largest defect in the middle of a step, as a fraction of the reference, if the tolerance is not smaller: a tolerance coarser
/// than the distance of two branches does not distinguish them. Of a four-bar whose links pass through one line, generalized-α,
/// HHT and Radau IIA find the branch with seven times this limit.
const MAX_DEFECT: f64 = 1e-3;
/// Defects below this fraction of the allowed one are not expected to exceed it in the next step, which is at most five times as
/// long.
const NEGLIGIBLE_DEFECT: f64 = 0.02;
/// Steps shorter than this fraction of the largest one are not tried [-].
const SHORTEST: f64 = 1e-12;

/// Order of the estimate in the step size.
const ORDER: f64 = 3.0;

/// Control of adaptive steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Adaptive {
    control: StepControl,
    controller: Controller,
    /// Of the motion since the start.
    farthest: Extent,
    /// Defect that was evaluated last, over the allowed one.
    defect: f64,
    /// Duration to the target of the present step, and the longest step on the way [s].
    distance: f64,
    bound: f64,
    /// Estimated error of the attempt reviewed last, over the tolerance.
    error: f64,
    /// Its size [s], and the extent of its motion.
    reviewed: f64,
    reached: Extent,
}

/// What errors are related to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Extent {
    /// Largest displacement of a node, at most 1 [-].
    displacement: f64,
    /// Largest scaled acceleration [1/s²]; zero if forces are not controlled.
    acceleration: f64,
}

impl Extent {
    fn or(self, other: Self) -> Self {
        Self {
            displacement: self.displacement.max(other.displacement),
            acceleration: self.acceleration.max(other.acceleration),
        }
    }
}

impl Adaptive {
    /// At the start, with a first step of `size` [s].
    pub(crate) fn new(control: StepControl, size: f64) -> Self {
        let (distance, bound) = (control.max_step, control.max_step);
        let controller = Controller::new(size);
        Self {
            control,
            controller,
            farthest: Extent::default(),
            defect: 0.0,
            distance,
            bound,
            error: 1.0,
            reviewed: 0.0,
            reached: Extent::default(),
        }
    }

    /// Estimated error of an attempt over the allowed error, converted to third order in the step size: raised to the
    /// power of three over the order of the estimate.
    fn estimated_error(&mut self, review: Review<'_>) -> f64 {
        let StepControl { relative_tolerance: tolerance, max_step, of: controlled } = self.control;
        let Problem { system, settings } = review.problem;
        let integrator = review.integrator;
        let (end, length) = (&review.attempt.end.kinematics, integrator.representative.length);
        let displacement = excursion(system, (review.origin, end), length);
        self.reached = Extent { displacement, acceleration: 0.0 };
        let mut reference = self.farthest.displacement.max(displacement).max(MIN_REFERENCE);
        if reference < 1.0 {
            reference = reference.max(driven(system, (review.origin.time, end.time + max_step), length));
        }
        let scheme_order = f64::from(settings.scheme.controlled_order);
        let is_third_order = scheme_order > 2.0;
        let is_fourth = is_third_order && integrator.work.is_miss_known();
        let order = if is_fourth { ErrorOrder::Fourth } else { ErrorOrder::Third };
        integrator.estimate_error(review.problem, end, review.last_size, order, review.has_switched);
        let work = &*integrator.work;
        let largest = work.filtered.iter().zip(&work.sizes).fold(0.0_f64, |most, (error, size)| {
            if (error * size).abs() <= most { most } else { (error * size).abs() }
        });
        let tuning = &settings.limits.tuning;
        let share = tuning.of(TuningParameter::ShareOfStep);
        let (allowed, power) = match order {
            ErrorOrder::Third if is_third_order => (FIRST * tolerance, 1.0),
            ErrorOrder::Third => (share * tolerance.powf(3.0 / 2.0), 1.0),
            ErrorOrder::Fourth => (share * tolerance.powf(4.0 / scheme_order), 3.0 / 4.0),
        };
        let positions = largest / (reference * allowed).max(MIN_ERROR);
        // First-order states, each relative to its magnitude, unfiltered.
        let of = |(row, coordinate, magnitude): (usize, CoordinateId, f64)| {
            let value = review.start.kinematics.coordinates[coordinate].value;
            (work.error[row] / magnitude.max(value.abs())).abs()
        };
        // A NaN counts as the largest.
        let states = system.layout().states().map(of);
        let states =
            states.fold(0.0_f64, |most, error| if error <= most || most.is_nan() { most } else { error });
        let states = states / allowed;
        let mut error = if states <= positions || positions.is_nan() { positions } else { states };
        if controlled == Controlled::Forces {
            let (error_of_forces, acceleration) = integrator.error_of_forces(review.problem, end);
            self.reached.acceleration = acceleration;
            let largest = self.farthest.or(self.reached).acceleration;
            let forces = error_of_forces / (largest * tolerance).max(f64::MIN_POSITIVE);
            error = if forces <= error || error.is_nan() { error } else { forces };
        }
        let error = error.powf(power);
        // A tangent that remains valid over the step shows that the equations change little within it, unless the last defect was
        // considerable. A step that is rejected needs no second reason.
        let is_due = review.attempt.outcome.factorizations > 0 || self.defect > NEGLIGIBLE_DEFECT;
        if !(is_due && error <= 1.0) {
            return error;
        }
        let defect = integrator.defect(review.problem, (review.start, &review.attempt.end));
        self.defect = defect / (tolerance.min(MAX_DEFECT) * reference).max(MIN_ERROR);
        if self.defect <= error { error } else { self.defect }
    }
}

impl Control for Adaptive {
    fn longest(&self) -> f64 {
        self.control.max_step
    }

    fn planned(&self) -> Option<f64> {
        None
    }

    fn by_error(&self) -> Option<f64> {
        Some(self.controller.size().min(self.control.max_step))
    }

    fn aim(&mut self, distance: f64, bound: f64) {
        (self.distance, self.bound) = (distance, bound);
    }

    fn limit(&mut self, size: f64) {
        self.bound = self.bound.min(size);
    }

    fn propose(&mut self) -> f64 {
        let size = self.controller.propose(self.distance).min(self.control.max_step).min(self.bound);
        // The remainder would be round-off, over which velocities cannot be determined.
        if (self.distance - size).abs() <= SAME * size { self.distance } else { size }
    }

    fn review(&mut self, review: Review<'_>) -> bool {
        let (size, tuning) = (review.attempt.size, review.problem.settings.limits.tuning);
        self.reviewed = size;
        self.error = self.estimated_error(review);
        let is_accurate = self.error <= 1.0;
        if !is_accurate {
            self.controller.reject(size, self.error, &tuning);
        }
        is_accurate
    }

    fn shorten(&mut self, size: f64, has_solution: bool) -> bool {
        if !has_solution {
            self.controller.fail(size);
        }
        self.controller.size() >= SHORTEST * self.control.max_step
    }

    fn accept(&mut self, attempt: &Attempt, tuning: &Tuning) -> bool {
        self.controller.accept(attempt.size, self.error, self.control.max_step, tuning);
        // An event may have ended the step before the time at which it was reviewed.
        if attempt.size == self.reviewed {
            self.farthest = self.farthest.or(self.reached);
        }
        attempt.size == self.distance
    }

    fn prefers_first_failure(&self) -> bool {
        false
    }

    fn error(&self) -> Option<f64> {
        Some(self.error)
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.controller, self.farthest, self.defect))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let mut learned = (self.controller, self.farthest, self.defect);
        let is_read = from_bytes(saved, &mut learned);
        (self.controller, self.farthest, self.defect) = learned;
        is_read
    }
}

/// The controller between two steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Controller {
    /// Size of the next step [s].
    size: f64,
    /// Whether the last attempt failed: the step then does not grow at once.
    has_failed: bool,
}

impl Controller {
    /// At the start, with a first step of `size` [s].
    fn new(size: f64) -> Self {
        Self { size, has_failed: false }
    }

    /// Size of the next step [s].
    fn size(&self) -> f64 {
        self.size
    }

    /// Shortens the next attempt to end at the target; the size is kept for later.
    fn propose(&self, rest: f64) -> f64 {
        if self.size >= rest * (1.0 - 1e-9) {
            rest
        } else if 2.0 * self.size > rest {
            // Two steps of equal size rather than a long and a very short one.
            0.5 * rest
        } else {
            self.size
        }
    }

    /// A step of `taken` [s] is accepted with an estimated error of `error` times the tolerance.
    fn accept(&mut self, taken: f64, error: f64, max_step: f64, tuning: &Tuning) {
        let largest = if self.has_failed { 1.0 } else { MAX_GROWTH };
        let factor = (tuning.of(TuningParameter::Safety) * error.powf(-1.0 / ORDER)).min(largest);
        self.has_failed = false;
        let kept = tuning.of(TuningParameter::Kept);
        let wanted = taken * if (1.0 / kept..kept).contains(&factor) { 1.0 } else { factor };
        // A step shortened to end at the target shows that at least its size is possible.
        self.size = if taken < self.size { wanted.max(self.size.min(taken * factor)) } else { wanted };
        self.size = self.size.min(max_step);
    }

    /// A step of `taken` [s] is rejected: its estimated error is `error` times the tolerance, above 1.
    fn reject(&mut self, taken: f64, error: f64, tuning: &Tuning) {
        if error.is_finite() {
            self.size = taken * tuning.of(TuningParameter::Safety) * error.powf(-1.0 / ORDER);
            self.has_failed = true;
        } else {
            self.fail(taken);
        }
    }

    /// A step of `taken` [s] has no solution.
    fn fail(&mut self, taken: f64) {
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
        // A constant problem is solved with one step size.
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
