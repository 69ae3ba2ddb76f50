//! An instance of a unit: its phase, its values, and the session. Errors are sentences for the importer's log.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;

use lissom::exchange::fmu::{Causality, Interface, MODEL_FILE, PackedModel, Variable};
use lissom::{Model, Session, SessionSnapshot, sealed};
use serde::{Deserialize, Serialize};

/// Communication points this close, relative to the step, are equal.
const SAME_POINT: f64 = 1e-6;

/// Phases, which determine the functions that the importer may call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Phase {
    Instantiated,
    Initialization,
    Step,
    Terminated,
}

/// Result of a step.
pub(crate) struct Stepped {
    /// Time reached [s].
    pub(crate) time: f64,
    /// Whether that is before the end of the step, because an event of the model ends the simulation.
    pub(crate) is_ended: bool,
}

/// An instance of a unit.
pub(crate) struct Instance {
    model: Model,
    interface: Interface,
    given: Given,
    /// Started when it is first needed.
    session: Option<Session>,
    values: Vec<f64>,
}

/// Data from the importer: together with a snapshot of the session the whole state.
#[derive(Clone, Serialize, Deserialize)]
struct Given {
    phase: Phase,
    /// First time [s], if it differs from that of the model.
    start: Option<f64>,
    /// Parameters and inputs by their value references.
    parameters: BTreeMap<usize, f64>,
    inputs: BTreeMap<usize, f64>,
    /// Inputs that have not yet been passed to the session.
    pending: Vec<usize>,
}

impl Given {
    fn nothing() -> Self {
        Self {
            phase: Phase::Instantiated,
            start: None,
            parameters: BTreeMap::new(),
            inputs: BTreeMap::new(),
            pending: Vec::new(),
        }
    }
}

/// A saved state of a unit.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct SavedState {
    given: Given,
    snapshot: Option<SessionSnapshot>,
}

impl SavedState {
    /// As bytes.
    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, String> {
        sealed::to_bytes(self).map_err(words)
    }

    /// From bytes.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        sealed::from_bytes(bytes).ok_or_else(|| "the bytes are no state of this unit".to_owned())
    }
}

fn words(error: impl Display) -> String {
    error.to_string()
}

impl Instance {
    /// A unit of the model among the `resources`.
    pub(crate) fn new(resources: &Path, token: &str) -> Result<Self, String> {
        let file = resources.join(MODEL_FILE);
        let text =
            std::fs::read_to_string(&file).map_err(|error| format!("`{}`: {error}", file.display()))?;
        let packed: PackedModel =
            serde_json::from_str(&text).map_err(|error| format!("`{}`: {error}", file.display()))?;
        if packed.version != lissom::VERSION {
            let (there, here) = (&packed.version, lissom::VERSION);
            return Err(format!("the model was packed by version {there}, the library is of version {here}"));
        }
        if token != packed.token() {
            return Err("the instantiation token is not that of the model among the resources".to_owned());
        }
        let model = packed.model();
        let interface = Interface::of(&model).map_err(words)?;
        Ok(Self { model, interface, given: Given::nothing(), session: None, values: Vec::new() })
    }

    fn expect(&self, phases: &[Phase], what: &str) -> Result<(), String> {
        if phases.contains(&self.given.phase) {
            Ok(())
        } else {
            Err(format!("{what} is not allowed in the phase {:?}", self.given.phase))
        }
    }

    pub(crate) fn enter_initialization(&mut self, start: f64) -> Result<(), String> {
        self.expect(&[Phase::Instantiated], "initialization")?;
        if !start.is_finite() {
            return Err(format!("the start time {start} is none"));
        }
        self.given.start = (start != self.interface.span[0]).then_some(start);
        self.session = None;
        self.given.phase = Phase::Initialization;
        Ok(())
    }

    pub(crate) fn exit_initialization(&mut self) -> Result<(), String> {
        self.expect(&[Phase::Initialization], "the end of initialization")?;
        self.session()?;
        self.given.phase = Phase::Step;
        Ok(())
    }

    pub(crate) fn terminate(&mut self) -> Result<(), String> {
        self.expect(&[Phase::Step], "termination")?;
        self.given.phase = Phase::Terminated;
        Ok(())
    }

    pub(crate) fn reset(&mut self) {
        self.given = Given::nothing();
        self.session = None;
    }

    /// The model with parameters, and with another first time.
    fn given_model(&self) -> Model {
        let mut model = self.model.clone();
        for (&index, &value) in &self.given.parameters {
            model = model.with(&quoted_path(&self.interface.variables[index].name), value);
        }
        let Some(start) = self.given.start else { return model };
        let [first, last] = self.interface.span;
        model.with("analysis.start", start).with("analysis.end", start + (last - first))
    }

    /// The session, started if there is none, with all inputs set.
    fn session(&mut self) -> Result<&mut Session, String> {
        if self.session.is_none() {
            self.session = Some(self.given_model().session().map_err(words)?);
            self.given.pending = self.given.inputs.keys().copied().collect();
        }
        let session = self.session.as_mut().ok_or_else(String::new)?;
        let pending = std::mem::take(&mut self.given.pending);
        let named = |&index: &usize| (&*self.interface.variables[index].name, self.given.inputs[&index]);
        session.set_inputs(pending.iter().map(named)).map_err(words)?;
        Ok(session)
    }

    fn variable(&self, reference: u32) -> Result<(usize, &Variable), String> {
        let index = reference as usize;
        let variable = self.interface.variables.get(index);
        variable.map(|variable| (index, variable)).ok_or_else(|| format!("there is no variable {reference}"))
    }

    pub(crate) fn get(&mut self, references: &[u32], out: &mut [f64]) -> Result<(), String> {
        if references.len() != out.len() {
            return Err("as many values as variables are needed".to_owned());
        }
        let mut is_evaluated = false;
        for (&reference, out) in references.iter().zip(out) {
            let (index, variable) = self.variable(reference)?;
            let start = variable.start.unwrap_or_default();
            *out = match variable.causality {
                Causality::Input => *self.given.inputs.get(&index).unwrap_or(&start),
                Causality::Parameter => *self.given.parameters.get(&index).unwrap_or(&start),
                Causality::Independent => match &self.session {
                    Some(session) => session.progress().time,
                    None => self.given.start.unwrap_or(self.interface.span[0]),
                },
                Causality::Output => {
                    if !is_evaluated {
                        let mut values = std::mem::take(&mut self.values);
                        values.clear();
                        self.session()?.values(&mut values);
                        self.values = values;
                        is_evaluated = true;
                    }
                    let first = self.interface.variables.len() - self.values.len();
                    self.values[index - first]
                }
            };
        }
        Ok(())
    }

    pub(crate) fn set(&mut self, references: &[u32], values: &[f64]) -> Result<(), String> {
        if references.len() != values.len() {
            return Err("as many values as variables are needed".to_owned());
        }
        for (&reference, &value) in references.iter().zip(values) {
            let (index, variable) = self.variable(reference)?;
            if !value.is_finite() {
                return Err(format!("`{}` cannot be {value}", variable.name));
            }
            match variable.causality {
                Causality::Input => {
                    self.expect(&[Phase::Instantiated, Phase::Initialization, Phase::Step], "an input")?;
                    self.given.inputs.insert(index, value);
                    self.given.pending.push(index);
                }
                Causality::Parameter => {
                    self.expect(&[Phase::Instantiated, Phase::Initialization], "a parameter")?;
                    if variable.start == Some(value) {
                        self.given.parameters.remove(&index);
                    } else {
                        self.given.parameters.insert(index, value);
                    }
                    self.session = None;
                }
                Causality::Independent | Causality::Output => {
                    return Err(format!("`{}` is computed, it cannot be set", variable.name));
                }
            }
        }
        Ok(())
    }

    /// Continues from `current` [s] by `size` [s]. After an error the unit is at the end of the last successful step.
    pub(crate) fn step(&mut self, current: f64, size: f64) -> Result<Stepped, String> {
        self.expect(&[Phase::Step], "a step")?;
        let session = self.session()?;
        let now = session.progress().time;
        if !(size > 0.0 && size.is_finite()) {
            return Err(format!("a step of {size} s is none"));
        }
        if (current - now).abs() > session.clock_tolerance(size).max(SAME_POINT * size) {
            return Err(format!("the step begins at t = {current} s, the unit is at t = {now} s"));
        }
        let target = current + size;
        session.step_to(target).map_err(words)?;
        let time = session.progress().time;
        Ok(Stepped { time, is_ended: session.stopped_by().is_some() })
    }

    /// Present time of the unit [s].
    pub(crate) fn time(&self) -> f64 {
        self.session.as_ref().map_or(self.interface.span[0], |session| session.progress().time)
    }

    pub(crate) fn save(&self) -> SavedState {
        SavedState { given: self.given.clone(), snapshot: self.session.as_ref().map(Session::snapshot) }
    }

    /// Restores a state that was saved from this unit, or from another one of the same model. On failure the state is
    /// unchanged.
    pub(crate) fn restore(&mut self, state: &SavedState) -> Result<(), String> {
        let known = self.interface.variables.len();
        let mut references = state.given.parameters.keys().chain(state.given.inputs.keys());
        if references.any(|&index| index >= known) {
            return Err("the state is of another model".to_owned());
        }
        let before = std::mem::replace(&mut self.given, state.given.clone());
        let is_same = before.parameters == state.given.parameters && before.start == state.given.start;
        let outcome = match &state.snapshot {
            None => {
                self.session = None;
                Ok(())
            }
            Some(snapshot) => match &mut self.session {
                Some(session) if is_same => session.restore(snapshot).map_err(words),
                _ => self.given_model().session().map_err(words).and_then(|mut session| {
                    session.restore(snapshot).map_err(words)?;
                    self.session = Some(session);
                    Ok(())
                }),
            },
        };
        if outcome.is_err() {
            self.given = before;
        }
        outcome
    }
}

/// The path of a parameter, its name in quotes if it contains dots.
fn quoted_path(name: &str) -> String {
    match name.split_once('.') {
        Some((table, own)) if own.contains(['.', ' ', '"']) => {
            format!("{table}.\"{}\"", own.replace('\\', "\\\\").replace('"', "\\\""))
        }
        _ => name.to_owned(),
    }
}
