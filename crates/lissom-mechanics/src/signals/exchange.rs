//! Units of other programs whose equations belong to those of the model (FMI model exchange): their states are first-order states,
//! and their outputs are signals.
//!
//! Legend: x states of the unit, u its inputs, f derivatives of the states, y outputs, z event indicators.
//!
//! ```text
//! x' = f(t, x, u),      y = g(t, x, u),      z = h(t, x, u)
//! ```
//!
//! Between events these are functions of t, x and u alone, so that a rejected step changes nothing of the unit. Values that depend on
//! the same inputs form a group and are evaluated at once, with all derivatives if one is required. The last evaluations are kept: all
//! loads, states, laws and records at one point share them.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{Graph, SignalFunction, SignalId};
use crate::kinematics::{CoordinateId, Kinematics};

/// Why a unit cannot continue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFault {
    /// What went wrong.
    pub cause: String,
    /// What to try.
    pub remedy: String,
}

/// Values of a group at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitValues {
    /// The values.
    pub values: Vec<f64>,
    /// Derivatives with respect to states and inputs, value by value; empty if they were not requested.
    pub derivatives: Vec<f64>,
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

/// A running unit with equations.
pub trait UnitEquations: Send {
    /// Sets inputs before the first event, and returns the states there.
    ///
    /// # Errors
    /// If the unit cannot start.
    fn begin(&mut self, inputs: &[f64]) -> Result<Vec<f64>, UnitFault>;

    /// Evaluates a group at a time [s], with its arguments: all states, then the inputs of the group. None if the unit discards the
    /// point, with the cause.
    ///
    /// # Errors
    /// If the unit cannot continue.
    fn evaluate(
        &mut self,
        group: usize,
        time: f64,
        arguments: &[f64],
        differentiates: bool,
    ) -> Result<Result<UnitValues, UnitFault>, UnitFault>;

    /// Ends an accepted step. Returns whether the unit requests an event.
    ///
    /// # Errors
    /// If the unit cannot continue.
    fn complete(&mut self, at: &UnitPoint) -> Result<bool, UnitFault>;

    /// Executes an event: the first one ends the initialisation.
    ///
    /// # Errors
    /// If the unit cannot continue.
    fn event(&mut self, at: &UnitPoint) -> Result<AfterEvent, UnitFault>;

    /// State of the unit; none if the unit cannot return it.
    fn save(&self) -> Option<Vec<u8>>;

    /// Returns to a saved state.
    ///
    /// # Errors
    /// If that is not possible.
    fn restore(&mut self, state: &[u8]) -> Result<(), UnitFault>;
}

/// Where a system finds the running unit, which a simulation attaches. Without a unit all values are zero.
pub struct UnitSlot {
    name: String,
    running: Mutex<Running>,
}

#[derive(Default)]
struct Running {
    unit: Option<Box<dyn UnitEquations>>,
    /// The last evaluations, the oldest first.
    known: Vec<Known>,
    /// When [s] and why the unit cannot continue.
    fault: Option<(f64, UnitFault)>,
    /// Why the unit has discarded a point since the last accepted step.
    discarded: Option<UnitFault>,
}

struct Known {
    group: usize,
    time: f64,
    arguments: Vec<f64>,
    found: UnitValues,
}

impl fmt::Debug for UnitSlot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("UnitSlot").field("name", &self.name).finish_non_exhaustive()
    }
}

impl UnitSlot {
    /// An empty slot for the unit called `name`.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), running: Mutex::default() }
    }

    /// Name of the unit.
    pub fn name(&self) -> &str {
        &self.name
    }

    fn running(&self) -> MutexGuard<'_, Running> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Attaches a running unit.
    ///
    /// # Errors
    /// If another simulation of this system has one.
    pub fn attach(&self, unit: Box<dyn UnitEquations>) -> Result<(), UnitFault> {
        let mut running = self.running();
        if running.unit.is_some() {
            let cause = "another simulation of the same prepared model uses it".to_owned();
            let remedy = "end that simulation first, or prepare the model again".to_owned();
            return Err(UnitFault { cause, remedy });
        }
        *running = Running { unit: Some(unit), ..Running::default() };
        Ok(())
    }

    /// Ends the unit.
    pub fn detach(&self) {
        *self.running() = Running::default();
    }

    /// When [s] and why the unit cannot continue.
    pub fn fault(&self) -> Option<(f64, UnitFault)> {
        self.running().fault.clone()
    }

    /// Why the unit has discarded a point since the last call.
    pub fn take_discarded(&self) -> Option<UnitFault> {
        self.running().discarded.take()
    }

    /// Calls the unit, whose later values may differ.
    ///
    /// # Errors
    /// Those of the call.
    pub fn call<T>(
        &self,
        call: impl FnOnce(&mut dyn UnitEquations) -> Result<T, UnitFault>,
    ) -> Result<T, UnitFault> {
        let mut running = self.running();
        running.known.clear();
        let Some(unit) = &mut running.unit else {
            let remedy = "run the model by a session".to_owned();
            return Err(UnitFault { cause: "it is not attached to this simulation".to_owned(), remedy });
        };
        call(&mut **unit)
    }

    /// Ends an accepted step as [`UnitEquations::complete`] does, after which values remain as they are.
    ///
    /// # Errors
    /// If the unit cannot continue.
    pub fn complete(&self, at: &UnitPoint) -> Result<bool, UnitFault> {
        match &mut self.running().unit {
            Some(unit) => unit.complete(at),
            None => Ok(false),
        }
    }

    /// Passes the values of a group to `read`; zeros without a unit, NaN where the unit discards the point or has failed.
    fn read<T>(
        &self,
        (group, time, arguments): (usize, f64, &[f64]),
        differentiates: bool,
        read: impl FnOnce(Result<&UnitValues, f64>) -> T,
    ) -> T {
        let mut running = self.running();
        let Running { unit, known, fault, discarded } = &mut *running;
        let is_at = |own: &Known| {
            let is_complete = !differentiates || !own.found.derivatives.is_empty();
            own.group == group && own.time == time && own.arguments == arguments && is_complete
        };
        if let Some(own) = known.iter().rev().find(|own| is_at(own)) {
            return read(Ok(&own.found));
        }
        let Some(unit) = unit else { return read(Err(0.0)) };
        if fault.is_some() || arguments.iter().any(|argument| !argument.is_finite()) {
            return read(Err(f64::NAN));
        }
        match unit.evaluate(group, time, arguments, differentiates) {
            Ok(Ok(found)) => {
                // Stages of a step, each with few groups; values of one point are found while it is iterated.
                if known.len() == 24 {
                    known.remove(0);
                }
                let result = read(Ok(&found));
                known.push(Known { group, time, arguments: arguments.to_vec(), found });
                result
            }
            Ok(Err(cause)) => {
                *discarded = Some(cause);
                read(Err(f64::NAN))
            }
            Err(cause) => {
                *fault = Some((time, cause));
                read(Err(f64::NAN))
            }
        }
    }
}

/// A value of a group as a function of the states of the unit and the inputs of the group.
#[derive(Clone, Debug)]
pub struct UnitValue {
    /// The unit.
    pub slot: Arc<UnitSlot>,
    /// The group.
    pub group: usize,
    /// Index among the values of the group.
    pub index: usize,
}

impl SignalFunction for UnitValue {
    fn value(&self, time: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.slot.read((self.group, time, arguments), false, |found| {
            found.map_or_else(|instead| instead, |found| found.values[self.index])
        })
    }

    fn gradient(&self, time: f64, arguments: &[f64], _: &[f64], out: &mut [f64]) {
        let count = arguments.len();
        self.slot.read((self.group, time, arguments), true, |found| match found {
            Ok(found) => out.copy_from_slice(&found.derivatives[self.index * count..][..count]),
            Err(instead) => out.fill(instead),
        });
    }

    /// A unit reports its jumps by event indicators; nothing else is known of it.
    fn is_polynomial(&self) -> bool {
        true
    }
}

/// A unit with equations in a graph of signals.
#[derive(Clone, Debug)]
pub struct ExchangedUnit {
    /// The running unit.
    pub slot: Arc<UnitSlot>,
    /// States.
    pub states: Vec<CoordinateId>,
    /// Signals that are its inputs.
    pub inputs: Vec<SignalId>,
    /// Events that are its indicators.
    pub indicators: Range<usize>,
}

impl ExchangedUnit {
    /// Time, states and inputs at a configuration.
    pub fn point(&self, graph: &Graph, at: &Kinematics) -> UnitPoint {
        let states = self.states.iter().map(|&state| at.coordinates[state].value).collect();
        let inputs =
            graph.evaluate(at, |values| self.inputs.iter().map(|input| values[input.index()]).collect());
        UnitPoint { time: at.time, states, inputs }
    }
}
