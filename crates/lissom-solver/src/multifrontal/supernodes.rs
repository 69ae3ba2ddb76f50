//! Groups that are eliminated in one front: the tree of groups is contracted where a larger dense front costs less
//! time than two small ones, then traversed in postorder. Uses sizes only, no patterns of single unknowns.

use super::elimination_tree::{EliminationTree, NONE};

/// Pivots and boundary unknowns of the largest front that is eliminated pivot by pivot. A multiple of the padding of fronts.
pub(super) const MAX_SMALL: usize = 24;

/// Groups eliminated in one front.
pub(super) struct Supernode {
    /// Positions of its groups in the order of elimination, ascending.
    pub(super) groups: Vec<u32>,
    /// Supernodes that contribute to it, by their index in postorder, ascending.
    pub(super) children: Vec<usize>,
    /// Time its front takes, in the units of [`cost`].
    pub(super) time: f64,
}

/// Time that a front takes for one factorisation and the solves that follow it, in cycles of a processor with vectors of eight
/// numbers. Only ratios matter, and only roughly.
mod cost {
    /// Typical number of solves with the same factors.
    pub(super) const SOLVES: f64 = 20.0;
    /// Numbers in a vector register.
    pub(super) const LANES: f64 = 8.0;

    /// A small front: overhead, and for each vector that is changed by a pivot; in solves, for each vector that is
    /// read.
    pub(super) const SMALL: f64 = 300.0;
    pub(super) const SMALL_UPDATE: f64 = 2.0;
    pub(super) const SMALL_SOLVE: f64 = 45.0;
    pub(super) const SMALL_FACTOR: f64 = 1.75;

    /// A large front: overhead, each pivot, on whose reciprocal all others depend, each factor, each entry of the
    /// contribution, each multiplication.
    /// contribution, each multiplication.
    pub(super) const LARGE: f64 = 330.0;
    pub(super) const PIVOT: f64 = 33.0;
    pub(super) const FACTOR: f64 = 1.3;
    pub(super) const CONTRIBUTION: f64 = 1.3;
    pub(super) const PRODUCT: f64 = 0.22;
    /// A large front in solves: overhead, each pivot, each factor.
    pub(super) const LARGE_SOLVE: f64 = 120.0;
    pub(super) const PIVOT_SOLVE: f64 = 10.0;
    pub(super) const FACTOR_SOLVE: f64 = 0.125;
}

fn time(pivots: f64, boundary: f64) -> f64 {
    let largest = MAX_SMALL as f64;
    let vectors = |rows: f64| (rows / cost::LANES).ceil();
    let (factorisation, solve) = if pivots <= largest && boundary <= largest {
        let size = pivots + boundary;
        let read = pivots * vectors(boundary) + size * vectors(pivots);
        (
            cost::SMALL + cost::SMALL_UPDATE * pivots * size * vectors(size),
            cost::SMALL_SOLVE + cost::SMALL_FACTOR * read,
        )
    } else {
        let factors = pivots * (pivots + 2.0 * boundary);
        let products = pivots * (pivots * pivots / 3.0 + pivots * boundary + boundary * boundary);
        (
            cost::LARGE
                + cost::PIVOT * pivots
                + cost::FACTOR * factors
                + cost::CONTRIBUTION * boundary * boundary
                + cost::PRODUCT * products,
            cost::LARGE_SOLVE + cost::PIVOT_SOLVE * pivots + cost::FACTOR_SOLVE * factors,
        )
    };
    factorisation + cost::SOLVES * solve
}

/// The supernodes in postorder.
pub(super) fn supernodes(tree: &EliminationTree) -> Vec<Supernode> {
    let mut contraction = Contraction::new(tree);
    for place in 0..tree.parents.len() {
        contraction.absorb_children(place);
    }
    contraction.postorder()
}

/// The tree during contraction. A supernode is identified by the last of its groups.
struct Contraction {
    parents: Vec<u32>,
    children: Vec<Vec<u32>>,
    groups: Vec<Vec<u32>>,
    pivots: Vec<f64>,
    boundaries: Vec<f64>,
}

impl Contraction {
    fn new(tree: &EliminationTree) -> Contraction {
        let count = tree.parents.len();
        let mut children = vec![Vec::new(); count];
        for (place, &parent) in tree.parents.iter().enumerate() {
            if parent != NONE {
                children[parent as usize].push(place as u32);
            }
        }
        let weight = |&place: &u32| f64::from(tree.weights[place as usize]);
        Contraction {
            parents: tree.parents.clone(),
            children,
            groups: (0..count as u32).map(|place| vec![place]).collect(),
            pivots: (0..count as u32).map(|place| weight(&place)).collect(),
            boundaries: tree.boundaries.iter().map(|boundary| boundary.iter().map(weight).sum()).collect(),
        }
    }

    /// Merges with a node those children that reduce the total cost, those with the largest fronts first.
    fn absorb_children(&mut self, node: usize) {
        let mut candidates = std::mem::take(&mut self.children[node]);
        let front = |child: u32| self.pivots[child as usize] + self.boundaries[child as usize];
        candidates.sort_by(|&a, &b| front(b).total_cmp(&front(a)).then(a.cmp(&b)));
        for child in candidates {
            let index = child as usize;
            let apart = time(self.pivots[index], self.boundaries[index])
                + time(self.pivots[node], self.boundaries[node]);
            let together = time(self.pivots[index] + self.pivots[node], self.boundaries[node]);
            if together <= apart {
                self.pivots[node] += self.pivots[index];
                let groups = std::mem::take(&mut self.groups[index]);
                self.groups[node].extend(groups);
                for grandchild in std::mem::take(&mut self.children[index]) {
                    self.parents[grandchild as usize] = node as u32;
                    self.children[node].push(grandchild);
                }
            } else {
                self.children[node].push(child);
            }
        }
        self.groups[node].sort_unstable();
    }

    /// Children before parents, each child directly after its own children. Of several children the first is the one
    /// whose subtree needs the most memory beyond its contribution (Liu 1986, ACM Trans. Math. Softw. 12, 249).
    fn postorder(mut self) -> Vec<Supernode> {
        let count = self.parents.len();
        let mut needs = vec![0.0; count];
        for node in 0..count {
            if self.groups[node].is_empty() {
                continue;
            }
            let mut children = std::mem::take(&mut self.children[node]);
            let left = |child: u32| self.boundaries[child as usize].powi(2);
            let excess = |child: u32| needs[child as usize] - left(child);
            children.sort_by(|&a, &b| excess(b).total_cmp(&excess(a)).then(a.cmp(&b)));
            let (mut held, mut peak) = (0.0, 0.0_f64);
            for &child in &children {
                peak = peak.max(held + needs[child as usize]);
                held += left(child);
            }
            needs[node] = peak.max(held + self.boundaries[node].powi(2));
            self.children[node] = children;
        }

        let mut numbers = vec![NONE; count];
        let mut order: Vec<Supernode> = Vec::new();
        let roots = (0..count).filter(|&node| !self.groups[node].is_empty() && self.parents[node] == NONE);
        for root in roots.collect::<Vec<_>>() {
            let mut stack = vec![(root, 0)];
            while let Some((node, next)) = stack.pop() {
                if let Some(&child) = self.children[node].get(next) {
                    stack.push((node, next + 1));
                    stack.push((child as usize, 0));
                    continue;
                }
                numbers[node] = order.len() as u32;
                let children = self.children[node].iter().map(|&child| numbers[child as usize] as usize);
                order.push(Supernode {
                    time: time(self.pivots[node], self.boundaries[node]),
                    children: children.collect(),
                    groups: std::mem::take(&mut self.groups[node]),
                });
            }
        }
        order
    }
}
