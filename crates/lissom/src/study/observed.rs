//! One output of one run, at evenly spaced instants, and how far two such histories are apart. Knows no study.

use std::ops::ControlFlow;

use lissom_model::lower::{Lowered, Plan, lower};
use lissom_model::output::Record;

use super::StudyError;
use super::members::Effort;
use crate::model::{Model, Override};
use crate::report::Stopped;
use crate::session::Session;

/// Values of all components, instant by instant.
pub(super) type History = Vec<Vec<f64>>;

/// The model with time steps of `step`, as written. Newton's iteration has `tolerance`, unless the user sets one or
/// the model has a smaller one: what a study measures must not be what the iteration has left.
pub(super) fn prepared(
    model: &Model,
    overrides: &[Override],
    step: &str,
    tolerance: f64,
) -> Result<Lowered, StudyError> {
    let mut all = overrides.to_vec();
    all.push(("analysis.step".to_owned(), step.to_owned()));
    let mut lowered = lower(&model.document(&all)?)?;
    if lowered.plan.is_static {
        return Err(StudyError::NotDynamic);
    }
    if !overrides.iter().any(|(path, _)| path == "analysis.tolerance") {
        let limits = &mut lowered.settings.limits;
        limits.tolerance = limits.tolerance.min(tolerance);
    }
    Ok(lowered)
}

/// Complains unless the model has `output`.
pub(super) fn check_output(lowered: &Lowered, output: &str) -> Result<(), StudyError> {
    if lowered.channels.iter().any(|channel| channel.name == output) {
        return Ok(());
    }
    let known: Vec<&str> = lowered.channels.iter().map(|channel| channel.name.as_str()).collect();
    Err(StudyError::Output { name: output.to_owned(), known: known.join(", ") })
}

/// Values of `output` at the start and after every `every` of `steps` steps, whatever end the model has.
pub(super) fn observe(
    mut lowered: Lowered,
    output: &str,
    (steps, every): (usize, usize),
    effort: &Effort<'_>,
) -> Result<History, StudyError> {
    lowered.channels.retain(|channel| channel.name == output);
    let start = lowered.plan.start;
    let end = start + steps as f64 * lowered.settings.step_size;
    lowered.plan = Plan { start, end, steps, output_every: every, is_static: false };
    let mut session = Session::start(lowered)?;
    let mut record = Record::default();
    let watch = &mut |progress: &crate::session::Progress| match progress.done {
        0 => ControlFlow::Continue(()),
        done => effort.note(done),
    };
    match session.run(&mut [&mut record], watch).stopped {
        Stopped::End => {}
        Stopped::Interrupted => return Err(StudyError::Interrupted),
        Stopped::Failed(error) => return Err(StudyError::Run(error)),
    }
    let instant = |index: usize| record.values.iter().map(|column| column[index]).collect();
    Ok((0..record.times.len()).map(instant).collect())
}

/// Sum of the squares of all components at one instant.
pub(super) fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Components of `a` less those of `b`.
pub(super) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
