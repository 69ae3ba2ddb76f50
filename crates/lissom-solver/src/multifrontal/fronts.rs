//! Symbolic result of the multifrontal solver: every front's size, place in memory, and the maps by which
//! entries and contributions get there. Knows positions, never values.
//!
//! A front with `k` pivots and `b` boundary unknowns is stored as three column-major pieces, one after the other: the
//! square (`k` columns, `L11` below and `U11` above the diagonal), the lower panel `L21` and the upper panel
//! `U12ᵀ` (`k` columns of `b` rows each). Columns are padded with zeros to a multiple of [`PADDING`] rows. What it
//! contributes to its parent is a square of `b` columns in one of two stacks: a front's children leave theirs
//! in one stack, the front its own in the other.

use std::ops::Range;

use super::elimination_tree::EliminationTree;
use super::supernodes::supernodes;
use crate::ordering::{GroupGraph, minimum_degree_order};
use crate::structure::Structure;

/// Rows of every column are padded to a multiple of this, so that kernels have no tails.
pub(super) const PADDING: usize = 4;

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
    /// Panels stored: the lower alone for symmetric matrices, or both.
    pub(super) panels: usize,
    /// Where its pieces begin among the factors.
    pub(super) factors: usize,
    /// Its boundary in [`Symbolic::boundaries`].
    pub(super) rows: Range<usize>,
    /// Its entries in [`Symbolic::sources`] and [`Symbolic::targets`].
    pub(super) entries: Range<usize>,
    /// Its children in [`Symbolic::children`].
    pub(super) children: Range<usize>,
    /// Which stack its contribution goes to, and where.
    pub(super) stack: usize,
    pub(super) contribution: usize,
}

impl Front {
    pub(super) fn square_stride(&self) -> usize {
        padded(self.pivots)
    }
    pub(super) fn panel_stride(&self) -> usize {
        padded(self.boundary)
    }
    pub(super) fn square_length(&self) -> usize {
        self.pivots * self.square_stride()
    }
    pub(super) fn panel_length(&self) -> usize {
        self.pivots * self.panel_stride()
    }
    pub(super) fn factor_range(&self) -> Range<usize> {
        self.factors..self.factors + self.square_length() + self.panels * self.panel_length()
    }
    pub(super) fn contribution_range(&self) -> Range<usize> {
        self.contribution..self.contribution + self.boundary * self.panel_stride()
    }
}

/// A child's contribution: where it lies and where it goes.
#[derive(Clone, Debug)]
pub(super) struct Child {
    pub(super) contribution: Range<usize>,
    pub(super) stride: usize,
    /// Its runs in [`Symbolic::runs`] that go to pivots of the parent, and those that go to its boundary.
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

/// The whole symbolic factorisation.
#[derive(Clone, Debug)]
pub(super) struct Symbolic {
    /// Unknown eliminated at each step.
    pub(super) unknowns: Vec<u32>,
    pub(super) fronts: Vec<Front>,
    /// Steps of the boundary unknowns of all fronts.
    pub(super) boundaries: Vec<u32>,
    /// Indices of values, sorted by front.
    pub(super) sources: Vec<u32>,
    /// Where those values go, counted from the beginning of the front's pieces.
    pub(super) targets: Vec<u32>,
    pub(super) children: Vec<Child>,
    pub(super) runs: Vec<Run>,
    pub(super) factor_length: usize,
    pub(super) factor_entries: usize,
    pub(super) stack_lengths: [usize; 2],
    pub(super) largest_pivots: usize,
    pub(super) largest_boundary: usize,
}

impl Symbolic {
    /// For LU, with two panels to a front, or for LDLᵀ, with one.
    pub(super) fn new(structure: &Structure, panels: usize) -> Symbolic {
        let graph = GroupGraph::new(structure);
        let order = minimum_degree_order(structure);
        let tree = EliminationTree::new(&graph, &order);
        let nodes = supernodes(&tree);

        let mut symbolic = Symbolic {
            unknowns: Vec::with_capacity(structure.pattern.size()),
            fronts: Vec::with_capacity(nodes.len()),
            boundaries: Vec::new(),
            sources: Vec::with_capacity(structure.pattern.entries()),
            targets: Vec::with_capacity(structure.pattern.entries()),
            children: Vec::new(),
            runs: Vec::new(),
            factor_length: 0,
            factor_entries: 0,
            stack_lengths: [0; 2],
            largest_pivots: 0,
            largest_boundary: 0,
        };
        let mut first_steps = vec![0_u32; order.len()];
        let mut firsts = Vec::with_capacity(nodes.len());
        for node in &nodes {
            firsts.push(symbolic.unknowns.len());
            for &place in &node.groups {
                first_steps[place as usize] = symbolic.unknowns.len() as u32;
                let unknowns = &structure.groups[order[place as usize]].unknowns;
                symbolic.unknowns.extend(unknowns.iter().map(|&unknown| unknown as u32));
            }
        }
        firsts.push(symbolic.unknowns.len());
        for (index, node) in nodes.iter().enumerate() {
            // The last group of a supernode is an ancestor of the others: what it is coupled with later is
            // all that any of them is.
            let last = node.groups.last().map_or(0, |&place| place as usize);
            let rows = symbolic.boundaries.len();
            for &place in &tree.boundaries[last] {
                let first = first_steps[place as usize];
                symbolic.boundaries.extend(first..first + tree.weights[place as usize]);
            }
            symbolic.boundaries[rows..].sort_unstable();
            symbolic.add_front((firsts[index]..firsts[index + 1], panels), rows, &node.children);
        }
        symbolic.place_contributions(&nodes.iter().map(|node| &node.children[..]).collect::<Vec<_>>());
        symbolic.map_entries(structure);
        symbolic
    }

    fn add_front(&mut self, (steps, panels): (Range<usize>, usize), rows: usize, children: &[usize]) {
        let mut front = Front {
            first: steps.start,
            pivots: steps.len(),
            boundary: self.boundaries.len() - rows,
            panels,
            factors: self.factor_length,
            rows: rows..self.boundaries.len(),
            entries: 0..0,
            children: self.children.len()..self.children.len(),
            stack: 0,
            contribution: 0,
        };
        for &child in children {
            self.add_child(&front, child);
        }
        front.children.end = self.children.len();
        self.factor_length = front.factor_range().end;
        let square =
            if panels == 1 { front.pivots * (front.pivots + 1) / 2 } else { front.pivots * front.pivots };
        self.factor_entries += square + panels * front.pivots * front.boundary;
        self.largest_pivots = self.largest_pivots.max(front.pivots);
        self.largest_boundary = self.largest_boundary.max(front.boundary);
        self.fronts.push(front);
    }

    /// The runs of a child's boundary; both lists are ascending, so one walk finds them all.
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
            contribution: 0..0,
            stride: self.fronts[child].panel_stride(),
            to_pivots: begin..middle,
            to_boundary: middle..self.runs.len(),
        });
    }

    /// Plays the two stacks through once, to know where every contribution will lie.
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
        let mut tops = [0; 2];
        for index in 0..self.fronts.len() {
            let list = self.fronts[index].children.clone();
            for (slot, &child) in list.zip(children[index]) {
                self.children[slot].contribution = self.fronts[child].contribution_range();
            }
            if let Some(&lowest) = children[index].first() {
                tops[self.fronts[lowest].stack] = self.fronts[lowest].contribution;
            }
            let front = &mut self.fronts[index];
            front.contribution = tops[front.stack];
            tops[front.stack] = front.contribution_range().end;
            self.stack_lengths[front.stack] = self.stack_lengths[front.stack].max(tops[front.stack]);
        }
    }

    /// Sends every entry to the front of the earlier of its row and its column.
    fn map_entries(&mut self, structure: &Structure) {
        let pattern = &structure.pattern;
        let mut steps = vec![0_u32; pattern.size()];
        for (step, &unknown) in self.unknowns.iter().enumerate() {
            steps[unknown as usize] = step as u32;
        }
        // Local row in the present front of every step on its boundary.
        let mut local = vec![0_u32; pattern.size()];
        for front in &mut self.fronts {
            for (row, &step) in self.boundaries[front.rows.clone()].iter().enumerate() {
                local[step as usize] = row as u32;
            }
            let begin = self.sources.len();
            let steps_here = front.first..front.first + front.pivots;
            let (square, panel) = (front.square_length(), front.panel_length());
            let mut entries: Vec<(u32, u32)> = Vec::new();
            for step in steps_here.clone() {
                let pivot = step - front.first;
                let column = self.unknowns[step] as usize;
                let start = pattern.column_starts()[column];
                for (offset, &row) in pattern.column(column).iter().enumerate() {
                    let other = steps[row] as usize;
                    if other < front.first {
                        continue;
                    }
                    let source = (start + offset) as u32;
                    if other < steps_here.end {
                        let target = other - front.first + pivot * front.square_stride();
                        entries.push((target as u32, source));
                        continue;
                    }
                    let target = square + local[other] as usize + pivot * front.panel_stride();
                    entries.push((target as u32, source));
                    if front.panels == 1 {
                        continue;
                    }
                    let mirror = pattern.position(column, row).expect("the pattern is symmetric");
                    entries.push(((target + panel) as u32, mirror as u32));
                }
            }
            entries.sort_unstable();
            self.targets.extend(entries.iter().map(|&(target, _)| target));
            self.sources.extend(entries.iter().map(|&(_, source)| source));
            front.entries = begin..self.sources.len();
        }
    }
}
