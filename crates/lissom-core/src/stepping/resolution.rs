//! Whether steps of planned size resolve the motion: now and then the error of two steps in a row is estimated, and what
//! such errors come to over the run is compared with how far the model moves.
//!
//! ```text
//! E_i = s min(Σ |ẽ_i|, 8 A_i),      A_i = |e_i| / (C (ωh)³),   ωh = |e_i - e_i'| / |e_i|
//! ```
//!
//! Legend: e error of a step, ẽ the same filtered through the tangent (see `error_estimate`), by unknown and scaled; e' that of
//! the step after it; A amplitude of what is missed: an oscillation that gets out of phase errs twice by it, and it was larger
//! before it was damped;
//! s part of the sum that errors at the end come to, by scheme. Fitted to some eight hundred random mechanisms, where the
//! error beside the reference was mostly 0.2 to 3.6 times E.

use serde::{Deserialize, Serialize};

use super::error_estimate::{MIN_REFERENCE, Order};
use crate::analysis::{Simulation, warn};
use crate::judge::{self, Warning};

/// Steps or parts from one pair that is looked at to the next: with the two estimates of sixteen steps a chain of ten rigid bodies took
/// four per cent more instructions.
const STRIDE: u32 = 64;
/// Steps or parts before the first pair.
const FIRST: u32 = 4;
/// Errors of two steps in a row that differ by more than this factor belong to an instant, not to the motion.
const SPIKE: f64 = 4.0;
/// C: local error of an oscillation over (ωh)³ times its amplitude, for all schemes about a twelfth.
const OSCILLATION: f64 = 1.0 / 12.0;
/// Mean of |cos|.
const MEAN_COSINE: f64 = std::f64::consts::FRAC_2_PI;
/// Most that an oscillation errs, in amplitudes.
const MAX_ERROR: f64 = 8.0;
/// Estimates beyond this part of how far the model moves are reported. Where motions amplify errors, those at the end are up to ten
/// times the estimate: of 10 000 random mechanisms four erred by 1 to 2.5 % with estimates of 0.15 to 0.19 %.
const NOTEWORTHY: f64 = 1e-3;
/// Rates of constraints that miss more than this part of the speed are reported: forces then err by a multiple of it.
const NOTEWORTHY_RATES: f64 = 0.02;

/// What is known of one unknown [scaled].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Missed {
    /// Sum of the filtered errors of all steps so far, as if they changed linearly from pair to pair.
    sum: f64,
    /// Filtered error of a step of the last pair.
    last: f64,
    /// Sums over all pairs: unfiltered errors, and how they differ within a pair.
    errors: f64,
    differences: f64,
}

impl Missed {
    /// How far the unknown may be off so many steps after the last pair.
    fn total(&self, pairs: f64, steps: f64) -> f64 {
        let angle = self.differences / self.errors;
        let amplitude = self.errors / (2.0 * pairs * MEAN_COSINE * OSCILLATION * angle.powi(3));
        // Where nothing differs there is no oscillation.
        let sum = self.sum + steps * self.last;
        if amplitude.is_nan() { sum } else { sum.min(MAX_ERROR * amplitude) }
    }
}

/// What steps of planned size are estimated to miss.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Resolution {
    missed: Vec<Missed>,
    /// Filtered and unfiltered errors of the first step of a pair.
    first: Vec<[f64; 2]>,
    /// Whether they are those of the last step.
    has_first: bool,
    /// Planned steps since the last pair; parts of them by their share.
    steps: f64,
    /// Steps and parts until the next pair.
    wait: u32,
    /// Share of the planned size of the last one.
    share: f64,
    pairs: f64,
    /// Sums over all steps looked at: what rates of constraints miss, and speeds.
    rates: [f64; 2],
}

impl Resolution {
    /// At the start of a motion with steps of planned size and so many coordinates.
    pub(crate) fn new(coordinates: usize) -> Self {
        Self {
            missed: vec![Missed::default(); coordinates],
            first: vec![[0.0; 2]; coordinates],
            wait: FIRST,
            ..Self::default()
        }
    }

    /// Counts a step, or a part of one, by its share of the planned size. Whether its error is to be estimated. Two in a row
    /// of one size are a pair: a motion may take each planned step in parts.
    fn is_due(&mut self, share: f64) -> bool {
        self.steps += share;
        self.wait = self.wait.saturating_sub(1);
        self.has_first &= share == self.share;
        self.share = share;
        self.wait == 0
    }

    /// Takes note of the errors of a step: filtered and not, by coordinate row. Whether a pair is complete.
    fn note<'e>(&mut self, errors: impl Iterator<Item = [f64; 2]> + Clone + 'e) -> bool {
        if !self.has_first {
            for (first, errors) in self.first.iter_mut().zip(errors) {
                *first = errors;
            }
            self.has_first = true;
            return false;
        }
        let largest =
            |of: &mut dyn Iterator<Item = f64>| of.fold(0.0_f64, |most, error| most.max(error.abs()));
        let one = largest(&mut self.first.iter().map(|errors| errors[0]));
        let other = largest(&mut errors.clone().map(|errors| errors[0]));
        let weight = (SPIKE * one.min(other) / one.max(other)).min(1.0);
        let weight = if weight.is_nan() { 0.0 } else { weight };
        let (steps, is_first) = (self.steps, self.pairs == 0.0);
        for ((missed, first), second) in self.missed.iter_mut().zip(&self.first).zip(errors) {
            // Per planned step.
            let error = 0.5 * weight * (first[0].abs() + second[0].abs()) / self.share;
            missed.sum += 0.5 * steps * (error + if is_first { error } else { missed.last });
            missed.last = error;
            missed.errors += first[1].abs() + second[1].abs();
            missed.differences += 2.0 * (first[1] - second[1]).abs();
        }
        self.pairs += 1.0;
        (self.has_first, self.steps, self.wait) = (false, 0.0, STRIDE - 1);
        true
    }

    /// The coordinate row that is off most, and by how much.
    fn worst(&self) -> (usize, f64) {
        let all = self.missed.iter().map(|missed| missed.total(self.pairs, self.steps)).enumerate();
        all.fold((0, 0.0), |worst, (row, total)| if total > worst.1 { (row, total) } else { worst })
    }
}

impl Simulation {
    /// What the rates of constraints miss at the end of a step that is looked at.
    fn note_rates(&mut self) {
        let (from, to) = (&self.state.kinematics, &self.next.kinematics);
        let (length, step) = (self.representative.length, to.time - from.time);
        let found = self.constraint_rates.missed(&self.system, to, length, step);
        let rates = &mut self.resolution.rates;
        rates.iter_mut().zip(found).for_each(|(sum, found)| *sum += found);
        let part = rates[0] / rates[1];
        let known =
            self.warnings.iter().position(|warning| matches!(warning, Warning::UnresolvedRates { .. }));
        match (known, part > NOTEWORTHY_RATES) {
            // What a start has shaken may turn out small beside what follows.
            (Some(known), false) => {
                self.warnings.remove(known);
            }
            (Some(known), true) => {
                if let Warning::UnresolvedRates { missed, .. } = &mut self.warnings[known] {
                    *missed = part;
                }
            }
            (None, true) => {
                let time = self.next.kinematics.time;
                warn(&mut self.warnings, Warning::UnresolvedRates { time, missed: part });
            }
            (None, false) => {}
        }
    }

    /// Before a step of planned size, or a part of one that is this share of it, is accepted.
    pub(super) fn note_resolution(&mut self, share: f64) {
        if self.resolution.missed.is_empty() {
            return;
        }
        let step = (&self.state.kinematics, &self.next.kinematics);
        if let Some(warning) = judge::contact::runs_round(&self.system, step) {
            warn(&mut self.warnings, warning);
        }
        let is_due = self.resolution.is_due(share);
        if is_due {
            self.note_rates();
        }
        let known = self.warnings.iter().position(|warning| matches!(warning, Warning::Unresolved { .. }));
        let mut is_pair = false;
        if is_due {
            self.estimate_error(Order::Third);
            let work = &*self.work;
            let errors = work.filtered.iter().zip(&work.error).zip(&work.sizes);
            is_pair =
                self.resolution.note(errors.map(|((filtered, error), size)| [filtered * size, error * size]));
        }
        // What has been reported is kept up to date with every step, so that the last word is that of the end.
        if !is_pair && known.is_none() {
            return;
        }
        self.farthest = self.farthest.max(self.excursion_of(&self.next));
        let (row, total) = self.resolution.worst();
        let part = self.settings.scheme.planned_share * total / self.farthest.max(MIN_REFERENCE);
        if part <= NOTEWORTHY {
            // What looked large at the start may turn out small beside how far the model goes.
            if let Some(known) = known {
                self.warnings.remove(known);
            }
            return;
        }
        let system = &self.system;
        match known.map(|known| &mut self.warnings[known]) {
            Some(Warning::Unresolved { error, unknown, .. }) => {
                *error = part;
                if is_pair {
                    *unknown = system.layout().name_of(row);
                }
            }
            _ => warn(
                &mut self.warnings,
                Warning::Unresolved {
                    time: self.next.kinematics.time,
                    error: part,
                    unknown: system.layout().name_of(row),
                },
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is estimated of an oscillation whose error is C (ωh)³ per step, of this amplitude, after so many steps.
    fn estimated(angle: f64, amplitude: f64, steps: u32) -> f64 {
        let mut resolution = Resolution::new(1);
        for step in 0..steps {
            if resolution.is_due(1.0) {
                let error = OSCILLATION * angle.powi(3) * amplitude * (angle * f64::from(step)).cos();
                resolution.note(std::iter::once([error; 2]));
            }
        }
        resolution.worst().1
    }

    #[test]
    fn errors_add_up_to_the_phase_that_is_lost_and_no_further_than_the_amplitude() {
        for angle in [0.03_f64, 0.1, 0.37] {
            let lost = OSCILLATION * angle.powi(3) * 1000.0;
            let sum = estimated(angle, 0.01, 1000);
            assert!((0.4..1.6).contains(&(sum / (0.01 * lost.min(2.0)))), "{angle}: {sum}");
        }
        let most = estimated(0.37, 1e-4, 1_000_000);
        assert!((4e-4..2e-3).contains(&most), "{most}");
    }

    #[test]
    fn a_single_step_that_errs_does_not_count_for_those_around_it() {
        let mut resolution = Resolution::new(1);
        for step in 0..100 {
            if resolution.is_due(1.0) {
                let error = if step == FIRST { 1.0 } else { 1e-6 };
                resolution.note(std::iter::once([error; 2]));
            }
        }
        assert!(resolution.worst().1 < 1e-3, "{:?}", resolution.worst());
    }

    #[test]
    fn a_motion_that_begins_late_does_not_count_for_the_steps_before() {
        let mut resolution = Resolution::new(1);
        for step in 0..=FIRST + STRIDE {
            if resolution.is_due(1.0) {
                resolution.note(std::iter::once([if step < FIRST + 10 { 0.0 } else { 1.0 }; 2]));
            }
        }
        let sum = resolution.worst().1;
        assert!((0.4..0.6).contains(&(sum / f64::from(STRIDE))), "{sum}");
    }

    #[test]
    fn steps_of_other_sizes_are_no_pair() {
        let mut resolution = Resolution::new(1);
        let due = (0..40).filter(|step| resolution.is_due(if step % 2 == 0 { 1.0 } else { 0.5 })).count();
        assert!(due > 0 && !resolution.has_first);
    }

    /// A motion of constant error per step, which a failure in the middle has taken in sixteenths for a while.
    #[test]
    fn steps_that_are_taken_in_parts_count_as_often_as_whole_ones() {
        let estimated = |parts: u32| {
            let mut resolution = Resolution::new(1);
            for step in 0..10 * STRIDE {
                let in_parts = (100..200).contains(&step);
                for _ in 0..if in_parts { parts } else { 1 } {
                    let share = if in_parts { f64::from(parts).recip() } else { 1.0 };
                    if resolution.is_due(share) {
                        resolution.note(std::iter::once([share; 2]));
                    }
                }
            }
            resolution.worst().1
        };
        let [whole, parts] = [estimated(1), estimated(16)];
        assert!((parts / whole - 1.0).abs() < 0.12, "{parts} {whole}");
    }
}
