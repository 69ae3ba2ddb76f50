//! A tree of boxes around nodes, for finding those near a straight line.

use crate::vectors::{difference, length};

/// Nodes of a box that is not divided further.
const LEAF: usize = 8;

/// Box around the nodes from `start` to `end`, and its two halves.
struct Branch {
    low: [f64; 3],
    high: [f64; 3],
    start: usize,
    end: usize,
    halves: Option<[usize; 2]>,
}

/// Boxes around nodes; every box with many nodes is divided in two with equally many.
pub(crate) struct NodeTree<'a> {
    positions: &'a [[f64; 3]],
    nodes: Vec<usize>,
    branches: Vec<Branch>,
}

impl<'a> NodeTree<'a> {
    /// The tree of some of the nodes.
    pub(crate) fn new(positions: &'a [[f64; 3]], nodes: Vec<usize>) -> Self {
        let count = nodes.len();
        let mut tree = Self { positions, nodes, branches: Vec::new() };
        tree.build(0, count);
        tree
    }

    fn build(&mut self, start: usize, end: usize) -> usize {
        let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for &node in &self.nodes[start..end] {
            for axis in 0..3 {
                low[axis] = low[axis].min(self.positions[node][axis]);
                high[axis] = high[axis].max(self.positions[node][axis]);
            }
        }
        let own = self.branches.len();
        self.branches.push(Branch { low, high, start, end, halves: None });
        if end - start > LEAF {
            let extent = difference(high, low);
            let axis = (1..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
            let (middle, positions) = ((end - start) / 2, self.positions);
            self.nodes[start..end]
                .select_nth_unstable_by(middle, |&a, &b| positions[a][axis].total_cmp(&positions[b][axis]));
            let halves = [self.build(start, start + middle), self.build(start + middle, end)];
            self.branches[own].halves = Some(halves);
        }
        own
    }

    /// Nodes in boxes at most `distance` beside the line between two positions, until `visit` returns true.
    pub(crate) fn near_line(&self, ends: [[f64; 3]; 2], distance: f64, mut visit: impl FnMut(usize) -> bool) {
        let mut waiting = vec![0];
        while let Some(branch) = waiting.pop().map(|index| &self.branches[index]) {
            if !branch.is_near(ends, distance) {
                continue;
            }
            if let Some(halves) = branch.halves {
                waiting.extend(halves);
            } else if self.nodes[branch.start..branch.end].iter().any(|&node| visit(node)) {
                return;
            }
        }
    }
}

impl Branch {
    /// Whether the line enters the box, enlarged by a distance.
    fn is_near(&self, [from, to]: [[f64; 3]; 2], distance: f64) -> bool {
        let direction = difference(to, from);
        let [mut first, mut last] = [0.0_f64, 1.0_f64];
        for axis in 0..3 {
            let [low, high] =
                [self.low[axis] - distance - from[axis], self.high[axis] + distance - from[axis]];
            if direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let [a, b] = [low / direction[axis], high / direction[axis]];
            first = first.max(a.min(b));
            last = last.min(a.max(b));
        }
        first <= last
    }
}

/// Position along a line, from 0 to 1, and distance from it.
pub(crate) fn along(position: [f64; 3], [from, to]: [[f64; 3]; 2]) -> (f64, f64) {
    let (direction, offset) = (difference(to, from), difference(position, from));
    let squared = crate::vectors::dot(direction, direction);
    let parameter = crate::vectors::dot(offset, direction) / squared;
    (parameter, length(difference(offset, direction.map(|component| parameter * component))))
}

#[cfg(test)]
#[path = "../../tests/unit/surface/node_tree.rs"]
mod tests;
