// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! First-order states and events.

use super::words;
use crate::builder::entry::entries;
use crate::builder::expression::Expression;

entries! {
    /// A first-order state: a number whose time derivative is an expression.
    State => StateId, "state" {
        * derivative: Expression = "derivative", "time derivative \\[1/s\\]";
        algebraic: bool = "algebraic", "Whether the value makes `derivative` zero at all times, as that of an infinitely fast state; `start` is a first guess; default `false`.";
        start: f64 = "start", "Value at the start; default 0.";
        magnitude: f64 = "magnitude", "Typical magnitude, relative to which errors are measured unless its value is larger; default 1.";
    }

    /// What happens when an expression passes through zero.
    Event => EventId, "event" {
        * zero_of: Expression = "zero_of", "the event occurs when this expression crosses zero";
        direction: words::Direction = "direction", "Direction of the crossing; default `\"both\"`.";
        stop: bool = "stop", "Whether the run ends at the event; default `false`.";
    }
}
