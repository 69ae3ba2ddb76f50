//! Units of other programs, which are advanced from sample to sample, or whose equations belong to those of the model.

use std::borrow::Cow;
use std::path::PathBuf;

use super::entries::each;
use crate::expression::{self, Formula};
use crate::files::library::joined;
use crate::format::keys::{Key, Shape, optional, required, unitless};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::{Located, Span};
use crate::text::{Node, Value};

/// A unit of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitEntry {
    /// Name.
    pub name: Located<String>,
    /// Path of the archive.
    pub file: Located<PathBuf>,
    /// Input variables with their expressions.
    pub inputs: Vec<(Located<String>, Located<Formula>)>,
    /// Names in expressions, without that of the unit, with the output variables.
    pub outputs: Vec<(String, Located<String>)>,
    /// Start values of variables.
    pub parameters: Vec<(Located<String>, f64)>,
    /// Time from sample to sample [s], for co-simulation.
    pub sample: Option<Located<f64>>,
    /// How it is simulated; none for what the unit supports.
    pub mode: Option<UnitMode>,
    /// Equations, for model exchange; none until the unit is read.
    pub equations: Option<UnitEquations>,
    /// Longest real time of a call of the unit [s].
    pub timeout: f64,
}

/// How a unit is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitMode {
    /// It takes its own steps from sample to sample.
    CoSimulation,
    /// Equations solved with those of the model.
    ModelExchange,
}

/// Words of the modes.
const MODES: [&str; 2] = ["co_simulation", "model_exchange"];

/// Equations of a unit for model exchange.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnitEquations {
    /// Names of the states, with their usual magnitudes.
    pub states: Vec<(String, f64)>,
    /// Number of event indicators.
    pub indicators: usize,
    /// Values that depend on the same inputs.
    pub groups: Vec<UnitGroup>,
}

/// Values of a unit that depend on the same inputs: outputs, then derivatives of states, then event indicators.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UnitGroup {
    /// Indices of the inputs in the entry.
    pub inputs: Vec<usize>,
    /// Indices of the outputs in the entry.
    pub outputs: Vec<usize>,
    /// Whether derivatives of states and event indicators are in the group.
    pub has_derivatives: bool,
}

impl UnitEntry {
    /// Name of an output in expressions.
    pub fn output_name(&self, output: &str) -> String {
        format!("{}.{output}", self.name.value)
    }

    /// The group of an output, for model exchange.
    pub(crate) fn group_of(&self, output: &str) -> Option<usize> {
        let index = self.outputs.iter().position(|(own, _)| own == output)?;
        self.equations.as_ref()?.groups.iter().position(|group| group.outputs.contains(&index))
    }
}

/// Keys of a unit.
pub(super) fn keys() -> Vec<Key> {
    vec![
        required("file", Shape::Text, "", "the unit, a file `.fmu`; path relative to this file"),
        optional(
            "sample",
            Shape::Positive,
            "s",
            "for co-simulation, required: time from sample to sample, over which inputs and outputs are constant",
        ),
        unitless(
            "mode",
            Shape::Choice(Cow::Borrowed(&MODES)),
            "for units that support both: steps of its own, or equations solved with those of the model; default the first",
        ),
        unitless("inputs", Shape::Table, "input variables of the unit, with expressions of their values"),
        unitless(
            "outputs",
            Shape::Table,
            "output variables of the unit: `y = \"VARIABLE\"` is `unit.y` in expressions",
        ),
        unitless("parameters", Shape::Table, "start values of variables of the unit, numbers"),
        optional(
            "timeout",
            Shape::Positive,
            "s",
            "real time after which a unit that does not answer has failed",
        )
        .or_number(60.0),
    ]
}

pub(super) fn units(context: &Context<'_>) -> Vec<UnitEntry> {
    each(context, "units", |reader, name| {
        check_name(context, "unit", name, reader.name)?;
        let file = reader.text("file")?;
        let path = joined(context.sources.file(file.span), file.value);
        let path = match context.library.unit(&path) {
            Ok(path) => Located::new(path, file.span),
            Err(missing) => {
                return context.fail(file.span, missing.message, missing.help.unwrap_or_default());
            }
        };
        let mut inputs = Vec::new();
        for (variable, node) in table(reader, "inputs", "expressions")? {
            let formula = context.formula(node, &format!("`inputs.{}` of unit `{name}`", variable.value))?;
            inputs.push((variable, Located::new(formula, node.span)));
        }
        let mut outputs = Vec::new();
        for (output, node) in table(reader, "outputs", "names of variables")? {
            if !is_word(&output.value) {
                let message = format!(
                    "`{}` cannot be the name of an output, because expressions cannot contain it",
                    output.value
                );
                return context.fail(output.span, message, "use letters, digits and `_`, a letter first");
            }
            let Value::Text(variable) = &node.value else {
                return context.wrong_type(
                    node,
                    &format!("`outputs.{}` of unit `{name}`", output.value),
                    "a text: a variable of the unit",
                );
            };
            outputs.push((output.value, Located::new(variable.clone(), node.span)));
        }
        let mut parameters = Vec::new();
        for (variable, node) in table(reader, "parameters", "numbers")? {
            let value = context.number(node, &format!("`parameters.{}` of unit `{name}`", variable.value))?;
            parameters.push((variable, value));
        }
        let sample = if reader.has("sample") { Some(reader.number("sample")?) } else { None };
        let mode = if reader.has("mode") { Some(reader.choice("mode")?.value) } else { None };
        let mode =
            mode.map(|word| if word == MODES[0] { UnitMode::CoSimulation } else { UnitMode::ModelExchange });
        Some(UnitEntry {
            name: Located::new(name.to_owned(), reader.name),
            file: path,
            inputs,
            outputs,
            parameters,
            sample,
            mode,
            equations: None,
            timeout: reader.number("timeout")?.value,
        })
    })
}

/// Entries of the table `key`; none for a value that is no table, which is reported.
fn table<'c>(reader: &Reader<'c, '_>, key: &str, of: &str) -> Option<Vec<(Located<String>, &'c Node)>> {
    let Some(node) = reader.node(key) else { return Some(Vec::new()) };
    let Value::Table(table) = &node.value else {
        return reader.context.wrong_type(
            node,
            &reader.words(key),
            &format!("a table of variables and {of}"),
        );
    };
    Some(table.iter().map(|(word, entry)| (Located::new(word.clone(), entry.key), &entry.node)).collect())
}

fn is_word(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
        && !expression::is_reserved(name)
}

/// Expressions name outputs of a unit, or components of another part `of` the model, as they name components of joints.
pub(super) fn check_name(context: &Context<'_>, of: &str, name: &str, span: Span) -> Option<()> {
    let local = name.rsplit('.').next().unwrap_or(name);
    if !is_word(local) {
        let message = format!("`{name}` cannot be the name of a {of}, because expressions cannot contain it");
        let help =
            "use letters, digits and `_`, a letter first, and no word of expressions such as `pi` or `t`";
        return context.fail(span, message, help);
    }
    // Hydraulic parts add springs and loads of their own names.
    let forces = [("springs", "spring"), ("loads", "load")].into_iter().filter(|_| of != "unit");
    let owners =
        [("joints", "joint"), ("outputs", "output"), ("signals", "signal"), ("hydraulics", "hydraulic part")];
    for (table, what) in owners.into_iter().chain(forces) {
        if what != of && context.has(table, name) {
            let message =
                format!("the {of} `{name}` has the name of a {what}, so `{name}.y` would be ambiguous");
            return context.fail(span, message, "rename one of them");
        }
    }
    Some(())
}
