//! How texts are answered by what reads them, and what a good answer is.

use std::collections::BTreeMap;

use lissom_model::Document;
use lissom_model::expression::{Expression, ExpressionError, Formula};
use lissom_model::registry::Registry;

/// How a text is answered.
#[derive(Debug, PartialEq)]
pub(crate) enum Answer {
    /// It is read.
    Read,
    /// It is rejected, and the position of every error is reported.
    Refused,
    /// Neither; in words.
    Badly(String),
}

/// How a model file is answered. An error must have a line of the text.
pub(crate) fn of_model(text: &str, registry: &Registry) -> Answer {
    match Document::parse_with(text, "fuzz.toml", registry, &[]) {
        Ok(_) => Answer::Read,
        Err(report) if !report.has_errors() => Answer::Badly("rejected without an error".to_owned()),
        Err(report) => {
            let reported = report.to_value();
            let lines = text.lines().count().max(1) as u64 + 1;
            match reported.as_array() {
                Some(problems)
                    if problems.iter().all(|problem| {
                        problem["line"].as_u64().is_some_and(|line| (1..=lines).contains(&line))
                    }) && !report.render(false).is_empty() =>
                {
                    Answer::Refused
                }
                _ => Answer::Badly(format!("an error without a line: {reported}")),
            }
        }
    }
}

/// How an expression of the time is answered, as a load and as a drive would read it: with names, and without. An error must
/// have words and bytes of the text; what is read without names must be the same as with them.
pub(crate) fn of_expression(text: &str, parameters: &BTreeMap<String, f64>) -> Answer {
    const TIMES: [f64; 3] = [0.0, 0.7, 1e9];
    let with_names = Formula::parse(text, parameters);
    let without = Expression::parse(text, Some("t"), parameters);
    let is_placed = |error: &ExpressionError| {
        let is_aside = error.range.start == text.len() && error.range.end == text.len();
        !error.message.is_empty() && (is_aside || text.get(error.range.clone()).is_some())
    };
    if let Some(error) = [with_names.as_ref().err(), without.as_ref().err()]
        .into_iter()
        .flatten()
        .find(|error| !is_placed(error))
    {
        return Answer::Badly(format!("an error without a place: {error:?}"));
    }
    match (with_names, without) {
        (Err(_), Err(_)) => Answer::Refused,
        (Err(error), Ok(_)) => Answer::Badly(format!("read without names alone: {error}")),
        (Ok(formula), Err(_)) if formula.arguments().is_empty() => {
            Answer::Badly("without names it is rejected, and has none".to_owned())
        }
        (Ok(formula), Err(_)) => {
            for time in TIMES {
                formula.jet((time, 1.0), |index| (index as f64 - time, 0.5));
            }
            Answer::Read
        }
        (Ok(formula), Ok(expression)) => {
            let breakpoints = expression.breakpoints();
            if !breakpoints.iter().all(|kink| kink.is_finite()) || !breakpoints.is_sorted() {
                return Answer::Badly(format!("kinks at {breakpoints:?}"));
            }
            for time in TIMES {
                let jet = expression.jet(time);
                let wanted = [jet.value, jet.first, jet.second];
                let found = formula.jet((time, 1.0), |_| (0.0, 0.0));
                // What a number that is none is made of is no matter.
                let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                if !found.iter().zip(&wanted).all(is_same) {
                    return Answer::Badly(format!("with names it has another value at t = {time}"));
                }
            }
            Answer::Read
        }
    }
}
