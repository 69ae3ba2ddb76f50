//! Beams and cables, and loads along them.

mod distributed_loads;
mod driven_start;
mod hanging_cable;
mod local_loads;
mod outputs;
