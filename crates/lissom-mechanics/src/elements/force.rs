//! Force on a point of a node: dead (fixed direction) or follower (turning with the node).

use lissom_motion::{Vector3, skew};

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Load, Symmetric, Tangents, Unknowns, add_block};
use crate::kinematics::{Kinematics, NodeId, is_along};
use crate::ports::Ports;
use crate::registry::{Function, Parameter, ParameterError, ParameterType, Parameters, required, unitless};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "force",
    summary: "Force on a point, of fixed direction or rotating with the node, scaled by a function of time.",
    sample: "vector = [0.0, 0.0, 1.0]\nscale = \"10*sin(t)\"",
    parameters: LOAD_PARAMETERS,
    ports: Ports::ONE_NODE,
    build,
};

/// Parameters that a force and a moment share.
pub(super) const LOAD_PARAMETERS: &[Parameter] = &[
    required(
        "vector",
        ParameterType::GlobalVector,
        "N or N m",
        "Force or moment at scale 1, in global axes at the start.",
    ),
    unitless("scale", ParameterType::Size, "Factor.").or_number(1.0),
    unitless(
        "follower",
        ParameterType::Flag,
        "Whether it rotates with the node; otherwise its direction is fixed.",
    )
    .or_flag(false),
];

/// Force on a point of a node.
#[derive(Clone, Debug)]
pub struct Force {
    node: [NodeId; 1],
    point: Vector3,
    load: DirectedLoad,
}

/// A vector times a function of time, fixed in inertial or in body axes.
#[derive(Clone, Debug)]
pub(super) struct DirectedLoad {
    vector: Vector3,
    scale: Function,
    pub(super) follower: bool,
}

impl DirectedLoad {
    /// Reads the parameters; a follower's vector is transformed into the node's axes at the start.
    pub(super) fn new(
        model: &InitialModel,
        node: NodeId,
        parameters: &Parameters,
    ) -> Result<Self, ParameterError> {
        let follower = parameters.flag("follower")?;
        if follower && model.nodes[node].freedoms.is_point() {
            let problem = "rotates with the node, and a point mass has no rotation: remove it, or make the point mass a body";
            return Err(ParameterError::new("follower", problem));
        }
        let vector = parameters.vector("vector")?;
        let vector = if follower { model.frame(node).rotation.apply_inverse(&vector) } else { vector };
        Ok(Self { vector, scale: parameters.function("scale")?, follower })
    }

    /// Breakpoints of the function [s].
    pub(super) fn breakpoints(&self) -> Vec<f64> {
        self.scale.breakpoints()
    }

    /// Whether it is the same however far its node has turned about an axis.
    pub(super) fn is_symmetric_about(&self, axis: &Vector3) -> bool {
        !self.follower || is_along(&self.vector, axis)
    }

    /// The load in the node's axes.
    pub(super) fn in_body(&self, at: &Kinematics, node: NodeId) -> Vector3 {
        let load = self.scale.value(at.time) * self.vector;
        if self.follower { load } else { at.nodes[node].frame.rotation.apply_inverse(&load) }
    }
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (node, point) = attached.one_node()?;
    let load = DirectedLoad::new(model, node, parameters)?;
    Ok(Contribution::of(model, Force { node: [node], point, load }))
}

impl Element for Force {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.node)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let force = self.load.in_body(at, self.node[0]);
        let moment = self.point.cross(&force);
        for k in 0..3 {
            out[k] -= force[k];
            out[3 + k] -= moment[k];
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        if !self.load.follower {
            // δ(Rᵀ f) = (Rᵀ f)~ δθ
            let turning = skew(&self.load.in_body(at, self.node[0]));
            add_block(&mut out.stiffness, 6, (0, 3), &-turning);
            add_block(&mut out.stiffness, 6, (3, 3), &(-skew(&self.point) * turning));
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), symmetry: Some(self), ..Capabilities::default() }
    }
}

impl Symmetric for Force {
    fn is_symmetric_about(&self, node: NodeId, axis: &Vector3) -> bool {
        self.node == [node] && is_along(&self.point, axis) && self.load.is_symmetric_about(axis)
    }
}

impl Load for Force {
    fn breakpoints(&self) -> Vec<f64> {
        self.load.breakpoints()
    }
}
