//! Steps that end at samples of signals: a planned step across a sample, or a kink of a load or drive, is taken in pieces that
//! end there, as one across an event is.

use crate::analysis::{Simulation, StepError, StepReport, Stopwatch};

/// A sample this close to the end of a step, relative to the step, is at its end.
const CLOSE: f64 = 1e-9;

impl Simulation {
    /// Time of the state [s], with what rounding has cut off.
    fn now(&self) -> f64 {
        self.state.kinematics.time + self.state.time_remainder
    }

    /// The next instant at which a signal is sampled [s], if one is.
    pub(super) fn next_sample(&self) -> Option<f64> {
        self.system.signals().next_sample(self.origin.time, self.now())
    }

    /// Takes a step of planned size, in pieces that end at the samples and kinks within it.
    pub(super) fn sampled_step(
        &mut self,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let whole = self.settings.step_size;
        self.look_at_time_functions(self.now());
        let outcome = self.sampled_pieces(whole, watch, report);
        self.note_hidden();
        outcome
    }

    fn sampled_pieces(
        &mut self,
        whole: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        if !self.system.signals().has_samples() && self.watch.is_empty() && self.kinks.is_empty() {
            return self.planned_step(whole, watch, report);
        }
        let start = (self.state.clone(), self.ledger, self.watch.known.clone());
        let end = self.now() + whole;
        // Of the first piece the size is known to the last bit.
        let mut rest = whole;
        let mut pieces = 0;
        let outcome = loop {
            let began = self.now();
            let next = self.next_sample().map_or(f64::INFINITY, |next| next - began);
            let (mut reaches_end, mut size) = (true, rest);
            if next < rest * (1.0 - CLOSE) {
                (reaches_end, size) = (false, next);
            }
            let landing = self.landing(began, began + size, whole);
            if let Some(landing) = &landing {
                reaches_end &= landing.clock >= began + size;
                size = landing.end - began;
            }
            pieces += 1;
            let mut result = self.planned_step(size, watch, report);
            let is_whole = self.now() - began >= size * (1.0 - CLOSE);
            if let Some(landing) = landing.filter(|_| result.is_ok() && is_whole) {
                result = self.pass_kink(&landing, whole);
            }
            let result = result.and_then(|()| self.take_samples());
            if result.is_err() || (reaches_end && is_whole) || self.watch.known.stopped_by.is_some() {
                break result;
            }
            rest = end - self.now();
        };
        // What led to the state is known of the last piece alone.
        self.is_last_step_known &= pieces == 1;
        if outcome.is_err() {
            (self.state, self.ledger, self.watch.known) = start;
        }
        outcome
    }

    /// Samples what is due now.
    pub(super) fn take_samples(&mut self) -> Result<(), StepError> {
        let elapsed = self.now() - self.origin.time;
        let graph = self.system.signals();
        if !graph.has_samples() {
            return Ok(());
        }
        let mut at = self.state.kinematics.clone();
        graph.sample(&mut at, elapsed).map_err(StepError::Signal)?;
        if at.held == self.state.kinematics.held {
            return Ok(());
        }
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })
    }
}
