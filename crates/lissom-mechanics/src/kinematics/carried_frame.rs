//! Frames fixed to nodes.

use lissom_motion::Motion;

use super::motion::NodeId;

/// A joint frame: a frame fixed to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarriedFrame {
    /// Its node.
    pub node: NodeId,
    /// The frame relative to the node's frame.
    pub offset: Motion,
}
