//! Inputs, signals and the actions of events.

use super::entries::feedback::Event;
use super::entry::Entry;
use super::expression::Expression;
use super::ids::{InputId, SignalId};
use super::written::{Fields, NameOf, Written};

/// A number that can be set while a simulation runs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Input(f64);

impl Input {
    /// An input with its value at the start.
    pub fn starting_at(value: f64) -> Self {
        Self(value)
    }
}

impl Entry for Input {
    type Id = InputId;
    const WORD: &'static str = "input";

    fn written(self) -> Written {
        self.0.into()
    }
}

/// A named expression of time, inputs, signals, states and outputs.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Signal {
    value: Expression,
    sampling: Option<(f64, f64)>,
}

impl Signal {
    /// A signal that follows `value` continuously.
    pub fn new(value: impl Into<Expression>) -> Self {
        Self { value: value.into(), sampling: None }
    }

    /// A signal that is set to the value of `value` every `period` [s] and constant in between; `start` before the first
    /// sample.
    pub fn sampled(value: impl Into<Expression>, period: f64, start: f64) -> Self {
        Self { value: value.into(), sampling: Some((period, start)) }
    }
}

impl Entry for Signal {
    type Id = SignalId;
    const WORD: &'static str = "signal";

    fn written(self) -> Written {
        let Some((period, start)) = self.sampling else { return self.value.into() };
        let mut fields = Fields::default();
        fields.set("value", self.value);
        fields.set("sample", period);
        fields.set("start", start);
        fields.into()
    }
}

impl Event {
    /// Sets `input` to `value` at the event.
    pub fn set(mut self, input: InputId, value: impl Into<Expression>) -> Self {
        self.0.set_under("set", NameOf(input.0), value.into().into());
        self
    }
}
