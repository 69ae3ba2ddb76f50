//! Groups of unknowns that are eliminated together, and what they hang on.

use lissom_solver::Group;

use super::Builder;
use super::rolling::Impulse;
use crate::kinematics::Layout;
use crate::system::places::free_rows;

impl Builder {
    /// One group per node and per coordinate, then one per joint and drive, after all that it acts on.
    pub(super) fn groups(&self, layout: &Layout) -> Vec<Group> {
        let mut groups = Vec::new();
        let mut of_node = vec![None; self.nodes.len()];
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
        for Impulse { coordinate, nodes, coordinates } in &self.impulses {
            let nodes = nodes.iter().filter_map(|&node| of_node[node]);
            groups[first_coordinate + coordinate].hosts =
                nodes.chain(coordinates.iter().map(|own| first_coordinate + own)).collect();
        }
        let multipliers = layout.coordinate_count;
        for joint in &self.joints {
            let first = multipliers + joint.first_multiplier;
            let mut hosts: Vec<usize> = joint.frames.iter().filter_map(|frame| of_node[frame.node]).collect();
            hosts.extend(joint.coordinates.iter().map(|&coordinate| first_coordinate + coordinate));
            hosts.dedup();
            groups.push(Group { unknowns: (first..first + joint.equations()).collect(), hosts });
        }
        for drive in &self.drives {
            groups.push(Group {
                unknowns: vec![multipliers + drive.multiplier],
                hosts: vec![first_coordinate + drive.prescribed.coordinate],
            });
        }
        for coupling in &self.couplings {
            let hosts = coupling.coordinates.iter().map(|&coordinate| first_coordinate + coordinate);
            groups.push(Group { unknowns: vec![multipliers + coupling.multiplier], hosts: hosts.collect() });
        }
        for slider in &self.sliders {
            let first = multipliers + slider.first_multiplier;
            let nodes = slider.nodes.iter().chain([&slider.tip]).filter_map(|own| of_node[own.node]);
            let mut hosts: Vec<usize> = nodes.chain([first_coordinate + slider.coordinate]).collect();
            hosts.sort_unstable();
            hosts.dedup();
            groups.push(Group { unknowns: (first..first + slider.equations()).collect(), hosts });
        }
        groups
    }
}
