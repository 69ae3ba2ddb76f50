//! Steps that end at samples of signals: a planned step across a sample, or a kink of a load or drive, is taken in pieces that
//! end there, as one across an event is.

use crate::analysis::{Simulation, StepError, StepReport, Stopwatch};
use crate::instants;

impl Simulation {
    /// Time of the state [s], with what rounding has cut off.
    fn now(&self) -> f64 {
        self.state.kinematics.time + self.state.time_remainder
    }

    /// The sample or breakpoint nearest to `time` [s], if it is not farther away than `distance` [s].
    pub fn distinguished_instant(&self, time: f64, distance: f64) -> Option<f64> {
        let samples = self.system.signals().nearest_samples(self.origin.time, time);
        let next = self.breakpoints.partition_point(|breakpoint| breakpoint.time < time);
        let breakpoints = &self.breakpoints[next.saturating_sub(1)..self.breakpoints.len().min(next + 1)];
        let instants = samples.chain(breakpoints.iter().map(|breakpoint| breakpoint.time));
        let nearest = instants.min_by(|a, b| (a - time).abs().total_cmp(&(b - time).abs()))?;
        ((nearest - time).abs() <= distance).then_some(nearest)
    }

    /// Whether `instant` [s] is that of the state up to round-off, where steps are `step` [s] long.
    pub(super) fn is_at(&self, instant: f64, step: f64) -> bool {
        (instant - self.now()).abs() <= instants::tolerance(self.now(), step)
    }

    /// The next instant at which a signal is sampled [s], if one is.
    pub(super) fn next_sample(&self) -> Option<f64> {
        self.system.signals().next_sample(self.origin.time, self.now())
    }

    /// Takes a step of planned size, in pieces that end at the samples and breakpoints within it. If it ends at `limit` [s] up to
    /// round-off, the clock is set to `limit`: sums of step sizes would drift away from the instants that are planned.
    pub(super) fn sampled_step(
        &mut self,
        limit: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let whole = self.settings.step_size;
        self.look_at_time_functions(self.now());
        let outcome = self.sampled_pieces((whole, limit), watch, report);
        self.note_hidden();
        if outcome.is_ok() && self.is_at(limit, whole) {
            (self.state.kinematics.time, self.state.time_remainder) = (limit, 0.0);
        }
        outcome
    }

    fn sampled_pieces(
        &mut self,
        (whole, limit): (f64, f64),
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        if !self.system.signals().has_samples()
            && self.event_detector.is_empty()
            && self.breakpoints.is_empty()
        {
            return self.planned_step(whole, watch, report);
        }
        let start = (self.state.clone(), self.energy_balance, self.event_detector.known.clone());
        let end = self.now() + whole;
        let end = if (limit - end).abs() <= instants::tolerance(end, whole) { limit } else { end };
        let same = instants::tolerance(end, whole);
        // Of the first piece the size is known to the last bit.
        let mut rest = whole;
        let mut pieces = 0;
        let outcome = loop {
            let began = self.now();
            let next = self.next_sample().map_or(f64::INFINITY, |next| next - began);
            let (mut reaches_end, mut size) = (true, rest);
            if next < rest - same {
                (reaches_end, size) = (false, next);
            }
            let stop_time = self.stop_time(began, began + size, whole);
            if let Some(stop_time) = &stop_time {
                reaches_end &= stop_time.clock >= began + size;
                size = stop_time.end - began;
            }
            pieces += 1;
            let mut result = self.planned_step(size, watch, report);
            let is_whole = self.now() - began >= size - same;
            if let Some(stop_time) = stop_time.filter(|_| result.is_ok() && is_whole) {
                result = self.cross_breakpoint(&stop_time, whole);
            }
            let result = result.and_then(|()| self.take_samples());
            if result.is_err() || (reaches_end && is_whole) || self.event_detector.known.stopped_by.is_some()
            {
                break result;
            }
            rest = end - self.now();
            // An event or a breakpoint at the end, up to round-off.
            if rest <= same {
                break result;
            }
        };
        // What led to the state is known of the last piece alone.
        self.is_last_step_known &= pieces == 1;
        if outcome.is_err() {
            (self.state, self.energy_balance, self.event_detector.known) = start;
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
