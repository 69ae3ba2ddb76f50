//! The graph whose nodes are groups and whose edges are couplings between their unknowns.

use crate::structure::Structure;

/// Adjacency of groups in compressed form, each list ascending and without the group itself.
pub(crate) struct GroupGraph {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
    /// Number of unknowns in each group.
    pub(crate) weights: Vec<u32>,
}

impl GroupGraph {
    /// Couplings of the pattern, and of each group with its hosts.
    pub(crate) fn new(structure: &Structure) -> GroupGraph {
        let groups = &structure.groups;
        let mut group_of = vec![0_u32; structure.pattern.size()];
        for (index, group) in groups.iter().enumerate() {
            for &unknown in &group.unknowns {
                group_of[unknown] = index as u32;
            }
        }
        let mut guests: Vec<Vec<u32>> = vec![Vec::new(); groups.len()];
        for (index, group) in groups.iter().enumerate() {
            for &host in &group.hosts {
                guests[host].push(index as u32);
            }
        }
        let mut starts = vec![0];
        let mut neighbours = Vec::new();
        let mut seen = vec![u32::MAX; groups.len()];
        for (index, group) in groups.iter().enumerate() {
            let begin = neighbours.len();
            let mark = index as u32;
            seen[index] = mark;
            let mut visit = |other: u32| {
                if seen[other as usize] != mark {
                    seen[other as usize] = mark;
                    neighbours.push(other);
                }
            };
            for &unknown in &group.unknowns {
                structure.pattern.column(unknown).iter().for_each(|&row| visit(group_of[row]));
            }
            group.hosts.iter().for_each(|&host| visit(host as u32));
            guests[index].iter().for_each(|&guest| visit(guest));
            neighbours[begin..].sort_unstable();
            starts.push(neighbours.len());
        }
        let weights = groups.iter().map(|group| group.unknowns.len() as u32).collect();
        GroupGraph { starts, neighbours, weights }
    }

    /// Groups that have a common neighbour, or are neighbours: couplings in AᵀA.
    pub(crate) fn square(&self) -> GroupGraph {
        let mut starts = vec![0];
        let mut neighbours = Vec::new();
        let mut seen = vec![u32::MAX; self.len()];
        for group in 0..self.len() {
            let (begin, mark) = (neighbours.len(), group as u32);
            seen[group] = mark;
            for &near in self.neighbours(group) {
                for &next in std::iter::once(&near).chain(self.neighbours(near as usize)) {
                    if std::mem::replace(&mut seen[next as usize], mark) != mark {
                        neighbours.push(next);
                    }
                }
            }
            neighbours[begin..].sort_unstable();
            starts.push(neighbours.len());
        }
        GroupGraph { starts, neighbours, weights: self.weights.clone() }
    }

    pub(crate) fn len(&self) -> usize {
        self.weights.len()
    }

    pub(crate) fn neighbours(&self, group: usize) -> &[u32] {
        &self.neighbours[self.starts[group]..self.starts[group + 1]]
    }
}
