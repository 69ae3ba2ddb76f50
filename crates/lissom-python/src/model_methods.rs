//! What Python calls of a model.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::path::PathBuf;

use lissom::core::consistent::Redundant;
use lissom::core::consistent::mobility::mobility;
use lissom::start::lower_with_units;
use lissom::{Model, Override, Prepared, Record, Session, Stopped, Summary, summary};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::batch::Batch;
use crate::errors::{self, SolutionError, of_report, of_session, solution};
use crate::model::{NativeModel, threads_or_all};
use crate::results::{Parts, json, parts};
use crate::simulation::Simulation;
use crate::watch::{Watch, interruptible};

#[pymethods]
impl NativeModel {
    /// A model from a text; `name` is its name in messages, `known` has texts of included files, by path.
    #[new]
    #[pyo3(signature = (text, name, overrides, known = BTreeMap::new()))]
    fn new(
        text: &str,
        name: &str,
        overrides: Vec<Override>,
        known: BTreeMap<String, String>,
    ) -> PyResult<Self> {
        Self::checked(Model::from_text(name, text).with_known(known).with_overrides(&overrides))
    }

    /// A model from a file.
    #[staticmethod]
    fn read(path: PathBuf, overrides: Vec<Override>) -> PyResult<Self> {
        let model = Model::read(&path).map_err(|error| errors::of_file(&error))?;
        Self::checked(model.with_overrides(&overrides))
    }

    fn __getnewargs__(&self) -> (&str, &str, Vec<Override>, BTreeMap<String, String>) {
        (self.model.text(), self.model.name(), self.overrides(), self.model.included())
    }

    /// Path or name.
    #[getter]
    fn name(&self) -> &str {
        self.model.name()
    }

    /// Path into the model and TOML value of everything that was put into it.
    #[getter]
    fn overrides(&self) -> Vec<Override> {
        self.model.overrides().to_vec()
    }

    /// The model with further values put into it.
    fn replace(&self, overrides: Vec<Override>) -> PyResult<Self> {
        Self::checked(self.model.with_overrides(&overrides))
    }

    /// The model as TOML, overrides in place; the text as it was written where there are none.
    fn to_toml(&self) -> PyResult<String> {
        if self.model.overrides().is_empty() {
            return Ok(self.model.text().to_owned());
        }
        let text = self.model.model_text().map_err(|report| of_report(&report))?;
        match text.overrides_inside_parts().as_slice() {
            [] => Ok(text.to_toml()),
            [inside, ..] => Err(PyValueError::new_err(format!(
                "`{inside}` was put into a part, which the text of the model cannot express: change the file of the part, \
                 or a parameter of it"
            ))),
        }
    }

    /// Sizes, degrees of freedom, redundant constraints and warnings.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let document = self.document()?;
        let lowered = lower_with_units(&document).map_err(|report| of_report(&report))?;
        let freedom = mobility(&lowered.system, &lowered.state);
        let facts = PyDict::new(py);
        facts.set_item("title", &document.title)?;
        facts.set_item("unknowns", lowered.system.layout().size())?;
        facts.set_item("coordinates", freedom.coordinates)?;
        facts.set_item("constraints", freedom.constraints)?;
        facts.set_item("independent_constraints", freedom.rank)?;
        facts.set_item("freedoms", freedom.freedoms)?;
        let fact = |redundant: &Redundant| {
            let others = match redundant.among.as_slice() {
                [] => "its own other equations".to_owned(),
                names => names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", "),
            };
            format!("{} of joint `{}` follows from {others}", redundant.equation, redundant.joint)
        };
        facts.set_item("redundant", freedom.redundant.iter().map(fact).collect::<Vec<_>>())?;
        let warnings = document.warnings.problems().map(|problem| problem.message.clone());
        facts.set_item("warnings", warnings.collect::<Vec<_>>())?;
        let columns = lissom::columns(&lowered.channels);
        facts.set_item("names", columns.iter().map(lissom::Column::name).collect::<Vec<_>>())?;
        Ok(facts)
    }

    /// Runs to the end with the interpreter lock released: the results, and why it failed, if it did.
    #[pyo3(signature = (progress, threads))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        progress: Option<Py<PyAny>>,
        threads: Option<NonZero<usize>>,
    ) -> PyResult<(Parts<'py>, Option<Bound<'py, PyAny>>)> {
        // Assembly and initial conditions may also take long.
        let model = self.clone();
        let (session, mut summary) = interruptible(py, move || model.start(threads))?;
        let raised = |error: PyErr| error.into_value(py).into_bound(py).into_any();
        let mut session = match session {
            Ok(session) => session,
            Err(failure) => {
                return Ok((parts(py, Record::default(), json(&summary)), Some(raised(failure))));
            }
        };
        let (record, failure) = py.detach(|| solve(&mut session, &mut summary, progress.as_ref()))?;
        Ok((parts(py, record, json(&summary)), failure.map(raised)))
    }

    /// A session at the start of the model.
    fn simulation(slf: Bound<'_, Self>) -> PyResult<Simulation> {
        let model = slf.get().clone();
        let (session, document) = interruptible(slf.py(), move || {
            let document = model.document()?;
            let prepared = Prepared::of(&document).map_err(|error| of_session(&error))?;
            let session = prepared.session().map_err(|error| solution(&error))?;
            Ok((session, (document, prepared)))
        })?;
        Ok(Simulation::new(session, document, slf.unbind()))
    }

    /// A session at a snapshot, as pickled simulations contain it, with the joint coordinates that were chosen.
    fn restored(
        slf: Bound<'_, Self>,
        snapshot: &[u8],
        coordinates: Option<Vec<String>>,
    ) -> PyResult<Simulation> {
        let py = slf.py();
        let simulation = Self::simulation(slf)?;
        simulation.restore(py, snapshot)?;
        if coordinates.is_some() {
            simulation.coordinates(py, coordinates)?;
        }
        Ok(simulation)
    }

    /// So many sessions at the start of the model.
    fn simulations(&self, py: Python<'_>, count: NonZero<usize>) -> PyResult<Batch> {
        let own = self.clone();
        interruptible(py, move || {
            let prepared = own.model.prepare().map_err(|error| of_session(&error))?;
            Batch::new(own, prepared, count.get())
        })
    }
}

impl NativeModel {
    /// A session at its start, or the reason for its absence; and the known contents of the summary.
    fn start(&self, threads: Option<NonZero<usize>>) -> PyResult<(Result<Session, PyErr>, Summary)> {
        let document = self.document()?;
        let mut lowered = lower_with_units(&document).map_err(|report| of_report(&report))?;
        Self::in_time(&document)?;
        lowered.settings.threads = threads_or_all(threads).get();
        let mut summary = summary::of_model(&self.model, &document, &lowered);
        match Session::start(lowered) {
            Ok(session) => Ok((Ok(session), summary)),
            Err(error) => {
                summary::of_failed_start(&mut summary, &error);
                Ok((Err(solution(&error)), summary))
            }
        }
    }
}

/// Runs a session to its end, and returns the reason if it failed.
fn solve(
    session: &mut Session,
    summary: &mut Summary,
    progress: Option<&Py<PyAny>>,
) -> PyResult<(Record, Option<PyErr>)> {
    let mut record = Record::default();
    let mut watch = Watch::new(progress);
    let report = session.run_with(&mut [&mut record], &mut |progress| {
        watch.ask(progress.done as f64, progress.planned as f64)
    });
    watch.finish()?;
    summary::of_run(summary, session, &report);
    let failure = match &report.stopped {
        Stopped::End => None,
        Stopped::Interrupted => Some(SolutionError::new_err("interrupted")),
        Stopped::Failed(error) => Some(solution(error)),
    };
    Ok((record, failure))
}
