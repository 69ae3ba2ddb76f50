//! Inputs and outputs of a linear model, by the names of the model file.

use crate::start::{Lowered, lower};
use lissom_core::diagnostics::Diagnose;
use lissom_core::linearized::LinearModel;
use lissom_core::signals::{Argument, DiscreteValueId};
use lissom_core::system::{OutputDerivatives, State};
use lissom_model::Document;
use lissom_model::channels::Channel;

use crate::analyses::modes::ModesError;
use crate::analyses::operating_point::LinearizationPoint;
use crate::session::columns;
use lissom_model::output::Column;

/// An unknown input or output.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum PortError {
    /// No input has this name.
    Input {
        /// The given name.
        name: String,
        /// The existing inputs.
        known: String,
    },
    /// Several entries have this name.
    Ambiguous {
        /// The given name.
        name: String,
        /// Possible meanings of the name.
        meanings: String,
    },
    /// No output has this name.
    Output {
        /// The given name.
        name: String,
        /// The existing outputs.
        known: String,
    },
    /// An accumulated number.
    NotLinear(String),
    /// An input without effect.
    WithoutEffect(String),
    /// The model could not be built with the load as an input.
    #[error(transparent)]
    Model(#[from] ModesError),
}

/// An input: the change of the right-hand sides for its unit, by row.
pub(crate) struct Input {
    pub(crate) name: String,
    pub(crate) right: Vec<f64>,
    /// The held value of the input, for outputs that depend on it directly.
    held: Option<DiscreteValueId>,
}

/// An output column, and its derivatives with respect to the unknowns.
pub(crate) struct Observed {
    pub(crate) column: Column,
    pub(crate) derivatives: OutputDerivatives,
}

impl Observed {
    /// Direct derivative of the output with respect to the input, without the motion.
    pub(crate) fn direct(&self, input: &Input) -> f64 {
        input.held.and_then(|held| self.derivatives.by_held.get(&held).copied()).unwrap_or(0.0)
    }
}

/// The inputs of these names, for outputs with all requested columns.
pub(crate) fn inputs(
    document: &Document,
    reached: &LinearizationPoint<'_, '_>,
    names: &[String],
) -> Result<Vec<Input>, PortError> {
    names.iter().map(|name| input(document, reached, name)).collect()
}

fn input(document: &Document, reached: &LinearizationPoint<'_, '_>, name: &str) -> Result<Input, PortError> {
    let known = known_inputs(document, reached);
    let meant: Vec<&String> = known
        .iter()
        .filter(|full| *full == name || full.split_once('.').is_some_and(|(_, own)| own == name))
        .collect();
    let full = match meant[..] {
        [] => return Err(PortError::Input { name: name.to_owned(), known: listed(known.iter()) }),
        [one] => one,
        _ => return Err(PortError::Ambiguous { name: name.to_owned(), meanings: listed(meant.into_iter()) }),
    };
    let (table, own) = full.split_once('.').unwrap_or(("inputs", full));
    let system = reached.model.system();
    let at = reached.model.kinematics();
    let name = name.to_owned();
    let against = |derivative: Vec<f64>| derivative.into_iter().map(|value| 0.0 - value).collect();
    match table {
        "loads" => Ok(Input { right: against(load(document, reached, own)?), name, held: None }),
        "joints" => {
            let mut right = vec![0.0; system.layout().size()];
            for drive in system.drives().iter().filter(|drive| drive_as_input(&drive.name) == own) {
                right[system.layout().coordinate_count() + drive.multiplier] = 1.0;
            }
            Ok(Input { right, name, held: None })
        }
        _ => {
            let held = system.signals().input(own);
            let right = held.map_or_else(
                || vec![0.0; system.layout().size()],
                |held| against(system.input_derivative(held, at)),
            );
            Ok(Input { name, right, held })
        }
    }
}

fn listed<'n>(names: impl Iterator<Item = &'n String>) -> String {
    let words: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}

/// All existing inputs, with their tables.
fn known_inputs(document: &Document, reached: &LinearizationPoint<'_, '_>) -> Vec<String> {
    let inputs = document.inputs.iter().map(|(input, _)| format!("inputs.{}", input.value));
    let loads = document.loads.iter().map(|load| format!("loads.{}", load.name.value));
    let drives =
        reached.model.system().drives().iter().map(|drive| format!("joints.{}", drive_as_input(&drive.name)));
    inputs.chain(loads).chain(drives).collect()
}

/// Name of a drive as an input: that of a `prescribed_motion` `shaker, x` is `shaker.x`, because lists of inputs are
/// separated by commas.
fn drive_as_input(name: &str) -> String {
    name.replace(", ", ".")
}

/// The change of the left-hand sides by a unit load: its size as an input of another system with the same unknowns.
fn load(
    document: &Document,
    reached: &LinearizationPoint<'_, '_>,
    name: &str,
) -> Result<Vec<f64>, PortError> {
    let unknown = || PortError::Input { name: name.to_owned(), known: "no such load with a size".to_owned() };
    let document = document.with_load_as_input(name).ok_or_else(unknown)?;
    let Lowered { system, state, names, .. } = lower(&document).map_err(ModesError::from)?;
    let input = document.inputs.last().and_then(|(input, _)| names.signals.get(&input.value));
    let Some(&Argument::Held(held)) = input else { return Err(unknown()) };
    let [own, other] = [reached.model.system().layout(), system.layout()];
    let same = own.size() == other.size()
        && own.node_count() == other.node_count()
        && own.nodes().all(|node| own.rows_of_node(node) == other.rows_of_node(node));
    if !same {
        return Err(unknown());
    }
    let mut at = reached.model.kinematics().clone();
    let mut values = state.kinematics.held;
    for (value, own) in values.iter_mut().zip(&at.held) {
        *value = *own;
    }
    at.held = values;
    Ok(system.input_derivative(held, &at))
}

/// The output columns of these names: a column, or an output with all of its columns.
pub(crate) fn outputs(
    reached: &LinearizationPoint<'_, '_>,
    names: &[String],
) -> Result<Vec<Observed>, PortError> {
    let mut all: Vec<(usize, usize, Column)> = Vec::new();
    for (index, channel) in reached.channels.iter().enumerate() {
        let own = columns(std::slice::from_ref(channel));
        all.extend(own.into_iter().enumerate().map(|(k, column)| (index, k, column)));
    }
    let known_columns: Vec<Column> = all.iter().map(|(_, _, column)| column.clone()).collect();
    let mut found = Vec::new();
    for name in names {
        let named = Column::named(&known_columns, name);
        let is_meant = |index: usize| named == Some(index) || known_columns[index].output == *name;
        let meant: Vec<_> =
            (0..all.len()).filter(|&index| is_meant(index)).map(|index| &all[index]).collect();
        if meant.is_empty() {
            let known: Vec<String> = all.iter().map(|(_, _, column)| column.name()).collect();
            return Err(PortError::Output { name: name.clone(), known: listed(known.iter()) });
        }
        for (index, k, column) in meant {
            let derivatives = derivatives_of(&reached.channels[*index], reached.model);
            let own = derivatives.and_then(|all| all.into_iter().nth(*k));
            let derivatives = own.ok_or_else(|| PortError::NotLinear(name.clone()))?;
            found.push(Observed { column: column.clone(), derivatives });
        }
    }
    Ok(found)
}

/// Derivatives of the components of a channel at the state of `model`, in its unknowns; none of accumulated numbers.
fn derivatives_of(channel: &Channel, model: &LinearModel<'_>) -> Option<Vec<OutputDerivatives>> {
    let state = State {
        kinematics: model.kinematics().clone(),
        multipliers: model.multipliers().to_vec(),
        violations: Vec::new(),
        algorithmic: Vec::new(),
        time_remainder: 0.0,
        position_remainders: Vec::new(),
        accumulated: Vec::new(),
        touches: Vec::new(),
    };
    let found = channel.derivatives_at(model.system(), &state, model.length())?;
    Some(found.into_iter().map(|output| model.along_departures(output)).collect())
}

/// An input without effect is probably a mistake.
pub(crate) fn check_effect(inputs: &[Input], outputs: &[Observed]) -> Result<(), PortError> {
    let acts = |input: &&Input| {
        input.right.iter().all(|&value| value == 0.0)
            && outputs.iter().all(|output| output.direct(input) == 0.0)
    };
    inputs.iter().find(acts).map_or(Ok(()), |input| Err(PortError::WithoutEffect(input.name.clone())))
}
