//! A simulation that Python advances step by step.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use lissom::core::simulation::SnapshotError;
use lissom::core::simulation::joint_space::JointMotion;
use lissom::{Document, Prepared, Session, SessionSnapshot, with_code};
use numpy::{AllowTypeChange, PyArray1, PyArray2, PyArray3, PyArrayLike1, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::{PyBytes, PyFloat};

use crate::analyses::linearize_here;
use crate::cached_session::{CachedSession, ColumnNames, begin};
use crate::errors::{of_input, solution, value_error};
use crate::joints::{JointValues, Joints, of_joints};
use crate::model::NativeModel;
use crate::pictures::{array, framing};
use crate::watch::Watch;

/// A name, or several.
#[derive(FromPyObject)]
pub(crate) enum Names {
    One(String),
    Several(Vec<String>),
}

impl Names {
    pub(crate) fn all(self) -> Vec<String> {
        match self {
            Self::One(name) => vec![name],
            Self::Several(names) => names,
        }
    }
}

/// Snapshot and chosen joint coordinates.
type Pickled<'py> = (Bound<'py, PyBytes>, Option<Vec<String>>);

/// Inputs and their values.
#[derive(FromPyObject)]
enum Inputs {
    One(String),
    All(HashMap<String, f64>),
    Named(Vec<String>),
}

/// Issues these warnings of a category of the package.
pub(crate) fn warn(py: Python<'_>, category: &str, news: &[String]) -> PyResult<()> {
    if news.is_empty() {
        return Ok(());
    }
    let category = py.import("lissom")?.getattr(category)?;
    let warn = py.import("warnings")?.getattr("warn")?;
    news.iter().try_for_each(|words| warn.call1((words, &category)).map(|_| ()))
}

/// A model on its way, made by `Model.simulation()`.
///
/// `sim["arm.angle"]` is the present value of a column, in SI units. The interpreter lock is released while stepping.
#[pyclass(frozen, module = "lissom")]
pub(crate) struct Simulation {
    inner: Mutex<CachedSession>,
    model: Py<NativeModel>,
    document: Document,
    prepared: Prepared,
    names: ColumnNames,
    joints: Mutex<Joints>,
}

impl Simulation {
    pub(crate) fn new(
        session: Session,
        (document, prepared): (Document, Prepared),
        model: Py<NativeModel>,
    ) -> Self {
        let names = ColumnNames::of(&session);
        let inner = Mutex::new(CachedSession::new(session, None));
        Self { inner, model, document, prepared, names, joints: Mutex::default() }
    }

    /// The present equations of motion in joint coordinates.
    fn with_motion<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&JointMotion) -> T + Send,
    ) -> PyResult<T> {
        py.detach(|| {
            let inner = self.lock();
            let mut joints = self.lock_joints();
            joints.motion(&self.prepared, &inner).map(work)
        })
    }

    fn lock_joints(&self) -> MutexGuard<'_, Joints> {
        self.joints.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// For threads without the interpreter lock.
    fn lock(&self) -> MutexGuard<'_, CachedSession> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// For threads with the interpreter lock, which is released while they wait: a thread that steps needs it to look for signals.
    fn lock_attached(&self, py: Python<'_>) -> MutexGuard<'_, CachedSession> {
        self.inner.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner)
    }

    /// Present value of a column, a signal, an input or a state.
    fn value(&self, inner: &mut CachedSession, name: &str) -> PyResult<f64> {
        self.names.value(inner, name).ok_or_else(|| self.names.unknown(&inner.session, name))
    }
}

/// A symmetric matrix.
fn square(py: Python<'_>, values: Vec<f64>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let size = values.len().isqrt();
    PyArray1::from_vec(py, values).reshape([size, size])
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
            inner.change().advance().map_err(|error| solution(&error))?;
            Ok(inner.news().map(with_code).collect::<Vec<_>>())
        })?;
        warn(py, "ModelWarning", &news)
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
            let mut go_on = |_: &lissom::Progress| watch.ask(0.0, 0.0);
            let reached = inner.change().step_to_watched(time, &mut go_on);
            reached.map(|_| ()).map_err(|error| solution(&error))?;
            Ok(inner.news().map(with_code).collect::<Vec<_>>())
        });
        watch.finish()?;
        warn(py, "ModelWarning", &outcome?)
    }

    /// Warnings so far, as in `summary.json`. Each is also reported by a `ModelWarning` when it occurs.
    #[getter]
    fn warnings(&self, py: Python<'_>) -> Vec<String> {
        self.lock_attached(py).session.warnings().map(with_code).collect()
    }

    /// Present time [s].
    #[getter]
    fn time(&self, py: Python<'_>) -> f64 {
        self.lock_attached(py).session.progress().time
    }

    /// End of the model's analysis [s].
    #[getter]
    fn end(&self, py: Python<'_>) -> f64 {
        self.lock_attached(py).session.progress().end
    }

    /// Whether that end is reached.
    #[getter]
    fn is_finished(&self, py: Python<'_>) -> bool {
        self.lock_attached(py).session.is_finished()
    }

    /// Name of the event at which the simulation is, if that is to end the run.
    #[getter]
    fn stopped_by(&self, py: Python<'_>) -> Option<String> {
        self.lock_attached(py).session.stopped_by().map(str::to_owned)
    }

    /// Names and times [s] of the events that have happened.
    #[getter]
    fn events(&self, py: Python<'_>) -> Vec<(String, f64)> {
        self.lock_attached(py).session.events().map(|(name, time)| (name.to_owned(), time)).collect()
    }

    /// Names of the columns, in the order of `values`.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.all.clone()
    }

    /// Units of the columns, in the order of `values`.
    #[getter]
    fn units(&self, py: Python<'_>) -> Vec<String> {
        self.lock_attached(py).session.columns().iter().map(|column| column.unit.clone()).collect()
    }

    /// Present values of all columns: an array of shape (number of columns,), in SI units.
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.lock_attached(py).values())
    }

    /// Names of the inputs, in the order of the model file.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.prepared.inputs().to_vec()
    }

    /// Sets inputs of the model from now on, until they are set again: `set("torque", 0.5)`, `set({"torque": 0.5, "brake": 1})`,
    /// or `set(names, values)` with a list of names and a list or array of as many values. Several inputs that are set at once
    /// cost as much as one.
    ///
    /// Raises `ValueError` if the model has no such input or a value is not finite, `SolutionError` if there is no
    /// consistent start with them; then none is set.
    #[pyo3(signature = (inputs, values = None))]
    fn set(&self, py: Python<'_>, inputs: Inputs, values: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let needed = || PyValueError::new_err("inputs are set with their values: `set(names, values)`");
        let given: Vec<(String, f64)> = match inputs {
            Inputs::One(name) => vec![(name, values.ok_or_else(needed)?.extract()?)],
            Inputs::All(inputs) if values.is_none() => inputs.into_iter().collect(),
            Inputs::All(_) => return Err(PyValueError::new_err("a dictionary contains the values already")),
            Inputs::Named(names) => {
                let values: Vec<f64> = values.ok_or_else(needed)?.extract()?;
                if values.len() != names.len() {
                    let counts = format!("there are {} inputs and {} values", names.len(), values.len());
                    return Err(PyValueError::new_err(counts));
                }
                names.into_iter().zip(values).collect()
            }
        };
        py.detach(|| {
            let mut inner = self.lock();
            let given = given.iter().map(|(name, value)| (&**name, *value));
            inner.change().set_inputs(given).map_err(|error| of_input(&error))
        })
    }

    /// Names of the independent joint coordinates, such as `["shoulder.angle", "elbow.angle"]`; with `names` these are chosen, as
    /// many as degrees of freedom of the parts that joints connect with them; other parts, such as free bodies, move apart. By
    /// default they are those of joints with a `joint_torque` or `joint_force`, or otherwise those of all joints with one
    /// coordinate, in the order of the joints in the model file. A robot that floats has one more name at the beginning: that of
    /// its base, a free body, which stands for seven values and six rates.
    ///
    /// Raises `ValueError` if a name is unknown, or they are not as many as those degrees of freedom.
    #[pyo3(signature = (names = None))]
    pub(crate) fn coordinates(&self, py: Python<'_>, names: Option<Vec<String>>) -> PyResult<Vec<String>> {
        py.detach(|| Ok(self.lock_joints().choose(&self.prepared, names.as_deref())?.names().to_vec()))
    }

    /// Values [rad, m] and rates [rad/s, m/s] of the joint coordinates, two arrays in the order of `coordinates()`. A base has its
    /// position x, y, z and quaternion q0 … q3 in global axes, and its velocity and angular velocity in its own axes.
    fn joint_state<'py>(&self, py: Python<'py>) -> PyResult<[Bound<'py, PyArray1<f64>>; 2]> {
        let state = py.detach(|| {
            let inner = self.lock();
            Ok::<_, PyErr>(
                self.lock_joints().dynamics(&self.prepared, &inner.session)?.values_and_rates(&inner.session),
            )
        })?;
        Ok(state.map(|values| PyArray1::from_vec(py, values)))
    }

    /// Mass matrix H of `H q̈ + h = τ`, the equations of motion in the joint coordinates q, in the order of `coordinates()`; τ are the
    /// forces of `joint_torque` and `joint_force` loads on them. An array of shape (number of rates, number of rates): a base has the
    /// first six, its velocity and angular velocity in its own axes.
    ///
    /// Raises `ValueError` if there are no joint coordinates, `SolutionError` if they depend on each other in this position.
    fn mass_matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mass = self.with_motion(py, |motion| motion.mass.as_slice().to_vec())?;
        square(py, mass)
    }

    /// h of `H q̈ + h = τ`: all forces on the joint coordinates that are not τ, with the opposite sign, such as those of gravity,
    /// velocities, springs, friction and other loads [N m, N]. Friction that depends on normal forces is that of the present ones.
    ///
    /// Raises as `mass_matrix`.
    fn bias<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, self.with_motion(py, |motion| motion.bias.as_slice().to_vec())?))
    }

    /// Forces of `joint_torque` and `joint_force` loads at which the joint coordinates have these accelerations [rad/s², m/s²]:
    /// `mass_matrix() @ accelerations + bias()` [N m, N].
    ///
    /// Raises as `mass_matrix`; `ValueError` if their number is not that of the coordinates.
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        accelerations: PyArrayLike1<'_, f64, AllowTypeChange>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let accelerations = accelerations.as_array().to_vec();
        let forces = self.with_motion(py, |motion| {
            let (found, wanted) = (accelerations.len(), motion.bias.len());
            let is_fitting = found == wanted;
            is_fitting.then(|| motion.forces(&accelerations)).ok_or((found, wanted))
        })?;
        let forces = forces.map_err(|(found, wanted)| {
            PyValueError::new_err(format!(
                "there are {found} accelerations, but {wanted} rates of joint coordinates"
            ))
        })?;
        Ok(PyArray1::from_vec(py, forces))
    }

    /// Jacobian of an output with respect to the joint coordinates, of one of velocities with respect to their rates: an array of shape
    /// (number of components, number of coordinates). Outputs of the position and of the velocity of a point have the same one.
    ///
    /// Raises as `mass_matrix`; `ValueError` if there is no such output, or it depends on accelerations or forces.
    fn jacobian<'py>(&self, py: Python<'py>, output: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = py.detach(|| {
            let inner = self.lock();
            let mut joints = self.lock_joints();
            let dynamics = joints.dynamics(&self.prepared, &inner.session)?;
            let (_, rows) = dynamics.jacobian(&inner.session, output).map_err(|error| of_joints(&error))?;
            Ok::<_, PyErr>(rows)
        })?;
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// Starts again at the start time, with these values `q` of joint coordinates [rad, m] and rates `v` [rad/s, m/s]: dictionaries, or
    /// arrays in the order of `coordinates()`; a base is given by a list of seven values or six rates. Parts are moved such that all
    /// joints close, and a base that is not named stays where it was. Coordinates that are not named stay where
    /// they were at the model's start if they can, and rates that are not named are zero. Inputs are those of the model. Without
    /// arguments this is the start of the model, with its velocities.
    ///
    /// Raises `SolutionError` if the joints do not close with these values, or coordinates are not independent there; `ValueError`
    /// if a name is unknown or a value not finite. The simulation is then as it was.
    #[pyo3(signature = (q = None, v = None))]
    fn reset(&self, py: Python<'_>, q: Option<JointValues<'_>>, v: Option<JointValues<'_>>) -> PyResult<()> {
        let is_model = q.is_none() && v.is_none();
        let (values, rates) = {
            let mut joints = self.joints.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner);
            (
                joints.rows(&self.prepared, (q, false), None)?.row(0),
                joints.rows(&self.prepared, (v, true), None)?,
            )
        };
        let news = py.detach(|| {
            let beginning = if is_model {
                None
            } else {
                let coordinates = self.lock_joints().with_rates(&self.prepared, &rates)?;
                Some((values, coordinates, rates.row(0)))
            };
            let session = begin(&self.prepared, &beginning).map_err(|error| of_joints(&error))?;
            Ok::<_, PyErr>(self.lock().replace(session, beginning))
        })?;
        warn(py, "ModelWarning", &news)
    }

    /// Present value of a column, a signal, an input or a state, in SI units; with a list of names an array of their values.
    fn __getitem__<'py>(&self, py: Python<'py>, names: Names) -> PyResult<Bound<'py, PyAny>> {
        let mut inner = self.lock_attached(py);
        match names {
            Names::One(name) => Ok(PyFloat::new(py, self.value(&mut inner, &name)?).into_any()),
            Names::Several(names) => {
                let values: PyResult<Vec<f64>> =
                    names.iter().map(|name| self.value(&mut inner, name)).collect();
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
        warn(py, "ModelWarning", &files.2)?;
        py.import("lissom._linear")?.getattr("LinearModel")?.call_method1("_of", files)
    }

    /// Picture of the present state as `lissom snapshot` draws it, without title and forces: red, green and blue, an array of shape
    /// (height, width, 3) and type uint8. `size` is (width, height), `view` is `"chosen"`, `"oblique"`, `"front"`, `"side"` or `"top"`.
    /// `center` [m] is the position in the middle, `extent` [m] the length of the shorter side; by default they show the model at its
    /// start. The frame does not depend on the motion.
    ///
    /// Raises `ValueError` if there is no such view, or a size is not positive or too large.
    #[pyo3(signature = (size = [640, 480], view = "chosen".to_owned(), center = None, extent = None))]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        size: [u32; 2],
        view: String,
        center: Option<[f64; 3]>,
        extent: Option<f64>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let framing = framing((size, view, center, extent))?;
        let model = self.model.get();
        let image = py.detach(|| {
            let camera = model.camera()?;
            Ok::<_, PyErr>(camera.image(self.lock().session.simulation(), &framing))
        })?;
        array(py, image)
    }

    /// Where the simulation is, as bytes that can be kept, sent and pickled.
    ///
    /// Raises `SolutionError` if a unit of another program cannot return its state.
    pub(crate) fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| {
            let inner = self.lock();
            inner.session.simulation().check_snapshots().map_err(|error| solution(&error))?;
            let mut bytes = self.model.get().fingerprint().to_le_bytes().to_vec();
            let beginning = serde_json::to_vec(&inner.beginning).unwrap_or_default();
            bytes.extend((beginning.len() as u64).to_le_bytes());
            bytes.extend(beginning);
            bytes.extend(inner.session.snapshot().to_bytes());
            Ok::<_, PyErr>(bytes)
        })?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Simulations are pickled as their model and a snapshot.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Pickled<'py>)> {
        let chosen = py.detach(|| self.lock_joints().names());
        let restored = self.model.bind(py).getattr("restored")?;
        Ok((restored, (self.snapshot(py)?, chosen)))
    }

    /// Restores the state of a snapshot of the same model; subsequent results are bitwise identical.
    ///
    /// Raises `ValueError` if the bytes are no snapshot of this model and version; the simulation is then as it was.
    pub(crate) fn restore(&self, py: Python<'_>, snapshot: &[u8]) -> PyResult<()> {
        py.detach(|| {
            let refused = |error: SnapshotError| value_error(&error);
            let too_few = || PyValueError::new_err("the bytes are no snapshot: there are too few");
            let (of, bytes) = snapshot.split_first_chunk().ok_or_else(too_few)?;
            let (length, bytes) = bytes.split_first_chunk().ok_or_else(too_few)?;
            if u64::from_le_bytes(*of) != self.model.get().fingerprint() {
                return Err(PyValueError::new_err(
                    "the snapshot belongs to another model: its text, or values put into it, are not those of this one; restore it \
                     where it was taken (`step_to` goes beyond the end of an analysis)",
                ));
            }
            let length = usize::try_from(u64::from_le_bytes(*length)).unwrap_or(usize::MAX);
            let (beginning, bytes) = bytes.split_at_checked(length).ok_or_else(too_few)?;
            let read = SessionSnapshot::from_bytes(bytes).map_err(refused)?;
            let beginning = serde_json::from_slice(beginning).map_err(|_| refused(SnapshotError::Damaged {}))?;
            let mut inner = self.lock();
            if inner.beginning == beginning {
                inner.change().restore(&read).map_err(refused)?;
            } else {
                let mut session = begin(&self.prepared, &beginning).map_err(|error| of_joints(&error))?;
                session.restore(&read).map_err(refused)?;
                inner.replace(session, beginning);
            }
            Ok(())
        })
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let progress = self.lock_attached(py).session.progress();
        format!("<lissom.Simulation at t = {} of {} s>", progress.time, progress.end)
    }
}
