//! Problems of a model file with the positions that they underline, collected in a report.
//! Independent of the meaning of keys.

use lissom_mechanics::diagnostics::{self, Diagnose, Diagnostic, Entry, Value};
use lissom_mechanics::kinematics::Subject;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::format::top_level::singular;
use crate::text::excerpt::{Excerpt, Label, Mark, Painter};

/// A stretch of the model's text: byte offsets, the end excluded. Overrides count as text behind the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// Where a text is that is there a second time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shift {
    /// The repeated text; positions elsewhere, such as in an override, are unchanged.
    within: Span,
    /// How far behind it is there again.
    by: usize,
}

impl Shift {
    /// A text that was read as if it stood at the start.
    pub(crate) fn of_text(length: usize, by: usize) -> Self {
        Self { within: Span { start: 0, end: length }, by }
    }
}

impl Span {
    /// This stretch where its text is there again.
    pub(crate) fn moved(self, shift: Shift) -> Self {
        if self.start < shift.within.start || self.start > shift.within.end {
            return self;
        }
        Self { start: self.start + shift.by, end: self.end + shift.by }
    }
}

impl From<Range<usize>> for Span {
    fn from(range: Range<usize>) -> Self {
        Self { start: range.start, end: range.end }
    }
}

/// A value and the text it was read from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located<T> {
    /// The value.
    pub value: T,
    /// Where it is.
    pub span: Span,
}

impl<T> Located<T> {
    /// A value read at `span`.
    pub fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }

    /// This position with another value.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> Located<U> {
        Located { value: change(self.value), span: self.span }
    }
}

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// The model can be used, but may contain a mistake.
    Warning,
}

/// A problem without its position.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// The part it is about.
    pub part: Subject,
    /// One sentence.
    pub message: String,
    /// A remedy; may be empty.
    pub help: String,
}

/// An error or warning with its position and remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Error or warning.
    pub severity: Severity,
    /// One sentence that names the part.
    pub message: String,
    /// The text to underline.
    pub span: Span,
    /// A few words below the underlined text; may be empty.
    pub label: String,
    /// A remedy.
    pub help: Option<String>,
    /// Other text to underline, such as the first definition of a name.
    pub also: Option<(Span, String)>,
}

impl Problem {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        let severity = Severity::Error;
        Self { severity, message: message.into(), span, label: String::new(), help: None, also: None }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(span, message) }
    }

    /// Adds words below the underlined text.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a remedy.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds a remedy, if there is one.
    pub fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }

    /// Underlines another position as well.
    pub fn also(mut self, span: Span, label: impl Into<String>) -> Self {
        self.also = Some((span, label.into()));
        self
    }
}

/// One text of the model: the file, an override, or the contents of a part.
#[derive(Clone, Debug)]
struct Piece {
    name: Arc<str>,
    text: Arc<str>,
    start: usize,
    end: usize,
    origin: Option<Origin>,
}

/// Why a text is there a second time, or at all: a part that was made of it.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    /// Name of the part.
    pub(crate) part: String,
    /// Position of the request for the part.
    pub(crate) place: Span,
}

/// The texts a model was read from, laid end to end so that a [`Span`] finds its way back.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    pieces: Vec<Piece>,
}

/// Name of the text of an override.
pub(crate) const OVERRIDE: &str = "override";

impl Sources {
    /// The text of one file.
    pub fn new(name: &str, text: &str) -> Self {
        let mut sources = Self::default();
        sources.push(name, text);
        sources
    }

    /// Adds a text and returns where it starts.
    pub(crate) fn push(&mut self, name: &str, text: &str) -> usize {
        self.push_shared(name, Arc::from(text), None)
    }

    /// Adds a text that others may share, for the part that `origin` names, and returns where it starts.
    pub(crate) fn push_shared(&mut self, name: &str, text: Arc<str>, origin: Option<Origin>) -> usize {
        let start = self.next_start();
        let end = start + text.len();
        self.pieces.push(Piece { name: Arc::from(name), text, start, end, origin });
        start
    }

    /// Adds the text that contains `span` again, for the part `origin`.
    pub(crate) fn push_again(&mut self, span: Span, origin: Origin) -> Shift {
        let Some(piece) = self.piece(span) else { return Shift::default() };
        let (name, text) = (Arc::clone(&piece.name), Arc::clone(&piece.text));
        let within = Span { start: piece.start, end: piece.end };
        let start = self.push_shared(&name, text, Some(origin));
        Shift { within, by: start - within.start }
    }

    /// Name of the first text.
    pub(crate) fn first_name(&self) -> &str {
        self.pieces.first().map_or("", |piece| &piece.name)
    }

    /// Where the next text will start.
    pub(crate) fn next_start(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.end + 1)
    }

    /// The file that `span` is in, as a path from the folder of the model; for overrides that of the model.
    pub(crate) fn file(&self, span: Span) -> &str {
        let name = self.piece(span).map_or("", |piece| &piece.name);
        let folder = self.first_name().rsplit_once('/').map_or(0, |(folder, _)| folder.len() + 1);
        if name == OVERRIDE { "" } else { name.get(folder..).unwrap_or(name) }
    }

    /// Whether `span` is in an override.
    pub(crate) fn is_override(&self, span: Span) -> bool {
        self.piece(span).is_some_and(|piece| &*piece.name == OVERRIDE)
    }

    /// Name of the file at `span` and number of the line, such as `masses.toml:12`.
    pub(crate) fn position(&self, span: Span) -> String {
        let Some(piece) = self.piece(span) else { return String::new() };
        let before = piece.text.get(..local(span, piece).start).unwrap_or_default();
        format!("{}:{}", piece.name, before.matches('\n').count() + 1)
    }

    /// The text at `span`, empty where there is none.
    pub(crate) fn text(&self, span: Span) -> &str {
        let Some(piece) = self.piece(span) else { return "" };
        let local = local(span, piece);
        piece.text.get(local).unwrap_or("")
    }

    /// Where a part of an expression is, whose `text` is within `whole`; all of it where it is written otherwise.
    pub(crate) fn within(&self, whole: Span, text: &str, range: &Range<usize>) -> Span {
        let found = self.text(whole).find(text).filter(|_| !text.is_empty());
        found.map_or(whole, |offset| {
            let start = whole.start + offset + range.start;
            // The end of the expression is shown at the closing quote.
            Span { start, end: start + range.len().max(1) }
        })
    }

    fn piece(&self, span: Span) -> Option<&Piece> {
        // Pieces are consecutive; each begins after the end of the previous one.
        let after = self.pieces.partition_point(|piece| piece.start <= span.start);
        let found = after.checked_sub(1).and_then(|index| self.pieces.get(index));
        found.filter(|piece| span.start <= piece.end).or(self.pieces.first())
    }
}

impl Piece {
    fn excerpt<'a>(&'a self, labels: impl Iterator<Item = (&'a Span, &'a String)>) -> Excerpt<'a> {
        let labels = labels.map(|(span, words)| Label { range: local(*span, self), words });
        Excerpt { name: &self.name, text: &self.text, labels: labels.collect() }
    }
}

fn local(span: Span, piece: &Piece) -> Range<usize> {
    let length = piece.end - piece.start;
    let start = span.start.saturating_sub(piece.start).min(length);
    start..span.end.saturating_sub(piece.start).clamp(start, length)
}

/// A problem together with its text, ready to be shown.
#[derive(Clone, Debug)]
struct Shown {
    problem: Problem,
    piece: Option<Piece>,
    /// Parts that were made of the text, from the inside outwards.
    origins: Vec<Included>,
}

/// Position of the request for a part whose text has a problem.
#[derive(Clone, Debug)]
struct Included {
    words: String,
    span: Span,
    piece: Option<Piece>,
}

impl Shown {
    fn write(&self, painter: &mut Painter<'_>) {
        let problem = &self.problem;
        painter.sentence(
            if problem.severity == Severity::Error { Mark::Cross } else { Mark::Triangle },
            &problem.message,
        );
        if let Some(piece) = &self.piece {
            let inside = |span: &Span| span.start >= piece.start && span.start <= piece.end;
            let first = (&problem.span, &problem.label);
            let also =
                problem.also.iter().filter(|(span, _)| inside(span)).map(|(span, words)| (span, words));
            painter.excerpt(&piece.excerpt(std::iter::once(first).chain(also)));
        }
        if let Some(help) = &problem.help {
            painter.help(help);
        }
        for origin in &self.origins {
            painter.out.push('\n');
            painter.sentence(Mark::Hand, &origin.words);
            if let Some(piece) = &origin.piece {
                painter.excerpt(&piece.excerpt([(&origin.span, &"here".to_owned())].into_iter()));
            }
        }
    }
}

/// Problems with the names of further parts made of the same text that have it too: a mistake in a text that is included
/// a hundred times is one mistake.
fn once_per_text(problems: Vec<Problem>, sources: &Sources) -> Vec<(Problem, Vec<String>)> {
    let mut known: Vec<(Problem, Vec<String>)> = Vec::new();
    let mut first_of = BTreeMap::new();
    let mut reported = BTreeSet::new();
    for problem in problems {
        let part = sources.piece(problem.span).and_then(|piece| {
            let text = piece.text.as_ptr() as usize;
            piece.origin.as_ref().map(|origin| (text, local(problem.span, piece), &origin.part))
        });
        let Some((text, place, part)) = part else {
            known.push((problem, Vec::new()));
            continue;
        };
        let key = (text, place.start, place.end, problem.label.clone(), problem.help.clone());
        if let Some(&index) = first_of.get(&key) {
            let (_, others): &mut (Problem, Vec<String>) = &mut known[index];
            if reported.insert((index, part.clone())) {
                others.push(part.clone());
            }
        } else {
            first_of.insert(key, known.len());
            known.push((problem, Vec::new()));
        }
    }
    known
}

/// The parts that were made of the text of a problem, from the inside outwards; `also` have the same problem.
fn origins(sources: &Sources, problem: &Problem, also: &[String]) -> Vec<Included> {
    let mut found = Vec::new();
    let mut piece = sources.piece(problem.span);
    // Only a part in a file of its own does not have the names around it.
    let is_name_left_out = problem.label.starts_with("no such")
        && piece.is_some_and(|piece| piece.name != sources.pieces[0].name);
    while let Some(origin) = piece.and_then(|piece| piece.origin.as_ref()) {
        let others = match also {
            others if !found.is_empty() || others.is_empty() => String::new(),
            [other] => format!("; the same in `{other}`"),
            others => {
                format!("; the same in {} more parts, `{}` the last", others.len(), others[others.len() - 1])
            }
        };
        piece = sources.piece(origin.place);
        let remedy = if is_name_left_out && found.is_empty() {
            let name = sources.text(problem.span).trim_matches('"');
            format!("; if it is outside the part, pass it by `names = {{ {name} = \"…\" }}`")
        } else {
            String::new()
        };
        let words = format!("this is in the part `{}`{others}{remedy}", origin.part);
        found.push(Included { words, span: origin.place, piece: piece.cloned() });
    }
    found
}

/// Offsets at which lines of a text start.
fn line_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect()
}

/// The table of a TOML text that `place` is in, such as `joints.hinge`; without the key itself, where that is a number of the table.
fn table_at(text: &str, place: usize) -> Option<String> {
    let is_header = |line: &&str| {
        let inner = line.trim_start_matches('[').split(']').next().unwrap_or_default();
        line.starts_with('[')
            && !inner.is_empty()
            && !inner.contains([',', '{', '='])
            && inner.parse::<f64>().is_err()
    };
    let before = text.get(..place)?;
    let end = text[place..].find('\n').map_or(text.len(), |length| place + length);
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let own = text[start..end].trim();
    let header = text[..end].lines().map(str::trim_start).rfind(is_header);
    let header = header.map(|line| line.trim_start_matches('[').split(']').next().unwrap_or_default().trim());
    let key = own.split_once('=').map_or("", |(key, _)| key.trim());
    let outer = if is_header(&own) { "" } else { key.rsplit_once('.').map_or("", |(outer, _)| outer) };
    match (header, outer) {
        (Some(header), "") => Some(header.to_owned()),
        (Some(header), outer) => Some(format!("{header}.{outer}")),
        (None, "") => Some(key.to_owned()).filter(|key| !key.is_empty()),
        (None, outer) => Some(outer.to_owned()),
    }
}

/// Problems that are shown on a terminal: nobody reads thousands, and the first ones are often the cause of the rest.
const MAX_SHOWN: usize = 50;

/// All that is wrong with a model.
#[derive(Clone, Debug)]
pub struct Report {
    name: String,
    shown: Vec<Shown>,
}

impl Report {
    /// A report of `problems` in the order of the text.
    pub fn new(mut problems: Vec<Problem>, sources: &Sources) -> Self {
        problems.sort_by_key(|problem| (problem.severity == Severity::Warning, problem.span));
        problems.dedup();
        let name = sources.pieces.first().map_or("model", |piece| &piece.name).to_owned();
        let shown = once_per_text(problems, sources).into_iter().map(|(problem, also)| Shown {
            piece: sources.piece(problem.span).cloned(),
            origins: origins(sources, &problem, &also),
            problem,
        });
        Self { name, shown: shown.collect() }
    }

    /// The problems, errors first, each group in the order of the text.
    pub fn problems(&self) -> impl Iterator<Item = &Problem> {
        self.shown.iter().map(|shown| &shown.problem)
    }

    /// Number of problems.
    pub fn len(&self) -> usize {
        self.shown.len()
    }

    /// Whether there is no problem.
    pub fn is_empty(&self) -> bool {
        self.shown.is_empty()
    }

    /// Whether there is an error among the problems.
    pub fn has_errors(&self) -> bool {
        self.problems().any(|problem| problem.severity == Severity::Error)
    }

    /// Every problem for programs: severity, message, help, and where it is known the file with line and column, counted from
    /// one, and the table of the model file, such as `joints.hinge`.
    pub fn to_value(&self) -> serde_json::Value {
        let mut lines = BTreeMap::new();
        let of = |shown: &Shown| {
            let problem = &shown.problem;
            let severity = if problem.severity == Severity::Error { "error" } else { "warning" };
            let mut value =
                serde_json::json!({ "severity": severity, "message": problem.message, "help": problem.help });
            if let Some(piece) = &shown.piece {
                let place = problem.span.start.saturating_sub(piece.start);
                let text = &piece.text;
                // The starts of lines are tabulated: counting lines for each problem would take time proportional to their product.
                let starts = lines.entry((text.as_ptr(), text.len())).or_insert_with(|| line_starts(text));
                let line = starts.partition_point(|start| *start <= place);
                let start = line.checked_sub(1).map_or(0, |line| starts[line]);
                let column = text.get(start..place).unwrap_or_default().chars().count() + 1;
                value["file"] = (*piece.name).into();
                value["line"] = line.into();
                value["column"] = column.into();
                value["part"] = table_at(text, place).into();
            }
            value
        };
        self.shown.iter().map(of).collect()
    }

    /// Every problem with the part that it is about.
    pub fn remarks(&self) -> impl Iterator<Item = Remark> {
        let of = |shown: &Shown| {
            let Shown { problem, piece, .. } = shown;
            let table =
                piece.as_ref().and_then(|piece| table_at(&piece.text, local(problem.span, piece).start));
            let entry = table.as_deref().and_then(|table| table.split_once('.'));
            let outer = piece.as_ref().and_then(|piece| piece.origin.as_ref());
            let outer = outer.map_or_else(String::new, |origin| format!("{}.", origin.part));
            let part = entry.map_or_else(
                || Subject::nameless(""),
                |(kind, name)| Subject::new(singular(kind), outer + name.trim_matches('"')),
            );
            let (message, help) = (problem.message.clone(), problem.help.clone().unwrap_or_default());
            Remark { part, message, help }
        };
        self.shown.iter().map(of)
    }

    /// Problems with file, line, underlined text and remedy, as a text for a terminal: the first fifty, errors
    /// before warnings, and how many more there are.
    pub fn render(&self, colour: bool) -> String {
        let mut text = String::new();
        for shown in self.shown.iter().take(MAX_SHOWN) {
            shown.write(&mut Painter { out: &mut text, colour });
            text.push('\n');
        }
        if let Some(more) = self.shown.len().checked_sub(MAX_SHOWN).filter(|more| *more > 0) {
            text.push_str("  … and ");
            text.push_str(&more.to_string());
            text.push_str(" more\n\n");
        }
        text
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors = self.problems().filter(|problem| problem.severity == Severity::Error).count();
        let warnings = self.len() - errors;
        let plural =
            |count: usize, word: &str| format!("{count} {word}{}", if count == 1 { "" } else { "s" });
        match (errors, warnings) {
            (0, _) => write!(f, "{}: {}", self.name, plural(warnings, "warning")),
            (_, 0) => write!(f, "{}: {}", self.name, plural(errors, "error")),
            _ => write!(f, "{}: {}, {}", self.name, plural(errors, "error"), plural(warnings, "warning")),
        }
    }
}

impl std::error::Error for Report {}

/// Entry of the catalogue for errors of a model file.
pub(crate) const MODEL_FILE: Entry = Entry {
    code: "model-file",
    variant: "Report",
    severity: diagnostics::Severity::Failure,
    message: "{name}: {errors} errors",
    meaning: "The model file has errors: TOML syntax, unknown keys, missing or invalid values, names that do not exist, or parts that \
              are not connected. Nothing was computed.",
    advice: "Correct the underlined positions; each error states a remedy. `lissom check MODEL.toml` reports all errors, \
             `lissom kinds NAME` the keys of a table.",
};

impl Diagnose for Report {
    fn diagnostic(&self) -> Diagnostic {
        let errors = self.problems().filter(|problem| problem.severity == Severity::Error).count();
        let first = self.to_value().get(0).cloned().unwrap_or_default();
        let part = first["part"].as_str().filter(|part| !part.is_empty());
        Diagnostic {
            code: MODEL_FILE.code,
            severity: MODEL_FILE.severity,
            time: None,
            subject: part.map(|part| Subject::new("", part).called(format!("`{part}`"))),
            values: vec![("errors", Value::Count(errors))],
            cause: self.to_string(),
            remedy: first["help"].as_str().unwrap_or_default().to_owned(),
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/text/report.rs"]
mod tests;
