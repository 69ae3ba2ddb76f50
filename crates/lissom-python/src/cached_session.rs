//! A session, and the present values of its columns.

use std::collections::HashMap;

use lissom::core::errors::Warning;
use lissom::model::suggestion;
use lissom::{Column, JointCoordinateError, Prepared, Session, StartError, with_code};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;

/// Joint values, chosen coordinates and rates with which a session began; none for the start of the model.
pub(crate) type Beginning = Option<(Vec<(String, f64)>, Option<Vec<String>>, Vec<(String, f64)>)>;

/// A session that begins there.
pub(crate) fn begin(prepared: &Prepared, beginning: &Beginning) -> Result<Session, JointCoordinateError> {
    let Some((values, coordinates, rates)) = beginning else {
        return prepared.session().map_err(|error| StartError::from(error).into());
    };
    let chosen = coordinates.as_ref().map(|names| prepared.joint_coordinates(Some(names))).transpose()?;
    prepared.session_at(values, chosen.as_ref(), rates)
}

/// A session and the values of its columns.
pub(crate) struct CachedSession {
    pub(crate) session: Session,
    /// Where it began: what depends on the start of a session, such as tolerances, is not part of its snapshots.
    pub(crate) beginning: Beginning,
    values: Vec<f64>,
    are_current: bool,
    /// Increases with every change.
    revision: u64,
    /// Number of the session's warnings that Python has received.
    reported: usize,
}

impl CachedSession {
    pub(crate) fn new(session: Session, beginning: Beginning) -> Self {
        Self { session, beginning, values: Vec::new(), are_current: false, revision: 0, reported: 0 }
    }

    /// The session, which the caller changes.
    pub(crate) fn change(&mut self) -> &mut Session {
        self.are_current = false;
        self.revision += 1;
        &mut self.session
    }

    /// A number that differs after every change.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    /// Continues with another session of the model. Returns the warnings that the former one did not have.
    pub(crate) fn replace(&mut self, session: Session, beginning: Beginning) -> Vec<String> {
        let known: Vec<String> = self.session.warnings().map(with_code).collect();
        *self = Self { revision: self.revision + 1, ..Self::new(session, beginning) };
        self.news().map(with_code).filter(|warning| !known.contains(warning)).collect()
    }

    /// Value of one column. Columns that need nothing but positions are evaluated alone.
    pub(crate) fn value(&mut self, column: usize) -> f64 {
        if self.are_current || self.session.recovers(column) {
            return self.values()[column];
        }
        self.session.column_value(column)
    }

    /// Values of all columns.
    pub(crate) fn values(&mut self) -> &[f64] {
        if !self.are_current {
            self.values.clear();
            self.session.values(&mut self.values);
            self.are_current = true;
        }
        &self.values
    }

    /// Warnings that Python has not received.
    pub(crate) fn news(&mut self) -> impl Iterator<Item = &Warning> {
        let reported = std::mem::replace(&mut self.reported, self.session.warnings().count());
        self.session.warnings().skip(reported)
    }
}

/// Names of columns, and their indices.
pub(crate) struct ColumnNames {
    pub(crate) all: Vec<String>,
    indices: HashMap<String, usize>,
}

impl ColumnNames {
    pub(crate) fn of(session: &Session) -> Self {
        let all: Vec<String> = session.columns().iter().map(Column::name).collect();
        let indices = all.iter().enumerate().map(|(index, name)| (name.clone(), index)).collect();
        Self { all, indices }
    }

    /// Present value of a column, a signal, an input or a state.
    pub(crate) fn value(&self, of: &mut CachedSession, name: &str) -> Option<f64> {
        match self.indices.get(name) {
            Some(&column) => Some(of.value(column)),
            None => of.session.value(name),
        }
    }

    /// Whether a column needs more than positions.
    pub(crate) fn recovers(&self, session: &Session, name: &str) -> bool {
        self.indices.get(name).is_some_and(|&column| session.recovers(column))
    }

    /// The `KeyError` of a name that is none of them, which suggests a similar one.
    pub(crate) fn unknown(&self, session: &Session, name: &str) -> PyErr {
        let known = self.all.iter().map(String::as_str).chain(session.signal_names());
        let help =
            suggestion(name, known).unwrap_or_else(|| format!("the columns are {}", self.all.join(", ")));
        PyKeyError::new_err(format!("`{name}` is no column, signal, input or state; {help}"))
    }
}
