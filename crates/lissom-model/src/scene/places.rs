//! Positions of named parts among the nodes.

use lissom_mechanics::kinematics::{GROUND, NodeId, NodeMotion};
use lissom_motion::{Motion, Vector3};
use serde::{Deserialize, Serialize};

use crate::lower::Names;
use crate::reading::node_reference::{NodeReference, interface_name};
use crate::text::report::Located;

/// A position carried by a node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Anchor {
    /// The node.
    pub node: NodeId,
    /// Position in its frame [m].
    pub position: [f64; 3],
}

/// Table of the model file in which a part is: names are unique within a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Table {
    /// Bodies, point masses and beams, which have names in common.
    Parts,
    /// Joints and drives.
    Joints,
    /// Springs.
    Springs,
    /// Loads.
    Loads,
    /// Loads of the local motion.
    LocalLoads,
    /// Superelements.
    Superelements,
}

/// Parts of a model among its nodes, at their start.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    /// Where the parts are among the nodes.
    pub names: &'a Names,
    /// Motions of the nodes.
    pub nodes: &'a [NodeMotion],
    /// Frames of the nodes as the model describes them, where an assembly has moved them.
    pub drawn: Option<&'a [Motion]>,
    /// Whether time represents the growth of loads.
    pub is_static: bool,
}

/// Where named things are among the nodes.
pub(super) struct Places<'a> {
    pub(super) of: &'a Placed<'a>,
}

impl Places<'_> {
    /// The node a reference means; none where a beam has no node there.
    pub(super) fn node(&self, reference: &NodeReference) -> Option<NodeId> {
        let names = self.of.names;
        match reference {
            NodeReference::Ground => Some(GROUND),
            NodeReference::Body(name) | NodeReference::PointMass(name) => names.nodes.get(name).copied(),
            NodeReference::Interface { superelement, interface } => {
                names.nodes.get(&interface_name(superelement, interface)).copied()
            }
            NodeReference::Mesh { part, place } => names.meshes.nodes_of(part)?.middle(place),
            NodeReference::Beam { beam, fraction } => names.lines.get(beam)?.node_at(*fraction),
        }
    }

    /// Pose of a node as the model describes it.
    pub(super) fn frame(&self, node: NodeId) -> Motion {
        self.of.drawn.map_or_else(|| self.of.nodes[node].frame, |drawn| drawn[node])
    }

    /// The position `at` of the model, carried by a node.
    pub(super) fn anchor(&self, reference: &Located<NodeReference>, at: &Vector3) -> Option<Anchor> {
        let node = self.node(&reference.value)?;
        Some(Anchor { node, position: self.frame(node).inverse_transform_point(at).into() })
    }

    /// A direction of the model, in the frame of a node, of length one.
    pub(super) fn direction(&self, node: NodeId, direction: &Vector3) -> [f64; 3] {
        self.frame(node).rotation.apply_inverse(&direction.normalize()).into()
    }

    /// The point that an output observes: a beam's is that of its section, not of the node.
    pub(super) fn observed(&self, reference: &NodeReference, point: Option<&Vector3>) -> Option<Anchor> {
        let node = self.node(reference)?;
        let position = match (point, reference) {
            (Some(point), _) => self.frame(node).inverse_transform_point(point),
            (None, NodeReference::Beam { beam, .. }) => {
                let line = self.of.names.lines.get(beam)?;
                let index = line.nodes.iter().position(|other| *other == node)?;
                line.offsets[index].position
            }
            (None, _) => Vector3::zeros(),
        };
        Some(Anchor { node, position: position.into() })
    }
}

/// Name of the part that a reference belongs to.
pub(super) fn part_of(reference: &NodeReference) -> &str {
    match reference {
        NodeReference::Ground => "ground",
        NodeReference::Body(name) | NodeReference::PointMass(name) => name,
        NodeReference::Beam { beam, .. } => beam,
        NodeReference::Mesh { part, .. } => part,
        NodeReference::Interface { superelement, .. } => superelement,
    }
}

#[cfg(test)]
impl<'a> Placed<'a> {
    /// Places of a model that is not moved before its start.
    pub(crate) fn as_built(built: &'a crate::lower::Built) -> Self {
        let crate::lower::Built { names, state, .. } = built;
        Self { names, nodes: &state.kinematics.nodes, drawn: None, is_static: false }
    }
}
