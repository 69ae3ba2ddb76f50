//! Parts of the tree of fronts on which several threads may work: independent subtrees, and the top, which follows. The
//! choice depends on the tree only, not on the number of threads, so that the arithmetic is the same for any number. It
//! uses only the estimated times of fronts.

use std::ops::Range;

use super::supernodes::Supernode;

/// Total time, in the units of the supernodes' model, from which on parallel work is efficient: some 0.2 ms of a
/// factorisation.
const WORTH_WHILE: f64 = 4e6;

/// Number of threads for which the choice is made.
const THREADS: f64 = 4.0;

/// Whole trees, such as those of thousands of free bodies, are combined to about this number of parts: each part has memory of its own.
const MAX_TREES: f64 = 64.0;

/// Maximum number of fronts that are moved to the top in search of a better choice.
const MAX_TOP: usize = 400;

/// The supernodes, grouped by subtree with those of the top last, and the ranges of the groups.
pub(super) struct Subtrees {
    pub(super) nodes: Vec<Supernode>,
    /// Subtrees in order, then the top.
    pub(super) parts: Vec<Range<usize>>,
}

/// Divides a tree in postorder.
pub(super) fn cut(nodes: Vec<Supernode>) -> Subtrees {
    let roots = subtree_roots(&nodes);
    if roots.is_empty() {
        let all = 0..nodes.len();
        return Subtrees { nodes, parts: vec![all] };
    }
    let sizes = accumulated(&nodes, |_| 1.0);
    let times = accumulated(&nodes, |node| node.time);
    let has_parent = with_parent(&nodes);
    let share = times.iter().zip(&has_parent).filter(|(_, has)| !**has).map(|(time, _)| time).sum::<f64>()
        / MAX_TREES;
    let (mut order, mut parts) = (Vec::with_capacity(nodes.len()), Vec::<Range<usize>>::new());
    // Time of the last part, if it consists of whole trees.
    let mut trees: Option<f64> = None;
    let mut is_below = vec![false; nodes.len()];
    for &root in &roots {
        let begin = order.len();
        let subtree = root + 1 - sizes[root] as usize..root + 1;
        is_below[subtree.clone()].fill(true);
        order.extend(subtree);
        let together = trees.filter(|_| !has_parent[root]).map(|time| time + times[root]);
        if let (Some(time), Some(last)) = (together.filter(|time| *time <= share), parts.last_mut()) {
            (last.end, trees) = (order.len(), Some(time));
        } else {
            parts.push(begin..order.len());
            trees = (!has_parent[root]).then_some(times[root]);
        }
    }
    let begin = order.len();
    order.extend((0..nodes.len()).filter(|&node| !is_below[node]));
    parts.push(begin..order.len());

    let mut numbers = vec![0; nodes.len()];
    for (number, &node) in order.iter().enumerate() {
        numbers[node] = number;
    }
    let mut old: Vec<Option<Supernode>> = nodes.into_iter().map(Some).collect();
    let nodes = order.iter().filter_map(|&node| old[node].take()).map(|mut node| {
        node.children.iter_mut().for_each(|child| *child = numbers[*child]);
        node.children.sort_unstable();
        node
    });
    Subtrees { nodes: nodes.collect(), parts }
}

/// Sums over the subtree of every node.
fn accumulated(nodes: &[Supernode], of: impl Fn(&Supernode) -> f64) -> Vec<f64> {
    let mut sums: Vec<f64> = Vec::with_capacity(nodes.len());
    for node in nodes {
        sums.push(of(node) + node.children.iter().map(|&child| sums[child]).sum::<f64>());
    }
    sums
}

/// Which nodes have a parent.
fn with_parent(nodes: &[Supernode]) -> Vec<bool> {
    let mut is_child = vec![false; nodes.len()];
    for &child in nodes.iter().flat_map(|node| &node.children) {
        is_child[child] = true;
    }
    is_child
}

/// Roots of the subtrees, ascending. The root of the costliest subtree is moved to the top repeatedly; the division with
/// the least time is returned.
fn subtree_roots(nodes: &[Supernode]) -> Vec<usize> {
    let times = accumulated(nodes, |node| node.time);
    let is_child = with_parent(nodes);
    let mut roots: Vec<usize> = (0..nodes.len()).filter(|&node| !is_child[node]).collect();
    let total: f64 = roots.iter().map(|&root| times[root]).sum();
    let mut best = (0.9 * total, Vec::new());
    if total < WORTH_WHILE {
        return best.1;
    }
    let mut top = 0.0;
    for _ in 0..MAX_TOP {
        let Some(costliest) = (0..roots.len()).max_by(|&a, &b| times[roots[a]].total_cmp(&times[roots[b]]))
        else {
            break;
        };
        let together = top + times[roots[costliest]].max((total - top) / THREADS);
        if roots.len() > 1 && together < 0.99 * best.0 {
            best = (together, roots.clone());
        }
        let root = roots.swap_remove(costliest);
        top += nodes[root].time;
        roots.extend(&nodes[root].children);
    }
    best.1.sort_unstable();
    best.1
}
