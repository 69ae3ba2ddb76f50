//! Outputs of a model, evaluated in its states.

use std::sync::{Arc, Mutex, PoisonError};

use lissom_core::analysis::{ConsistentRates, Simulation};
use lissom_core::system::{State, System};
use lissom_model::channels::Channel;

/// The outputs of a model, and their source.
pub(crate) struct Observed {
    system: Arc<System>,
    channels: Vec<Channel>,
    /// For motions prescribed by drives, if any output contains rates.
    consistent_rates: Option<Mutex<ConsistentRates>>,
}

impl Observed {
    pub(super) fn new(simulation: &Simulation, channels: Vec<Channel>) -> Self {
        let is_reported = channels.iter().any(Channel::reports_rates);
        let consistent_rates = is_reported.then(|| ConsistentRates::of(simulation)).flatten().map(Mutex::new);
        Self { system: simulation.shared_system(), channels, consistent_rates }
    }

    /// The outputs, as they are evaluated.
    pub(crate) fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Appends the values of all channels in a state at the end of a step of `step` [s].
    pub(crate) fn values(&self, state: &State, step: f64, out: &mut Vec<f64>) {
        let consistent = self.consistent(state, step);
        self.channels.iter().for_each(|channel| self.evaluate(channel, (state, consistent.as_ref()), out));
    }

    /// The values of one channel.
    pub(crate) fn values_of(&self, channel: &Channel, state: &State, step: f64) -> Vec<f64> {
        let mut values = Vec::new();
        let consistent = channel.reports_rates().then(|| self.consistent(state, step)).flatten();
        self.evaluate(channel, (state, consistent.as_ref()), &mut values);
        values
    }

    /// The value of a column, counted over all channels.
    pub(crate) fn value(&self, column: usize, state: &State, step: f64) -> f64 {
        let mut first = 0;
        for channel in &self.channels {
            let count = channel.components.len();
            if column < first + count {
                return self.values_of(channel, state, step)[column - first];
            }
            first += count;
        }
        f64::NAN
    }

    fn evaluate(&self, channel: &Channel, (state, consistent): (&State, Option<&State>), out: &mut Vec<f64>) {
        let state_of_rates = consistent.filter(|_| channel.reports_rates());
        channel.evaluate(&self.system, state_of_rates.unwrap_or(state), out);
    }

    /// The state with rates, accelerations and constraint forces that are consistent with its positions.
    fn consistent(&self, state: &State, step: f64) -> Option<State> {
        let rates = self.consistent_rates.as_ref()?;
        rates.lock().unwrap_or_else(PoisonError::into_inner).state(&self.system, state, step)
    }
}
