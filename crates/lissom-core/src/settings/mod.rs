//! Settings of a simulation, and what is counted and timed in it.

mod phase;
mod totals;

pub use phase::{Phase, Stopwatch, Unwatched};
pub use totals::{StepReport, Totals};

pub use crate::system::settings::{Controlled, Settings, StepControl};

use crate::system::System;

/// A model with the settings of its solution.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'p> {
    pub(crate) system: &'p System,
    pub(crate) settings: &'p Settings,
}
