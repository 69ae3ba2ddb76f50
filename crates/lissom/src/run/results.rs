//! Results of a run in memory.

use std::fmt;
use std::ops::{Deref, Index};

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::errors::{StepError, Warning};
use lissom_model::output::{Column, Record};

use crate::run::report::{RunReport, Stopped};

/// Results of a run: the [`Record`] of all columns, the report of the run and its warnings.
///
/// Columns are read by name, such as `results["tip.u3"]`; [`get`](Self::get) returns an error if there is no such column.
#[derive(Debug)]
pub struct Results {
    record: Record,
    report: RunReport,
    warnings: Vec<Warning>,
}

/// A column that was not recorded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum ColumnError {
    /// There is no column of this name.
    Unknown {
        /// The name.
        name: String,
        /// Similar names.
        near: String,
    },
}

/// A run that did not reach its end, with the results so far.
pub struct IncompleteRun {
    results: Results,
}

impl Results {
    /// # Errors
    /// If the run has not reached its end.
    pub(crate) fn of(
        record: Record,
        report: RunReport,
        warnings: Vec<Warning>,
    ) -> Result<Self, IncompleteRun> {
        let results = Self { record, report, warnings };
        if results.report.is_complete() { Ok(results) } else { Err(IncompleteRun { results }) }
    }

    /// The column of this name, such as `tip.u3`; its component may have one of its other names.
    ///
    /// # Errors
    /// If there is none: the error contains similar names.
    pub fn get(&self, name: &str) -> Result<&[f64], ColumnError> {
        let found = Column::named(&self.record.columns, name);
        found.map(|index| self.record.values[index].as_slice()).ok_or_else(|| self.unknown(name))
    }

    /// Times of the records [s].
    pub fn time(&self) -> &[f64] {
        &self.record.times
    }

    /// How the run ended, its counts, durations and energies.
    pub fn report(&self) -> &RunReport {
        &self.report
    }

    /// Warnings of the model and of the run.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The columns.
    pub fn into_record(self) -> Record {
        self.record
    }

    /// The columns and the report.
    pub fn into_parts(self) -> (Record, RunReport) {
        (self.record, self.report)
    }

    fn unknown(&self, name: &str) -> ColumnError {
        let names: Vec<String> = self.record.columns.iter().map(Column::name).collect();
        let near = lissom_model::suggestion(name, names.iter().map(String::as_str));
        let near =
            near.unwrap_or_else(|| "names consist of an output and a component, such as `tip.x`".to_owned());
        ColumnError::Unknown { name: name.to_owned(), near }
    }
}

impl Deref for Results {
    type Target = Record;

    fn deref(&self) -> &Record {
        &self.record
    }
}

impl Index<&str> for Results {
    type Output = [f64];

    /// The column of this name.
    ///
    /// # Panics
    /// If there is none; [`Results::get`] returns an error instead.
    fn index(&self, name: &str) -> &[f64] {
        self.get(name).unwrap_or_else(|error| panic!("{error}"))
    }
}

impl IncompleteRun {
    /// The results so far.
    pub fn results(&self) -> &Results {
        &self.results
    }
}

impl From<IncompleteRun> for Results {
    fn from(run: IncompleteRun) -> Self {
        run.results
    }
}

impl Diagnose for IncompleteRun {
    fn diagnostic(&self) -> Diagnostic {
        match &self.results.report.stopped {
            Stopped::Failed(error) => error.diagnostic(),
            Stopped::Interrupted | Stopped::End => {
                StepError::Interrupted { time: self.results.report.time }.diagnostic()
            }
        }
    }
}

impl fmt::Display for IncompleteRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.diagnostic())
    }
}

/// The message, without the columns.
impl fmt::Debug for IncompleteRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "IncompleteRun({self})")
    }
}

impl std::error::Error for IncompleteRun {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.results.report.error().map(|error| error as _)
    }
}
