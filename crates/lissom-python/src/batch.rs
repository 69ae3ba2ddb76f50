//! Several simulations of one model, which Python advances together on all processors.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lissom::core::errors::StepError;
use lissom::core::interrupt;
use lissom::core::simulation::InputError;
use lissom::core::solvers::in_parallel;
use lissom::{Diagnose, Diagnostic, Prepared, Session, SessionSnapshot, with_code};
use numpy::ndarray::ArrayViewD;
use numpy::{
    AllowTypeChange, PyArray1, PyArray3, PyArrayLike1, PyArrayLikeDyn, PyArrayMethods, PyReadonlyArray1,
};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use rayon::prelude::*;

use crate::cached_session::{CachedSession, ColumnNames, begin};
use crate::errors::{of_failure, solution, value_error};
use crate::joints::{JointValues, Joints};
use crate::model::NativeModel;
use crate::pictures::{array, framing};
use crate::simulation::{Names, warn};
use crate::watch::{EVERY, asked};

/// Numbers as an array of any shape, or as one number.
type Numbers<'py> = PyArrayLikeDyn<'py, f64, AllowTypeChange>;

/// Inputs and their values.
#[derive(FromPyObject)]
pub(crate) enum BatchInputs<'py> {
    One(String),
    All(BTreeMap<String, Numbers<'py>>),
    Named(Vec<String>),
    Every(Numbers<'py>),
}

/// One of the simulations.
struct Member {
    cached: CachedSession,
    /// Why it cannot continue.
    failure: Option<(String, Diagnostic)>,
}

impl Member {
    fn fail(&mut self, error: &(impl Diagnose + Display)) {
        self.failure = Some((error.to_string(), error.diagnostic()));
    }

    /// Records the result of a step.
    fn stepped(&mut self, outcome: Result<(), StepError>) {
        match outcome {
            Ok(()) | Err(StepError::Interrupted { .. }) => {}
            Err(error) => self.fail(&error),
        }
    }

    fn time(&self) -> f64 {
        self.cached.session.progress().time
    }
}

/// Simulations of one model that advance together, made by `Model.simulations(count)`.
///
/// All processors work on them, with the interpreter lock released. A simulation without a solution stays where it was, with NaN
/// as its values, until it is reset; the others continue. `failed` and `errors` report it, and a `SolutionWarning` is issued.
#[pyclass(frozen, module = "lissom")]
pub(crate) struct Batch {
    members: Mutex<Vec<Member>>,
    count: usize,
    model: NativeModel,
    prepared: Prepared,
    start: SessionSnapshot,
    names: ColumnNames,
    joints: Mutex<Joints>,
    /// Codes of warnings that Python has received.
    reported: Mutex<BTreeSet<&'static str>>,
}

impl Batch {
    pub(crate) fn new(model: NativeModel, prepared: Prepared, count: usize) -> PyResult<Self> {
        let session = || prepared.session().map_err(|error| solution(&error));
        let first = session()?;
        let start = first.snapshot();
        let names = ColumnNames::of(&first);
        let mut others: Vec<Option<PyResult<Session>>> = (1..count).map(|_| None).collect();
        in_parallel(|scope| {
            scope.spawn(|_| others.par_iter_mut().for_each(|other| *other = Some(session())));
        });
        let sessions: Vec<Session> =
            std::iter::once(Ok(first)).chain(others.into_iter().flatten()).collect::<PyResult<_>>()?;
        let member = |session| Member { cached: CachedSession::new(session, None), failure: None };
        let members = Mutex::new(sessions.into_iter().map(member).collect());
        Ok(Self {
            members,
            count,
            model,
            prepared,
            start,
            names,
            joints: Mutex::default(),
            reported: Mutex::default(),
        })
    }

    fn lock_joints(&self, py: Python<'_>) -> MutexGuard<'_, Joints> {
        self.joints.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }

    fn lock(&self, py: Python<'_>) -> MutexGuard<'_, Vec<Member>> {
        self.members.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }

    /// Steps the members that have not failed, and issues warnings afterwards.
    fn advance(
        &self,
        py: Python<'_>,
        members: &mut [Member],
        advance: impl Fn(usize, &mut Session) -> Result<(), StepError> + Sync,
    ) -> PyResult<()> {
        self.active(py, members, |index, member| {
            let outcome = advance(index, member.cached.change());
            member.stepped(outcome);
        })
    }

    /// Does `work` for the members that have not failed, and issues warnings afterwards.
    fn active(
        &self,
        py: Python<'_>,
        members: &mut [Member],
        work: impl Fn(usize, &mut Member) + Sync,
    ) -> PyResult<()> {
        let had_failed: Vec<bool> = members.iter().map(|member| member.failure.is_some()).collect();
        each(py, members, |index, member| {
            if member.failure.is_none() {
                work(index, member);
            }
        })?;
        let mut failed = members
            .iter()
            .enumerate()
            .filter(|(index, member)| !had_failed[*index] && member.failure.is_some());
        let failure = failed.next().and_then(|(index, member)| {
            let (text, _) = member.failure.as_ref()?;
            let others = failed.count();
            let more = if others > 0 {
                format!(" ({others} more have failed, see `errors`)")
            } else {
                String::new()
            };
            Some(format!("simulation {index}: {text}{more}"))
        });
        let mut news = Vec::new();
        let mut reported = self.reported.lock().unwrap_or_else(PoisonError::into_inner);
        for (index, member) in members.iter_mut().enumerate() {
            for warning in member.cached.news().filter(|warning| reported.insert(warning.diagnostic().code)) {
                news.push(format!("simulation {index}: {}", with_code(warning)));
            }
        }
        drop(reported);
        warn(py, "SolutionWarning", failure.as_slice())?;
        warn(py, "ModelWarning", &news)
    }

    /// `given` for each member, and each of so many columns.
    fn broadcast<'a>(&self, given: &'a ArrayViewD<'a, f64>, columns: Option<usize>) -> PyResult<Vec<f64>> {
        let shape: Vec<usize> = std::iter::once(self.count).chain(columns).collect();
        let all = given.broadcast(shape.clone()).ok_or_else(|| {
            let given = given.shape();
            PyValueError::new_err(format!(
                "the values have the shape {given:?}, which does not fit {shape:?}"
            ))
        })?;
        Ok(all.iter().copied().collect())
    }

    /// Indices of `members`, all by default.
    fn chosen(&self, members: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<usize>> {
        let Some(members) = members else { return Ok((0..self.count).collect()) };
        let members = members.py().import("numpy")?.call_method1("asarray", (members,))?;
        if let Ok(mask) = members.extract::<PyReadonlyArray1<'_, bool>>() {
            let mask = mask.as_array();
            if mask.len() == self.count {
                return Ok((0..self.count).filter(|&index| mask[index]).collect());
            }
            let counts =
                format!("the mask has {} entries, but there are {} simulations", mask.len(), self.count);
            return Err(PyValueError::new_err(counts));
        }
        let known = |&index: &i64| {
            let own = usize::try_from(index).ok().filter(|index| *index < self.count);
            own.ok_or_else(|| self.no_member(index))
        };
        members.extract::<PyArrayLike1<'_, i64, AllowTypeChange>>()?.as_array().iter().map(known).collect()
    }

    fn no_member(&self, index: impl Display) -> PyErr {
        PyIndexError::new_err(format!(
            "there is no simulation {index}: they are numbered from 0 to {}",
            self.count - 1
        ))
    }
}

/// Does `work` for every member on all processors. Ctrl-C cancels it.
fn each(py: Python<'_>, members: &mut [Member], work: impl Fn(usize, &mut Member) + Sync) -> PyResult<()> {
    let cancelled = Arc::new(AtomicBool::new(false));
    py.detach(|| {
        let (running, ended) = mpsc::channel::<()>();
        let work = &work;
        in_parallel(|scope| {
            let asked_of_work = &cancelled;
            scope.spawn(move |_| {
                let _running = running;
                members.par_iter_mut().enumerate().for_each(|(index, member)| {
                    interrupt::within(Arc::clone(asked_of_work), || work(index, member));
                });
            });
            // Only the thread that was called can receive Ctrl-C.
            while ended.recv_timeout(EVERY) == Err(RecvTimeoutError::Timeout) {
                asked().inspect_err(|_| cancelled.store(true, Ordering::Relaxed))?;
            }
            Ok(())
        })
    })
}

#[pymethods]
impl Batch {
    fn __len__(&self) -> usize {
        self.count
    }

    /// Sets inputs of all simulations from now on, until they are set again: `set(array)` with an array of shape (count, number of
    /// inputs), in the order of `inputs`; `set(names, array)` with some of them; `set("torque", values)` and `set({"torque": values})`
    /// with one value per simulation. Arrays of fewer dimensions, and single numbers, are the same for all.
    ///
    /// Raises `ValueError` if the model has no such input, a shape does not fit or a value is not finite; then none is set.
    #[pyo3(signature = (inputs, values = None))]
    fn set(&self, py: Python<'_>, inputs: BatchInputs<'_>, values: Option<Numbers<'_>>) -> PyResult<()> {
        let needed = || PyValueError::new_err("inputs are set with their values: `set(names, values)`");
        if values.is_some() && matches!(inputs, BatchInputs::All(_) | BatchInputs::Every(_)) {
            return Err(PyValueError::new_err("the values are given already: specify them once"));
        }
        let (names, values) = match inputs {
            BatchInputs::One(name) => {
                (vec![name], self.broadcast(&values.ok_or_else(needed)?.as_array().view(), None)?)
            }
            BatchInputs::All(inputs) => {
                let mut rows = vec![0.0; self.count * inputs.len()];
                for (column, values) in inputs.values().enumerate() {
                    let values = self.broadcast(&values.as_array().view(), None)?;
                    rows.iter_mut()
                        .skip(column)
                        .step_by(inputs.len())
                        .zip(values)
                        .for_each(|(own, value)| *own = value);
                }
                (inputs.into_keys().collect(), rows)
            }
            BatchInputs::Named(names) => {
                let values =
                    self.broadcast(&values.ok_or_else(needed)?.as_array().view(), Some(names.len()))?;
                (names, values)
            }
            BatchInputs::Every(values) => {
                let names = self.prepared.inputs().to_vec();
                let values = self.broadcast(&values.as_array().view(), Some(names.len()))?;
                (names, values)
            }
        };
        let known = self.prepared.inputs();
        if let Some(name) = names.iter().find(|name| !known.contains(name)) {
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            return Err(value_error(&InputError::Unknown { name: name.clone(), known }));
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            let (name, value) = (names[index % names.len()].clone(), values[index]);
            return Err(value_error(&InputError::NotFinite { name, value }));
        }
        self.active(py, &mut self.lock(py), |index, member| {
            let own = &values[index * names.len()..][..names.len()];
            let given = names.iter().map(String::as_str).zip(own.iter().copied());
            if let Err(error) = member.cached.change().set_inputs(given) {
                member.fail(&error);
            }
        })
    }

    /// Performs one step of every simulation: the next planned one, or one whose size is limited by its error.
    ///
    /// Raises `ValueError` if a simulation is at the end of the model's analysis or at an event that ends the run; then none is
    /// advanced.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        let mut members = self.lock(py);
        let is_at_end = |member: &Member| member.failure.is_none() && member.cached.session.is_finished();
        if let Some(index) = members.iter().position(is_at_end) {
            let time = members[index].time();
            return Err(PyValueError::new_err(format!(
                "simulation {index} has ended at t = {time} s: reset it, or go on by `step_to`"
            )));
        }
        self.advance(py, &mut members, |_, session| session.advance().map(|_| ()))
    }

    /// Advances all simulations to `time` [s] exactly, one time for all or one for each: `step_to(batch.time + 0.01)`. A simulation
    /// stops before it at an event that ends its run, which `stopped_by` names.
    ///
    /// Raises `ValueError` if a time is before the present time of its simulation or not finite; then none is advanced.
    fn step_to(&self, py: Python<'_>, time: Numbers<'_>) -> PyResult<()> {
        let times = self.broadcast(&time.as_array().view(), None)?;
        let mut members = self.lock(py);
        for (index, (member, time)) in members.iter().zip(&times).enumerate() {
            let now = member.time();
            // NaN is rejected as well.
            if member.failure.is_none() && !(*time >= now && time.is_finite()) {
                return Err(PyValueError::new_err(format!(
                    "simulation {index} is at t = {now} s: it cannot go to {time} s"
                )));
            }
        }
        self.advance(py, &mut members, |index, session| session.step_to(times[index]))
    }

    /// Names of the independent joint coordinates, in the order of the model file; with `names` these are chosen, as
    /// `Simulation.coordinates` does.
    #[pyo3(signature = (names = None))]
    fn coordinates(&self, py: Python<'_>, names: Option<Vec<String>>) -> PyResult<Vec<String>> {
        Ok(self.lock_joints(py).choose(&self.prepared, names.as_deref())?.names().to_vec())
    }

    /// Starts simulations again, with the inputs of the model: all, or those that a mask or a list of indices selects. This is also
    /// how a simulation without a solution continues. With values `q` of joint coordinates and rates `v`, arrays of shape (number of
    /// selected simulations, number of `coordinates()`) or dictionaries of arrays, as `Simulation.reset` does; arrays of fewer
    /// dimensions, and single numbers, are the same for all.
    ///
    /// Raises `ValueError` if a name is unknown or a shape does not fit.
    #[pyo3(signature = (members = None, q = None, v = None))]
    fn reset(
        &self,
        py: Python<'_>,
        members: Option<&Bound<'_, PyAny>>,
        q: Option<JointValues<'_>>,
        v: Option<JointValues<'_>>,
    ) -> PyResult<()> {
        let chosen = self.chosen(members)?;
        let is_model = q.is_none() && v.is_none();
        let mut joints = self.lock_joints(py);
        let values = joints.rows(&self.prepared, (q, false), Some(chosen.len()))?;
        let rates = joints.rows(&self.prepared, (v, true), Some(chosen.len()))?;
        let coordinates = if is_model { None } else { joints.with_rates(&self.prepared, &rates)? };
        drop(joints);
        let mut rows = vec![None; self.count];
        chosen.iter().enumerate().for_each(|(row, &index)| rows[index] = Some(row));
        let mut members = self.lock(py);
        for &index in &chosen {
            members[index].failure = None;
        }
        self.active(py, &mut members, |index, member| {
            let Some(row) = rows[index] else { return };
            if is_model && member.cached.beginning.is_none() {
                if let Err(error) = member.cached.change().restore(&self.start) {
                    member.fail(&error);
                }
                return;
            }
            let beginning = (!is_model).then(|| (values.row(row), coordinates.clone(), rates.row(row)));
            match begin(&self.prepared, &beginning) {
                Ok(session) => {
                    member.cached.replace(session, beginning);
                }
                Err(error) => member.fail(&error),
            }
        })
    }

    /// Present times [s], of shape (count,).
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.lock(py).iter().map(Member::time).collect())
    }

    /// Which simulations are at the end of the model's analysis, or at an event that ends the run; of shape (count,).
    #[getter]
    fn is_finished<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_vec(
            py,
            self.lock(py).iter().map(|member| member.cached.session.is_finished()).collect(),
        )
    }

    /// Name of the event at which each simulation is, if that is to end the run.
    #[getter]
    fn stopped_by(&self, py: Python<'_>) -> Vec<Option<String>> {
        self.lock(py).iter().map(|member| member.cached.session.stopped_by().map(str::to_owned)).collect()
    }

    /// Which simulations have no solution, of shape (count,).
    #[getter]
    fn failed<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_vec(py, self.lock(py).iter().map(|member| member.failure.is_some()).collect())
    }

    /// A `SolutionError` for each of these, by the index of the simulation.
    #[getter]
    fn errors(&self, py: Python<'_>) -> BTreeMap<usize, PyErr> {
        let members = self.lock(py);
        let of = |(index, member): (usize, &Member)| Some((index, of_failure(member.failure.as_ref()?)));
        members.iter().enumerate().filter_map(of).collect()
    }

    /// Warnings so far of each simulation. Each code is reported once by a `ModelWarning`, for the first simulation concerned.
    #[getter]
    fn warnings(&self, py: Python<'_>) -> Vec<Vec<String>> {
        self.lock(py).iter().map(|member| member.cached.session.warnings().map(with_code).collect()).collect()
    }

    /// Names of the inputs in the order of the model file, which is that of `set(array)`.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.prepared.inputs().to_vec()
    }

    /// Names of the columns, in the order of `values`.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.all.clone()
    }

    /// Units of the columns, in the order of `values`.
    #[getter]
    fn units(&self, py: Python<'_>) -> Vec<String> {
        self.lock(py)[0].cached.session.columns().iter().map(|column| column.unit.clone()).collect()
    }

    /// Present values of all columns: an array of shape (count, number of columns), in SI units.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let columns = self.names.all.len();
        let mut members = self.lock(py);
        each(py, &mut members, |_, member| {
            member.cached.values();
        })?;
        let mut all = vec![f64::NAN; self.count * columns];
        for (own, member) in all.chunks_exact_mut(columns.max(1)).zip(members.iter_mut()) {
            if member.failure.is_none() {
                own.copy_from_slice(member.cached.values());
            }
        }
        Ok(PyArray1::from_vec(py, all).reshape([self.count, columns])?.into_any())
    }

    /// Present values of a column, a signal, an input or a state, in SI units: of shape (count,); with a list of names of shape
    /// (count, number of names).
    fn __getitem__<'py>(&self, py: Python<'py>, names: Names) -> PyResult<Bound<'py, PyAny>> {
        let is_one = matches!(names, Names::One(_));
        let names = names.all();
        let mut members = self.lock(py);
        let first = &mut members[0].cached;
        if let Some(name) = names.iter().find(|name| self.names.value(first, name).is_none()) {
            return Err(self.names.unknown(&first.session, name));
        }
        if names.iter().any(|name| self.names.recovers(&first.session, name)) {
            each(py, &mut members, |_, member| {
                member.cached.values();
            })?;
        }
        let mut all = Vec::with_capacity(self.count * names.len());
        for member in members.iter_mut() {
            let value = |name: &String| match member.failure {
                None => self.names.value(&mut member.cached, name).unwrap_or(f64::NAN),
                Some(_) => f64::NAN,
            };
            all.extend(names.iter().map(value));
        }
        let all = PyArray1::from_vec(py, all);
        Ok(if is_one { all.into_any() } else { all.reshape([self.count, names.len()])?.into_any() })
    }

    /// Picture of one simulation, as `Simulation.picture`. A simulation without a solution is drawn where it was.
    ///
    /// Raises `IndexError` if there is no such simulation; `ValueError` as `Simulation.picture`.
    #[pyo3(signature = (index, size = [640, 480], view = "chosen".to_owned(), center = None, extent = None))]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        index: usize,
        size: [u32; 2],
        view: String,
        center: Option<[f64; 3]>,
        extent: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let framing = framing((size, view, center, extent))?;
        let camera = self.model.camera()?;
        let mut members = self.lock(py);
        let member = members.get_mut(index).ok_or_else(|| self.no_member(index))?;
        let image = py.detach(move || camera.image(member.cached.session.simulation(), &framing));
        array(py, image)
    }

    fn __repr__(&self) -> String {
        format!("<lissom.Batch of {} simulations>", self.count)
    }
}
