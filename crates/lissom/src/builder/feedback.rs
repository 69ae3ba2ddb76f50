//! Inputs, signals and the actions of events.

use super::entries::feedback::Event;
use super::entry::Entry;
use super::expression::{Expression, TabulatedFunction};
use super::written::{Fields, NameOf, Written};
use crate::ids::{InputId, SignalId};

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
    /// Keys of a sampled signal or a table.
    fields: Fields,
}

impl Signal {
    /// A signal that follows `value` continuously.
    pub fn new(value: impl Into<Expression>) -> Self {
        Self { value: value.into(), fields: Fields::default() }
    }

    /// A signal that is set to the value of `value` every `period` [s] and constant in between; `start` before the first
    /// sample.
    pub fn sampled(value: impl Into<Expression>, period: f64, start: f64) -> Self {
        let mut fields = Fields::default();
        fields.set("sample", period);
        fields.set("start", start);
        Self { value: value.into(), fields }
    }

    /// A signal that is the value of `value` `delay` [s] earlier, and the value at the start before it.
    pub fn delayed(value: impl Into<Expression>, delay: f64) -> Self {
        let mut fields = Fields::default();
        fields.set("delay", delay);
        Self { value: value.into(), fields }
    }

    /// The signal as the input of a discrete filter: `numerator` are the coefficients of its present and past samples, `denominator`
    /// those of the filter's present and past values. The signal must be sampled.
    pub fn filtered(mut self, numerator: impl Into<Vec<f64>>, denominator: impl Into<Vec<f64>>) -> Self {
        self.fields.set("numerator", numerator.into());
        self.fields.set("denominator", denominator.into());
        self
    }

    /// A continuous signal: `table` over the argument `of`.
    pub fn tabulated(of: impl Into<Expression>, table: TabulatedFunction) -> Self {
        Self { value: of.into(), fields: table.0 }
    }
}

impl Entry for Signal {
    type Id = SignalId;
    const WORD: &'static str = "signal";

    fn written(self) -> Written {
        if self.fields == Fields::default() {
            return self.value.into();
        }
        let mut fields = self.fields;
        fields.set(if fields.has("table") { "of" } else { "value" }, self.value);
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
