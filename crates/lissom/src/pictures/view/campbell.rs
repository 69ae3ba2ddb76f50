//! A Campbell diagram for a page: the table of `lissom campbell`, read back.

use serde::Serialize;
use serde_json::Value;

/// Frequencies over a parameter.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Diagram {
    /// Path of the number that is varied.
    vary: Value,
    unit: Value,
    /// Multiples of the rotation.
    multiples: Value,
    lines: Vec<Line>,
    /// Critical speeds, as in `summary.json`.
    crossings: Value,
}

/// Modes of similar shape.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Line {
    number: usize,
    /// Word for its whirl.
    whirl: String,
    values: Vec<f64>,
    /// Rates of rotation [Hz].
    rotations: Vec<f64>,
    /// Frequencies [Hz], in axes at rest where they exist.
    frequencies: Vec<f64>,
    /// Damping ratios.
    damping: Vec<f64>,
    #[serde(skip)]
    words: Vec<String>,
}

impl Diagram {
    /// A short text about it.
    pub(crate) fn facts(&self) -> String {
        let count = self.lines.iter().map(|line| line.values.len()).max().unwrap_or_default();
        let path = self.vary.as_str().unwrap_or("a parameter");
        format!("{} lines over {count} values of {path}", self.lines.len())
    }
}

/// Reads `campbell.csv`; none if it is invalid.
pub(crate) fn read(table: &str, summary: &Value) -> Option<Diagram> {
    let mut rows = table.lines();
    let heading: Vec<&str> = rows.next()?.split(',').collect();
    let column = |name: &str| heading.iter().position(|known| *known == name);
    let [value, rotation, line, frequency, damping, whirl, at_rest] =
        ["value", "rotation", "line", "frequency", "damping", "whirl", "frequency_at_rest"].map(column);
    let mut lines: Vec<Line> = Vec::new();
    for row in rows {
        let fields: Vec<&str> = row.split(',').collect();
        let number = |column: Option<usize>| fields.get(column?)?.parse::<f64>().ok();
        let index = fields.get(line?)?.parse::<usize>().ok()?.checked_sub(1)?;
        if index > table.len() {
            return None;
        }
        while lines.len() <= index {
            lines.push(Line { number: lines.len() + 1, ..Line::default() });
        }
        let line = &mut lines[index];
        line.values.push(number(value)?);
        line.rotations.push(number(rotation)?);
        let own = number(frequency)?;
        line.frequencies.push(number(at_rest).unwrap_or(own));
        line.damping.push(number(damping)?);
        line.words.push((*fields.get(whirl?)?).to_owned());
    }
    for line in &mut lines {
        let turning = line.words.iter().zip(&line.rotations).filter(|(_, rotation)| **rotation > 0.0);
        line.whirl = common_whirl(turning.map(|(word, _)| word.as_str())).to_owned();
    }
    let of = |name: &str| summary[name].clone();
    let (vary, unit, multiples) = (of("vary"), of("unit"), of("multiples"));
    Some(Diagram { vary, unit, multiples, lines, crossings: of("critical_speeds") })
}

/// The word for the whirl of a line from those of its modes at nonzero speeds: `changes` if they differ.
pub(crate) fn common_whirl<'w>(mut words: impl Iterator<Item = &'w str>) -> &'w str {
    let first = words.next().unwrap_or("none");
    if words.all(|word| word == first) { first } else { "changes" }
}
