//! The exceptions, with the texts of the command line.

use std::fmt::Display;

use lissom::analyses::{AnalysisError, Origin};
use lissom::core::diagnostics::Value;
use lissom::core::simulation::InputError;
use lissom::sweep::{SweepError, SweepFolderError};
use lissom::{CommandError, Diagnose, Diagnostic, FileError, FolderError, Report, SessionError};
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMappingProxy, PyTuple};

create_exception!(
    lissom,
    LissomError,
    PyException,
    "Base class of the exceptions of this package.\n\nThe text is that of the command line. `code` identifies the failure, as in \
     `lissom explain`; `values` has its numbers and names, in SI units. `time` [s], `part` and `remedy` are parts of the text. They \
     are None if absent."
);
create_exception!(
    lissom,
    ModelError,
    LissomError,
    "A model, a sweep or a request is invalid. The text underlines every error, with a remedy.\n\n`problems` has them as \
     `lissom check --json` does: dictionaries of `severity`, `message`, `help` and, if known, `part`, `file`, `line`, `column`. \
     `part` and `remedy` are those of the first."
);
create_exception!(
    lissom,
    SolutionError,
    LissomError,
    "A model has no solution. The text states the time, the part, the cause and a remedy.\n\n`result` is the `lissom.Result` of a run \
     up to its failure; None otherwise."
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
        for attribute in ["code", "time", "part", "remedy"] {
            class.setattr(attribute, py.None())?;
        }
        class.setattr("values", PyMappingProxy::new(py, PyDict::new(py).as_mapping()))?;
        module.add(name, class)?;
    }
    py.get_type::<ModelError>().setattr("problems", PyTuple::empty(py))?;
    py.get_type::<SolutionError>().setattr("result", py.None())
}

/// Values of a diagnostic by name.
fn values<'py>(py: Python<'py>, diagnostic: &Diagnostic) -> PyResult<Bound<'py, PyDict>> {
    let values = PyDict::new(py);
    for (name, value) in &diagnostic.values {
        match value {
            Value::Number(number) => values.set_item(name, number)?,
            Value::Count(count) => values.set_item(name, count)?,
            Value::Flag(flag) => values.set_item(name, flag)?,
            Value::Text(text) => values.set_item(name, text)?,
        }
    }
    Ok(values)
}

/// Adds code, values, time, part and remedy as attributes.
fn with(error: PyErr, diagnostic: &Diagnostic) -> PyErr {
    let result = Python::attach(|py| {
        let value = error.value(py);
        value.setattr("code", diagnostic.code)?;
        value.setattr("values", values(py, diagnostic)?)?;
        value.setattr("time", diagnostic.time)?;
        value.setattr("part", diagnostic.part())?;
        value.setattr("remedy", diagnostic.remedy())
    });
    result.err().unwrap_or(error)
}

/// An argument that cannot be read.
pub(crate) fn question(words: impl Into<String>) -> PyErr {
    request(&CommandError::Request(words.into()))
}

/// An argument with an invalid value.
pub(crate) fn value_error(error: &(impl Diagnose + Display)) -> PyErr {
    with(PyValueError::new_err(error.to_string()), &error.diagnostic())
}

/// A request that is invalid for a model.
fn request(error: &(impl Diagnose + Display + ?Sized)) -> PyErr {
    with(ModelError::new_err(error.to_string()), &error.diagnostic())
}

/// A model without a solution.
pub(crate) fn solution(error: &(impl Diagnose + Display + ?Sized)) -> PyErr {
    with(SolutionError::new_err(error.to_string()), &error.diagnostic())
}

/// An input that cannot be set.
pub(crate) fn of_input(error: &InputError) -> PyErr {
    match error {
        InputError::Unknown { .. } | InputError::NotFinite { .. } => value_error(error),
        other => solution(other),
    }
}

/// The exception of a failure that was stored.
pub(crate) fn of_failure((text, diagnostic): &(String, Diagnostic)) -> PyErr {
    with(SolutionError::new_err(text.clone()), diagnostic)
}

/// An invalid request, or a model without a solution.
pub(crate) fn refused(is_of_question: bool, error: &(impl Diagnose + Display)) -> PyErr {
    if is_of_question { request(error) } else { solution(error) }
}

/// An invalid model. Its problems are those of `lissom check --json`.
pub(crate) fn of_report(report: &Report) -> PyErr {
    let error = ModelError::new_err(format!("\n{}{report}", report.render(false)));
    let problems = report.to_value();
    let result = Python::attach(|py| {
        let value = error.value(py);
        let read = py.import("json")?.getattr("loads")?.call1((problems.to_string(),))?;
        value.setattr("problems", PyTuple::new(py, read.try_iter()?.collect::<PyResult<Vec<_>>>()?)?)
    });
    result.err().unwrap_or_else(|| with(error, &report.diagnostic()))
}

/// An analysis without a result.
pub(crate) fn of_analysis(error: &dyn AnalysisError) -> PyErr {
    match error.origin() {
        Origin::Model(report) => of_report(report),
        Origin::Request => request(error),
        Origin::Computation => solution(error),
    }
}

/// A session that cannot start.
pub(crate) fn of_session(error: &SessionError) -> PyErr {
    match error {
        SessionError::Model(report) => of_report(report),
        SessionError::NotInTime(_) => request(error),
        other => solution(other),
    }
}

/// A file that cannot be used.
pub(crate) fn of_file(error: &FileError) -> PyErr {
    with(PyOSError::new_err(error.to_string()), &error.diagnostic())
}

/// Results that cannot be read.
pub(crate) fn of_folder(error: &FolderError) -> PyErr {
    match error {
        FolderError::File(error) => of_file(error),
        other => value_error(other),
    }
}

/// A sweep that cannot start.
pub(crate) fn of_sweep(error: &SweepError) -> PyErr {
    match error {
        SweepError::Model(report) => of_report(report),
        other => request(other),
    }
}

/// A folder that cannot be used for a sweep.
pub(crate) fn of_sweep_folder(error: &SweepFolderError) -> PyErr {
    match error {
        SweepFolderError::File(error) => of_file(error),
        other => value_error(other),
    }
}
