//! Frames fixed to nodes.

use lissom_motion::Motion;

use super::{Kinematics, NodeId};

/// A joint frame: a frame fixed to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarriedFrame {
    /// Node of the frame.
    pub node: NodeId,
    /// The frame relative to the node's frame.
    pub offset: Motion,
}

impl CarriedFrame {
    /// The origin of a node's frame, in its axes.
    pub fn of_node(node: NodeId) -> Self {
        Self { node, offset: Motion::identity() }
    }

    /// The frame in the inertial frame.
    pub fn frame(&self, at: &Kinematics) -> Motion {
        at.nodes[self.node].frame * self.offset
    }
}
