//! Torque or force in a joint: acts on a relative coordinate, on the tip and with the opposite sign on the base.

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Load, Tangents, Unknowns};
use crate::kinematics::{CoordinateId, Kinematics, Quantity};
use crate::ports::Ports;
use crate::registry::{COORDINATE, Function, ParameterError, ParameterType, Parameters, required};

/// Registry entry of the torque on a rotation.
pub(crate) const TORQUE: ElementKind = ElementKind {
    name: "joint_torque",
    summary: "Torque of an actuator on a joint's relative rotation, from the base on the tip.",
    sample: "torque = \"2*sin(t)\"",
    parameters: &[
        required(
            "torque",
            ParameterType::Size,
            "N m",
            "Torque about the joint's axis, positive where it increases the rotation.",
        ),
        COORDINATE,
    ],
    ports: Ports::ROTATION,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Angle, "torque"),
};

/// Registry entry of the force on a displacement.
pub(crate) const FORCE: ElementKind = ElementKind {
    name: "joint_force",
    summary: "Force of an actuator on a joint's relative displacement, from the base on the tip.",
    sample: "force = \"2*sin(t)\"",
    parameters: &[
        required(
            "force",
            ParameterType::Size,
            "N",
            "Force along the joint's axis, positive where it increases the displacement.",
        ),
        COORDINATE,
    ],
    ports: Ports::DISPLACEMENT,
    build: |model, attached, parameters| add(model, attached, parameters, Quantity::Length, "force"),
};

/// Generalised force on an algebraic coordinate.
#[derive(Clone, Debug)]
pub(crate) struct JointLoad {
    coordinate: [CoordinateId; 1],
    size: Function,
}

fn add(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
    acts_on: Quantity,
    size: &str,
) -> Result<Contribution, ParameterError> {
    let coordinate = attached.coordinate()?;
    model.check_quantity(coordinate, acts_on)?;
    Ok(Contribution::of(model, JointLoad { coordinate: [coordinate], size: parameters.function(size)? }))
}

impl Element for JointLoad {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_coordinates(&self.coordinate)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        out[0] -= self.size.value(at.time);
    }

    fn linearize(&self, _: &Kinematics, _: &mut Tangents) {}

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), ..Capabilities::default() }
    }
}

impl Load for JointLoad {
    fn breakpoints(&self) -> Vec<f64> {
        self.size.breakpoints()
    }
}
