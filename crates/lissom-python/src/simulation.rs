//! A simulation that Python advances step by step.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use lissom::core::analysis::InputError;
use lissom::core::stepping::SnapshotError;
use lissom::{Document, Session, SessionSnapshot, with_code};
use numpy::PyArray1;
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyFloat};

use crate::analyses::linearize_here;
use crate::errors::{solution, value_error};
use crate::model::NativeModel;
use crate::watch::Watch;

/// A name, or several.
#[derive(FromPyObject)]
enum Names {
    One(String),
    Several(Vec<String>),
}

impl Names {
    fn all(self) -> Vec<String> {
        match self {
            Self::One(name) => vec![name],
            Self::Several(names) => names,
        }
    }
}

/// Inputs and their values.
#[derive(FromPyObject)]
enum Inputs {
    One(String),
    All(HashMap<String, f64>),
    Named(Vec<String>),
}

/// A session and the values of its columns.
struct Inner {
    session: Session,
    values: Vec<f64>,
    are_current: bool,
    /// Number of the session's warnings that Python has received.
    reported: usize,
}

impl Inner {
    /// Of one column. Columns that need nothing but positions are evaluated alone.
    fn value(&mut self, column: usize) -> f64 {
        if self.are_current || self.session.recovers(column) {
            return self.values()[column];
        }
        self.session.column_value(column)
    }

    fn values(&mut self) -> &[f64] {
        if !self.are_current {
            self.values.clear();
            self.session.values(&mut self.values);
            self.are_current = true;
        }
        &self.values
    }

    /// Warnings that Python has not received.
    fn news(&mut self) -> Vec<String> {
        let count = self.session.warnings().count();
        let news = if count > self.reported {
            self.session.warnings().skip(self.reported).map(with_code).collect()
        } else {
            Vec::new()
        };
        self.reported = count;
        news
    }
}

/// Issues these warnings.
fn warn(py: Python<'_>, news: &[String]) -> PyResult<()> {
    if news.is_empty() {
        return Ok(());
    }
    let category = py.import("lissom")?.getattr("ModelWarning")?;
    let warn = py.import("warnings")?.getattr("warn")?;
    news.iter().try_for_each(|words| warn.call1((words, &category)).map(|_| ()))
}

/// A model on its way, made by `Model.simulation()`.
///
/// `sim["arm.angle"]` is the present value of a column, in SI units. The interpreter lock is released while stepping.
#[pyclass(frozen, module = "lissom")]
pub(crate) struct Simulation {
    inner: Mutex<Inner>,
    model: Py<NativeModel>,
    document: Document,
    names: Vec<String>,
    indices: HashMap<String, usize>,
}

impl Simulation {
    pub(crate) fn new(session: Session, document: Document, model: Py<NativeModel>) -> Self {
        let names: Vec<String> = session.columns().iter().map(lissom::Column::name).collect();
        let indices = names.iter().enumerate().map(|(index, name)| (name.clone(), index)).collect();
        let inner = Mutex::new(Inner { session, values: Vec::new(), are_current: false, reported: 0 });
        Self { inner, model, document, names, indices }
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Present value of a column, a signal, an input or a state.
    fn value(&self, inner: &mut Inner, name: &str) -> PyResult<f64> {
        let value = match self.indices.get(name) {
            Some(&column) => Some(inner.value(column)),
            None => inner.session.value(name),
        };
        value.ok_or_else(|| {
            let known = self.names.join(", ");
            PyKeyError::new_err(format!("`{name}` is no column; the columns are {known}"))
        })
    }
}

#[pymethods]
impl Simulation {
    /// Performs one step: the next planned one, or one whose size is limited by its error. On failure the simulation stays
    /// where it was.
    ///
    /// Raises `SolutionError` if the step has no solution, `ValueError` at the end of the model's analysis.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        let news = py.detach(|| {
            let mut inner = self.lock();
            if let Some(event) = inner.session.stopped_by() {
                return Err(PyValueError::new_err(format!(
                    "event `{event}` has ended the simulation: go on by `step_to`"
                )));
            }
            if inner.session.is_finished() {
                let end = inner.session.progress().end;
                return Err(PyValueError::new_err(format!(
                    "the simulation is at its end, t = {end} s: set a later `analysis.end`, or go on by `step_to`"
                )));
            }
            inner.are_current = false;
            inner.session.advance().map_err(|error| solution(&error))?;
            Ok(inner.news())
        })?;
        warn(py, &news)
    }

    /// Advances to `time` [s] exactly, also beyond the end of the model's analysis. Stops before it
    /// at an event that ends the run, which `stopped_by` names.
    /// Raises `SolutionError` if a step has no solution; the simulation then remains at the end of the previous step.
    /// Raises `ValueError` if `time` is before the present time or not finite.
    fn step_to(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        let mut watch = Watch::new(None);
        let outcome = py.detach(|| {
            let mut inner = self.lock();
            let now = inner.session.progress().time;
            // NaN is rejected as well.
            if !(time >= now && time.is_finite()) {
                return Err(PyValueError::new_err(format!(
                    "the simulation is at t = {now} s: it cannot go to {time} s"
                )));
            }
            inner.are_current = false;
            let mut go_on = |_: &lissom::Progress| watch.ask(0.0, 0.0);
            let reached = inner.session.step_to_watched(time, &mut go_on);
            reached.map(|_| ()).map_err(|error| solution(&error))?;
            Ok(inner.news())
        });
        watch.finish()?;
        warn(py, &outcome?)
    }

    /// Warnings so far, as in `summary.json`. Each is also reported by a `ModelWarning` when it occurs.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.lock().session.warnings().map(with_code).collect()
    }

    /// Present time [s].
    #[getter]
    fn time(&self) -> f64 {
        self.lock().session.progress().time
    }

    /// End of the model's analysis [s].
    #[getter]
    fn end(&self) -> f64 {
        self.lock().session.progress().end
    }

    /// Whether that end is reached.
    #[getter]
    fn is_finished(&self) -> bool {
        self.lock().session.is_finished()
    }

    /// Name of the event at which the simulation is, if that is to end the run.
    #[getter]
    fn stopped_by(&self) -> Option<String> {
        self.lock().session.stopped_by().map(str::to_owned)
    }

    /// Names and times [s] of the events that have happened.
    #[getter]
    fn events(&self) -> Vec<(String, f64)> {
        self.lock().session.events().map(|(name, time)| (name.to_owned(), time)).collect()
    }

    /// Names of the columns, in the order of `values`.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// Units of the columns, in the order of `values`.
    #[getter]
    fn units(&self) -> Vec<String> {
        self.lock().session.columns().iter().map(|column| column.unit.clone()).collect()
    }

    /// Present values of all columns: an array of shape (number of columns,), in SI units.
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.lock().values())
    }

    /// Sets inputs of the model from now on, until they are set again: `set("torque", 0.5)`, `set({"torque": 0.5, "brake": 1})`,
    /// or `set(names, values)` with a list of names and a list or array of as many values. Several inputs that are set at once
    /// cost as much as one.
    ///
    /// Raises `ValueError` if the model has no such input or a value is not finite, `SolutionError` if there is no
    /// consistent start with them; then none is set.
    #[pyo3(signature = (inputs, value = None))]
    fn set(&self, py: Python<'_>, inputs: Inputs, value: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let needed = || PyValueError::new_err("an input is set with its value: `set(name, value)`");
        let given: Vec<(String, f64)> = match inputs {
            Inputs::One(name) => vec![(name, value.ok_or_else(needed)?.extract()?)],
            Inputs::All(inputs) if value.is_none() => inputs.into_iter().collect(),
            Inputs::All(_) => return Err(PyValueError::new_err("a dictionary contains the values already")),
            Inputs::Named(names) => {
                let values: Vec<f64> = value.ok_or_else(needed)?.extract()?;
                if values.len() != names.len() {
                    let counts = format!("there are {} inputs and {} values", names.len(), values.len());
                    return Err(PyValueError::new_err(counts));
                }
                names.into_iter().zip(values).collect()
            }
        };
        py.detach(|| {
            let mut inner = self.lock();
            inner.are_current = false;
            let given = given.iter().map(|(name, value)| (&**name, *value));
            inner.session.set_inputs(given).map_err(|error| match error {
                InputError::Unknown { .. } | InputError::NotFinite { .. } => value_error(&error),
                other => solution(&other),
            })
        })
    }

    /// Present value of a column, a signal, an input or a state, in SI units; with a list of names an array of their values.
    fn __getitem__<'py>(&self, py: Python<'py>, names: Names) -> PyResult<Bound<'py, PyAny>> {
        let mut inner = self.lock();
        match names {
            Names::One(name) => Ok(PyFloat::new(py, self.value(&mut inner, &name)?).into_any()),
            Names::Several(names) => {
                let values: PyResult<Vec<f64>> = names.iter().map(|name| self.value(&mut inner, name)).collect();
                Ok(PyArray1::from_vec(py, values?).into_any())
            }
        }
    }

    /// The model linearised at the current state, a `lissom.LinearModel`: as `model.linearize` about this
    /// time. `inputs` name inputs, loads and prescribed motions, `outputs` outputs or columns of them.
    ///
    /// Raises `ModelError` if there is no such input or output, `SolutionError` if the model is at rest without being in
    /// equilibrium.
    #[pyo3(signature = (inputs = Names::Several(Vec::new()), outputs = Names::Several(Vec::new())))]
    fn linearize<'py>(&self, py: Python<'py>, inputs: Names, outputs: Names) -> PyResult<Bound<'py, PyAny>> {
        let (inputs, outputs) = (inputs.all(), outputs.all());
        let model = self.model.get();
        let files =
            py.detach(|| linearize_here(&self.lock().session, model, &self.document, (&inputs, &outputs)))?;
        warn(py, &files.2)?;
        py.import("lissom._linear")?.getattr("LinearModel")?.call_method1("_of", files)
    }

    /// Where the simulation is, as bytes that can be kept, sent and pickled.
    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes = py.detach(|| {
            let mut bytes = self.model.get().fingerprint().to_le_bytes().to_vec();
            bytes.extend(self.lock().session.snapshot().to_bytes());
            bytes
        });
        PyBytes::new(py, &bytes)
    }

    /// Restores the state of a snapshot of the same model; subsequent results are bitwise identical.
    ///
    /// Raises `ValueError` if the bytes are no snapshot of this model and version; the simulation is then as it was.
    fn restore(&self, py: Python<'_>, snapshot: &[u8]) -> PyResult<()> {
        py.detach(|| {
            let refused = |error: SnapshotError| value_error(&error);
            let (of, bytes) = snapshot
                .split_first_chunk()
                .ok_or_else(|| PyValueError::new_err("the bytes are no snapshot: there are too few"))?;
            let read = SessionSnapshot::from_bytes(bytes).map_err(refused)?;
            if u64::from_le_bytes(*of) != self.model.get().fingerprint() {
                return Err(PyValueError::new_err(
                    "the snapshot belongs to another model: its text, or values put into it, are not those of this one; restore it \
                     where it was taken (`step_to` goes beyond the end of an analysis)",
                ));
            }
            let mut inner = self.lock();
            inner.session.restore(&read).map_err(refused)?;
            inner.are_current = false;
            Ok(())
        })
    }

    fn __repr__(&self) -> String {
        let progress = self.lock().session.progress();
        format!("<lissom.Simulation at t = {} of {} s>", progress.time, progress.end)
    }
}
