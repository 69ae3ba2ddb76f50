//! Units: models of other programs, as signals and simulations use them.
//!
//! Legend: x states of the unit, u its inputs, f derivatives of the states, y outputs, z event indicators.
//!
//! ```text
//! x' = f(t, x, u),      y = g(t, x, u),      z = h(t, x, u)
//! ```
//!
//! A sampled unit takes its own steps from sample to sample (FMI co-simulation). The equations of other units belong to those of the
//! model: their states are first-order states, and their outputs are signals (FMI model exchange). Between events these are functions
//! of t, x and u alone, so that a rejected step changes nothing of the unit. Values that depend on the same inputs form a group and are
//! evaluated at once, with all derivatives if one is required.

use std::fmt;
use std::sync::Arc;

/// Why a unit cannot continue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFault {
    /// What went wrong.
    pub cause: String,
    /// What to try.
    pub remedy: String,
}

/// Where a group of values is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct GroupPoint<'a> {
    /// The group.
    pub group: usize,
    /// Time [s].
    pub time: f64,
    /// All states, then the inputs of the group.
    pub arguments: &'a [f64],
}

/// Values of a group at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitValues {
    /// The values.
    pub values: Vec<f64>,
    /// Derivatives with respect to states and inputs, value by value; empty if they were not requested.
    pub derivatives: Vec<f64>,
}

/// Why a unit has returned no values.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationFault {
    /// The point at which it cannot continue [s]; none if it has only discarded a point.
    pub fails_at: Option<f64>,
    /// Cause and remedy.
    pub fault: UnitFault,
}

/// Time, states and inputs of a unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnitPoint {
    /// Time [s].
    pub time: f64,
    /// States.
    pub states: Vec<f64>,
    /// Inputs.
    pub inputs: Vec<f64>,
}

/// What an event has changed.
#[derive(Clone, Debug, PartialEq)]
pub struct AfterEvent {
    /// States after the event.
    pub states: Vec<f64>,
    /// Next event that is known in advance [s].
    pub next: Option<f64>,
}

/// A running unit, which belongs to one simulation. Its signals may be evaluated by several threads: it answers them in turn.
pub trait Unit: fmt::Debug + Send + Sync {
    /// Sets inputs before the first step or event, and returns the outputs of a sampled unit, the states of another one there. Is
    /// called again with other inputs.
    ///
    /// # Errors
    /// If the unit cannot start.
    fn begin(&self, inputs: &[f64]) -> Result<Vec<f64>, UnitFault>;

    /// Advances a sampled unit with constant inputs over an interval, from a time [s] by a duration [s], and returns its outputs there.
    ///
    /// # Errors
    /// If the unit cannot take the step.
    fn advance(&self, interval: [f64; 2], inputs: &[f64]) -> Result<Vec<f64>, UnitFault>;

    /// Evaluates a group; none if there are no values, see [`fault`](Self::fault).
    fn evaluate(&self, at: GroupPoint<'_>, differentiates: bool) -> Option<Arc<UnitValues>>;

    /// Why the unit cannot continue, or else why it has discarded a point since the last accepted step.
    fn fault(&self) -> Option<EvaluationFault>;

    /// Ends an accepted step, after which values remain as they are. Returns whether the unit requests an event.
    ///
    /// # Errors
    /// If the unit cannot continue.
    fn complete(&self, at: &UnitPoint) -> Result<bool, UnitFault>;

    /// Executes an event: the first one ends the initialisation.
    ///
    /// # Errors
    /// If the unit cannot continue.
    fn event(&self, at: &UnitPoint) -> Result<AfterEvent, UnitFault>;

    /// State of the unit; none if the unit cannot return it.
    fn save(&self) -> Option<Vec<u8>>;

    /// Returns to a state that [`save`](Self::save) of this unit, or of another instance of it, has returned.
    ///
    /// # Errors
    /// If that is not possible.
    fn restore(&self, state: &[u8]) -> Result<(), UnitFault>;
}

/// Units are equal if they are the same instance.
impl PartialEq for dyn Unit {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(self, other)
    }
}
