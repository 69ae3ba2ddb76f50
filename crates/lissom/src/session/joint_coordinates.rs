//! Independent joint coordinates, and sessions that start with given values and rates of them.

use std::collections::BTreeSet;

use lissom_core::assembly::AssemblyError;
use lissom_core::consistent::mobility::mobility;
use lissom_core::diagnostics::Diagnose;
use lissom_core::kinematics::CoordinateId;
use lissom_core::simulation::joint_space::{JointSpace, JointSpaceError, check_number};
use lissom_core::system::ElementId;
use lissom_motion::Vector6;

use super::{Prepared, Session, StartError};

/// Why a request about joint coordinates is not met.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum JointCoordinateError {
    /// There is no such coordinate, or it is not among the chosen ones.
    Unknown {
        /// The name that was given.
        name: String,
        /// The names that are possible.
        known: String,
    },
    /// Neither the coordinates of actuators nor the single coordinates of joints are as many as the degrees of freedom of their parts.
    NoDefault {
        /// Number of coordinates of joints with actuators.
        actuated: usize,
        /// Number of coordinates of joints with one coordinate.
        single: usize,
        /// Number of degrees of freedom.
        freedoms: usize,
    },
    /// A value is not finite.
    NotFinite {
        /// The coordinate.
        name: String,
        /// The value that was given.
        value: f64,
    },
    /// The model has no such output.
    Output {
        /// The name that was given.
        name: String,
        /// Names of all outputs.
        known: String,
    },
    /// An output depends on accelerations or forces, or has no derivatives.
    NoJacobian(String),
    /// The joints do not close with these values.
    Assembly(AssemblyError),
    /// The coordinates do not describe the motion.
    Space(#[from] JointSpaceError),
    /// The model cannot start there.
    Start(#[from] StartError),
}

impl From<AssemblyError> for JointCoordinateError {
    fn from(error: AssemblyError) -> Self {
        Self::Assembly(error)
    }
}

/// Independent joint coordinates, as many as the degrees of freedom of the parts that joints connect with them.
#[derive(Clone, Debug)]
pub struct JointCoordinates {
    names: Vec<String>,
    ids: Vec<CoordinateId>,
    /// Loads on these coordinates.
    actuators: Vec<ElementId>,
}

impl JointCoordinates {
    /// Their names, such as `elbow.angle`.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    pub(crate) fn ids(&self) -> &[CoordinateId] {
        &self.ids
    }

    pub(crate) fn actuators(&self) -> &[ElementId] {
        &self.actuators
    }
}

impl Prepared {
    /// Coordinates of joints, in the order of the file.
    fn of_joints(&self) -> impl Iterator<Item = CoordinateId> + Clone + '_ {
        let names = &self.lowered().names;
        let of_joints = names.joints.iter().filter_map(|joint| names.coordinates.get(joint));
        let mut seen = BTreeSet::new();
        of_joints.flatten().copied().filter(move |&own| seen.insert(own))
    }

    fn coordinate(&self, name: &str) -> Result<CoordinateId, JointCoordinateError> {
        let name_of = |own| self.system().layout().coordinate_name(own);
        let unknown = || JointCoordinateError::Unknown {
            name: name.to_owned(),
            known: self.of_joints().map(name_of).collect::<Vec<_>>().join(", "),
        };
        self.of_joints().find(|&own| name_of(own) == name).ok_or_else(unknown)
    }

    /// Independent joint coordinates with these names. By default they are those of joints with a `joint_torque` or `joint_force`, or
    /// otherwise those of all joints with one coordinate that is not prescribed, if they are as many as the degrees of freedom of the
    /// parts that joints connect with them. The default order is that of the joints in the file.
    ///
    /// # Errors
    /// If there is no such coordinate, or there are not as many as degrees of freedom of the parts that joints connect with them.
    pub fn joint_coordinates(
        &self,
        names: Option<&[String]>,
    ) -> Result<JointCoordinates, JointCoordinateError> {
        let system = self.system();
        let check = |ids: &[CoordinateId]| check_number(system, self.state(), ids);
        let ids = if let Some(names) = names {
            let ids = names.iter().map(|name| self.coordinate(name)).collect::<Result<Vec<_>, _>>()?;
            check(&ids)?;
            ids
        } else {
            let lowered = &self.lowered().names;
            let is_driven =
                |own: &CoordinateId| system.drives().iter().any(|drive| drive.prescribed.coordinate == *own);
            let with_actuator: BTreeSet<_> = lowered.actuators.iter().map(|&(own, _)| own).collect();
            let alone: BTreeSet<_> =
                lowered.coordinates.values().filter(|own| own.len() == 1).flatten().copied().collect();
            let of_joints = self.of_joints();
            let actuated: Vec<_> = of_joints.clone().filter(|own| with_actuator.contains(own)).collect();
            let single: Vec<_> = of_joints.filter(|own| alone.contains(own) && !is_driven(own)).collect();
            let (actuated_count, single_count) = (actuated.len(), single.len());
            match [actuated, single].into_iter().find(|ids| check(ids).is_ok()) {
                Some(ids) => ids,
                None => {
                    return Err(JointCoordinateError::NoDefault {
                        actuated: actuated_count,
                        single: single_count,
                        freedoms: mobility(system, self.state()).freedoms,
                    });
                }
            }
        };
        let layout = system.layout();
        let actuators = self.lowered().names.actuators.iter().filter(|(own, _)| ids.contains(own));
        Ok(JointCoordinates {
            names: ids.iter().map(|&own| layout.coordinate_name(own).to_owned()).collect(),
            actuators: actuators.filter_map(|&(_, element)| element).collect(),
            ids,
        })
    }

    /// A session at the start time with these `values` of joint coordinates [rad, m], and all parts moved such that joints close. The
    /// parts have the velocities at which independent `coordinates` have these `rates` [rad/s, m/s]; those that are not named have
    /// none. Without `coordinates` all parts are at rest. Inputs and states are those of the model's start.
    ///
    /// # Errors
    /// If a name is unknown, if there are no such positions nearby, or the coordinates depend on each other there.
    pub fn session_at(
        &self,
        values: &[(String, f64)],
        coordinates: Option<&JointCoordinates>,
        rates: &[(String, f64)],
    ) -> Result<Session, JointCoordinateError> {
        if let Some((name, value)) = values.iter().chain(rates).find(|(_, value)| !value.is_finite()) {
            return Err(JointCoordinateError::NotFinite { name: name.clone(), value: *value });
        }
        let wanted = values.iter().map(|(name, value)| Ok((self.coordinate(name)?, *value)));
        let wanted = wanted.collect::<Result<Vec<_>, JointCoordinateError>>()?;
        let mut state = self.state().clone();
        if !wanted.is_empty() {
            state.kinematics = self.lowered().positions_with(&wanted)?;
        }
        for node in &mut state.kinematics.nodes {
            node.twist = Vector6::zeros();
        }
        for own in &mut state.kinematics.coordinates {
            own.rate = 0.0;
        }
        let names = coordinates.map(JointCoordinates::names).unwrap_or_default();
        if let Some((name, _)) = rates.iter().find(|(name, _)| !names.contains(name)) {
            return Err(JointCoordinateError::Unknown { name: name.clone(), known: names.join(", ") });
        }
        if let Some(coordinates) = coordinates {
            let rate =
                |name: &String| rates.iter().find(|(own, _)| own == name).map_or(0.0, |(_, rate)| *rate);
            let all: Vec<f64> = names.iter().map(rate).collect();
            let system = self.system();
            let mut space =
                JointSpace::new(system, &state, &self.lowered().settings, coordinates.ids.clone());
            space.set_rates(system, &mut state, &all)?;
        }
        Ok(self.session_from(state)?)
    }
}
