//! Sweeps: the members of a sweep file over a model, all in this process or some of them for a cluster.

use std::num::NonZero;
use std::path::PathBuf;

use lissom::Summary;
use lissom::sweep::{
    MemberOutcome, STATISTICS, Sweep, SweepFile, SweepFolder, SweepValue, sampling::SAMPLINGS,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{of_file, of_report, of_sweep, of_sweep_folder};
use crate::model::NativeModel;
use crate::watch::Watch;

/// A sweep file over a model.
#[pyclass(frozen, module = "lissom._lissom")]
pub(crate) struct NativeSweep {
    sweep: Sweep,
}

/// An outcome for Python: member, state, collected values, time, steps, largest violation, diagnosis, histories as a Parquet
/// file.
type Outcome =
    (usize, &'static str, Vec<f64>, Option<f64>, usize, Option<f64>, Option<String>, Option<Vec<u8>>);

fn outcome(of: MemberOutcome) -> PyResult<Outcome> {
    let state = of.state.name();
    let history = of.history.map(|history| history.parquet(of.member)).transpose()?;
    Ok((of.member, state, of.values, of.time, of.steps, of.max_constraint_violation, of.diagnosis, history))
}

#[pymethods]
impl NativeSweep {
    /// A sweep from `text`, a sweep file; `model` replaces the model of that file.
    #[new]
    fn new(py: Python<'_>, model: &NativeModel, text: &str, name: &str) -> PyResult<Self> {
        let file = SweepFile::parse(text, name).map_err(|report| of_report(&report))?;
        let model = &model.model;
        let sweep = py.detach(|| Sweep::new(model, file));
        Ok(Self { sweep: sweep.map_err(|error| of_sweep(&error))? })
    }

    fn __len__(&self) -> usize {
        self.sweep.len()
    }

    /// All that results depend on, as one line of JSON.
    fn definition(&self) -> String {
        self.sweep.definition()
    }

    /// The varied paths.
    fn paths(&self) -> Vec<String> {
        self.sweep.file().vary.iter().map(|varied| varied.path.clone()).collect()
    }
    /// Names of the collected scalars.
    fn collected(&self) -> Vec<String> {
        self.sweep.file().collect.iter().map(|collected| collected.name.clone()).collect()
    }

    /// The varied values of a member, in the order of `paths`: numbers, texts, or TOML.
    fn values(&self, py: Python<'_>, member: usize) -> PyResult<Vec<Py<PyAny>>> {
        self.check(&[member])?;
        let value = |path| match self.sweep.file().value(member, path) {
            SweepValue::Number(number) => Ok(number.into_pyobject(py)?.into_any().unbind()),
            SweepValue::Text(text) | SweepValue::Toml(text) => {
                Ok(text.into_pyobject(py)?.into_any().unbind())
            }
        };
        (0..self.sweep.file().vary.len()).map(value).collect()
    }

    /// Solves some members with the interpreter lock released.
    #[pyo3(signature = (members, workers, progress))]
    fn solve(
        &self,
        py: Python<'_>,
        members: Vec<usize>,
        workers: Option<NonZero<usize>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Vec<Outcome>> {
        self.check(&members)?;
        let mut outcomes = Vec::with_capacity(members.len());
        let mut keep = |outcome: MemberOutcome| {
            outcomes.push(outcome);
            Ok(())
        };
        let count = members.len() as f64;
        py.detach(|| {
            let mut watch = Watch::new(progress.as_ref());
            let ended: Result<_, PyErr> =
                self.sweep.run(&members, workers_or_all(workers), &mut keep, &mut |done| {
                    watch.ask(done as f64, count)
                });
            ended.and_then(|_| watch.finish())
        })?;
        outcomes.sort_by_key(|outcome| outcome.member);
        outcomes.into_iter().map(outcome).collect()
    }

    /// Solves the members that are missing in a folder, and writes the results of `lissom sweep`. Returns all outcomes.
    #[pyo3(signature = (folder, restart, workers, progress))]
    fn solve_in_folder(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        restart: bool,
        workers: Option<NonZero<usize>>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Vec<Outcome>> {
        let outcomes = py.detach(|| {
            let opened = SweepFolder::open(&folder, &self.sweep, restart);
            let (mut folder, mut outcomes) = opened.map_err(|error| of_sweep_folder(&error))?;
            let mut is_there = vec![false; self.sweep.len()];
            for outcome in &outcomes {
                is_there[outcome.member] = true;
            }
            let missing: Vec<usize> = (0..self.sweep.len()).filter(|member| !is_there[*member]).collect();
            let (found, count) = (outcomes.len(), self.sweep.len() as f64);
            let mut keep = |outcome: MemberOutcome| {
                folder.append(&outcome).map_err(|error| of_file(&error))?;
                // Histories are already in their files.
                outcomes.push(MemberOutcome { history: None, ..outcome });
                Ok::<(), PyErr>(())
            };
            let mut watch = Watch::new(progress.as_ref());
            let mut report = |done: usize| watch.ask((found + done) as f64, count);
            let ended = self.sweep.run(&missing, workers_or_all(workers), &mut keep, &mut report)?;
            watch.finish()?;
            outcomes.sort_by_key(|outcome| outcome.member);
            if ended.is_continue() {
                let mut summary = Summary::new();
                // Names and numbers are valid JSON.
                let _ = summary.insert("model", self.sweep.model_name());
                let _ = summary.insert("version", lissom::VERSION);
                let _ = summary.insert("members", outcomes.len());
                folder.finish(&self.sweep, &outcomes, &summary).map_err(|error| of_file(&error))?;
            }
            Ok::<_, PyErr>(outcomes)
        })?;
        outcomes.into_iter().map(outcome).collect()
    }
}

impl NativeSweep {
    fn check(&self, members: &[usize]) -> PyResult<()> {
        match members.iter().find(|member| **member >= self.sweep.len()) {
            None => Ok(()),
            Some(member) => Err(PyValueError::new_err(format!(
                "the sweep has {} members, there is no {member}",
                self.sweep.len()
            ))),
        }
    }
}

fn workers_or_all(workers: Option<NonZero<usize>>) -> NonZero<usize> {
    workers.unwrap_or_else(|| std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN))
}

/// Statistics and samplings: two dictionaries of names and descriptions.
#[pyfunction]
pub(crate) fn statistics(py: Python<'_>) -> PyResult<(Bound<'_, PyDict>, Bound<'_, PyDict>)> {
    let (collected, sampled) = (PyDict::new(py), PyDict::new(py));
    for statistic in &STATISTICS {
        collected.set_item(statistic.name, statistic.summary)?;
    }
    for sampling in &SAMPLINGS {
        sampled.set_item(sampling.name, sampling.summary)?;
    }
    Ok((collected, sampled))
}
