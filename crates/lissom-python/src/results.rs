//! Results for Python: arrays by name, created without a copy, and the summary as JSON.

use std::path::PathBuf;

use lissom::{Record, ResultFolder, Summary};
use lissom_model::files;
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::errors;

/// Times, then names, units and values of all columns, then the summary as JSON.
pub(crate) type Parts<'py> =
    (Bound<'py, PyArray1<f64>>, Vec<String>, Vec<String>, Vec<Bound<'py, PyArray1<f64>>>, String);

/// Converts the numbers.
pub(crate) fn parts(py: Python<'_>, record: Record, summary: String) -> Parts<'_> {
    let Record { columns, times, values } = record;
    let names = columns.iter().map(lissom::Column::name).collect();
    let units = columns.into_iter().map(|column| column.unit).collect();
    let arrays = values.into_iter().map(|column| PyArray1::from_vec(py, column)).collect();
    (PyArray1::from_vec(py, times), names, units, arrays, summary)
}

/// Position of the column that is called `name`, which may be one of its other names.
#[pyfunction]
pub(crate) fn column_position(names: Vec<String>, name: &str) -> Option<usize> {
    let column = |full: &String| {
        let (output, component) = full.rsplit_once('.').unwrap_or((full, ""));
        lissom::Column::new(output, component, "", "")
    };
    lissom::Column::named(&names.iter().map(column).collect::<Vec<_>>(), name)
}

/// The summary as JSON, with numbers to the last bit.
pub(crate) fn json(summary: &Summary) -> String {
    summary.to_json()
}

/// Results of a run in a folder; the summary is empty if there is none, such as after a crash.
#[pyfunction]
pub(crate) fn read_folder(py: Python<'_>, folder: PathBuf) -> PyResult<Parts<'_>> {
    let read = || {
        let (_, record, _) = ResultFolder::open(&folder).map_err(|error| errors::of_folder(&error))?;
        let summary = folder.join("summary.json");
        let text = if summary.is_file() {
            files::read_text(&summary).map_err(|error| errors::of_file(&error))?
        } else {
            "{}".to_owned()
        };
        Ok::<_, PyErr>((record, text))
    };
    let (record, text) = py.detach(read)?;
    Ok(parts(py, record, text))
}
