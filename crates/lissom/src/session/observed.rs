//! Outputs of a model, evaluated in its states.

use std::sync::{Arc, Mutex, PoisonError};

use lissom_core::simulation::{Need, Recovered, Recovery, Simulation};
use lissom_core::system::{State, System};
use lissom_model::channels::Channel;

/// The outputs of a model, and their source.
pub(crate) struct Observed {
    system: Arc<System>,
    channels: Vec<Channel>,
    /// The largest need of the channels.
    need: Need,
    /// Recovery of motions, if any output depends on more than positions.
    recovery: Option<Mutex<Box<Recovery>>>,
}

impl Observed {
    pub(super) fn new(simulation: &Simulation, channels: Vec<Channel>) -> Self {
        let need = channels.iter().map(Channel::need).max().unwrap_or_default();
        let recovery = (need > Need::Positions).then(|| Recovery::of(simulation)).flatten().map(Mutex::new);
        Self { system: simulation.shared_system(), channels, need, recovery }
    }

    /// The outputs, as they are evaluated.
    pub(crate) fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Appends the values of all channels in a state at the end of a step of `step` [s].
    pub(crate) fn values(&self, state: &State, step: f64, out: &mut Vec<f64>) {
        self.with_recovered(self.need, state, step, |recovered| {
            self.channels.iter().for_each(|channel| self.evaluate(channel, (state, recovered), out));
        });
    }

    /// Appends the values of one channel.
    pub(crate) fn values_of(&self, channel: &Channel, state: &State, step: f64, out: &mut Vec<f64>) {
        self.with_recovered(channel.need(), state, step, |recovered| {
            self.evaluate(channel, (state, recovered), out);
        });
    }

    /// The value of a column, counted over all channels.
    pub(crate) fn value(&self, column: usize, state: &State, step: f64) -> f64 {
        let Some((channel, component)) = self.channel_of(column) else { return f64::NAN };
        let mut values = Vec::new();
        self.with_recovered(channel.need_of(component), state, step, |recovered| {
            self.evaluate(channel, (state, recovered), &mut values);
        });
        values[component]
    }

    /// Whether a column is recovered from the positions.
    pub(crate) fn recovers(&self, column: usize) -> bool {
        self.recovery.is_some()
            && self
                .channel_of(column)
                .is_some_and(|(channel, component)| channel.need_of(component) > Need::Positions)
    }

    /// Channel and component of a column.
    fn channel_of(&self, column: usize) -> Option<(&Channel, usize)> {
        let mut first = 0;
        self.channels.iter().find_map(|channel| {
            let begin = first;
            first += channel.components.len();
            (column < first).then_some((channel, column - begin))
        })
    }

    fn evaluate(
        &self,
        channel: &Channel,
        (state, recovered): (&State, Option<&Recovered>),
        out: &mut Vec<f64>,
    ) {
        let state = match recovered {
            Some(recovered) if channel.reports_internal_forces() => &recovered.forces,
            Some(recovered) if channel.need() > Need::Positions => &recovered.rates,
            _ => state,
        };
        channel.evaluate(&self.system, state, out);
    }

    /// Evaluates outputs with what they need recovered, if it is found.
    fn with_recovered(
        &self,
        need: Need,
        state: &State,
        step: f64,
        evaluate: impl FnOnce(Option<&Recovered>),
    ) {
        match self.recovery.as_ref().filter(|_| need > Need::Positions) {
            Some(recovery) => {
                let mut recovery = recovery.lock().unwrap_or_else(PoisonError::into_inner);
                evaluate(recovery.recover(need, (&self.system, state), step));
            }
            None => evaluate(None),
        }
    }
}
