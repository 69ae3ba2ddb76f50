//! The exceptions, with the texts of the command line.

use std::fmt::Display;

use lissom::sweep::{SweepError, SweepFolderError};
use lissom::{Diagnose, Diagnostic, FileError, FolderError, Report, SessionError};
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

create_exception!(
    lissom,
    LissomError,
    PyException,
    "What all exceptions of this package are.\n\nThe text is that of the command line; `time` [s], `part` and `remedy` are parts of it, or None."
);
create_exception!(
    lissom,
    ModelError,
    LissomError,
    "A model or sweep is wrong. The text underlines every mistake, with a remedy.\n\n`problems` has them as \
     `lissom check --json` does: dictionaries of `severity`, `message`, `help` and, where it is known, `part`, `file`, `line`, \
     `column`. `part` and `remedy` are those of the first."
);
create_exception!(
    lissom,
    SolutionError,
    LissomError,
    "A model has no solution. The text says at which time and where, and what to try.\n\n`result` holds what was computed before a \
     run failed, a `lissom.Result`; None otherwise."
);

/// Attributes of every exception, with their defaults, so that they always exist.
pub(crate) fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    let all = [
        ("LissomError", py.get_type::<LissomError>()),
        ("ModelError", py.get_type::<ModelError>()),
        ("SolutionError", py.get_type::<SolutionError>()),
    ];
    for (name, class) in all {
        for attribute in ["time", "part", "remedy"] {
            class.setattr(attribute, py.None())?;
        }
        module.add(name, class)?;
    }
    py.get_type::<ModelError>().setattr("problems", PyTuple::empty(py))?;
    py.get_type::<SolutionError>().setattr("result", py.None())
}

/// Adds time, part and remedy as attributes.
fn with(error: PyErr, diagnostic: &Diagnostic) -> PyErr {
    let result = Python::attach(|py| {
        let value = error.value(py);
        value.setattr("time", diagnostic.time)?;
        value.setattr("part", diagnostic.part())?;
        value.setattr("remedy", diagnostic.remedy())
    });
    result.err().unwrap_or(error)
}

/// A request that is invalid for a model.
pub(crate) fn question(words: impl Into<String>) -> PyErr {
    let words = words.into();
    with(ModelError::new_err(words.clone()), &Diagnostic::uncatalogued(&words))
}

/// A model without a solution.
pub(crate) fn solution(error: &(impl Diagnose + Display)) -> PyErr {
    with(SolutionError::new_err(error.to_string()), &error.diagnostic())
}

/// An invalid request, or a model without a solution.
pub(crate) fn refused(is_of_question: bool, error: &(impl Diagnose + Display)) -> PyErr {
    if is_of_question { question(error.to_string()) } else { solution(error) }
}

/// An invalid model. Its problems are those of `lissom check --json`.
pub(crate) fn of_report(report: &Report) -> PyErr {
    let error = ModelError::new_err(format!("\n{}{report}", report.render(false)));
    let problems = report.to_value();
    let result = Python::attach(|py| {
        let value = error.value(py);
        let read = py.import("json")?.getattr("loads")?.call1((problems.to_string(),))?;
        value.setattr("problems", PyTuple::new(py, read.try_iter()?.collect::<PyResult<Vec<_>>>()?)?)?;
        value.setattr("part", problems[0]["part"].as_str())?;
        value.setattr("remedy", problems[0]["help"].as_str())
    });
    result.err().unwrap_or(error)
}

/// A session that cannot start.
pub(crate) fn of_session(error: &SessionError) -> PyErr {
    match error {
        SessionError::Model(report) => of_report(report),
        SessionError::NotInTime(_) => question(error.to_string()),
        other => solution(other),
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
        other => question(other.to_string()),
    }
}

/// A folder that cannot be used for a sweep.
pub(crate) fn of_sweep_folder(error: &SweepFolderError) -> PyErr {
    match error {
        SweepFolderError::File(error) => of_file(error),
        other => PyValueError::new_err(other.to_string()),
    }
}
