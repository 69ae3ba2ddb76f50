//! One output of one run, at equidistant instants, and the difference of two such histories.

use std::ops::ControlFlow;

use crate::start::{Lowered, lower_with_units};
use lissom_model::component_position;
use lissom_model::lower::{Plan, Records};
use lissom_model::output::Record;

use super::StudyError;
use super::members::Effort;
use crate::model_text::Model;
use crate::run::report::Stopped;
use crate::session::Session;

/// Values of all components, instant by instant.
pub(super) type History = Vec<Vec<f64>>;

/// A model with time steps of `step`, as written.
pub(super) fn with_step(model: &Model, step: &str) -> Model {
    model.with_overrides(&[("analysis.step".to_owned(), step.to_owned())])
}

/// The model with time steps of `step`, as written. Newton's iteration has `tolerance`, unless the user sets one or
/// the model has a smaller one: the iteration error must be below the measured error.
pub(super) fn prepared(model: &Model, step: &str, tolerance: f64) -> Result<Lowered, StudyError> {
    let mut lowered = lower_with_units(&with_step(model, step).document()?)?;
    if lowered.plan.is_static {
        return Err(StudyError::NotDynamic);
    }
    if !model.overrides().iter().any(|(path, _)| path == "analysis.tolerance") {
        let limits = &mut lowered.settings.limits;
        limits.tolerance = limits.tolerance.min(tolerance);
    }
    Ok(lowered)
}

/// An output's name, and one of its components if it is given, such as `tip` or `tip.u2`.
fn parts<'a>(lowered: &Lowered, output: &'a str) -> Option<(&'a str, Option<usize>)> {
    let find = |name: &str| lowered.channels.iter().find(|channel| channel.name == name);
    if find(output).is_some() {
        return Some((output, None));
    }
    let (name, component) = output.rsplit_once('.')?;
    let known = find(name)?.components.iter().map(String::as_str);
    let index = component_position(known, component)?;
    Some((name, Some(index)))
}

/// Returns an error unless the model has `output`.
pub(super) fn check_output(lowered: &Lowered, output: &str) -> Result<(), StudyError> {
    if parts(lowered, output).is_some() {
        return Ok(());
    }
    let known: Vec<&str> = lowered.channels.iter().map(|channel| channel.name.as_str()).collect();
    Err(StudyError::Output { name: output.to_owned(), known: known.join(", ") })
}

/// Values of `output` at the start and after every `every` of `steps` steps, independent of the end of the model.
pub(super) fn observe(
    mut lowered: Lowered,
    output: &str,
    (steps, every): (usize, usize),
    effort: &Effort<'_>,
) -> Result<History, StudyError> {
    let (name, component) = parts(&lowered, output).unwrap_or((output, None));
    lowered.channels.retain(|channel| channel.name == name);
    let start = lowered.plan.start;
    let end = start + steps as f64 * lowered.settings.step_size;
    lowered.plan =
        Plan { start, end, steps, records: Records::Every(every), is_controlled: false, ..lowered.plan };
    lowered.settings.control = None;
    let mut session = Session::start(lowered)?;
    let mut record = Record::default();
    let watch = &mut |progress: &crate::session::Progress| match progress.done {
        0 => ControlFlow::Continue(()),
        done => effort.note(done),
    };
    match session.run_with(&mut [&mut record], watch).stopped {
        Stopped::End => {}
        Stopped::Interrupted => return Err(StudyError::Interrupted),
        Stopped::Failed(error) => return Err(StudyError::Run(error)),
    }
    let chosen = match component {
        Some(index) => &record.values[index..=index],
        None => &record.values[..],
    };
    let instant = |index: usize| chosen.iter().map(|column| column[index]).collect();
    Ok((0..record.times.len()).map(instant).collect())
}

/// Sum of the squares of all components at one instant.
pub(super) fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Components of `a` minus those of `b`.
pub(super) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
