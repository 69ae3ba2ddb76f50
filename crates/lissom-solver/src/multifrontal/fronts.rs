//! Symbolic result of the multifrontal solver: every front's size, position in memory, and the maps of entries and
//! contributions to it. Positions only, no values.
//!
//! A front with `k` pivots and `b` boundary unknowns is stored as three consecutive column-major pieces. A large one
//! has its square (`k` columns, `L11` below and `U11` above the diagonal), the lower panel `L21` and the upper panel
//! `U12ᵀ` (`k` columns of `b` rows each); a small one the inverse of its square, the lower panel `A21 A11⁻¹` and the
//! upper panel `A11⁻¹ A12` (`b` columns of `k` rows), see [`super::small`]. Columns of large fronts are padded to a
//! multiple of [`PADDING`] rows, and so are the pivots of any front in the vector of a solve. Those of small fronts
//! are not, and vectors of their numbers extend into the following data. The contribution of a front to its parent is
//! a square of `b` columns in one of two stacks: the contributions of a front's children are in one stack, its own is
//! in the other.
//!
//! Fronts are divided into independent parts, subtrees first and the top last. Those of a thread use its stacks one after the other;
//! what the root of a subtree contributes to the top is stored apart. After its own steps, each part has positions for its
//! contributions to unknowns outside, those on the boundary of its root. These contributions are added to the top after all subtrees.

use std::ops::Range;

use super::elimination_tree::{EliminationTree, NONE};
use super::subtrees;
use super::supernodes::{MAX_SMALL, Supernode, supernodes};
use crate::ordering::{GroupGraph, dissected_order, minimum_degree_order};
use crate::structure::Structure;

/// Rows of every column, and pivots of every front, are padded to a multiple of this, so that kernels have no
/// remainders.
pub(super) const PADDING: usize = 4;

/// Estimated time, in the units of the supernodes' model, from which on a second order of elimination is tried: some 0.1 s of a
/// factorisation.
const EXPENSIVE: f64 = 4e8;

pub(super) fn padded(rows: usize) -> usize {
    rows.next_multiple_of(PADDING)
}

/// One front.
#[derive(Clone, Debug)]
pub(super) struct Front {
    /// Step of its first pivot.
    pub(super) first: usize,
    pub(super) pivots: usize,
    pub(super) boundary: usize,
    /// Panels stored: only the lower for symmetric matrices, otherwise both.
    pub(super) panels: usize,
    /// Offset of its pieces among the factors.
    pub(super) factors: usize,
    /// Boundary of the front in [`Symbolic::boundaries`].
    pub(super) rows: Range<usize>,
    /// Entries of the front in [`Symbolic::sources`] and [`Symbolic::targets`].
    pub(super) entries: Range<usize>,
    /// Children of the front in [`Symbolic::children`].
    pub(super) children: Range<usize>,
    /// The stack of its contribution, and the position in it.
    pub(super) stack: usize,
    pub(super) contribution: usize,
    /// Whether its contribution is to the top, from the root of a subtree: it is then stored apart.
    pub(super) passes_up: bool,
    /// First position of its boundary, if the positions are consecutive.
    pub(super) span: Option<usize>,
    /// Whether it is eliminated by [`super::small`].
    small: bool,
}

impl Front {
    /// Whether it is eliminated by [`super::small`].
    pub(super) fn is_small(&self) -> bool {
        self.small
    }
    /// Stride of the columns of a small front during elimination.
    pub(super) fn small_stride(&self) -> usize {
        match self.pivots + self.boundary {
            ..=16 => 16,
            17..=24 => 24,
            25..=32 => 32,
            _ => 2 * MAX_SMALL,
        }
    }
    pub(super) fn square_stride(&self) -> usize {
        padded(self.pivots)
    }
    pub(super) fn panel_stride(&self) -> usize {
        padded(self.boundary)
    }
    pub(super) fn square_length(&self) -> usize {
        self.pivots * if self.is_small() { self.pivots } else { self.square_stride() }
    }
    pub(super) fn panel_length(&self) -> usize {
        self.pivots * if self.is_small() { self.boundary } else { self.panel_stride() }
    }
    pub(super) fn factor_range(&self) -> Range<usize> {
        self.factors..self.factors + self.square_length() + self.panels * self.panel_length()
    }
    pub(super) fn contribution_range(&self) -> Range<usize> {
        self.contribution..self.contribution + self.boundary * self.panel_stride()
    }
    /// Length of its contribution to the top.
    pub(super) fn passed_up(&self) -> usize {
        if self.passes_up { self.contribution_range().len() } else { 0 }
    }
}

/// A child's contribution: its source and its target.
#[derive(Clone, Debug)]
pub(super) struct Child {
    /// The part it is in.
    pub(super) part: usize,
    pub(super) contribution: Range<usize>,
    pub(super) stride: usize,
    /// Runs of the child in [`Symbolic::runs`] that are added to pivots of the parent, and those that are added to its
    /// boundary.
    pub(super) to_pivots: Range<usize>,
    pub(super) to_boundary: Range<usize>,
}

/// Consecutive rows of a child that are consecutive in its parent. Rows of the parent are counted from its
/// first pivot, or from its first boundary row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) length: u32,
}

/// A subtree, or the top: the work of one thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub(super) fronts: Range<usize>,
    /// Steps of the part, including the positions for outside unknowns.
    pub(super) steps: Range<usize>,
    /// Positions for outside unknowns, and the steps they represent.
    pub(super) places: Range<usize>,
    pub(super) outside: Vec<u32>,
    pub(super) factors: Range<usize>,
    /// Estimated time, in the units of the supernodes' model.
    pub(super) time: f64,
    pub(super) stack_lengths: [usize; 2],
    pub(super) largest_pivots: usize,
    pub(super) largest_boundary: usize,
    pub(super) largest_panel: usize,
}

impl Part {
    /// Positions of a front's pivots within the part's vector.
    pub(super) fn steps_of(&self, front: &Front) -> Range<usize> {
        let first = front.first - self.steps.start;
        first..first + front.pivots
    }
}

/// The whole symbolic factorisation.
#[derive(Clone, Debug)]
pub(super) struct Symbolic {
    /// Unknown eliminated at each step, [`NONE`] in padding and at positions for unknowns outside a subtree.
    pub(super) unknowns: Vec<u32>,
    /// Step of each unknown.
    pub(super) steps: Vec<u32>,
    /// Subtrees, then the top.
    pub(super) parts: Vec<Part>,
    pub(super) fronts: Vec<Front>,
    /// Steps of the boundary unknowns of all fronts.
    pub(super) boundaries: Vec<u32>,
    /// Their positions for each front, counted from the first step of its part.
    pub(super) places: Vec<u32>,
    /// Indices of values, sorted by front.
    pub(super) sources: Vec<u32>,
    /// Targets of those values, counted from the beginning of the front's pieces.
    pub(super) targets: Vec<u32>,
    pub(super) children: Vec<Child>,
    pub(super) runs: Vec<Run>,
    pub(super) factor_length: usize,
    pub(super) factor_entries: usize,
    /// Whether it is for LDLᵀ, with one panel to a front.
    pub(super) is_symmetric: bool,
    /// Whether small fronts are eliminated by [`super::small`], not like large ones.
    has_small: bool,
}

/// First step of every group, by elimination order, and steps of every front.
struct Numbering {
    firsts: Vec<u32>,
    steps: Vec<Range<usize>>,
}

impl Symbolic {
    /// For LU, with two panels per front, or for LDLᵀ, with one; with separate small fronts, or all like large ones.
    pub(super) fn new(structure: &Structure, panels: usize, has_small: bool) -> Symbolic {
        let graph = GroupGraph::new(structure);
        let mut order = minimum_degree_order(structure);
        let mut tree = EliminationTree::new(&graph, &order);
        let mut nodes = supernodes(&tree);
        let time = |nodes: &[Supernode]| nodes.iter().map(|node| node.time).sum::<f64>();
        if time(&nodes) > EXPENSIVE {
            let other = dissected_order(structure, &graph);
            let other_tree = EliminationTree::new(&graph, &other);
            let other_nodes = supernodes(&other_tree);
            if time(&other_nodes) < time(&nodes) {
                (order, tree, nodes) = (other, other_tree, other_nodes);
            }
        }
        let subtrees::Subtrees { nodes, parts } = subtrees::cut(nodes);

        let mut symbolic = Symbolic {
            unknowns: Vec::with_capacity(structure.pattern.size()),
            steps: vec![0; structure.pattern.size()],
            parts: Vec::with_capacity(parts.len()),
            fronts: Vec::with_capacity(nodes.len()),
            boundaries: Vec::new(),
            places: Vec::new(),
            sources: Vec::with_capacity(structure.pattern.entries()),
            targets: Vec::with_capacity(structure.pattern.entries()),
            children: Vec::new(),
            runs: Vec::new(),
            factor_length: 0,
            factor_entries: 0,
            is_symmetric: panels == 1,
            has_small,
        };
        let groups = symbolic.number_steps(structure, &order, (&nodes, &parts), &tree);
        for (part, fronts) in parts.iter().enumerate() {
            for index in fronts.clone() {
                // The last group of a supernode is an ancestor of the others: its later couplings include those of
                // all others.
                let last = nodes[index].groups.last().map_or(0, |&place| place as usize);
                let rows = symbolic.boundaries.len();
                for &place in &tree.boundaries[last] {
                    let first = groups.firsts[place as usize];
                    symbolic.boundaries.extend(first..first + tree.weights[place as usize]);
                }
                symbolic.boundaries[rows..].sort_unstable();
                symbolic.add_front((groups.steps[index].clone(), panels), rows, &nodes[index].children);
            }
            symbolic.finish_part(part);
        }
        symbolic.place_contributions(&nodes.iter().map(|node| &node.children[..]).collect::<Vec<_>>());
        symbolic.map_entries(structure);
        symbolic
    }

    /// Assigns the steps of all parts.
    fn number_steps(
        &mut self,
        structure: &Structure,
        order: &[usize],
        (nodes, parts): (&[Supernode], &[Range<usize>]),
        tree: &EliminationTree,
    ) -> Numbering {
        let mut numbering =
            Numbering { firsts: vec![0; order.len()], steps: Vec::with_capacity(nodes.len()) };
        for (part, fronts) in parts.iter().enumerate() {
            let begin = self.unknowns.len();
            for node in &nodes[fronts.clone()] {
                let first = self.unknowns.len();
                for &place in &node.groups {
                    numbering.firsts[place as usize] = self.unknowns.len() as u32;
                    let unknowns = &structure.groups[order[place as usize]].unknowns;
                    self.unknowns.extend(unknowns.iter().map(|&unknown| unknown as u32));
                }
                numbering.steps.push(first..self.unknowns.len());
                self.unknowns.resize(first + padded(self.unknowns.len() - first), NONE);
            }
            let end = self.unknowns.len();
            let mut outside = 0;
            if part + 1 < parts.len() {
                let root = nodes[fronts.end - 1].groups.last().map_or(0, |&place| place as usize);
                let weight = |&place: &u32| tree.weights[place as usize] as usize;
                outside = tree.boundaries[root].iter().map(weight).sum();
            }
            self.unknowns.resize(end + outside + PADDING, NONE);
            self.parts.push(Part {
                fronts: fronts.clone(),
                steps: begin..self.unknowns.len(),
                places: end..end + outside,
                time: nodes[fronts.clone()].iter().map(|node| node.time).sum(),
                ..Part::default()
            });
        }
        for (step, &unknown) in self.unknowns.iter().enumerate() {
            if unknown != NONE {
                self.steps[unknown as usize] = step as u32;
            }
        }
        numbering
    }

    /// Sizes of a part with all its fronts, and positions of their boundaries.
    fn finish_part(&mut self, index: usize) {
        let part = &mut self.parts[index];
        let fronts = &self.fronts[part.fronts.clone()];
        let (Some(first), Some(root)) = (fronts.first(), fronts.last()) else { return };
        self.factor_length += PADDING;
        part.factors = first.factors..self.factor_length;
        if !part.places.is_empty() {
            part.outside = self.boundaries[root.rows.clone()].to_vec();
        }
        for front in fronts {
            part.largest_pivots = part.largest_pivots.max(front.pivots);
            part.largest_boundary = part.largest_boundary.max(front.boundary);
            part.largest_panel = part.largest_panel.max(front.panel_length());
        }
        for &step in &self.boundaries[first.rows.start..root.rows.end] {
            let inside = step as usize;
            let place = if inside < part.places.start || part.outside.is_empty() {
                inside
            } else {
                part.places.start + part.outside.partition_point(|&other| other < step)
            };
            self.places.push((place - part.steps.start) as u32);
        }
        for front in &mut self.fronts[part.fronts.clone()] {
            let places = &self.places[front.rows.clone()];
            let first = places.first().map(|&first| first as usize);
            front.span = first
                .filter(|first| places.iter().zip(*first..).all(|(&at, expected)| at as usize == expected));
        }
    }

    fn add_front(&mut self, (steps, panels): (Range<usize>, usize), rows: usize, children: &[usize]) {
        let (pivots, boundary) = (steps.len(), self.boundaries.len() - rows);
        let mut front = Front {
            first: steps.start,
            pivots,
            boundary,
            panels,
            factors: self.factor_length,
            rows: rows..self.boundaries.len(),
            entries: 0..0,
            children: self.children.len()..self.children.len(),
            stack: 0,
            contribution: 0,
            passes_up: false,
            span: None,
            small: self.has_small && pivots <= MAX_SMALL && boundary <= MAX_SMALL,
        };
        for &child in children {
            self.add_child(&front, child);
        }
        front.children.end = self.children.len();
        self.factor_length = front.factor_range().end;
        let square =
            if panels == 1 { front.pivots * (front.pivots + 1) / 2 } else { front.pivots * front.pivots };
        self.factor_entries += square + panels * front.pivots * front.boundary;
        self.fronts.push(front);
    }

    /// The runs of a child's boundary; both lists are ascending, so one pass finds them all.
    fn add_child(&mut self, parent: &Front, child: usize) {
        let begin = self.runs.len();
        let mut middle = begin;
        let end_of_pivots = parent.first + parent.pivots;
        let parent_rows = &self.boundaries[parent.rows.clone()];
        let mut search = 0;
        for (from, &step) in self.boundaries[self.fronts[child].rows.clone()].iter().enumerate() {
            let step = step as usize;
            let is_pivot = step < end_of_pivots;
            let to = if is_pivot {
                step - parent.first
            } else {
                while parent_rows[search] as usize != step {
                    search += 1;
                }
                search
            };
            let (from, to) = (from as u32, to as u32);
            let open = if is_pivot { begin } else { middle };
            match self.runs[open..].last_mut() {
                Some(run) if run.to + run.length == to && run.from + run.length == from => run.length += 1,
                _ => self.runs.push(Run { from, to, length: 1 }),
            }
            if is_pivot {
                middle = self.runs.len();
            }
        }
        self.children.push(Child {
            part: self.part_of(child),
            contribution: 0..0,
            stride: self.fronts[child].panel_stride(),
            to_pivots: begin..middle,
            to_boundary: middle..self.runs.len(),
        });
    }

    /// Fronts of a part.
    pub(super) fn fronts_of(&self, part: &Part) -> &[Front] {
        &self.fronts[part.fronts.clone()]
    }

    fn part_of(&self, front: usize) -> usize {
        self.parts.partition_point(|part| part.fronts.end <= front)
    }

    /// Simulates the two stacks of every part, to determine the position of every contribution.
    fn place_contributions(&mut self, children: &[&[usize]]) {
        let mut parents = vec![None; self.fronts.len()];
        for (parent, children) in children.iter().enumerate() {
            for &child in *children {
                parents[child] = Some(parent);
            }
        }
        for index in (0..self.fronts.len()).rev() {
            self.fronts[index].stack =
                parents[index].map_or(0, |parent: usize| 1 - self.fronts[parent].stack);
        }
        for part in &mut self.parts {
            let mut tops = [0; 2];
            for index in part.fronts.clone() {
                let list = self.fronts[index].children.clone();
                for (slot, &child) in list.zip(children[index]) {
                    self.children[slot].contribution = self.fronts[child].contribution_range();
                }
                // Those of other parts are stored apart.
                if let Some(&lowest) = children[index].iter().find(|&&child| child >= part.fronts.start) {
                    tops[self.fronts[lowest].stack] = self.fronts[lowest].contribution;
                }
                let front = &mut self.fronts[index];
                front.passes_up = parents[index].is_some_and(|parent| parent >= part.fronts.end);
                if front.passes_up {
                    continue;
                }
                front.contribution = tops[front.stack];
                tops[front.stack] = front.contribution_range().end;
                part.stack_lengths[front.stack] = part.stack_lengths[front.stack].max(tops[front.stack]);
            }
        }
    }

    /// Assigns every entry to the front of the earlier of its row and its column.
    fn map_entries(&mut self, structure: &Structure) {
        let pattern = &structure.pattern;
        let mut mirrors = vec![0_u32; if self.is_symmetric { 0 } else { pattern.entries() }];
        for (_, _, [below, above]) in pattern.mirrors().filter(|_| !self.is_symmetric) {
            (mirrors[below], mirrors[above]) = (above as u32, below as u32);
        }
        // Local row in the present front of every step on its boundary.
        let mut local = vec![0_u32; self.unknowns.len()];
        for front in &mut self.fronts {
            for (row, &step) in self.boundaries[front.rows.clone()].iter().enumerate() {
                local[step as usize] = row as u32;
            }
            let begin = self.sources.len();
            let steps_here = front.first..front.first + front.pivots;
            let places = Places::of(front);
            let mut entries: Vec<(u32, u32)> = Vec::new();
            for step in steps_here.clone() {
                let pivot = step - front.first;
                let column = self.unknowns[step] as usize;
                let start = pattern.column_starts()[column];
                for (offset, &row) in pattern.column(column).iter().enumerate() {
                    let other = self.steps[row] as usize;
                    if other < front.first {
                        continue;
                    }
                    let source = (start + offset) as u32;
                    if other < steps_here.end {
                        let target = other - front.first + pivot * places.square_stride;
                        entries.push((target as u32, source));
                        continue;
                    }
                    let row_of_other = local[other] as usize;
                    let target = places.lower + row_of_other + pivot * places.lower_stride;
                    entries.push((target as u32, source));
                    if front.panels == 1 {
                        continue;
                    }
                    let target =
                        places.upper + row_of_other * places.upper_step + pivot * places.upper_stride;
                    entries.push((target as u32, mirrors[source as usize]));
                }
            }
            entries.sort_unstable();
            self.targets.extend(entries.iter().map(|&(target, _)| target));
            self.sources.extend(entries.iter().map(|&(_, source)| source));
            front.entries = begin..self.sources.len();
        }
    }
}

/// Targets of entries of a front: among its pieces for a large one, in the matrix of its elimination for a small one.
struct Places {
    square_stride: usize,
    lower: usize,
    lower_stride: usize,
    upper: usize,
    /// From an unknown of the boundary to the next, and from a pivot to the next.
    upper_step: usize,
    upper_stride: usize,
}

impl Places {
    fn of(front: &Front) -> Places {
        if front.is_small() {
            let stride = front.small_stride();
            return Places {
                square_stride: stride,
                lower: front.pivots,
                lower_stride: stride,
                upper: front.pivots * stride,
                upper_step: stride,
                upper_stride: 1,
            };
        }
        let (square, stride) = (front.square_length(), front.panel_stride());
        Places {
            square_stride: front.square_stride(),
            lower: square,
            lower_stride: stride,
            upper: square + front.panel_length(),
            upper_step: 1,
            upper_stride: stride,
        }
    }
}
