//! Orders of elimination of groups. In both, every group follows all of its hosts, close to the last of them. They
//! use the pattern, not values.

mod group_graph;
mod minimum_degree;
mod profile;

pub(crate) use group_graph::GroupGraph;
pub(crate) use minimum_degree::column_order;
pub use minimum_degree::minimum_degree_order;
pub use profile::profile_order;

use crate::structure::Group;

/// Counts the remaining hosts of every group as groups are placed.
pub(crate) struct HostCount {
    remaining: Vec<u32>,
    guests: Vec<Vec<u32>>,
}

impl HostCount {
    pub(crate) fn new(groups: &[Group]) -> HostCount {
        let mut remaining = vec![0; groups.len()];
        let mut guests = vec![Vec::new(); groups.len()];
        for (index, group) in groups.iter().enumerate() {
            for &host in &group.hosts {
                // A host named twice is still one host.
                if guests[host].last() != Some(&(index as u32)) {
                    guests[host].push(index as u32);
                    remaining[index] += 1;
                }
            }
        }
        HostCount { remaining, guests }
    }

    /// Whether the group may be placed now.
    pub(crate) fn is_free(&self, group: usize) -> bool {
        self.remaining[group] == 0
    }

    /// Records that the group has been placed, and appends the groups whose last host it was.
    pub(crate) fn place(&mut self, group: usize, freed: &mut Vec<u32>) {
        for &guest in &self.guests[group] {
            let remaining = &mut self.remaining[guest as usize];
            *remaining -= 1;
            if *remaining == 0 {
                freed.push(guest);
            }
        }
    }
}

/// The given order of the groups without hosts, with every other group directly after the last of its hosts. Groups
/// whose hosts form a cycle are omitted.
pub(crate) fn in_host_order(groups: &[Group], preferred: impl IntoIterator<Item = usize>) -> Vec<usize> {
    let mut hosts = HostCount::new(groups);
    let mut order = Vec::with_capacity(groups.len());
    let mut freed = Vec::new();
    for group in preferred {
        if groups[group].hosts.is_empty() {
            freed.push(group as u32);
            // A stack places one guest's own guests before the next guest; both orders are valid.
            while let Some(next) = freed.pop() {
                order.push(next as usize);
                hosts.place(next as usize, &mut freed);
            }
        }
    }
    order
}
