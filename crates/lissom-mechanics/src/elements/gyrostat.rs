//! A rotor that spins at a constant rate about an axis of its body: a gyrostat.
//!
//! Legend: h angular momentum of the spin in body axes, w angular velocity of the body.
//!
//! ```text
//! moment on the left-hand side:  w × h,      by twist  -h~
//! ```
//!
//! The rotor's mass, and its inertia without spin, belong to the body. A motor keeps the spin constant; its work is stored
//! in the rotor and is not part of the model's energy: w·(w × h) = 0. The angular momentum h is part of the model's.

use lissom_motion::{Vector3, rotation_part, skew};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, OwnInertia, Tangents, Unknowns, add_block};
use crate::kinematics::{Kinematics, NodeId};
use crate::ports::Ports;
use crate::registry::ParameterType::{Number, Positive};
use crate::registry::{ParameterError, ParameterType, Parameters, required};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "gyrostat",
    summary: "Rotor in a body, with a constant rate of spin relative to it.",
    sample: "axis = [0.0, 0.0, 1.0]\ninertia = 0.02\nspin = 300.0",
    parameters: &[
        required(
            "axis",
            ParameterType::Direction,
            "",
            "Axis of the rotor at the start, global axes; it rotates with the node.",
        ),
        required("inertia", Positive, "kg m²", "Inertia of the rotor about its axis."),
        required("spin", Number, "rad/s", "Rate of spin relative to the body."),
    ],
    ports: Ports::ONE_FRAME,
    build,
};

/// A constant angular momentum in a node's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyrostat {
    node: [NodeId; 1],
    momentum: Vector3,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (node, _) = attached.one_node()?;
    let axis = model.frame(node).rotation.apply_inverse(&parameters.vector("axis")?.normalize());
    let momentum = parameters.number("inertia")? * parameters.number("spin")? * axis;
    Ok(Contribution::of(model, Gyrostat { node: [node], momentum }))
}

impl Element for Gyrostat {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.node)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let moment = rotation_part(&at.nodes[self.node[0]].twist).cross(&self.momentum);
        for k in 0..3 {
            out[3 + k] += moment[k];
        }
    }

    fn linearize(&self, _: &Kinematics, out: &mut Tangents) {
        add_block(&mut out.damping, 6, (3, 3), &-skew(&self.momentum));
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { inertia: Some(self), ..Capabilities::default() }
    }
}

impl OwnInertia for Gyrostat {
    fn angular_momentum(&self, at: &Kinematics) -> Vector3 {
        at.nodes[self.node[0]].frame.rotation.apply(&self.momentum)
    }
}
