//! Whether steps of planned size resolve the motion. At intervals the error of two consecutive steps is estimated, and
//! the accumulated error over the run is compared with the displacement of the model. The errors of instants are added.
//!
//! ```text
//! E_i = s min(Σ |ẽ_i|, 8 A_i) + s' Σ' |ẽ_i|,      A_i = |e_i| / (C (ωh)^k),   ωh = |e_i - e_i'| / |e_i|
//! ```
//!
//! Legend: e error of a step, ẽ the same filtered through the tangent (see `error_estimate`), by unknown and scaled; e' that of
//! the next step; A amplitude of the unresolved motion: the error of an oscillation out of phase is twice that, and it was
//! larger before it was damped; C, k constant and order of the estimate, s error at the end as a fraction of the sum of the
//! estimates, by scheme; Σ' sum over the steps of instants, s' = 0.4. Fitted to some eight
//! hundred random mechanisms, for which the error relative to the reference was mostly 0.2 to 3.6 times E.

use serde::{Deserialize, Serialize};

use super::instants::Instants;
use super::monitor::{Accepted, Beginning, Monitor};
use super::pairs::Pairs;
use crate::bytes::{from_bytes, to_bytes};
use crate::errors::{Warning, report};
use crate::integrator::error_estimate::{MIN_REFERENCE, excursion};
use crate::schemes::ErrorEstimate;
use std::f64::consts::FRAC_2_PI;

/// If the errors of two successive steps, or of two successive pairs, differ by more than this factor, they are due to an
/// instant, not to the motion.
const SPIKE: f64 = 4.0;
/// Maximum error of an oscillation, in amplitudes.
const MAX_ERROR: f64 = 8.0;
/// Estimates above this fraction of the model's displacement are reported. If a motion amplifies errors, the error at the end is
/// up to ten times the estimate: among 10 000 random mechanisms, four with estimates of 0.15 to 0.19 % had errors of 1 to 2.5 %.
const NOTEWORTHY: f64 = 1e-3;
/// Error at the end as a fraction of the errors at instants. The estimates for a wheelset's contacts, which are resolved to
/// 0.07 %, sum to 0.12 %; those for unresolved friction with an error of 3 % sum to 0.4 %.
const INSTANT_SHARE: f64 = 0.4;

/// Estimates for one unknown [scaled].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Missed {
    /// Sum of the filtered errors of all steps so far, interpolated linearly from pair to pair.
    sum: f64,
    /// Filtered error of a step of the last pair.
    last: f64,
    /// Sums over all pairs: unfiltered errors, and their differences within a pair.
    errors: f64,
    differences: f64,
    /// Sum of the filtered errors of steps that contain an instant.
    instants: f64,
}

impl Missed {
    /// Estimated error of the unknown, `steps` steps after the last pair. `share` is the fraction of the sum that remains at the
    /// end of a smooth motion.
    fn total(&self, pairs: f64, steps: f64, estimate: &ErrorEstimate, share: f64) -> f64 {
        let angle = self.differences / self.errors;
        // The mean of |cos| is 2/π.
        let amplitude =
            self.errors / (2.0 * pairs * FRAC_2_PI * estimate.of_oscillation * angle.powi(estimate.order));
        // Without differences there is no oscillation.
        let sum = self.sum + steps * self.last;
        let vibration = if amplitude.is_nan() { sum } else { sum.min(MAX_ERROR * amplitude) };
        share * vibration + INSTANT_SHARE * self.instants
    }
}

/// Estimated errors of steps of planned size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Resolution {
    missed: Vec<Missed>,
    /// Filtered and unfiltered errors of the first step of a pair.
    first: Vec<[f64; 2]>,
    pairs: Pairs,
    instants: Instants,
    /// Planned steps since the last pair; parts of them by their fraction.
    steps: f64,
    /// Number of pairs.
    count: f64,
    /// Largest displacement of a node since the start, at most 1 [-].
    farthest: f64,
}

impl Resolution {
    /// At the start of a motion with this number of coordinates.
    fn new(coordinates: usize) -> Self {
        Self {
            missed: vec![Missed::default(); coordinates],
            first: vec![[0.0; 2]; coordinates],
            pairs: Pairs::new(),
            instants: Instants::default(),
            steps: 0.0,
            count: 0.0,
            farthest: 0.0,
        }
    }

    /// Counts a step. Whether its error is to be estimated.
    fn is_due(&mut self, fraction: f64) -> bool {
        self.steps += fraction;
        self.pairs.is_due(fraction)
    }

    /// Records the errors of a step: filtered and not, by coordinate row. Whether a pair is complete.
    fn note<'e>(&mut self, errors: impl Iterator<Item = [f64; 2]> + Clone + 'e) -> bool {
        if !self.pairs.is_complete() {
            for (first, errors) in self.first.iter_mut().zip(errors) {
                *first = errors;
            }
            return false;
        }
        let largest =
            |of: &mut dyn Iterator<Item = f64>| of.fold(0.0_f64, |most, error| most.max(error.abs()));
        let one = largest(&mut self.first.iter().map(|errors| errors[0]));
        let other = largest(&mut errors.clone().map(|errors| errors[0]));
        let weight = (SPIKE * one.min(other) / one.max(other)).min(1.0);
        let weight = if weight.is_nan() { 0.0 } else { weight };
        let (steps, is_first) = (self.steps, self.count == 0.0);
        for ((missed, first), second) in self.missed.iter_mut().zip(&self.first).zip(errors) {
            // Per planned step.
            let error = 0.5 * weight * (first[0].abs() + second[0].abs()) / self.pairs.fraction;
            missed.sum += 0.5 * steps * (error + if is_first { error } else { missed.last });
            missed.last = error;
            missed.errors += first[1].abs() + second[1].abs();
            missed.differences += 2.0 * (first[1] - second[1]).abs();
        }
        (self.count, self.steps) = (self.count + 1.0, 0.0);
        true
    }

    /// Adds the filtered errors of a step of an instant. Those that pairs of steps have as well are counted there.
    fn note_instant<'e>(&mut self, errors: impl Iterator<Item = [f64; 2]> + Clone + 'e) {
        let largest = errors.clone().fold(0.0_f64, |most, error| most.max(error[0].abs()));
        let of_pairs = self.missed.iter().fold(0.0_f64, |most, missed| most.max(missed.last));
        if self.count > 0.0 && largest > SPIKE * of_pairs {
            let missed = self.missed.iter_mut().zip(errors);
            missed.for_each(|(missed, error)| missed.instants += error[0].abs());
        }
    }

    /// The coordinate row with the largest error, and that error.
    fn worst(&self, estimate: &ErrorEstimate, share: f64) -> (usize, f64) {
        let all = self
            .missed
            .iter()
            .map(|missed| missed.total(self.count, self.steps, estimate, share))
            .enumerate();
        all.fold((0, 0.0), |worst, (row, total)| if total > worst.1 { (row, total) } else { worst })
    }
}

pub(super) fn begin(beginning: &Beginning<'_>) -> Option<Box<dyn Monitor>> {
    let coordinates = beginning.problem.system.layout().coordinate_count();
    // Errors of positions mean little where parts collide: there the energy that the scheme loses is examined.
    let is_examined =
        beginning.is_planned_motion() && coordinates > 0 && beginning.problem.system.contacts().is_empty();
    is_examined.then(|| Box::new(Resolution::new(coordinates)) as Box<dyn Monitor>)
}

impl Monitor for Resolution {
    fn accept(&mut self, step: &mut Accepted<'_>, warnings: &mut Vec<Warning>) {
        let (system, end) = (step.problem.system, &step.end.kinematics);
        let scheme = &step.problem.settings.scheme;
        let Some(estimate) = scheme.errors.first() else { return };
        let is_unresolved = |warning: &Warning| matches!(warning, Warning::Unresolved { .. });
        let is_instant = step.fraction == 1.0 && self.instants.contain(step.prediction_error);
        let is_due = self.is_due(step.fraction);
        if is_due || is_instant {
            step.integrator.estimate_error(step.problem, estimate, end, step.has_switched);
        }
        let work = &*step.integrator.work;
        let errors = work.error.at_end.iter().zip(&work.error.unfiltered).zip(&work.units.coordinates);
        let errors = errors.map(|((filtered, error), size)| [filtered * size, error * size]);
        if is_instant {
            self.note_instant(errors.clone());
        }
        let is_pair = is_due && self.note(errors);
        // A reported warning is updated in every step, so that its values are those of the end.
        if !is_pair && !is_instant && !warnings.iter().any(is_unresolved) {
            return;
        }
        let length = step.integrator.representative.length;
        self.farthest = self.farthest.max(excursion(system, (step.origin, end), length));
        let (row, total) = self.worst(estimate, scheme.planned_share);
        let part = total / self.farthest.max(MIN_REFERENCE);
        report(warnings, is_unresolved, |known| {
            // An error at the start may be small compared with the later displacement of the model.
            if part <= NOTEWORTHY {
                return None;
            }
            let (time, unknown) = match known {
                Some(Warning::Unresolved { time, unknown, .. }) => (*time, Some(unknown.clone())),
                _ => (end.time, None),
            };
            let unknown = unknown
                .filter(|_| !is_pair && !is_instant)
                .unwrap_or_else(|| system.layout().subject_of(row));
            Some(Warning::Unresolved { time, error: part, unknown })
        });
    }

    fn save(&self) -> Vec<u8> {
        to_bytes(self)
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let coordinates = self.missed.len();
        from_bytes(saved, self) && self.missed.len() == coordinates
    }
}

#[cfg(test)]
#[path = "../../tests/unit/monitors/resolution.rs"]
mod tests;
