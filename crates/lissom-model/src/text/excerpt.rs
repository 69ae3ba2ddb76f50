//! Excerpts of a text with underlined ranges and labels below, for a terminal. Independent of their meaning.

use std::fmt::Write;
use std::ops::Range;

/// Columns that are written before words go on in the next line.
const WIDTH: usize = 110;
/// Columns of a line of the text above which only those around its labels are written, and columns before the first of them.
const MAX_COLUMNS: usize = 120;
const COLUMNS_BEFORE: usize = 30;
/// Replacement of a tab.
const TAB: &str = "    ";

/// Prefix of a sentence, and the colour of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// An error.
    Cross,
    /// A warning.
    Triangle,
    /// Continuation of the previous sentence.
    Hand,
}

impl Mark {
    fn sign(self) -> char {
        match self {
            Mark::Cross => '×',
            Mark::Triangle => '⚠',
            Mark::Hand => '☞',
        }
    }

    /// Number of the terminal's colour.
    fn colour(self) -> &'static str {
        match self {
            Mark::Cross => "31",
            Mark::Triangle => "33",
            Mark::Hand => "36",
        }
    }
}

/// Underlined text, and words below it, which may be empty.
pub(crate) struct Label<'a> {
    pub(crate) range: Range<usize>,
    pub(crate) words: &'a str,
}

/// Text of a file. The first label is the one whose position is named.
pub(crate) struct Excerpt<'a> {
    pub(crate) name: &'a str,
    pub(crate) text: &'a str,
    pub(crate) labels: Vec<Label<'a>>,
}

/// Writes with colours, or without.
pub(crate) struct Painter<'a> {
    pub(crate) out: &'a mut String,
    pub(crate) colour: bool,
}

/// Where a label is drawn: line, first column and count of columns, all from zero, as they are shown.
#[derive(Clone, Copy)]
struct Underline<'a> {
    line: usize,
    first: usize,
    count: usize,
    words: &'a str,
}

impl Underline<'_> {
    /// Position of the label below.
    fn middle(&self) -> usize {
        self.first + self.count / 2
    }
}

impl Painter<'_> {
    /// Writes a sentence behind its mark.
    pub(crate) fn sentence(&mut self, mark: Mark, words: &str) {
        let sign = self.painted(&mark.sign().to_string(), mark.colour());
        let bar = self.painted("│", mark.colour());
        for (index, line) in wrapped(words, WIDTH - 4).into_iter().enumerate() {
            let front = if index == 0 { &sign } else { &bar };
            self.line(&format!("  {front} {line}"));
        }
    }

    /// Writes a remedy.
    pub(crate) fn help(&mut self, words: &str) {
        let front = self.painted("help: ", "36");
        for (index, line) in wrapped(words, WIDTH - 8).into_iter().enumerate() {
            let front = if index == 0 { front.as_str() } else { "      " };
            self.line(&format!("  {front}{line}"));
        }
    }

    /// Writes the lines around the labels.
    pub(crate) fn excerpt(&mut self, excerpt: &Excerpt<'_>) {
        let lines: Vec<&str> = excerpt.text.split('\n').collect();
        let places: Vec<Underline<'_>> =
            excerpt.labels.iter().map(|label| place(excerpt.text, &lines, label)).collect();
        let (Some(first), Some(label)) = (places.first(), excerpt.labels.first()) else { return };
        let before = excerpt.text.get(..label.range.start).unwrap_or(excerpt.text);
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count();
        // The text of a file ends with a line end, behind which there is no line.
        let last = lines.len() - usize::from(lines.len() > 1 && lines[lines.len() - 1].is_empty());
        let is_shown = |line: usize| places.iter().any(|place| place.line.abs_diff(line) <= 1);
        let shown: Vec<usize> = (0..last).filter(|&line| is_shown(line)).collect();
        let margin = shown.last().map_or(1, |line| (line + 1).to_string().len()) + 2;
        let empty = " ".repeat(margin);
        let name = self.painted(excerpt.name, "36;1;4");
        self.line(&format!("{empty}╭─[{name}:{}:{}]", first.line + 1, column + 1));
        let mut next = None;
        for line in shown {
            if next.is_some_and(|next| next != line) {
                self.line(&format!("{empty}⋮"));
            }
            next = Some(line + 1);
            let number = self.painted(&format!("{:>1$}", line + 1, margin - 1), "2");
            let text = lines[line].trim_end_matches('\r').replace('\t', TAB);
            let mut here: Vec<Underline<'_>> =
                places.iter().filter(|place| place.line == line).copied().collect();
            here.sort_by_key(|place| place.first);
            let text = cut(text, &mut here);
            self.line(&format!("{number} │ {text}"));
            self.underline(&empty, &here.iter().collect::<Vec<_>>());
        }
        self.line(&format!("{empty}╰────"));
    }

    /// Writes lines below the labels of a line, in order, and their words, the last first.
    fn underline(&mut self, margin: &str, places: &[&Underline<'_>]) {
        if places.is_empty() {
            return;
        }
        let mut line = Vec::new();
        for place in places {
            line.resize(line.len().max(place.first + place.count), ' ');
            line[place.first..place.first + place.count].fill('─');
            if !place.words.is_empty() {
                line[place.middle()] = '┬';
            }
        }
        let painted = self.painted(&line.iter().collect::<String>(), "35;1");
        self.line(&format!("{margin}· {painted}"));
        let worded: Vec<&&Underline<'_>> = places.iter().filter(|place| !place.words.is_empty()).collect();
        for (index, place) in worded.iter().enumerate().rev() {
            let mut line = vec![' '; place.middle()];
            for before in &worded[..index] {
                if let Some(sign) = line.get_mut(before.middle()) {
                    *sign = '│';
                }
            }
            let hook = format!("{}╰── {}", line.iter().collect::<String>(), place.words);
            let painted = self.painted(&hook, "35;1");
            self.line(&format!("{margin}· {painted}"));
        }
    }

    fn painted(&self, words: &str, colour: &str) -> String {
        if self.colour { format!("\u{1b}[{colour}m{words}\u{1b}[0m") } else { words.to_owned() }
    }

    fn line(&mut self, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.out, "{}", line.trim_end_matches(' '));
    }
}

/// The part of a long line around its labels, which move with it.
fn cut(text: String, labels: &mut [Underline<'_>]) -> String {
    let count = text.chars().count();
    if count <= MAX_COLUMNS {
        return text;
    }
    let first = labels.first().map_or(0, |label| label.first.saturating_sub(COLUMNS_BEFORE));
    let first = if first <= 1 { 0 } else { first };
    let last = labels.iter().map(|label| label.first + label.count.min(MAX_COLUMNS)).max().unwrap_or(0);
    let end = (first + MAX_COLUMNS).max(last).min(count);
    let (before, after) = (if first > 0 { "…" } else { "" }, if end < count { "…" } else { "" });
    for label in labels {
        label.count = label.count.min(end.saturating_sub(label.first)).max(1);
        // The sign for what is left out takes one column.
        label.first = label.first - first + before.chars().count();
    }
    let shown: String = text.chars().skip(first).take(end - first).collect();
    format!("{before}{shown}{after}")
}

/// Position of a label. A range of several lines is underlined in the first one, an empty range as one character.
fn place<'a>(text: &str, lines: &[&str], label: &Label<'a>) -> Underline<'a> {
    let before = text.get(..label.range.start).unwrap_or(text);
    let line = before.matches('\n').count();
    let within = before.len() - before.rfind('\n').map_or(0, |end| end + 1);
    let whole = lines.get(line).copied().unwrap_or_default().trim_end_matches('\r');
    let columns =
        |part: &str| -> usize { part.chars().map(|sign| if sign == '\t' { TAB.len() } else { 1 }).sum() };
    let end = (within + label.range.len()).min(whole.len());
    let first = whole.get(..within).map_or_else(|| columns(whole), columns);
    let count = whole.get(within..end).map_or(0, columns).max(1);
    Underline { line, first, count, words: label.words }
}

/// Words in lines of at most so many columns; a longer word has a line of its own.
fn wrapped(words: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (index, paragraph) in words.split('\n').enumerate() {
        if index > 0 {
            lines.push(String::new());
        }
        for word in paragraph.split(' ') {
            let line = lines.last_mut().expect("there is a first line");
            if line.is_empty() {
                line.push_str(word);
            } else if line.chars().count() + 1 + word.chars().count() <= width {
                line.push(' ');
                line.push_str(word);
            } else {
                lines.push(word.to_owned());
            }
        }
    }
    lines
}

#[cfg(test)]
#[path = "../../tests/unit/text/excerpt.rs"]
mod tests;
