//! Windows of statistics: the part of a history to which a statistic applies, such as `after=0.5`, `last=0.2` or
//! `after=impact, before=impact[2]`. Limits are times, expressions of the parameters, or events.

use std::collections::{BTreeMap, VecDeque};

use serde::{Deserialize, Serialize};

use super::rainflow::Fatigue;
use super::statistic::Accumulator;
use crate::expression::Expression;
use crate::format::suggest;

/// Keys of a window, each with its synonyms.
const KEYS: [(&str, &[&str]); 3] =
    [("after", &["from", "since", "start"]), ("before", &["to", "until", "end"]), ("last", &[])];
/// Records this close to a limit, relative to the duration of the analysis, are inside.
const TOLERANCE: f64 = 1e-9;

/// Part of a history, as written.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Window {
    /// Texts of the limits, in the order of the keys.
    limits: [Option<String>; 3],
}

/// Message and remedy for a window that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WindowError {
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub remedy: String,
}

fn fail<T>(message: impl Into<String>, remedy: impl Into<String>) -> Result<T, WindowError> {
    Err(WindowError { message: message.into(), remedy: remedy.into() })
}

/// Properties of a model on which the limits of windows depend.
#[derive(Clone, Copy, Debug)]
pub struct WindowContext<'a> {
    /// Names of the events.
    pub events: &'a [&'a str],
    /// Values of the parameters.
    pub parameters: &'a BTreeMap<String, f64>,
    /// First time of the analysis [s].
    pub start: f64,
    /// Last time of the analysis [s].
    pub end: f64,
}

/// A limit of a window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum Limit {
    Time(f64),
    /// Name of the event and number of its occurrence: 1 is the first, -1 the last.
    Event(String, i32),
}

/// A window with the numbers of a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TimeWindow {
    after: Option<Limit>,
    before: Option<Limit>,
    /// Duration before the last record [s].
    last: Option<f64>,
    /// Records this much outside are inside [s].
    tolerance: f64,
}

/// Texts between commas outside of brackets.
pub(super) fn split(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let is_comma = |letter: char| {
        depth += i32::from(matches!(letter, '(' | '[')) - i32::from(matches!(letter, ')' | ']'));
        letter == ',' && depth == 0
    };
    text.split(is_comma).map(str::trim).collect()
}

impl Window {
    /// Reads a text such as `after=0.5, before=impact`; an empty text is the whole history.
    ///
    /// # Errors
    /// If it has unknown or contradicting keys.
    pub fn parse(text: &str) -> Result<Self, WindowError> {
        if text.trim().is_empty() { Ok(Self::default()) } else { Self::of_parts(&split(text)) }
    }

    pub(super) fn of_parts(parts: &[&str]) -> Result<Self, WindowError> {
        const FORMS: &str = "write `after=0.5`, `before=2`, both, or `last=0.2`; times are in s, and events limit windows, too: \
                             `after=impact`";
        let mut limits = [const { None }; 3];
        for part in parts {
            let Some((word, value)) = part.split_once('=') else {
                return fail(format!("`{part}` is no limit of a window"), FORMS);
            };
            let (word, value) = (word.trim(), value.trim().trim_matches(['"', '\'']));
            let Some(index) = KEYS.iter().position(|(key, others)| *key == word || others.contains(&word))
            else {
                let remedy = suggest::nearest(word, KEYS.map(|(key, _)| key));
                let remedy = remedy.map_or(FORMS.to_owned(), |key| format!("did you mean `{key}`?"));
                return fail(format!("unknown limit `{word}` of a window"), remedy);
            };
            let key = KEYS[index].0;
            if value.is_empty() {
                return fail(format!("the limit `{word}` has no value"), FORMS);
            }
            if limits[index].replace(value.to_owned()).is_some() {
                return fail(format!("the window has two limits `{key}`"), "remove one of them");
            }
        }
        if limits[2].is_some() && (limits[0].is_some() || limits[1].is_some()) {
            return fail("`last` ends at the last record and has no other limits", "remove the other limits");
        }
        if let [Some(Ok(after)), Some(Ok(before))] =
            [&limits[0], &limits[1]].map(|limit| limit.as_ref().map(|text| text.parse::<f64>()))
            && after >= before
        {
            return fail(
                format!("the window from {after} s to {before} s is empty"),
                "`before` must be greater than `after`",
            );
        }
        Ok(Self { limits })
    }

    /// Whether it is the whole history.
    pub fn is_whole(&self) -> bool {
        self.limits.iter().all(Option::is_none)
    }

    /// The window with the numbers of a model.
    ///
    /// # Errors
    /// If a limit is neither a number nor an event, or the window is empty or not within the analysis.
    pub fn resolve(&self, context: &WindowContext<'_>) -> Result<TimeWindow, WindowError> {
        let WindowContext { start, end, .. } = *context;
        let tolerance = TOLERANCE * (end - start);
        let limit = |index: usize| self.limits[index].as_deref().map(|text| limit(text, context)).transpose();
        let (after, before) = (limit(0)?, limit(1)?);
        let time = |limit: &Option<Limit>| match limit {
            Some(Limit::Time(time)) => Some(*time),
            _ => None,
        };
        let (from, to) = (time(&after).unwrap_or(start), time(&before).unwrap_or(end));
        if from > end + tolerance {
            return fail(
                format!("the window begins at {from} s, but the analysis ends at {end} s"),
                "choose a smaller `after`, or a later `end` of the analysis",
            );
        }
        if to > end + tolerance {
            return fail(
                format!("the window ends at {to} s, but the analysis ends at {end} s"),
                "remove `before`, or choose a later `end` of the analysis",
            );
        }
        if to < from || to < start - tolerance {
            return fail(
                format!("the window from {from} s to {to} s is empty"),
                "`before` must be greater than `after` and than the start of the analysis",
            );
        }
        let last = match limit(2)? {
            None => None,
            Some(Limit::Event(name, _)) => {
                return fail(
                    format!("`last` is a duration, and `{name}` is an event"),
                    format!("write `after={name}[-1]` for the time after its last occurrence"),
                );
            }
            Some(Limit::Time(last)) if last > 0.0 && last <= end - start + tolerance => Some(last),
            Some(Limit::Time(last)) => {
                return fail(
                    format!("the last {last} s are not a part of the analysis of {} s", end - start),
                    "`last` must be greater than zero and not greater than the duration of the analysis",
                );
            }
        };
        Ok(TimeWindow { after, before, last, tolerance })
    }
}

fn limit(text: &str, context: &WindowContext<'_>) -> Result<Limit, WindowError> {
    let (name, occurrence) = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
        Some((name, number)) => (name.trim(), number.trim().parse().unwrap_or(0)),
        None => (text, 1),
    };
    if context.events.contains(&name) {
        if occurrence == 0 {
            return fail(
                format!("`{text}` has no whole number of an occurrence"),
                format!("`{name}[1]` is the first and `{name}[-1]` the last occurrence"),
            );
        }
        return Ok(Limit::Event(name.to_owned(), occurrence));
    }
    match Expression::parse(text, None, context.parameters).map(|expression| expression.value(0.0)) {
        Ok(time) if time.is_finite() => Ok(Limit::Time(time)),
        Ok(_) => fail(format!("the limit `{text}` is not a finite number"), "write a time in s"),
        Err(_) => {
            let names =
                || context.events.iter().copied().chain(context.parameters.keys().map(String::as_str));
            let known = match context.events {
                [] => "the model has no events".to_owned(),
                events => format!("the events are {}", suggest::list(events.iter().copied())),
            };
            let near = suggest::nearest(name, names());
            let remedy = near.map_or_else(
                || format!("write a time in s, an expression of [parameters] or an event; {known}"),
                |near| format!("did you mean `{near}`?"),
            );
            fail(format!("the limit `{text}` is neither a time nor an event"), remedy)
        }
    }
}

/// A history and its window: accumulates the records inside. Records are stored only where the window depends on what
/// happens later.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WindowedHistory {
    window: TimeWindow,
    inside: Accumulator,
    stored: VecDeque<(f64, f64)>,
    /// Whether a value is finite, also outside of the window.
    has_finite: bool,
}

impl WindowedHistory {
    /// An empty history; its cycles are counted if it has `fatigue`.
    pub fn new(window: TimeWindow, fatigue: Option<Fatigue>) -> Self {
        Self { window, inside: Accumulator::with_fatigue(fatigue), ..Self::default() }
    }

    /// Adds the value at `time` [s].
    pub fn add(&mut self, time: f64, value: f64) {
        self.has_finite |= value.is_finite();
        let TimeWindow { after, before, last, tolerance } = &self.window;
        let is_out = matches!(after, Some(Limit::Time(after)) if time < after - tolerance)
            || matches!(before, Some(Limit::Time(before)) if time > before + tolerance);
        if is_out {
            return;
        }
        if last.is_none()
            && !matches!((after, before), (Some(Limit::Event(..)), _) | (_, Some(Limit::Event(..))))
        {
            self.inside.add(time, value);
            return;
        }
        self.stored.push_back((time, value));
        if let Some(last) = last {
            while self.stored.front().is_some_and(|(first, _)| *first < time - last - tolerance) {
                self.stored.pop_front();
            }
        }
    }

    /// Whether a value that was added is finite.
    pub fn has_finite(&self) -> bool {
        self.has_finite
    }

    /// Data of the records in the window, for a run in which `events` happened [s].
    ///
    /// # Errors
    /// If an event that limits the window has not happened, or there are no records in the window.
    pub fn close(&self, events: &[(&str, f64)]) -> Result<Accumulator, WindowError> {
        let time = |limit: &Option<Limit>, none: f64| {
            let (name, number) = match limit {
                None => return Ok(none),
                Some(Limit::Time(time)) => return Ok(*time),
                Some(Limit::Event(name, number)) => (name, *number),
            };
            let times: Vec<f64> =
                events.iter().filter(|(own, _)| own == name).map(|(_, time)| *time).collect();
            let index = if number > 0 {
                Some(number as usize - 1)
            } else {
                times.len().checked_sub(number.unsigned_abs() as usize)
            };
            let found = index.and_then(|index| times.get(index)).copied();
            found.map_or_else(
                || {
                    let message = format!(
                        "event `{name}` has happened {} times, which limits the window at {number}",
                        times.len()
                    );
                    fail(message, "choose another limit, or a later `end` of the analysis")
                },
                Ok,
            )
        };
        let from = time(&self.window.after, f64::NEG_INFINITY)?;
        let to = time(&self.window.before, f64::INFINITY)?;
        let mut inside = self.inside.clone();
        for (at, value) in &self.stored {
            if *at >= from - self.window.tolerance && *at <= to + self.window.tolerance {
                inside.add(*at, *value);
            }
        }
        if inside.is_empty() {
            return fail(
                "there are no records in the window",
                "record more often by `output_step` or `output_every`, or choose a longer window",
            );
        }
        Ok(inside)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/sweep/window.rs"]
mod tests;
