//! Independent joint coordinates, with the free body that carries their joints if it floats, and sessions that start with given values
//! and rates of them.
//!
//! ```text
//! q = (x, y, z, q₀, q₁, q₂, q₃, joints)   position and unit quaternion of the base, global axes
//! v = (v₁, v₂, v₃, ω₁, ω₂, ω₃, joints)    velocity and angular velocity of the base, in its axes
//! ```

use std::collections::BTreeSet;

use lissom_core::assembly::AssemblyError;
use lissom_core::consistent::mobility::{coupled_nodes, mobility};
use lissom_core::diagnostics::Diagnose;
use lissom_core::kinematics::{CoordinateId, Kinematics, LOCKED, NodeId};
use lissom_core::simulation::joint_space::{JointSpace, JointSpaceError, check_number};
use lissom_core::system::{ElementId, State, System};
use lissom_motion::{Motion, Rotation, Vector3, Vector6};

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
    /// The quaternion of this base is zero.
    NoRotation(String),
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

/// Components of the position and orientation of a base, and of its velocities.
const POSE: [&str; 7] = ["x", "y", "z", "q0", "q1", "q2", "q3"];
const TWIST: [&str; 6] = ["v1", "v2", "v3", "w1", "w2", "w3"];

/// Independent joint coordinates, as many as the degrees of freedom of the parts that joints connect with them. Those of a robot that
/// floats begin with its base.
#[derive(Clone, Debug)]
pub struct JointCoordinates {
    names: Vec<String>,
    base: Option<NodeId>,
    ids: Vec<CoordinateId>,
    /// Rows of the rates in the layout: six of the base, then those of the coordinates.
    rows: Vec<usize>,
    /// Loads on these coordinates.
    actuators: Vec<ElementId>,
}

impl JointCoordinates {
    /// Their names, such as `elbow.angle`, that of the base first.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    fn with_base(&self, components: &[&str]) -> Vec<String> {
        let base = self.names[..usize::from(self.base.is_some())].iter();
        let of_base = base.flat_map(|name| components.iter().map(move |own| format!("{name}.{own}")));
        of_base.chain(self.names[usize::from(self.base.is_some())..].iter().cloned()).collect()
    }

    /// Names of their values: seven of the base, then one of each coordinate.
    pub fn value_names(&self) -> Vec<String> {
        self.with_base(&POSE)
    }

    /// Names of their rates: six of the base, then one of each coordinate.
    pub fn rate_names(&self) -> Vec<String> {
        self.with_base(&TWIST)
    }

    /// Names of the components that `name` stands for: those of the values or rates of a base, or one coordinate.
    pub fn components(&self, name: &str, is_rate: bool) -> Vec<String> {
        if self.base.is_none() || self.names[0] != name {
            return vec![name.to_owned()];
        }
        let all: &[&str] = if is_rate { &TWIST } else { &POSE };
        all.iter().map(|own| format!("{name}.{own}")).collect()
    }

    pub(crate) fn base(&self) -> Option<NodeId> {
        self.base
    }

    pub(crate) fn ids(&self) -> &[CoordinateId] {
        &self.ids
    }

    pub(crate) fn rows(&self) -> &[usize] {
        &self.rows
    }

    pub(crate) fn actuators(&self) -> &[ElementId] {
        &self.actuators
    }
}

/// Position, and quaternion with its scalar part first.
pub(super) fn pose_of(frame: &Motion) -> [f64; 7] {
    let ([x, y, z], [q0, q1, q2, q3]) = (frame.position.into(), frame.rotation.quaternion());
    [x, y, z, q0, q1, q2, q3]
}

/// Rows of a base and of coordinates.
fn rows(system: &System, base: Option<NodeId>, ids: &[CoordinateId]) -> Vec<usize> {
    let layout = system.layout();
    let of_base = base.into_iter().flat_map(|node| layout.rows_of_node(node).map(|row| row as usize));
    of_base.chain(ids.iter().map(|&own| layout.row_of_coordinate(own))).collect()
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

    /// The body of this name, if it is free in all six directions.
    fn free_body(&self, name: &str) -> Option<NodeId> {
        let node = *self.lowered().names.nodes.get(name)?;
        let is_free = !self.system().layout().rows_of_node(node).contains(&LOCKED);
        is_free.then_some(node)
    }

    /// Free bodies that are the tip of no joint, in the order of the file.
    fn roots(&self) -> Vec<NodeId> {
        let tips: BTreeSet<NodeId> = self.system().joints().iter().map(|own| own.frames[1].node).collect();
        let names = &self.lowered().names.nodes;
        let all: BTreeSet<_> = names.keys().filter_map(|name| self.free_body(name)).collect();
        all.difference(&tips).copied().collect()
    }

    /// Independent joint coordinates with these names, of which one may be that of a free body: the base, with its position and
    /// orientation. By default they are those of joints with a `joint_torque` or `joint_force`, or otherwise those of all joints with
    /// one coordinate that is not prescribed, if they are as many as the degrees of freedom of the parts that joints connect with
    /// them; with six more of a free body they have it as their base. The default order is that of the joints in the file.
    ///
    /// # Errors
    /// If there is no such coordinate, or there are not as many as degrees of freedom of the parts that joints connect with them.
    pub fn joint_coordinates(
        &self,
        names: Option<&[String]>,
    ) -> Result<JointCoordinates, JointCoordinateError> {
        let system = self.system();
        let check = |base: Option<NodeId>, ids: &[CoordinateId]| {
            check_number(system, self.state(), &rows(system, base, ids))
        };
        let (base, ids) = if let Some(names) = names {
            let bases: Vec<_> = names.iter().filter_map(|name| self.free_body(name)).collect();
            let is_base = |name: &&String| self.free_body(name).is_some() && bases.len() == 1;
            let ids = names.iter().filter(|name| !is_base(name)).map(|name| self.coordinate(name));
            let (base, ids) = (bases.first().copied(), ids.collect::<Result<Vec<_>, _>>()?);
            check(base, &ids)?;
            (base, ids)
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
            let with_base = |ids: &Vec<CoordinateId>| {
                let is_carrier = |base: &NodeId| !ids.is_empty() && check(Some(*base), ids).is_ok();
                self.roots().into_iter().find(is_carrier).map(|base| (Some(base), ids.clone()))
            };
            let alone = [&actuated, &single].into_iter().find(|ids| check(None, ids).is_ok());
            let found = alone.map(|ids| (None, ids.clone()));
            match found.or_else(|| with_base(&actuated)).or_else(|| with_base(&single)) {
                Some(found) => found,
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
        let of_base = base.map(|node| layout.node_name(node).to_owned());
        let names = ids.iter().map(|&own| layout.coordinate_name(own).to_owned());
        Ok(JointCoordinates {
            names: of_base.into_iter().chain(names).collect(),
            actuators: actuators.filter_map(|&(_, element)| element).collect(),
            rows: rows(system, base, &ids),
            base,
            ids,
        })
    }

    /// Positions with these values of joint coordinates at which all joints close, and with the pose of the base, which stays where it
    /// is unless it is given: the parts that joints connect with it move with it.
    fn kinematics_with(
        &self,
        values: &[(String, f64)],
        coordinates: Option<&JointCoordinates>,
    ) -> Result<Kinematics, JointCoordinateError> {
        let base = coordinates.and_then(|own| Some((own.base()?, own.names().first()?)));
        let component = |name: &str| {
            let (part, component) = name.rsplit_once('.')?;
            base.filter(|(_, base)| *base == part).and(POSE.iter().position(|own| *own == component))
        };
        let (of_base, of_joints): (Vec<_>, Vec<_>) =
            values.iter().partition(|(name, _)| component(name).is_some());
        let wanted = of_joints.into_iter().map(|(name, value)| Ok((self.coordinate(name)?, *value)));
        let wanted = wanted.collect::<Result<Vec<_>, JointCoordinateError>>()?;
        let start = &self.state().kinematics;
        let mut at =
            if wanted.is_empty() { start.clone() } else { self.lowered().positions_with(&wanted)? };
        let Some((base, name)) = base else { return Ok(at) };
        let mut pose = pose_of(&start.nodes[base].frame);
        for (name, value) in of_base {
            pose[component(name).unwrap_or_default()] = *value;
        }
        let [x, y, z, quaternion @ ..] = pose;
        let rotation = Rotation::from_quaternion(quaternion);
        let rotation = rotation.ok_or_else(|| JointCoordinateError::NoRotation(name.clone()))?;
        let frame = Motion { rotation, position: Vector3::new(x, y, z) };
        let shift = frame * at.nodes[base].frame.inverse();
        for node in coupled_nodes(self.system(), self.state(), base) {
            at.nodes[node].frame = shift * at.nodes[node].frame;
        }
        Ok(at)
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
        let kinematics = self.kinematics_with(values, coordinates)?;
        let mut state = State { kinematics, ..self.state().clone() };
        for node in &mut state.kinematics.nodes {
            node.twist = Vector6::zeros();
        }
        for own in &mut state.kinematics.coordinates {
            own.rate = 0.0;
        }
        let names = coordinates.map(JointCoordinates::rate_names).unwrap_or_default();
        if let Some((name, _)) = rates.iter().find(|(name, _)| !names.contains(name)) {
            return Err(JointCoordinateError::Unknown { name: name.clone(), known: names.join(", ") });
        }
        if let Some(coordinates) = coordinates {
            let rate =
                |name: &String| rates.iter().find(|(own, _)| own == name).map_or(0.0, |(_, rate)| *rate);
            let all: Vec<f64> = names.iter().map(rate).collect();
            let system = self.system();
            let mut space =
                JointSpace::new(system, &state, &self.lowered().settings, coordinates.rows.clone());
            space.set_rates(system, &mut state, &all)?;
        }
        Ok(self.session_from(state)?)
    }
}
