//! Order of elimination of groups: every group follows all of its hosts, close to the last of them. It uses the pattern,
//! not values.

mod dissection;
mod group_graph;
mod minimum_degree;

pub(crate) use group_graph::GroupGraph;
pub use minimum_degree::minimum_degree_order;
pub(crate) use minimum_degree::{column_order, dissected_order};
