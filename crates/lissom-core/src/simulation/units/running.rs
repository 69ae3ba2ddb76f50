//! A running unit of a simulation, and what of it snapshots contain.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::units::Unit;

/// A running unit of a simulation.
pub(crate) struct RunningUnit {
    pub(super) unit: Arc<dyn Unit>,
    pub(super) progress: Progress,
    /// Outputs at the last sample; none before the first one, and after a snapshot is restored.
    pub(super) outputs: Vec<f64>,
    /// Events since a time [s], at most one planned step ago.
    pub(super) recent: (f64, usize),
}

/// What a unit has reached, between two steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Progress {
    /// Time of the last sample or event [s].
    pub(super) reached: f64,
    /// Inputs at the start, or at the end of the last step, before they jump there.
    pub(super) inputs: Vec<f64>,
    /// Next event that is known in advance [s].
    pub(super) next: Option<f64>,
    /// Indicators that have crossed zero at the state.
    pub(super) crossed: Vec<usize>,
    /// Whether an event is due at the state.
    pub(super) is_due: bool,
}

/// Progress and state of a unit, if it can return it.
pub(crate) type SavedUnit = (Progress, Option<Vec<u8>>);
