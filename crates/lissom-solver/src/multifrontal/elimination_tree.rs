//! Elimination tree of groups: the couplings that remain after the elimination of a group, and the dependencies.
//! Groups are dense blocks, identified by their position in the order of elimination.

use crate::ordering::GroupGraph;

pub(super) const NONE: u32 = u32::MAX;

/// All indices are positions in the order of elimination.
pub(super) struct EliminationTree {
    /// Unknowns in each group.
    pub(super) weights: Vec<u32>,
    /// The first group that is coupled with a group after its elimination, or [`NONE`].
    pub(super) parents: Vec<u32>,
    /// All groups that are, unsorted.
    pub(super) boundaries: Vec<Vec<u32>>,
}

impl EliminationTree {
    /// The tree of a graph eliminated in the given order: the boundary of a group consists of its own couplings and
    /// those of its children, as far as they come later.
    pub(super) fn new(graph: &GroupGraph, order: &[usize]) -> EliminationTree {
        let count = order.len();
        let mut places = vec![0_u32; count];
        for (place, &group) in order.iter().enumerate() {
            places[group] = place as u32;
        }
        let mut parents = vec![NONE; count];
        let mut boundaries: Vec<Vec<u32>> = Vec::with_capacity(count);
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); count];
        let mut seen = vec![NONE; count];
        for place in 0..count {
            let mark = place as u32;
            seen[place] = mark;
            let mut boundary = Vec::new();
            let mut visit = |other: u32| {
                if other > mark && seen[other as usize] != mark {
                    seen[other as usize] = mark;
                    boundary.push(other);
                }
            };
            for &neighbour in graph.neighbours(order[place]) {
                visit(places[neighbour as usize]);
            }
            for &child in &children[place] {
                boundaries[child as usize].iter().for_each(|&other| visit(other));
            }
            if let Some(&parent) = boundary.iter().min() {
                parents[place] = parent;
                children[parent as usize].push(mark);
            }
            boundaries.push(boundary);
        }
        let weights = order.iter().map(|&group| graph.weights[group]).collect();
        EliminationTree { weights, parents, boundaries }
    }
}
