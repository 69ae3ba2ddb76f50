//! Distribution of a run's time. Only some of the short steps are measured, so that reading the clock does not affect
//! the result.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use lissom_core::interrupt;
use lissom_core::settings::{Phase, Stopwatch};

/// Steps that take longer than this on average are all measured.
const LONG: Duration = Duration::from_micros(20);
/// Number of shorter steps of which one is measured.
const STRIDE: u32 = 16;

/// Time by kind of work [s]. The whole time of steps is distributed in the proportions of the measured ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Consistent initial values, first analysis of the tangent's pattern.
    pub start: f64,
    /// Motions, forces and violations.
    pub evaluation: f64,
    /// Derivatives of forces and violations.
    pub linearisation: f64,
    /// Factorisation of tangents.
    pub factorisation: f64,
    /// Forward and backward substitution.
    pub solve: f64,
    /// Other parts of a step: prediction, corrections and their size, the end of the step.
    pub rest: f64,
    /// Outputs, energy and violations of recorded instants, and writing them.
    pub output: f64,
}

impl Seconds {
    /// All steps together.
    pub fn steps(&self) -> f64 {
        self.evaluation + self.linearisation + self.factorisation + self.solve + self.rest
    }
}

/// Measures steps.
pub(crate) struct Timings {
    by_phase: [Duration; Phase::COUNT],
    /// The part of the first step, which is exceptional: it computes a tangent, and all memory is new to it.
    first: [Duration; Phase::COUNT],
    /// Time of the steps whose end was measured.
    steps: Duration,
    /// Start of the subsequent steps.
    open: Option<Instant>,
    count: u32,
    are_short: bool,
    watching: bool,
    mark: Instant,
    phase: Phase,
    pub(crate) start: Duration,
    pub(crate) output: Duration,
    /// Set to cancel a step.
    pub(crate) cancelled: Option<Arc<AtomicBool>>,
}

impl Timings {
    pub(crate) fn new() -> Self {
        Self {
            by_phase: [Duration::ZERO; Phase::COUNT],
            first: [Duration::ZERO; Phase::COUNT],
            steps: Duration::ZERO,
            open: None,
            count: 0,
            are_short: false,
            watching: false,
            mark: Instant::now(),
            phase: Phase::Rest,
            start: Duration::ZERO,
            output: Duration::ZERO,
            cancelled: None,
        }
    }

    /// A step begins.
    pub(crate) fn begin_step(&mut self) {
        self.watching = !self.are_short || self.count.is_multiple_of(STRIDE);
        self.count += 1;
        self.phase = Phase::Rest;
        if self.watching || self.open.is_none() {
            let now = Instant::now();
            self.close(now);
            self.open = Some(now);
            self.mark = now;
        }
    }

    /// The step is over.
    pub(crate) fn end_step(&mut self) {
        if self.watching {
            let now = Instant::now();
            self.note(now);
            self.close(now);
            self.watching = false;
            if self.count == 1 {
                self.first = self.by_phase;
            }
            self.are_short = self.steps / self.count < LONG;
        }
    }

    /// Stops measuring until the next step.
    pub(crate) fn pause(&mut self) {
        if self.open.is_some() {
            self.close(Instant::now());
        }
    }

    fn close(&mut self, now: Instant) {
        if let Some(began) = self.open.take() {
            self.steps += now - began;
        }
    }

    /// Time of all steps up to the last pause, failed ones included.
    pub(crate) fn steps(&self) -> Duration {
        self.steps
    }

    fn note(&mut self, now: Instant) {
        if self.watching {
            self.by_phase[self.phase as usize] += now - self.mark;
            self.mark = now;
        }
    }

    pub(crate) fn seconds(&self) -> Seconds {
        let first: Duration = self.first.iter().sum();
        let seen = self.by_phase.iter().sum::<Duration>().saturating_sub(first);
        let others = self.steps.saturating_sub(first).as_secs_f64();
        let factor = if seen.is_zero() { 0.0 } else { others / seen.as_secs_f64() };
        let of = |phase: Phase| {
            let (all, first) = (self.by_phase[phase as usize], self.first[phase as usize]);
            first.as_secs_f64() + factor * all.saturating_sub(first).as_secs_f64()
        };
        Seconds {
            start: self.start.as_secs_f64(),
            evaluation: of(Phase::Evaluation),
            linearisation: of(Phase::Linearisation),
            factorisation: of(Phase::Factorisation),
            solve: of(Phase::Solve),
            rest: of(Phase::Rest),
            output: self.output.as_secs_f64(),
        }
    }
}

impl Stopwatch for Timings {
    fn begin(&mut self, phase: Phase) {
        if self.watching {
            self.note(Instant::now());
            self.phase = phase;
        }
    }

    fn is_cancelled(&self) -> bool {
        interrupt::is_asked()
            || self.cancelled.as_ref().is_some_and(|cancelled| cancelled.load(Ordering::Relaxed))
    }
}

#[cfg(test)]
#[path = "../../tests/unit/run/timings.rs"]
mod tests;
