//! Lines of a file and the numbers in them.

use crate::error::MeshError;

/// Largest number of a node or element: larger ones are not exact in the programs that write them.
const LARGEST_LABEL: u64 = 1 << 53;

/// Lines of a text without blanks at their ends, with their numbers from 1.
pub(crate) struct Lines<'a> {
    lines: std::str::Lines<'a>,
    /// Number of the line that was read last.
    pub(crate) number: usize,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { lines: text.lines(), number: 0 }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.lines.next()?;
        self.number += 1;
        Some((self.number, line.trim()))
    }
}

/// The beginning of a text, between backticks, for a message.
pub(crate) fn quote(text: &str) -> String {
    const LONGEST: usize = 60;
    let start: String = text.chars().take(LONGEST).collect();
    if start.len() < text.len() { format!("`{start}…`") } else { format!("`{start}`") }
}

/// A finite real number; the exponent may be written with D, as Fortran does.
pub(crate) fn real(line: usize, field: &str) -> Result<f64, MeshError> {
    let parse = |text: &str| text.parse::<f64>().ok();
    let value = parse(field).or_else(|| parse(&field.replace(['d', 'D'], "e"))).filter(|v| v.is_finite());
    value.ok_or_else(|| {
        MeshError::at(line, format!("{} is no finite number", quote(field)), "write a number such as 1.5e-3")
    })
}

/// Number of a node or element.
pub(crate) fn label(line: usize, field: &str) -> Result<u64, MeshError> {
    let value = field.parse().ok().filter(|value| (1..=LARGEST_LABEL).contains(value));
    value.ok_or_else(|| {
        MeshError::at(
            line,
            format!("{} is no number of a node or element", quote(field)),
            "write a whole number above zero",
        )
    })
}

/// A whole number, such as a count.
pub(crate) fn whole<T: std::str::FromStr>(line: usize, field: &str) -> Result<T, MeshError> {
    field.parse().map_err(|_| {
        MeshError::at(
            line,
            format!("{} is no whole number of this place", quote(field)),
            "write the file again",
        )
    })
}

#[cfg(test)]
#[path = "../../tests/unit/formats/fields.rs"]
mod tests;
