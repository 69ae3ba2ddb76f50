//! Tests of `monitors::resolution`, a module of it.

use super::super::pairs::{FIRST, STRIDE};
use super::*;
use crate::schemes::{Combination, MAX_STAGES};

const ESTIMATE: ErrorEstimate = ErrorEstimate {
    combination: Combination {
        increments: [0.0; MAX_STAGES],
        velocity: 0.0,
        algorithmic: 0.0,
        acceleration: 0.0,
    },
    order: 3,
    of_oscillation: 1.0 / 12.0,
};

/// Estimate for an oscillation whose error is C (ωh)³ per step, of this amplitude, after this number of steps.
fn estimated(angle: f64, amplitude: f64, steps: u32) -> f64 {
    let mut resolution = Resolution::new(1);
    for step in 0..steps {
        if resolution.is_due(1.0) {
            let error = ESTIMATE.of_oscillation * angle.powi(3) * amplitude * (angle * f64::from(step)).cos();
            resolution.note(std::iter::once([error; 2]));
        }
    }
    resolution.worst(&ESTIMATE, 1.0).1
}

#[test]
fn errors_add_up_to_the_phase_that_is_lost_and_no_further_than_the_amplitude() {
    for angle in [0.03_f64, 0.1, 0.37] {
        let lost = ESTIMATE.of_oscillation * angle.powi(3) * 1000.0;
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
    assert!(resolution.worst(&ESTIMATE, 1.0).1 < 1e-3, "{:?}", resolution.worst(&ESTIMATE, 1.0));
}

#[test]
fn a_motion_that_begins_late_does_not_count_for_the_steps_before() {
    let mut resolution = Resolution::new(1);
    for step in 0..=FIRST + STRIDE {
        if resolution.is_due(1.0) {
            resolution.note(std::iter::once([if step < FIRST + 10 { 0.0 } else { 1.0 }; 2]));
        }
    }
    let sum = resolution.worst(&ESTIMATE, 1.0).1;
    assert!((0.4..0.6).contains(&(sum / f64::from(STRIDE))), "{sum}");
}

#[test]
fn steps_of_other_sizes_are_no_pair() {
    let mut resolution = Resolution::new(1);
    let due = (0..40).filter(|step| resolution.is_due(if step % 2 == 0 { 1.0 } else { 0.5 })).count();
    assert!(due > 0 && !resolution.pairs.has_first);
}

/// A motion of constant error per step, with some steps in sixteenths after a failure.
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
        resolution.worst(&ESTIMATE, 1.0).1
    };
    let [whole, parts] = [estimated(1), estimated(16)];
    assert!((parts / whole - 1.0).abs() < 0.12, "{parts} {whole}");
}
