//! Reverse Cuthill-McKee on groups: the order for profile storage.
//!
//! The traversal is that of Cuthill and of `McKee` 1969, reversed after George 1971; it starts from a peripheral node
//! found as in George, Liu 1979. Groups with hosts are omitted from the traversal and placed after the last of their
//! hosts.

use super::GroupGraph;
use crate::structure::{Structure, in_host_order};

/// Elimination order of the groups with a small profile. Every group directly follows its last host. Deterministic.
///
/// # Panics
/// If [`Structure::check`] rejects the structure.
pub fn profile_order(structure: &Structure) -> Vec<usize> {
    let walk = Walk::new(structure);
    let mut reached = vec![false; structure.groups.len()];
    let mut order = Vec::with_capacity(structure.groups.len());
    for seed in 0..structure.groups.len() {
        if structure.groups[seed].hosts.is_empty() && !reached[seed] {
            let start = walk.peripheral(seed);
            walk.breadth_first(start, &mut reached, &mut order);
        }
    }
    let order = in_host_order(&structure.groups, order.into_iter().rev());
    assert_eq!(order.len(), structure.groups.len(), "hosts form no cycle");
    order
}

/// Coupling of groups without hosts, directly or through one group with hosts.
struct Walk {
    neighbours: Vec<Vec<u32>>,
}

impl Walk {
    fn new(structure: &Structure) -> Walk {
        let graph = GroupGraph::new(structure);
        let is_guest = |group: u32| !structure.groups[group as usize].hosts.is_empty();
        let mut seen = vec![u32::MAX; graph.len()];
        let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); graph.len()];
        for group in 0..graph.len() {
            let mark = group as u32;
            if is_guest(mark) {
                continue;
            }
            seen[group] = mark;
            let mut direct = Vec::new();
            for &other in graph.neighbours(group) {
                let through = if is_guest(other) { graph.neighbours(other as usize) } else { &[] };
                for &reached in through.iter().chain(std::iter::once(&other)) {
                    if !is_guest(reached) && seen[reached as usize] != mark {
                        seen[reached as usize] = mark;
                        direct.push(reached);
                    }
                }
            }
            neighbours[group] = direct;
        }
        let degrees: Vec<usize> = neighbours.iter().map(Vec::len).collect();
        for list in &mut neighbours {
            list.sort_unstable_by_key(|&other| (degrees[other as usize], other));
        }
        Walk { neighbours }
    }

    /// Appends all reachable nodes, level by level, and returns the beginning of the last level in the order and the
    /// number of levels.
    fn breadth_first(&self, start: usize, reached: &mut [bool], order: &mut Vec<usize>) -> (usize, usize) {
        reached[start] = true;
        let mut level = order.len();
        let mut levels = 1;
        order.push(start);
        loop {
            let end = order.len();
            for position in level..end {
                for &other in &self.neighbours[order[position]] {
                    if !reached[other as usize] {
                        reached[other as usize] = true;
                        order.push(other as usize);
                    }
                }
            }
            if order.len() == end {
                return (level, levels);
            }
            level = end;
            levels += 1;
        }
    }

    /// A group far from the others of its component.
    fn peripheral(&self, seed: usize) -> usize {
        let mut reached = vec![false; self.neighbours.len()];
        let mut order = Vec::new();
        let (mut start, mut depth) = (seed, 0);
        loop {
            let (last, levels) = self.breadth_first(start, &mut reached, &mut order);
            if levels <= depth {
                return start;
            }
            depth = levels;
            let candidates = order[last..].iter();
            let farthest = candidates.min_by_key(|&&group| (self.neighbours[group].len(), group));
            start = *farthest.expect("the last level is not empty");
            for &group in &order {
                reached[group] = false;
            }
            order.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::pattern::Pattern;

    #[test]
    fn a_shuffled_chain_is_walked_from_end_to_end() {
        let chain = [4, 0, 6, 2, 5, 1, 3];
        let links: Vec<[usize; 2]> = chain.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let pattern = Pattern::from_cliques(7, links.iter().map(|link| &link[..]));
        let order = profile_order(&Structure::ungrouped(Arc::new(pattern)));
        assert!(order == chain || order.iter().rev().eq(&chain));
    }
}
