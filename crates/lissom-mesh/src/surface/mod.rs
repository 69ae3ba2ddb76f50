//! Surface meshes: their edges, faults, orientation and division.

pub(crate) mod division;
pub(crate) mod edges;
pub(crate) mod fault;
pub(crate) mod faults;
pub(crate) mod node_tree;
pub(crate) mod orientation;
