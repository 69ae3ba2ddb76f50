//! Steps as long as their estimated error allows: the size of the next one follows from the error of the last one.
//!
//! ```text
//! h_{n+1} = 0.8 a_n min(1, a_n/a_{n-1}),      a_n = h_n/ε_n        [Gustafsson 1994]
//! ```
//!
//! Legend: a allowed step size, with the largest allowed error; ε ratio of the step size to it. If the allowed size decreases
//! from step to step, it is expected to decrease again. The size is kept if it would change only slightly. It grows slowly after
//! a step that needed many iterations, and shrinks after one that needed very many, if that has been of use; a size without
//! solution is avoided for a while.

use serde::{Deserialize, Serialize};

use super::interface::{Control, Review};
use crate::bytes::{read_bytes, to_bytes};
use crate::instants::TIME_TOLERANCE;
use crate::integrator::Attempt;
use crate::integrator::error_estimate::{
    MIN_ERROR, MIN_REFERENCE, driven, excursion, larger, largest, relative_size, travel,
};
use crate::kinematics::CoordinateId;
use crate::settings::{Controlled, Problem, StepControl};
use crate::tuning::{Tuning, TuningParameter};

/// Fraction of the tolerance that a step may err in accelerations: the errors of a vibration add up over its periods.
const SHARE_OF_FORCES: f64 = 0.4;
/// Largest growth of a step.
const MAX_GROWTH: f64 = 2.5;
/// Iterations of a step after which the next one grows slowly, and those and tangents after which it becomes shorter: longer steps
/// would cost more than they gain.
const MANY_ITERATIONS: usize = 8;
const TOO_MANY_ITERATIONS: usize = 14;
const MANY_TANGENTS: usize = 2;
/// Slow growth, and the ratio by which steps are shortened.
const SLOW_GROWTH: f64 = 1.25;
const SHORTENED: f64 = 0.7;
/// Fraction of a size without solution to which steps grow, and growth of that limit per step.
const BELOW_FAILED: f64 = 0.8;
const FORGETTING: f64 = 1.02;
/// Smallest ratio of the allowed sizes of two steps that is expected to continue.
const MIN_TREND: f64 = 0.5;
/// Largest defect in the middle of a step, as a fraction of the reference, if the tolerance is not smaller: a tolerance coarser
/// than the distance of two branches does not distinguish them. For a four-bar whose links pass through one line, generalized-α,
/// HHT and Radau IIA find the correct branch even with seven times this limit.
const MAX_DEFECT: f64 = 1e-3;
/// Ratio of sizes below which the last step was longer.
const SHORTER: f64 = 0.9;
/// Largest growth from step to step of the size that the defect allows: the defect of a periodic motion vanishes twice a period.
const MAX_GROWTH_BY_DEFECT: f64 = 1.5;
/// Defects below this fraction of the allowed one are not expected to exceed it in the next step.
const NEGLIGIBLE_DEFECT: f64 = 0.02;
/// Steps shorter than this fraction of the largest one are not tried [-].
const SHORTEST: f64 = 1e-12;

/// Control of adaptive steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Adaptive {
    control: StepControl,
    controller: Controller,
    /// Largest motion since the start.
    farthest: Extent,
    /// Defect that was evaluated last, over the allowed one, and the size that it allows [s].
    defect: f64,
    by_defect: f64,
    /// Duration to the target of the present step, and the longest step on the way [s].
    distance: f64,
    bound: f64,
    /// Size of the attempt reviewed last over that of a step with the largest allowed error.
    excess: f64,
    /// Size of the attempt reviewed last [s], and the extent of its motion.
    reviewed: f64,
    reached: Extent,
}

/// What errors are related to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Extent {
    /// Largest displacement of a node, at most 1 [-].
    displacement: f64,
    /// Largest mean displacement of the nodes [-].
    travel: f64,
    /// Largest scaled acceleration [1/s²]; zero if forces are not controlled.
    acceleration: f64,
}

impl Extent {
    fn or(self, other: Self) -> Self {
        Self {
            displacement: self.displacement.max(other.displacement),
            travel: self.travel.max(other.travel),
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
            by_defect: f64::INFINITY,
            distance,
            bound,
            excess: 1.0,
            reviewed: 0.0,
            reached: Extent::default(),
        }
    }

    /// The size of an attempt over that of a step with the largest allowed error.
    fn excess_of(&mut self, review: Review<'_>) -> f64 {
        let StepControl { relative_tolerance: tolerance, max_step, of: controlled } = self.control;
        let Problem { system, settings } = review.problem;
        let integrator = review.integrator;
        let (end, length) = (&review.attempt.end.kinematics, integrator.representative.length);
        let displacement = excursion(system, (review.origin, end), length);
        let travel = travel(system, (review.origin, end)) / length;
        self.reached = Extent { displacement, travel, acceleration: 0.0 };
        let mut reference = self.farthest.displacement.max(displacement).max(MIN_REFERENCE);
        if reference < 1.0 {
            reference = reference.max(driven(system, (review.origin.time, end.time + max_step), length));
        }
        let references = [reference, reference.max(self.farthest.travel).max(travel)];
        let limits = |allowed: f64| references.map(|reference| (allowed * reference).max(MIN_ERROR));
        let scheme = &settings.scheme;
        let share = settings.limits.tuning.of(TuningParameter::ShareOfStep);
        let root = |ratio: f64, order: i32| ratio.powf(1.0 / f64::from(order));
        let mut excess = 0.0;
        for estimate in &scheme.errors {
            let order = estimate.order;
            let allowed = share * tolerance.powf(f64::from(order) / f64::from(scheme.order));
            integrator.estimate_error(review.problem, estimate, end, review.has_switched);
            let work = &*integrator.work;
            let scaled = |row: usize| work.error.at_end[row] * work.units.coordinates[row];
            let positions = relative_size(system, end, scaled, limits(allowed));
            // First-order states, each relative to its magnitude, unfiltered.
            let of = |(row, coordinate, magnitude): (usize, CoordinateId, f64)| {
                let value = review.start.kinematics.coordinates[coordinate].value;
                work.error.unfiltered[row] / magnitude.max(value.abs())
            };
            let states = largest(system.layout().states().map(of)) / allowed;
            excess = larger(excess, root(larger(positions, states), order));
            if controlled == Controlled::Forces {
                let (error, acceleration) = integrator.error_of_forces(review.problem, end);
                self.reached.acceleration = acceleration;
                let largest = self.farthest.or(self.reached).acceleration;
                let forces = error / (largest * SHARE_OF_FORCES * tolerance).max(f64::MIN_POSITIVE);
                excess = larger(excess, root(forces, order));
            }
        }
        // The polynomial of two stages alone is no better than their start, unless that comes from a longer step.
        if scheme.stages.len() > 2 || review.attempt.size < SHORTER * self.controller.last[0] {
            integrator.correct_dense_start(review.problem);
        }
        // A tangent that remains valid over the step shows that the equations change little within it, unless the last defect was
        // considerable, or is that of a shorter step with drives, which error estimates of free directions do not see. A step that is
        // rejected needs no second reason.
        let is_due = review.attempt.outcome.factorizations > 0
            || self.defect > NEGLIGIBLE_DEFECT
            || review.attempt.size > self.by_defect && system.has_driven_constraint(end);
        if !(is_due && excess <= 1.0) {
            return excess;
        }
        let ends = (review.start, &review.attempt.end);
        let order = integrator.dense(review.problem, ends).order();
        let allowed = tolerance.min(MAX_DEFECT);
        self.defect = integrator.defect(review.problem, ends, limits(allowed));
        let (size, own) = (review.attempt.size, root(self.defect, order));
        let by_last = size / (MAX_GROWTH_BY_DEFECT * self.by_defect);
        let of_defect = larger(own, by_last.min(1.0));
        if of_defect.is_finite() {
            self.by_defect = size / of_defect;
        }
        larger(excess, of_defect)
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
        if (self.distance - size).abs() <= TIME_TOLERANCE * size { self.distance } else { size }
    }

    fn review(&mut self, review: Review<'_>) -> bool {
        let (size, tuning) = (review.attempt.size, review.problem.settings.limits.tuning);
        self.reviewed = size;
        self.excess = self.excess_of(review);

        let is_accurate = self.excess <= 1.0;
        if !is_accurate {
            self.controller.reject(size, self.excess, &tuning);
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
        let limits = (self.controller.growth(attempt), self.control.max_step);
        self.controller.accept(attempt.size, self.excess, limits, tuning);
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
        Some(self.excess)
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(&(self.controller, self.farthest, self.defect, self.by_defect))
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        read_bytes(saved)
            .map(|learned| (self.controller, self.farthest, self.defect, self.by_defect) = learned)
            .is_some()
    }
}

/// The controller between two steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Controller {
    /// Size of the next step [s].
    size: f64,
    /// Whether the last attempt failed: the step then does not grow at once.
    has_failed: bool,
    /// Largest allowed size of the last accepted step [s]; zero before the first.
    allowed: f64,
    /// Size of the last accepted step [s], and its iterations per second.
    last: [f64; 2],
    /// Size below which fewer iterations are not expected [s].
    futile: f64,
    /// Limit from a size without solution [s].
    failed: f64,
}

impl Controller {
    /// At the start, with a first step of `size` [s].
    fn new(size: f64) -> Self {
        Self { size, has_failed: false, allowed: 0.0, last: [0.0; 2], futile: 0.0, failed: f64::INFINITY }
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

    /// Largest growth after an accepted attempt, by its iterations.
    fn growth(&mut self, attempt: &Attempt) -> f64 {
        let (size, outcome) = (attempt.size, &attempt.outcome);
        let last = std::mem::replace(&mut self.last, [size, outcome.iterations as f64 / size]);
        if outcome.iterations <= MANY_ITERATIONS {
            self.futile = 0.0;
            return MAX_GROWTH;
        }
        if size < last[0] && self.last[1] > last[1] {
            self.futile = size;
        }
        let is_laborious = outcome.iterations > TOO_MANY_ITERATIONS || outcome.factorizations > MANY_TANGENTS;
        if is_laborious && size > self.futile { SHORTENED } else { SLOW_GROWTH }
    }

    /// A step of `taken` [s] is accepted, which is `excess` times as long as one with the largest allowed error. The next one may grow
    /// by a factor, and to a size.
    fn accept(&mut self, taken: f64, excess: f64, (growth, max_step): (f64, f64), tuning: &Tuning) {
        // A step shortened to end at the target shows little of the work of longer ones.
        let growth = if taken < self.size { MAX_GROWTH } else { growth };
        let largest = if self.has_failed { growth.min(1.0) } else { growth };
        let allowed = taken / excess;
        let trend = (allowed / std::mem::replace(&mut self.allowed, allowed)).sqrt().clamp(MIN_TREND, 1.0);
        // After a step without any error there is no trend.
        let trend = if trend.is_nan() { 1.0 } else { trend };
        let factor = (tuning.of(TuningParameter::Safety) * trend / excess).min(largest);
        self.has_failed = false;
        let kept = tuning.of(TuningParameter::Kept);
        let wanted = taken * if (1.0 / kept..kept).contains(&factor) { 1.0 } else { factor };
        // A step shortened to end at the target shows that at least its size is possible.
        self.size = if taken < self.size { wanted.max(self.size.min(taken * factor)) } else { wanted };
        self.failed *= FORGETTING;
        self.size = self.size.min(max_step).min(self.failed);
    }

    /// A step of `taken` [s] is rejected, which is `excess` times as long, more than 1.
    fn reject(&mut self, taken: f64, excess: f64, tuning: &Tuning) {
        if excess.is_finite() {
            self.size = taken * tuning.of(TuningParameter::Safety) / excess;
            self.has_failed = true;
        } else {
            self.fail(taken);
        }
    }

    /// A step of `taken` [s] has no solution.
    fn fail(&mut self, taken: f64) {
        self.size = 0.25 * taken;
        self.failed = BELOW_FAILED * taken;
        self.has_failed = true;
    }
}

#[cfg(test)]
#[path = "../../tests/unit/control/adaptive.rs"]
mod tests;
