//! The exceptions, with the texts of the command line.

use lissom::sweep::{SweepError, SweepFolderError};
use lissom::{FileError, FolderError, Report, SessionError};
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyOSError, PyValueError};
use pyo3::prelude::*;

create_exception!(lissom, LissomError, PyException, "What all exceptions of this package are.");
create_exception!(
    lissom,
    ModelError,
    LissomError,
    "A model or sweep is wrong. The text underlines every mistake where it stands, with a remedy."
);
create_exception!(
    lissom,
    SolutionError,
    LissomError,
    "A model has no solution. The text says at which time and where, and what to try."
);

/// A wrong model.
pub(crate) fn of_report(report: &Report) -> PyErr {
    ModelError::new_err(format!("\n{}{report}", report.render(false)))
}

/// A session that cannot start.
pub(crate) fn of_session(error: &SessionError) -> PyErr {
    match error {
        SessionError::Model(report) => of_report(report),
        SessionError::NotInTime(_) => ModelError::new_err(error.to_string()),
        other => SolutionError::new_err(other.to_string()),
    }
}

/// A file that cannot be used.
pub(crate) fn of_file(error: &FileError) -> PyErr {
    let help = error.help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
    PyOSError::new_err(format!("{error}{help}"))
}

/// Results that cannot be read.
pub(crate) fn of_folder(error: &FolderError) -> PyErr {
    match error {
        FolderError::File(error) => of_file(error),
        other => PyValueError::new_err(other.to_string()),
    }
}

/// A sweep that cannot start.
pub(crate) fn of_sweep(error: &SweepError) -> PyErr {
    match error {
        SweepError::Model(report) => of_report(report),
        other => ModelError::new_err(other.to_string()),
    }
}

/// A folder that cannot take a sweep.
pub(crate) fn of_sweep_folder(error: &SweepFolderError) -> PyErr {
    match error {
        SweepFolderError::File(error) => of_file(error),
        other => PyValueError::new_err(other.to_string()),
    }
}
