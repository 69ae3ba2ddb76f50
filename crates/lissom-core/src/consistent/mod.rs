//! Consistent positions, velocities and accelerations: initial values, mobility, loops and singular positions.

mod driven_start;
pub mod initial_conditions;
mod jump;
pub(crate) mod loops;
pub mod mobility;
mod open_trees;
pub(crate) mod redundancy;
pub(crate) mod rigid;
pub(crate) mod singular_positions;

pub use mobility::{Mobility, Redundant};
