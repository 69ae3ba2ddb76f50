//! Results in memory, by columns; written to by a run, or read back from comma-separated values.

use lissom_mechanics::diagnostics::Diagnose;
use std::io;

use super::{Column, Writer, check_count};

/// Results in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Content of each column.
    pub columns: Vec<Column>,
    /// Times [s].
    pub times: Vec<f64>,
    /// Values, one list per column, as long as the times.
    pub values: Vec<Vec<f64>>,
}

/// A text that is no table of results.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
pub enum RecordError {
    /// There is no heading.
    NoHeading,
    /// A line has too many or too few numbers, or something that is none.
    BadLine(usize),
}

impl Record {
    /// The column of `output` and `component`, which may also have one of its other names.
    pub fn column(&self, output: &str, component: &str) -> Option<&[f64]> {
        Column::of(&self.columns, output, component).map(|index| self.values[index].as_slice())
    }

    /// Reads the text of a [`CsvWriter`](super::CsvWriter). Quantities and units are not in the text:
    /// quantities are taken as the outputs' names.
    ///
    /// # Errors
    /// If the text is something else. A last line without end, as of an interrupted run, is omitted.
    pub fn from_csv(text: &str) -> Result<Self, RecordError> {
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        let mut lines = whole.lines();
        let heading = lines.next().map(fields).filter(|fields| fields[0] == "time");
        let columns: Vec<Column> =
            heading.ok_or(RecordError::NoHeading)?.iter().skip(1).map(|heading| column(heading)).collect();
        let mut record = Self { values: vec![Vec::new(); columns.len()], columns, times: Vec::new() };
        for (index, line) in lines.enumerate() {
            let bad = || RecordError::BadLine(index + 2);
            let numbers: Result<Vec<f64>, _> = line.split(',').map(str::parse).collect();
            let numbers = numbers.map_err(|_| bad())?;
            let [time, values @ ..] = numbers.as_slice() else { return Err(bad()) };
            if values.len() != record.columns.len() {
                return Err(bad());
            }
            record.push(*time, values);
        }
        Ok(record)
    }

    fn push(&mut self, time: f64, values: &[f64]) {
        self.times.push(time);
        for (column, value) in self.values.iter_mut().zip(values) {
            column.push(*value);
        }
    }
}

/// Splits at commas outside of quotes.
fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut inside = false;
    let mut last = ' ';
    for c in line.chars() {
        let open = fields.len() - 1;
        match c {
            // A doubled quote inside of quotes represents itself.
            '"' if !inside && last == '"' => {
                fields[open].push('"');
                inside = true;
            }
            '"' => inside = !inside,
            ',' if !inside => fields.push(String::new()),
            _ => fields[open].push(c),
        }
        last = c;
    }
    fields
}

/// From a heading back to a column.
fn column(heading: &str) -> Column {
    let (output, component) = heading.rsplit_once('.').unwrap_or((heading, ""));
    Column::new(output, component, output, "")
}

impl Writer for Record {
    fn begin(&mut self, columns: &[Column]) -> io::Result<()> {
        *self =
            Self { columns: columns.to_vec(), times: Vec::new(), values: vec![Vec::new(); columns.len()] };
        Ok(())
    }

    fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        check_count(values, &self.columns)?;
        self.push(time, values);
        Ok(())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/record.rs"]
mod tests;
