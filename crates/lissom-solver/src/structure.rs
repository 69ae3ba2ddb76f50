//! Structural input of a solver: the pattern, and which unknowns are eliminated together and after which others.
//! Independent of the meaning of the unknowns.

use std::sync::Arc;

use crate::pattern::Pattern;

/// A set of unknowns that is eliminated together, in the given order: the coordinates of a node, or the multipliers
/// of one joint.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// The unknowns, in their order of elimination.
    pub unknowns: Vec<usize>,
    /// The groups on whose coordinates the equations of this group act. Without pivoting it must be eliminated after
    /// all of them, and follows the last one directly. Empty for coordinates.
    pub hosts: Vec<usize>,
}

/// Pattern and groups of a family of matrices. The groups partition the unknowns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Structure {
    /// Positions of the entries.
    pub pattern: Arc<Pattern>,
    /// Unknowns that are eliminated together.
    pub groups: Vec<Group>,
}

/// An error in a [`Structure`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StructureError {
    /// A group names an unknown that does not exist.
    #[error("group {group} names unknown {unknown}, but there are only {size}")]
    UnknownOutOfRange {
        /// The group.
        group: usize,
        /// The unknown.
        unknown: usize,
        /// Number of unknowns.
        size: usize,
    },
    /// An unknown is in no group.
    #[error("unknown {unknown} is in no group")]
    Ungrouped {
        /// The unknown.
        unknown: usize,
    },
    /// An unknown is in more than one group, or twice in one.
    #[error("unknown {unknown} appears again in group {group}")]
    Repeated {
        /// The unknown.
        unknown: usize,
        /// The group of its second appearance.
        group: usize,
    },
    /// A group names a host that does not exist.
    #[error("group {group} names host group {host}, but there are only {groups}")]
    HostOutOfRange {
        /// The group.
        group: usize,
        /// The host.
        host: usize,
        /// Number of groups.
        groups: usize,
    },
    /// Hosts form a cycle.
    #[error("group {group} is, by way of its hosts, to be eliminated after itself")]
    CyclicHosts {
        /// A group on the cycle or after it.
        group: usize,
    },
}

impl Structure {
    /// Pattern and groups, checked.
    ///
    /// # Errors
    /// If the groups do not partition the unknowns or their hosts cannot be eliminated first.
    pub fn new(pattern: Arc<Pattern>, groups: Vec<Group>) -> Result<Structure, StructureError> {
        let structure = Structure { pattern, groups };
        structure.check()?;
        Ok(structure)
    }

    /// The structure in which every unknown is a group of its own, without hosts.
    pub fn ungrouped(pattern: Arc<Pattern>) -> Structure {
        let groups =
            (0..pattern.size()).map(|unknown| Group { unknowns: vec![unknown], hosts: vec![] }).collect();
        Structure { pattern, groups }
    }

    /// Whether the groups partition the unknowns and their hosts can be eliminated first.
    ///
    /// # Errors
    /// The first fault found.
    pub fn check(&self) -> Result<(), StructureError> {
        let size = self.pattern.size();
        let mut seen = vec![false; size];
        for (group, Group { unknowns, hosts }) in self.groups.iter().enumerate() {
            for &unknown in unknowns {
                if unknown >= size {
                    return Err(StructureError::UnknownOutOfRange { group, unknown, size });
                }
                if std::mem::replace(&mut seen[unknown], true) {
                    return Err(StructureError::Repeated { unknown, group });
                }
            }
            if let Some(&host) = hosts.iter().find(|&&host| host >= self.groups.len()) {
                return Err(StructureError::HostOutOfRange { group, host, groups: self.groups.len() });
            }
        }
        if let Some(unknown) = seen.iter().position(|&seen| !seen) {
            return Err(StructureError::Ungrouped { unknown });
        }
        let order = in_host_order(&self.groups, 0..self.groups.len());
        let mut placed = vec![false; self.groups.len()];
        for group in order {
            placed[group] = true;
        }
        match placed.iter().position(|&placed| !placed) {
            Some(group) => Err(StructureError::CyclicHosts { group }),
            None => Ok(()),
        }
    }

    /// The unknowns in the order of elimination, for an order of the groups.
    pub(crate) fn unknowns_in_order(&self, order: &[usize]) -> Vec<usize> {
        order.iter().flat_map(|&group| self.groups[group].unknowns.iter().copied()).collect()
    }
}

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

#[cfg(test)]
#[path = "../tests/unit/structure.rs"]
mod tests;
