// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! First-order states and events.

use super::words;
use crate::builder::entry::entry;
use crate::builder::expression::Expression;

entry! {
    /// A first-order state: a number whose time derivative is an expression.
    State => StateId, "state";
    []
    /// With what must be given.
    ///
    /// - `derivative`: time derivative \[1/s\]
    new(derivative: Expression = "derivative")
    /// Value at the start; default 0.
    start: f64 = "start";
    /// Typical magnitude, relative to which errors are measured unless its value is larger; default 1.
    magnitude: f64 = "magnitude";
}

entry! {
    /// What happens when an expression passes through zero.
    Event => EventId, "event";
    []
    /// With what must be given.
    ///
    /// - `zero_of`: the event occurs when this expression crosses zero
    new(zero_of: Expression = "zero_of")
    /// Direction of the crossing; default `"both"`.
    direction: words::Direction = "direction";
    /// Whether the run ends at the event; default `false`.
    stop: bool = "stop";
}
