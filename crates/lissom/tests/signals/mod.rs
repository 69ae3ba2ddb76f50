//! Signals, events and functions of time.

mod breakpoints;
mod delays;
mod events;
mod feedback;
