//! The pattern of the tangent with the blocks of touching parts. It is analysed again only if two parts touch that it does not couple, so
//! that a pile which settles keeps its analysis.

use std::sync::Arc;

use lissom_motion::Matrix6;
use lissom_solver::{Pattern, Structure};

use super::touch_point::{TouchPoint, TouchState};
use crate::kinematics::{Kinematics, LOCKED, Layout, NodeId};

/// Pairs in the pattern over those that touch from which it is reduced.
const SURPLUS: f64 = 1.2;
/// The same for few pairs.
const FEW: usize = 8;

/// Two nodes with unknowns, the first the smaller.
type Couple = [NodeId; 2];

/// Positions of the first row of a node in the columns of a node; none where they are not six in a row.
type Columns = Option<[u32; 6]>;

/// The pattern of the system, enlarged.
pub(crate) struct CoupledPattern {
    pub(crate) structure: Structure,
    base: Arc<Pattern>,
    /// Positions of the system's own entries.
    positions: Vec<u32>,
    couples: Vec<Couple>,
    /// Positions of the first rows of the columns of the blocks of each pair: those of the first node's rows in the second's columns, and
    /// of the second's in the first's.
    across: Vec<[Columns; 2]>,
    /// The same of the own block of each node.
    own: Vec<Columns>,
    /// Those that touch at the present iterate.
    touching: Vec<Couple>,
    /// Whether no solver has been made for it yet.
    is_new: bool,
}

impl CoupledPattern {
    /// That of the system alone.
    pub(crate) fn new(layout: &Layout, structure: &Structure) -> Self {
        let mut alone = Self {
            structure: structure.clone(),
            base: Arc::clone(&structure.pattern),
            positions: (0..structure.pattern.entries() as u32).collect(),
            couples: Vec::new(),
            across: Vec::new(),
            own: Vec::new(),
            touching: Vec::new(),
            is_new: true,
        };
        alone.build(layout);
        alone
    }

    /// The coupled nodes, for snapshots.
    pub(crate) fn couples(&self) -> Vec<[usize; 2]> {
        self.couples.iter().map(|couple| couple.map(NodeId::index)).collect()
    }

    /// Couples these nodes, and no others.
    pub(crate) fn restore(&mut self, layout: &Layout, couples: &[[usize; 2]]) {
        let node = |index: usize| layout.nodes().nth(index);
        self.couples = couples.iter().filter_map(|[one, other]| Some([node(*one)?, node(*other)?])).collect();
        self.build(layout);
    }

    /// Includes all points with a slope, and forgets pairs that do not touch `if_many` of them. Whether a solver is to be made for the
    /// pattern.
    pub(crate) fn follow(
        &mut self,
        (layout, if_many): (&Layout, bool),
        points: &[TouchPoint],
        states: &[TouchState],
    ) -> bool {
        let is_free = |node: NodeId| layout.rows_of_node(node).iter().any(|row| *row != LOCKED);
        self.touching.clear();
        for (point, _) in points.iter().zip(states).filter(|(_, state)| has_slope(state)) {
            let [one, other] = point.nodes;
            if is_free(one) && is_free(other) {
                self.touching.push(if one < other { [one, other] } else { [other, one] });
            }
        }
        self.touching.sort_unstable();
        self.touching.dedup();
        let most = SURPLUS * self.touching.len() as f64 + FEW as f64;
        let is_known = self.touching.iter().all(|couple| self.couples.binary_search(couple).is_ok());
        let has_many = self.couples.len() as f64 > most;
        if !is_known || if_many && has_many {
            // Fill costs more than an analysis.
            if has_many {
                self.couples.clear();
            }
            self.couples.extend_from_slice(&self.touching);
            self.couples.sort_unstable();
            self.couples.dedup();
            self.build(layout);
        }
        std::mem::take(&mut self.is_new)
    }

    fn build(&mut self, layout: &Layout) {
        let base = &self.base;
        let own =
            (0..base.size()).flat_map(|column| base.column(column).iter().map(move |&row| (row, column)));
        let coupled = self.couples.iter().flat_map(|&[one, other]| {
            let rows = |node: NodeId| layout.rows_of_node(node).iter().filter(|row| **row != LOCKED);
            rows(one).flat_map(move |&row| rows(other).map(move |&column| (row as usize, column as usize)))
        });
        let pattern =
            Pattern::from_entries(base.size(), own.filter(|(row, column)| row <= column).chain(coupled));
        self.positions.clear();
        for column in 0..base.size() {
            let mut position = pattern.column_starts()[column];
            for row in base.column(column) {
                while pattern.row_indices()[position] != *row {
                    position += 1;
                }
                self.positions.push(position as u32);
            }
        }
        self.own.clear();
        self.own.extend(layout.node_rows.iter().map(|rows| columns_of(&pattern, [rows; 2])));
        self.across.clear();
        self.across.extend(self.couples.iter().map(|couple| {
            let [one, other] = couple.map(|node| layout.rows_of_node(node));
            [columns_of(&pattern, [one, other]), columns_of(&pattern, [other, one])]
        }));
        self.structure.pattern = Arc::new(pattern);
        self.is_new = true;
    }

    /// Writes the tangent: values on the system's own pattern, and `factor` times the blocks of the points.
    pub(crate) fn assemble(
        &self,
        smooth: &[f64],
        (points, states, factor): (&[TouchPoint], &[TouchState], f64),
        (at, layout): (&Kinematics, &Layout),
        out: &mut Vec<f64>,
    ) {
        let pattern = &*self.structure.pattern;
        out.clear();
        out.resize(pattern.entries(), 0.0);
        for (&position, value) in self.positions.iter().zip(smooth) {
            out[position as usize] = *value;
        }
        for (point, state) in points.iter().zip(states).filter(|(_, state)| has_slope(state)) {
            let gradients = [0, 1].map(|side| point.gradient(side, at));
            let couple = self.couple_of(point.nodes);
            for (right, &to) in point.nodes.iter().enumerate() {
                let weighted = factor * state.slope * gradients[right];
                for (left, &from) in point.nodes.iter().enumerate() {
                    let block = gradients[left].tr_mul(&weighted);
                    let columns = if from == to {
                        self.own.get(from.index()).copied().flatten()
                    } else {
                        couple.and_then(|index| self.across[index][usize::from(from > to)])
                    };
                    if let Some(columns) = columns {
                        add_columns(&columns, &block, out);
                    } else {
                        let rows = [from, to].map(|node| layout.rows_of_node(node));
                        add_entries(pattern, rows, &block, out);
                    }
                }
            }
        }
    }

    /// Index of the pair of two nodes.
    fn couple_of(&self, [one, other]: [NodeId; 2]) -> Option<usize> {
        let couple = if one < other { [one, other] } else { [other, one] };
        self.couples.binary_search(&couple).ok()
    }
}

/// Whether a displacement changes the force.
fn has_slope(state: &TouchState) -> bool {
    state.slope.diagonal().amax() > 0.0
}

/// Positions of the first of six consecutive rows in six columns, if the pattern has them.
fn columns_of(pattern: &Pattern, [rows, columns]: [&[u32; 6]; 2]) -> Columns {
    let is_whole = |rows: &[u32; 6]| rows[5] != LOCKED && (1..6).all(|k| rows[k] == rows[0] + k as u32);
    if !(is_whole(rows) && is_whole(columns)) {
        return None;
    }
    let mut found = [0; 6];
    for (first, &column) in found.iter_mut().zip(columns) {
        *first = pattern.position(rows[0] as usize, column as usize)? as u32;
    }
    Some(found)
}

fn add_columns(columns: &[u32; 6], block: &Matrix6, out: &mut [f64]) {
    for (&first, column) in columns.iter().zip(block.column_iter()) {
        let first = first as usize;
        for (value, own) in out[first..first + 6].iter_mut().zip(column.iter()) {
            *value += own;
        }
    }
}

fn add_entries(pattern: &Pattern, [rows, columns]: [&[u32; 6]; 2], block: &Matrix6, out: &mut [f64]) {
    for (j, &column) in columns.iter().enumerate().filter(|(_, column)| **column != LOCKED) {
        for (i, &row) in rows.iter().enumerate().filter(|(_, row)| **row != LOCKED) {
            if let Some(position) = pattern.position(row as usize, column as usize) {
                out[position] += block[(i, j)];
            }
        }
    }
}
