//! Joint coordinates of a model: which ones are chosen, and values of them as Python gives them.

use std::collections::BTreeMap;

use lissom::core::simulation::joint_space::{JointMotion, JointSpaceError};
use lissom::{JointCoordinateError, JointCoordinates, JointDynamics, Prepared, Session};
use numpy::{AllowTypeChange, PyArrayLikeDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::cached_session::CachedSession;
use crate::errors::{solution, value_error};

/// Values of joint coordinates by name, or in the order of the chosen ones.
#[derive(FromPyObject)]
pub(crate) enum JointValues<'py> {
    Named(BTreeMap<String, PyArrayLikeDyn<'py, f64, AllowTypeChange>>),
    Ordered(PyArrayLikeDyn<'py, f64, AllowTypeChange>),
}

/// Values of joint coordinates of one or several simulations: a row for each.
#[derive(Default)]
pub(crate) struct Rows {
    names: Vec<String>,
    values: Vec<f64>,
}

impl Rows {
    pub(crate) fn row(&self, row: usize) -> Vec<(String, f64)> {
        let own = self.values.iter().skip(row * self.names.len());
        self.names.iter().cloned().zip(own.copied()).collect()
    }
}

/// The chosen coordinates of a model.
#[derive(Default)]
pub(crate) struct Joints {
    chosen: Option<JointCoordinates>,
    dynamics: Option<JointDynamics>,
    /// Equations of motion, and the revision of the session of which they are.
    motion: Option<(u64, JointMotion)>,
}

impl Joints {
    /// Chooses the coordinates of these names.
    pub(crate) fn choose(
        &mut self,
        prepared: &Prepared,
        names: Option<&[String]>,
    ) -> PyResult<&JointCoordinates> {
        if names.is_some() || self.chosen.is_none() {
            let coordinates = prepared.joint_coordinates(names).map_err(|error| of_joints(&error))?;
            (self.dynamics, self.motion) = (None, None);
            return Ok(self.chosen.insert(coordinates));
        }
        self.chosen(prepared)
    }

    /// Names of the chosen coordinates, if there was a choice.
    pub(crate) fn names(&self) -> Option<Vec<String>> {
        self.chosen.as_ref().map(|chosen| chosen.names().to_vec())
    }

    /// The chosen coordinates, or those that are chosen by default.
    pub(crate) fn chosen(&mut self, prepared: &Prepared) -> PyResult<&JointCoordinates> {
        let chosen = match self.chosen.take() {
            Some(chosen) => chosen,
            None => prepared.joint_coordinates(None).map_err(|error| of_joints(&error))?,
        };
        Ok(self.chosen.insert(chosen))
    }

    /// Motion of a session in the chosen coordinates.
    pub(crate) fn dynamics(
        &mut self,
        prepared: &Prepared,
        session: &Session,
    ) -> PyResult<&mut JointDynamics> {
        let dynamics = match self.dynamics.take() {
            Some(dynamics) => dynamics,
            None => JointDynamics::new(session, self.chosen(prepared)?.clone()),
        };
        Ok(self.dynamics.insert(dynamics))
    }

    /// Equations of motion of a session in the chosen coordinates, which are computed once per revision.
    pub(crate) fn motion(&mut self, prepared: &Prepared, of: &CachedSession) -> PyResult<&JointMotion> {
        let motion = match self.motion.take() {
            Some((revision, motion)) if revision == of.revision() => motion,
            _ => {
                let dynamics = self.dynamics(prepared, &of.session)?;
                dynamics.motion(&of.session).map_err(|error| of_joints(&error))?
            }
        };
        Ok(&self.motion.insert((of.revision(), motion)).1)
    }

    /// Values of so many simulations, or rates; arrays of fewer dimensions are the same for all.
    pub(crate) fn rows(
        &mut self,
        prepared: &Prepared,
        (given, is_rate): (Option<JointValues<'_>>, bool),
        count: Option<usize>,
    ) -> PyResult<Rows> {
        let fitting = |given: PyArrayLikeDyn<'_, f64, AllowTypeChange>, columns: Option<usize>| {
            let shape: Vec<usize> = count.into_iter().chain(columns).collect();
            let given = given.as_array();
            let all = given.broadcast(shape.clone()).filter(|_| count.is_some() || given.shape() == shape);
            let all = all.ok_or_else(|| {
                let found = given.shape();
                PyValueError::new_err(format!(
                    "the joint values have the shape {found:?} instead of {shape:?}"
                ))
            })?;
            Ok::<Vec<f64>, PyErr>(all.iter().copied().collect())
        };
        match given {
            None => Ok(Rows::default()),
            Some(JointValues::Ordered(values)) => {
                let chosen = self.chosen(prepared)?;
                let names = if is_rate { chosen.rate_names() } else { chosen.value_names() };
                let values = fitting(values, Some(names.len()))?;
                Ok(Rows { names, values })
            }
            Some(JointValues::Named(given)) => {
                // Without a choice there is no base.
                let chosen = self.chosen(prepared).ok();
                let (mut names, mut columns) = (Vec::new(), Vec::new());
                for (name, values) in given {
                    let own = chosen
                        .as_ref()
                        .map_or_else(|| vec![name.clone()], |own| own.components(&name, is_rate));
                    let width = own.len();
                    let values = fitting(values, (width > 1).then_some(width))?;
                    columns
                        .extend((0..width).map(|k| values.iter().skip(k).step_by(width).copied().collect()));
                    names.extend(own);
                }
                let columns: Vec<Vec<f64>> = columns;
                let row = |row: usize| columns.iter().map(move |column| column[row]);
                Ok(Rows { names, values: (0..count.unwrap_or(1)).flat_map(row).collect() })
            }
        }
    }

    /// Names of the coordinates whose rates are to be given: none where all parts are at rest and there is no choice.
    pub(crate) fn with_rates(&mut self, prepared: &Prepared, rates: &Rows) -> PyResult<Option<Vec<String>>> {
        match self.chosen(prepared) {
            Ok(chosen) => Ok(Some(chosen.names().to_vec())),
            Err(_) if rates.names.is_empty() => Ok(None),
            Err(error) => Err(error),
        }
    }
}

/// A request about joint coordinates that is not met.
pub(crate) fn of_joints(error: &JointCoordinateError) -> PyErr {
    use JointCoordinateError as Error;
    match error {
        Error::Assembly(_)
        | Error::Start(_)
        | Error::Space(JointSpaceError::Dependent { .. } | JointSpaceError::Initial(_)) => solution(error),
        other => value_error(other),
    }
}
