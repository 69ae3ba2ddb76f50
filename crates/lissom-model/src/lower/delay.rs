//! Delayed signals: the signal exists before all others, its expression after them, so that a delay breaks a loop of signals.

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::{Argument, SignalId};
use lissom_system::Builder;

use super::names::Names;
use super::signals::{Reader, of_entry, signals_named};
use crate::document::{AnalysisKind, DelayEntry, Document, SignalEntry};
use crate::text::report::Problem;

/// Maximum number of parts of a step of one size that is longer than a delay.
const MAX_PARTS: f64 = 1e3;

/// Adds a delayed signal without its expression.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (entry, delay): (&SignalEntry, &DelayEntry),
) -> Result<SignalId, Problem> {
    let name = &entry.name.value;
    if let AnalysisKind::Dynamics { step, control: None } = &document.analysis.kind
        && step.value > MAX_PARTS * delay.time.value
    {
        let message = format!(
            "the delay of signal `{name}`, {} s, is below a thousandth of the step, {} s: steps must not be longer than a delay",
            delay.time.value, step.value
        );
        let problem = Problem::error(delay.time.span, message).also(step.span, "the step");
        return Err(problem.help("shorten the step, or use the expression without `delay`"));
    }
    if delay.start.is_none() && depends_on_itself(document, entry) {
        let message = format!(
            "the value of signal `{name}` before the start is not determined: by default it is that of its expression, which depends \
             on the signal itself"
        );
        return Err(
            Problem::error(entry.value.span, message).help("add `start = …`, the value before the start")
        );
    }
    let subject = Subject::new("signal", name).called(name);
    let signal =
        builder.add_delay(subject, delay.time.value, delay.start).map_err(|error| invalid(entry, &error))?;
    names.signals.insert(name.clone(), Argument::Signal(signal));
    Ok(signal)
}

/// Adds the expression of a delayed signal, after all signals that it names.
pub(super) fn add_source(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    (entry, delayed): (&SignalEntry, SignalId),
) -> Result<(), Problem> {
    let subject = Subject::new("delayed signal", &entry.name.value);
    let reader = Reader { subject: &subject, expression: &entry.value, is_sampled: false, own_sample: None };
    let (source, _) = of_entry(document, builder, names, entry, (&reader, None))?;
    let source = builder.add_signal(source).map_err(|error| invalid(entry, &error))?;
    builder.set_source(delayed, source);
    Ok(())
}

fn invalid(entry: &SignalEntry, error: &ParameterError) -> Problem {
    Problem::error(entry.value.span, error.to_string())
}

/// Whether the expression of a delayed signal depends on the signal at the start, by sampled signals and delayed ones without a value
/// before the start as well.
fn depends_on_itself(document: &Document, entry: &SignalEntry) -> bool {
    let (mut open, mut seen) = (vec![entry], Vec::new());
    while let Some(next) = open.pop() {
        for argument in next.value.value.arguments() {
            for named in signals_named(document, &argument.text, &mut Vec::new()) {
                let name = named.name.value.as_str();
                if name == entry.name.value {
                    return true;
                }
                let is_given = named.delay.is_some_and(|delay| delay.start.is_some());
                if !is_given && !seen.contains(&name) {
                    seen.push(name);
                    open.push(named);
                }
            }
        }
    }
    false
}
