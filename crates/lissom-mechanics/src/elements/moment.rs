//! Moment on a node: dead (fixed direction) or follower (rotating with the node).

use lissom_motion::{Vector3, skew};

use super::contribution::Contribution;
use super::force::{DirectedLoad, LOAD_PARAMETERS};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::{Capabilities, Element, Load, Symmetric, Tangents, Unknowns, add_block};
use crate::kinematics::{Kinematics, NodeId};
use crate::ports::Ports;
use crate::registry::{ParameterError, Parameters};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "moment",
    summary: "Moment on a node, of fixed direction or rotating with the node, scaled by a function of time.",
    sample: "vector = [0.0, 0.0, 1.0]\nfollower = true",
    parameters: LOAD_PARAMETERS,
    ports: Ports::ONE_FRAME,
    build,
};

/// Moment on a node.
#[derive(Clone, Debug)]
pub struct Moment {
    node: [NodeId; 1],
    load: DirectedLoad,
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let (node, _) = attached.one_node()?;
    let load = DirectedLoad::new(model, node, parameters)?;
    Ok(Contribution::of(model, Moment { node: [node], load }))
}

impl Element for Moment {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.node)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let moment = self.load.in_body(at, self.node[0]);
        for k in 0..3 {
            out[3 + k] -= moment[k];
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        if !self.load.follower {
            let turning = skew(&self.load.in_body(at, self.node[0]));
            add_block(&mut out.stiffness, 6, (3, 3), &-turning);
        }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), symmetry: Some(self), ..Capabilities::default() }
    }
}

impl Symmetric for Moment {
    fn is_symmetric_about(&self, node: NodeId, axis: &Vector3) -> bool {
        self.node == [node] && self.load.is_symmetric_about(axis)
    }
}

impl Load for Moment {
    fn breakpoints(&self) -> Vec<f64> {
        self.load.breakpoints()
    }
}
