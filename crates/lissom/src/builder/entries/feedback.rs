// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! First-order states and events.

use super::words;
use crate::builder::entry::entry;
use crate::builder::expression::Expression;

entry! {
    /// A first-order state: a number whose derivative by time is an expression.
    State => StateId, "state";
    []
    /// With what must be given.
    ///
    /// - `derivative`: its derivative by time \[1/s\]
    new(derivative: Expression = "derivative")
    /// Value at the start, default 0.
    start: f64 = "start";
    /// How large it usually is: errors are measured by this, or by its value where that is larger; default 1.
    magnitude: f64 = "magnitude";
}

entry! {
    /// What happens when an expression passes through zero.
    Event => EventId, "event";
    []
    /// With what must be given.
    ///
    /// - `zero_of`: the event happens where this expression passes through zero
    new(zero_of: Expression = "zero_of")
    /// Which way it passes, default `both`.
    direction: words::Direction = "direction";
    /// Whether the run ends there, default `false`.
    stop: bool = "stop";
}
