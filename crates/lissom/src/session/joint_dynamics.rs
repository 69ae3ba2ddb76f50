//! Equations of motion of a session in independent joint coordinates, for control: mass matrix, bias, inverse dynamics, Jacobians.

use lissom_core::kinematics::{CoordinateId, Kinematics};
use lissom_core::simulation::joint_space::{JointMotion, JointSpace};
use lissom_core::simulation::{Need, Recovery};
use lissom_core::system::OutputDerivatives;
use lissom_core::system::{State, System};
use lissom_motion::Vector6;

use super::joint_coordinates::pose_of;
use super::{JointCoordinateError, JointCoordinates, Session};

/// Evaluates `H z̈ + h = τ` at the present state of a session: z joint coordinates, τ the forces of `joint_torque` and `joint_force`
/// loads on them. h contains all other forces: those of velocities, gravity, springs, friction and other loads.
pub struct JointDynamics {
    coordinates: JointCoordinates,
    space: JointSpace,
    /// Recovery of velocities that satisfy the constraints.
    recovery: Option<Box<Recovery>>,
}

impl JointDynamics {
    /// For a session of the prepared model that the coordinates belong to.
    pub fn new(session: &Session, coordinates: JointCoordinates) -> Self {
        let simulation = session.simulation();
        let (system, state, settings) = (simulation.system(), simulation.state(), simulation.settings());
        let space = JointSpace::new(system, state, settings, coordinates.rows().to_vec());
        Self { coordinates, space, recovery: Recovery::of(simulation) }
    }

    /// The coordinates.
    pub fn coordinates(&self) -> &JointCoordinates {
        &self.coordinates
    }

    /// Values [rad, m] and rates [rad/s, m/s] of the coordinates, those of a base first.
    pub fn values_and_rates(&mut self, session: &Session) -> [Vec<f64>; 2] {
        let at = &recovered(&mut self.recovery, session).kinematics;
        let base = self.coordinates.base().map(|node| &at.nodes[node]);
        let of_base = [
            base.map(|node| pose_of(&node.frame).to_vec()).unwrap_or_default(),
            base.map(|node| node.twist.as_slice().to_vec()).unwrap_or_default(),
        ];
        let own = self.coordinates.ids().iter().map(|&own| &at.coordinates[own]);
        let [values, rates] = of_base;
        [
            values.into_iter().chain(own.clone().map(|own| own.value)).collect(),
            rates.into_iter().chain(own.map(|own| own.rate)).collect(),
        ]
    }

    /// Mass matrix H, bias h [N m, N] and the velocities of the system per unit rate. Where friction depends on normal forces, h
    /// contains the friction of the present ones.
    ///
    /// # Errors
    /// If the coordinates depend on each other at this state, or there are no accelerations.
    pub fn motion(&mut self, session: &Session) -> Result<JointMotion, JointCoordinateError> {
        let system = session.simulation().system();
        let state = recovered(&mut self.recovery, session);
        let mut motion = self.space.motion(system, state)?;
        let forces = actuator_forces(&self.coordinates, system, &state.kinematics);
        motion.bias.iter_mut().zip(forces).for_each(|(bias, force)| *bias += force);
        Ok(motion)
    }

    /// Forces of the actuators [N m, N] at which the coordinates have these accelerations [rad/s², m/s²].
    ///
    /// # Errors
    /// As [`motion`](Self::motion).
    pub fn inverse_dynamics(
        &mut self,
        session: &Session,
        accelerations: &[f64],
    ) -> Result<Vec<f64>, JointCoordinateError> {
        Ok(self.motion(session)?.forces(accelerations))
    }

    /// Names of the components of an output, and their Jacobian: a row for each component, a column for each coordinate. An output
    /// of velocities is differentiated by the rates, any other by the coordinates.
    ///
    /// # Errors
    /// If there is no such output, if it depends on accelerations or forces, or the coordinates depend on each other.
    pub fn jacobian(
        &mut self,
        session: &Session,
        output: &str,
    ) -> Result<(Vec<String>, Vec<Vec<f64>>), JointCoordinateError> {
        let channels = session.observed().channels();
        let channel = channels.iter().find(|channel| channel.name == output).ok_or_else(|| {
            let names: Vec<&str> = channels.iter().map(|channel| &*channel.name).collect();
            JointCoordinateError::Output { name: output.to_owned(), known: names.join(", ") }
        })?;
        let none = || JointCoordinateError::NoJacobian(output.to_owned());
        if channel.need() > Need::Velocities {
            return Err(none());
        }
        let simulation = session.simulation();
        let (system, length) = (simulation.system(), simulation.representative().length);
        let state = recovered(&mut self.recovery, session);
        let derivatives = channel.derivatives_at(system, state, length).ok_or_else(none)?;
        let directions = self.space.directions(system, state).map_err(JointCoordinateError::from)?;
        let row = |derivatives: &OutputDerivatives| {
            let is_of_rates = derivatives.by_rate.values().any(|value| *value != 0.0);
            let by = if is_of_rates { &derivatives.by_rate } else { &derivatives.by_place };
            let entry = |column| by.iter().map(|(&row, value)| value * directions[(row, column)]).sum();
            (0..directions.ncols()).map(entry).collect()
        };
        let jacobian = derivatives.iter().map(row).collect();
        Ok((channel.components.clone(), jacobian))
    }
}

/// The present state with velocities that satisfy the constraints.
fn recovered<'a>(recovery: &'a mut Option<Box<Recovery>>, session: &'a Session) -> &'a State {
    let simulation = session.simulation();
    let at = (simulation.system(), simulation.state());
    let found = recovery
        .as_mut()
        .and_then(|recovery| recovery.recover(Need::Velocities, at, simulation.step_of_rates()));
    found.map_or(at.1, |recovered| &recovered.rates)
}

/// Present forces of the actuators on the rates of the coordinates: their power at unit rates. A base has none: they act between parts.
fn actuator_forces(coordinates: &JointCoordinates, system: &System, at: &Kinematics) -> Vec<f64> {
    let mut moving = at.clone();
    for node in &mut moving.nodes {
        node.twist = Vector6::zeros();
    }
    for own in &mut moving.coordinates {
        own.rate = 0.0;
    }
    let force = |&own: &CoordinateId| {
        moving.coordinates[own].rate = 1.0;
        // Signals may depend on the rates: their values are those of the motion.
        let of = |&element| match (system.scaled_power(element, at), system.scaled_power(element, &moving)) {
            (Some(now), Some(moving)) => now.size * moving.unit,
            _ => system.power(element, &moving),
        };
        let force: f64 = coordinates.actuators().iter().map(of).sum();
        moving.coordinates[own].rate = 0.0;
        force
    };
    let of_base = if coordinates.base().is_some() { 6 } else { 0 };
    std::iter::repeat_n(0.0, of_base).chain(coordinates.ids().iter().map(force)).collect()
}
