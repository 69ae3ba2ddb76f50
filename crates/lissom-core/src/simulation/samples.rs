//! Samples of signals: steps end at the sampling instants.

use crate::errors::StepError;
use crate::instants;
use crate::simulation::Simulation;

impl Simulation {
    /// Time of the state [s], including its accumulated round-off.
    pub(crate) fn now(&self) -> f64 {
        self.state.kinematics.time + self.state.time_remainder
    }

    /// The sample or breakpoint nearest to `time` [s], if it is not farther away than `distance` [s].
    pub fn distinguished_instant(&self, time: f64, distance: f64) -> Option<f64> {
        let samples = self.system.signals().nearest_samples(self.origin.kinematics.time, time);
        let next = self.stops.breakpoints.partition_point(|breakpoint| breakpoint.time < time);
        let breakpoints =
            &self.stops.breakpoints[next.saturating_sub(1)..self.stops.breakpoints.len().min(next + 1)];
        let instants = samples.chain(breakpoints.iter().map(|breakpoint| breakpoint.time));
        let nearest = instants.min_by(|a, b| (a - time).abs().total_cmp(&(b - time).abs()))?;
        ((nearest - time).abs() <= distance).then_some(nearest)
    }

    /// Whether `instant` [s] is equal to the time of the state up to round-off, with steps of `step` [s].
    pub(crate) fn is_at(&self, instant: f64, step: f64) -> bool {
        (instant - self.now()).abs() <= instants::tolerance(self.now(), step)
    }

    /// The next sampling instant of a signal [s], if there is one.
    pub(crate) fn next_sample(&self) -> Option<f64> {
        self.system.signals().next_sample(self.origin.kinematics.time, self.now())
    }

    /// Samples the signals that are due now.
    pub(crate) fn take_samples(&mut self) -> Result<(), StepError> {
        let elapsed = self.now() - self.origin.kinematics.time;
        if !self.system.signals().has_samples() {
            return Ok(());
        }
        let mut at = self.state.kinematics.clone();
        self.advance_units(&mut at, elapsed)?;
        let graph = self.system.signals();
        if self.system.has_readings() && graph.is_sample_due(at.time, elapsed) {
            for (held, value) in self.system.take_readings(&self.state) {
                at.held[held.index()] = value;
            }
        }
        graph.sample(&mut at, elapsed).map_err(StepError::Signal)?;
        if at.held == self.state.kinematics.held {
            return Ok(());
        }
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })
    }
}
