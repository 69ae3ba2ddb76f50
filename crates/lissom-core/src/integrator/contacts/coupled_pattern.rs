//! The pattern of the tangent with the blocks of touching parts. It is analysed again only if two parts touch that it does not couple, and
//! includes those with a small gap then, so that a pile which settles keeps its analysis.

use std::sync::Arc;

use lissom_motion::Matrix6;
use lissom_solver::{Pattern, Structure};

use super::touch_point::{TouchPoint, TouchState};
use crate::kinematics::{Kinematics, LOCKED, Layout, NodeId};

/// Pairs in the pattern over those that touch or may soon, or over the nodes if these are more, from which it is reduced.
const SURPLUS: f64 = 1.2;

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
    /// Positions of the first row of the own block of each node in its columns.
    own: Vec<Columns>,
    /// Pairs of nodes whose parts touch, or may soon.
    near: Vec<Couple>,
    /// Whether no solver has been made for it yet.
    is_new: bool,
    /// How often it was analysed.
    pub(crate) analyses: usize,
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
            near: Vec::new(),
            is_new: true,
            analyses: 0,
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

    /// Includes all touches, and forgets pairs that are not near `if_many` of them. Whether a solver is to be made for the pattern.
    pub(crate) fn follow(
        &mut self,
        (layout, if_many): (&Layout, bool),
        near: &[TouchPoint],
        (points, states): (&[TouchPoint], &[TouchState]),
    ) -> bool {
        let couple = |point: &TouchPoint| {
            point.nodes.iter().all(|node| is_free(layout, *node)).then(|| ordered(point.nodes))
        };
        let touching = || {
            let closed = points.iter().zip(states).filter(|(_, state)| has_slope(state));
            closed.filter_map(|(point, _)| couple(point))
        };
        let is_known = touching().all(|own| self.couples.binary_search(&own).is_ok());
        if !is_known || if_many {
            self.near.clear();
            self.near.extend(near.iter().filter(|point| point.is_close).filter_map(couple));
            self.near.extend(touching());
            sort(&mut self.near);
            // Fill costs more than an analysis.
            let has_many = self.couples.len() as f64 > SURPLUS * self.near.len().max(self.own.len()) as f64;
            if has_many {
                self.couples.clear();
            }
            if has_many || !is_known {
                self.couples.extend_from_slice(&self.near);
                sort(&mut self.couples);
                self.build(layout);
            }
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
        self.analyses += 1;
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
            let across = self.couples.binary_search(&ordered(point.nodes)).map(|index| self.across[index]);
            // Slopes are symmetric.
            for sides in [[0, 0], [1, 1], [0, 1]] {
                let nodes @ [from, to] = sides.map(|side| point.nodes[side]);
                if !nodes.iter().all(|node| is_free(layout, *node)) {
                    continue;
                }
                let block = gradients[sides[0]].tr_mul(&(factor * state.slope * gradients[sides[1]]));
                let mut add = |nodes: [NodeId; 2], columns: Columns, block: &Matrix6| {
                    let rows = nodes.map(|node| layout.rows_of_node(node));
                    match columns {
                        Some(columns) => add_columns(&columns, block, out),
                        None => add_entries(pattern, rows, block, out),
                    }
                };
                if from == to {
                    add(nodes, self.own[from.index()], &block);
                } else {
                    let turned = usize::from(from > to);
                    let across = across.unwrap_or_default();
                    add(nodes, across[turned], &block);
                    add([to, from], across[1 - turned], &block.transpose());
                }
            }
        }
    }
}

fn is_free(layout: &Layout, node: NodeId) -> bool {
    layout.rows_of_node(node).iter().any(|row| *row != LOCKED)
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

/// Two nodes, the smaller first.
fn ordered([one, other]: [NodeId; 2]) -> Couple {
    if one < other { [one, other] } else { [other, one] }
}

fn sort(couples: &mut Vec<Couple>) {
    couples.sort_unstable();
    couples.dedup();
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
