//! Groups of unknowns that are eliminated together, and their dependencies.

use lissom_solver::Group;

use super::Builder;
use crate::constraints::group_of;
use lissom_mechanics::evaluation::scatter_map::free_rows;
use lissom_mechanics::kinematics::Layout;

impl Builder {
    /// One group per node and per coordinate, then one per constraint, after all on which it acts.
    pub(super) fn groups(&self, layout: &Layout) -> Vec<Group> {
        let mut groups = Vec::new();
        let mut of_node = vec![None; self.model.nodes.len()];
        for (node, rows) in layout.node_rows.iter().enumerate() {
            let unknowns = free_rows(rows);
            if !unknowns.is_empty() {
                of_node[node] = Some(groups.len());
                groups.push(Group { unknowns, hosts: Vec::new() });
            }
        }
        let first_coordinate = groups.len();
        groups.extend(
            layout
                .coordinate_rows
                .iter()
                .map(|&row| Group { unknowns: vec![row as usize], hosts: Vec::new() }),
        );
        let hosts = (&of_node[..], first_coordinate);
        groups.extend(self.constraints.iter().map(|constraint| group_of(constraint, layout, hosts)));
        groups
    }
}
