//! Formulas over the columns of a record, such as `hypot(tip_x, tip_y)`. Independent of the cases.

use std::collections::BTreeMap;

use lissom::Record;
use lissom_model::expression::Expression;

/// Instants closer than this, relative to the last one, are the same.
const SAME_TIME: f64 = 1e-9;

/// The name of a column in a formula: dots become underscores.
fn word(name: &str) -> String {
    name.replace(|c: char| !c.is_alphanumeric(), "_")
}

/// The record with columns under the names formulas use.
pub(crate) struct Columns<'r> {
    record: &'r Record,
}

impl<'r> Columns<'r> {
    /// Columns of `record`.
    pub(crate) fn new(record: &'r Record) -> Self {
        Self { record }
    }

    /// Instants [s].
    pub(crate) fn times(&self) -> &'r [f64] {
        &self.record.times
    }

    /// The row recorded at `time`.
    pub(crate) fn row_at(&self, time: f64) -> Option<usize> {
        let last = self.record.times.last().copied().unwrap_or(0.0).abs().max(1e-300);
        let after = self.record.times.partition_point(|other| *other < time - SAME_TIME * last);
        (after < self.record.times.len() && (self.record.times[after] - time).abs() <= SAME_TIME * last)
            .then_some(after)
    }

    /// The value of `formula` in a row.
    pub(crate) fn value(&self, formula: &str, row: usize) -> Result<f64, String> {
        // The usual formula is a column.
        if let Some(index) = self.record.columns.iter().position(|column| word(&column.name()) == formula) {
            return Ok(self.record.values[index][row]);
        }
        let named = self.record.columns.iter().zip(&self.record.values);
        let parameters: BTreeMap<String, f64> =
            named.map(|(column, values)| (word(&column.name()), values[row])).collect();
        let expression = Expression::parse(formula, Some("t"), &parameters)
            .map_err(|error| format!("`{formula}`: {}", error.message))?;
        Ok(expression.jet(self.record.times[row]).value)
    }

    /// The values of `formula` in all rows.
    pub(crate) fn values(&self, formula: &str) -> Result<Vec<f64>, String> {
        (0..self.record.times.len()).map(|row| self.value(formula, row)).collect()
    }
}
