//! Frames carried by nodes.

use lissom_motion::Motion;

use super::motion::NodeId;

/// A joint frame: a frame carried by a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarriedFrame {
    /// The node that carries it.
    pub node: NodeId,
    /// The frame in the node's frame.
    pub offset: Motion,
}
