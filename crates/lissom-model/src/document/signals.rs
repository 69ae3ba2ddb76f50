//! Inputs, signals and first-order states of a model file.

use std::collections::BTreeMap;

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::signals::MAX_ARGUMENTS;

use super::entries::each;
use crate::expression::{self, Formula};
use crate::format::keys::Shape;
use crate::format::top_level::singular;
use crate::functions::table::{Extrapolation, Table};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::reading::table_values::table_key_in;
use crate::text::ROOT;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Value};

/// A named expression.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalEntry {
    /// Name.
    pub name: Located<String>,
    /// Expression of the signal, or the argument of its table.
    pub value: Located<Formula>,
    /// Table of the signal.
    pub table: Option<Table>,
    /// Time from sample to sample [s] and value before the first, for a sampled one.
    pub sampling: Option<(f64, f64)>,
    /// The delay of a delayed one.
    pub delay: Option<DelayEntry>,
    /// The filter of a sampled one.
    pub filter: Option<DiscreteFilter>,
}

/// The delay of a signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DelayEntry {
    /// Time by which it is later than its expression [s].
    pub time: Located<f64>,
    /// Value before the start; none for the value of the expression at the start.
    pub start: Option<f64>,
}

/// A transfer function in z: `y_k = Σ_i b_i u_(k-i) - Σ_j a_j y_(k-j)`, i = 0, 1, …, j = 1, 2, …, u the expression and y
/// the signal at samples.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscreteFilter {
    /// b_0, b_1, …
    pub numerator: Vec<f64>,
    /// a_1, a_2, …
    pub denominator: Vec<f64>,
}

/// A first-order state.
#[derive(Clone, Debug, PartialEq)]
pub struct StateEntry {
    /// Name.
    pub name: Located<String>,
    /// Derivative of the state by time, or what its value makes zero.
    pub derivative: Located<Formula>,
    /// Whose value is not valid below zero, if that is so.
    pub positive_of: Option<Subject>,
    /// Whether the state is algebraic: its value makes the expression zero.
    pub is_balance: bool,
    /// Value at the start.
    pub start: f64,
    /// Usual magnitude, by which errors are measured.
    pub magnitude: f64,
}

/// Inputs, signals and states have names that expressions can write, and share them with parameters.
pub(super) fn check_names(context: &Context<'_>) {
    let mut known: BTreeMap<&str, (Span, &str)> =
        context.names("parameters").into_iter().map(|(name, span)| (name, (span, "parameter"))).collect();
    for table in ["inputs", "signals", "states"] {
        for (name, span, node) in context.entries(table) {
            let what = singular(table);
            let local = context.local_name(name, node);
            let mut letters = local.chars();
            let is_word = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
                && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
            if !is_word {
                let message =
                    format!("`{name}` cannot be the name of a {what}, because expressions cannot contain it");
                context.fail::<()>(span, message, "use letters, digits and `_`, a letter first");
            } else if node.scope != ROOT && context.parameters_of(node.scope).contains_key(local) {
                let message = format!("the {what} `{name}` has the name of a parameter");
                context.fail::<()>(
                    span,
                    message,
                    "parameters, inputs, signals and states must have different names",
                );
            } else if expression::is_reserved(local) {
                let message = format!("a {what} cannot be called `{local}`");
                context.fail::<()>(span, message, "this word has another meaning in expressions");
            } else if let Some((first, other)) = known.insert(name, (span, what)) {
                let message = format!("the {what} `{name}` has the name of a {other}");
                let problem = Problem::error(span, message).label("again").also(first, "first here");
                context
                    .report(problem.help("parameters, inputs, signals and states must have different names"));
            }
        }
    }
}

pub(super) fn inputs(context: &Context<'_>) -> Vec<(Located<String>, f64)> {
    let read = |(name, span, node): (&str, Span, _)| {
        let value = context.number(node, &format!("input `{name}`"))?;
        Some((Located::new(name.to_owned(), span), value))
    };
    context.entries("inputs").into_iter().filter_map(read).collect()
}

pub(super) fn signals(context: &Context<'_>) -> Vec<SignalEntry> {
    let mut signals = Vec::new();
    for (name, span, node) in context.entries("signals") {
        let what = format!("signal `{name}`");
        let name = Located::new(name.to_owned(), span);
        let entry = if let Value::Table(_) = node.value {
            Reader::open(context, node, (what, span), Shape::signal_keys())
                .and_then(|reader| of_table(&reader, node, name))
        } else {
            context.formula(node, &what).map(|formula| SignalEntry {
                name,
                value: Located::new(formula, node.span),
                table: None,
                sampling: None,
                delay: None,
                filter: None,
            })
        };
        signals.extend(entry);
    }
    signals
}

/// A signal whose keys are in a table.
fn of_table(reader: &Reader<'_, '_>, node: &Node, name: Located<String>) -> Option<SignalEntry> {
    let (context, what) = (reader.context, &reader.what);
    let (value, table) = match (reader.node("value"), reader.node("of")) {
        (Some(value), Some(_)) => {
            let message = format!("{what} has both `value` and `of`");
            return context.fail(value.span, message, "remove one of them: `of` is the argument of a table");
        }
        (None, Some(_)) => {
            let table = context.table_of(reader, node, Extrapolation::Constant);
            (reader.formula("of")?, Some(table?))
        }
        (Some(value), None) => {
            if let Some(word) = table_key_in(reader) {
                let message = format!("{what} has `{word}`, but no argument of a table");
                return context.fail(
                    value.span,
                    message,
                    "write `of` instead of `value`, or remove the table",
                );
            }
            (reader.formula("value")?, None)
        }
        (None, None) => {
            let message = format!("{what} lacks `value`");
            let help =
                "add `value = …`, an expression, or `of = …` and `table = …`, a table over an expression";
            return context.fail(reader.name, message, help);
        }
    };
    let delay = if reader.has("delay") { Some(delay(reader)?) } else { None };
    let sampling = match reader.number("sample") {
        Some(period) => Some((period.value, reader.number("start").map_or(0.0, |start| start.value))),
        None if reader.has("sample") => return None,
        None => {
            let needed_by = ["numerator", "denominator"].into_iter().find(|word| reader.has(word));
            let of_start = (delay.is_none() && reader.has("start")).then_some("start");
            let of_value = (delay.is_none() && table.is_none()).then_some("value");
            if let Some(word) = of_start.or(needed_by).or(of_value) {
                let message = format!("{what} has `{word}`, but lacks `sample`");
                let help = "add `sample = …` [s], the time from sample to sample, or `delay = …` [s]; \
                            a continuous signal is an expression alone, or a table over one";
                return context.fail(reader.name, message, help);
            }
            None
        }
    };
    let filter =
        if reader.has("numerator") || reader.has("denominator") { Some(filter(reader)?) } else { None };
    Some(SignalEntry { name, value, table, sampling, delay, filter })
}

/// The delay of a signal, which is not sampled.
fn delay(reader: &Reader<'_, '_>) -> Option<DelayEntry> {
    let time = reader.number("delay")?;
    if reader.has("sample") {
        let message = format!("{} has both `delay` and `sample`", reader.what);
        let help = "remove one of them; the past of a sampled signal is a discrete filter, such as \
                    `numerator = [0, 1]`, or another signal with `delay`";
        return reader.context.fail(time.span, message, help);
    }
    let start = if reader.has("start") { Some(reader.number("start")?.value) } else { None };
    Some(DelayEntry { time, start })
}

/// The filter of a sampled signal, divided by the first coefficient of its denominator.
fn filter(reader: &Reader<'_, '_>) -> Option<DiscreteFilter> {
    let (context, what) = (reader.context, &reader.what);
    let coefficients = |key: &str| context.number_list(reader.node(key)?, &reader.words(key));
    let denominator = if reader.has("denominator") { coefficients("denominator") } else { Some(vec![1.0]) };
    let Some(node) = reader.node("numerator") else {
        let message = format!("{what} has `denominator`, but lacks `numerator`");
        return context.fail(reader.name, message, "add `numerator = [1]`, or other coefficients");
    };
    let (numerator, denominator) = (coefficients("numerator")?, denominator?);
    let first = denominator[0];
    if first == 0.0 {
        let message = format!("`denominator` of {what} begins with 0, the coefficient of the present value");
        return context.fail(reader.name, message, "begin with 1, such as [1, -0.9] for y_k - 0.9 y_(k-1)");
    }
    // The first of the denominator is no argument of the signal.
    if numerator.len() + denominator.len() - 1 > MAX_ARGUMENTS {
        let message = format!("{what} has a filter of more than {MAX_ARGUMENTS} past and present values");
        return context.fail(node.span, message, "divide it into several signals in series");
    }
    let normalized = |all: &[f64]| all.iter().map(|own| own / first).collect();
    Some(DiscreteFilter { numerator: normalized(&numerator), denominator: normalized(&denominator[1..]) })
}

pub(super) fn states(context: &Context<'_>) -> Vec<StateEntry> {
    each(context, "states", |reader, name| {
        Some(StateEntry {
            name: Located::new(name.to_owned(), reader.name),
            derivative: reader.formula("derivative")?,
            positive_of: None,
            is_balance: reader.flag("algebraic")?.value,
            start: reader.number("start")?.value,
            magnitude: reader.number("magnitude")?.value,
        })
    })
}
