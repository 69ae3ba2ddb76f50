//! Unknowns of an output.

use std::collections::BTreeSet;

use lissom_mechanics::kinematics::{CoordinateId, NodeId};

/// The unknowns a quantity depends on.
#[derive(Default)]
pub(crate) struct Touched {
    pub(super) nodes: BTreeSet<NodeId>,
    pub(super) coordinates: BTreeSet<CoordinateId>,
}
