//! Closed loops of constraints: only in loops can constraints be redundant. The others are removed from the ends inwards: a constraint
//! with a side that no other one constrains, such as the last joint of a chain; a relation with a coordinate that is in no other
//! constraint.

use nalgebra::DMatrix;

use crate::joints::constraint::{Constraint, Level, Port, ports_of};
use crate::kinematics::{Kinematics, LOCKED, Layout, NodeId, Quantity};
use crate::system::{System, rows_of_port};

/// Constraints that form a closed loop.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loop {
    /// Indices among all constraints of the system.
    constraints: Vec<usize>,
    /// Multiplier of every equation.
    pub(crate) multipliers: Vec<usize>,
    /// Rows of the layout that its equations depend on, in ascending order.
    pub(crate) columns: Vec<usize>,
}

/// The closed loops of a system; loops with a common moving part are merged.
pub(crate) fn of(system: &System) -> Vec<Loop> {
    from(system, kept(system, &[Level::Position]))
}

/// Closed loops of a system, also through constraints of velocities.
pub(crate) fn of_all_levels(system: &System) -> Vec<Loop> {
    from(system, kept(system, &[Level::Position, Level::Velocity]))
}

/// Loops of constraints, given with their rows of the layout.
fn from(system: &System, kept: Vec<(usize, Vec<usize>)>) -> Vec<Loop> {
    // By row of the layout: the first row of its loop (union-find).
    let mut parents: Vec<usize> = (0..system.layout().coordinate_count()).collect();
    for (_, columns) in &kept {
        for &column in &columns[1..] {
            let [a, b] = [columns[0], column].map(|row| root(&mut parents, row));
            parents[a.max(b)] = a.min(b);
        }
    }
    let mut loops: std::collections::BTreeMap<usize, Loop> = std::collections::BTreeMap::new();
    for (index, columns) in kept {
        let constraint = system.constraint(index);
        let first = constraint.first_multiplier();
        let found = loops.entry(root(&mut parents, columns[0])).or_default();
        found.constraints.push(index);
        found.multipliers.extend(first..first + constraint.equations());
        found.columns.extend(columns);
    }
    let sorted = |mut found: Loop| {
        found.columns.sort_unstable();
        found.columns.dedup();
        found
    };
    loops.into_values().map(sorted).collect()
}

/// For each row of the layout and each multiplier the first row that it is coupled with by constraints or inertias.
pub(crate) fn coupled_rows(system: &System, at: &Kinematics) -> Vec<usize> {
    let (layout, pattern) = (system.layout(), system.pattern());
    let count = layout.coordinate_count();
    let mass = system.linearization_at(at).mass;
    let mut parents: Vec<usize> = (0..layout.size()).collect();
    let mut couple = |rows: &[usize]| {
        for pair in rows.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|row| root(&mut parents, row));
            parents[a.max(b)] = a.min(b);
        }
    };
    for node in layout.nodes() {
        let rows = layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED);
        couple(&rows.map(|&row| row as usize).collect::<Vec<_>>());
    }
    for constraint in system.constraints() {
        let first = count + constraint.first_multiplier();
        let mut rows = columns_of(constraint, layout);
        rows.extend(first..first + constraint.equations());
        couple(&rows);
    }
    for column in 0..count {
        for position in pattern.column_starts()[column]..pattern.column_starts()[column + 1] {
            let row = pattern.row_indices()[position];
            if row < count && mass[position] != 0.0 {
                couple(&[row, column]);
            }
        }
    }
    (0..layout.size()).map(|row| root(&mut parents, row)).collect()
}

fn holds_nodes(constraint: &dyn Constraint) -> bool {
    !constraint.sides().is_empty()
}

/// Constraints of these levels that are not removed: index among all constraints, and rows of the layout that each depends on.
fn kept(system: &System, levels: &[Level]) -> Vec<(usize, Vec<usize>)> {
    let layout = system.layout();
    let columns: Vec<Vec<usize>> = system.constraints().map(|own| columns_of(own, layout)).collect();
    let has_equations = |own: &dyn Constraint| own.equations() > 0 && levels.contains(&own.level());
    let mut is_kept: Vec<bool> = system.constraints().map(has_equations).collect();
    take_ends(system, &mut is_kept);
    let mut known = vec![0_usize; layout.coordinate_count()];
    for (_, columns) in columns.iter().enumerate().filter(|(index, _)| is_kept[*index]) {
        for &column in columns {
            known[column] += 1;
        }
    }
    let is_relation: Vec<bool> = system.constraints().map(|own| !holds_nodes(own)).collect();
    let is_end = |index: &usize, is_kept: &[bool], known: &[usize]| {
        is_kept[*index] && is_relation[*index] && columns[*index].iter().any(|&column| known[column] == 1)
    };
    while let Some(index) = (0..is_kept.len()).find(|index| is_end(index, &is_kept, &known)) {
        is_kept[index] = false;
        for &column in &columns[index] {
            known[column] -= 1;
        }
    }
    let all = columns.into_iter().enumerate();
    all.filter(|(index, columns)| is_kept[*index] && !columns.is_empty()).collect()
}

/// Rows of the layout that a constraint depends on, in all arrangements.
fn columns_of(constraint: &dyn Constraint, layout: &Layout) -> Vec<usize> {
    let ports = ports_of(constraint).into_iter();
    let rows = ports.flat_map(|port| rows_of_port(port, layout)).filter(|&row| row != LOCKED);
    rows.map(|row| row as usize).collect()
}

/// Removes constraints with a side that no other one constrains and that has enough degrees of freedom to satisfy them: with fewer
/// degrees of freedom than equations, these may be redundant without any loop.
fn take_ends(system: &System, is_kept: &mut [bool]) {
    let layout = system.layout();
    let sides: Vec<Vec<Vec<NodeId>>> = system
        .constraints()
        .map(|constraint| {
            let mut sides = constraint.sides();
            for side in &mut sides {
                side.sort_unstable();
                side.dedup();
            }
            sides
        })
        .collect();
    // A joint between two points of one node counts twice there and is no end.
    let mut holders: Vec<Vec<usize>> = vec![Vec::new(); layout.node_count()];
    for (index, sides) in sides.iter().enumerate().filter(|(index, _)| is_kept[*index]) {
        sides.iter().flatten().for_each(|node| holders[node.index()].push(index));
    }
    let mut count: Vec<usize> = holders.iter().map(Vec::len).collect();
    let freedoms = |node: NodeId| layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED).count();
    let mut open: Vec<NodeId> = layout.nodes().collect();
    while let Some(node) = open.pop() {
        if count[node.index()] != 1 {
            continue;
        }
        let Some(&index) = holders[node.index()].iter().find(|&&index| is_kept[index]) else { continue };
        let is_free = |side: &Vec<NodeId>| {
            side.iter().all(|own| count[own.index()] == 1)
                && side.iter().map(|&own| freedoms(own)).sum::<usize>()
                    >= system.constraint(index).equations()
        };
        if sides[index].iter().any(is_free) {
            is_kept[index] = false;
            for &own in sides[index].iter().flatten() {
                count[own.index()] -= 1;
                open.push(own);
            }
        }
    }
}

fn root(parents: &mut [usize], mut row: usize) -> usize {
    while parents[row] != row {
        parents[row] = parents[parents[row]];
        row = parents[row];
    }
    row
}

impl Loop {
    /// Derivatives of its equations at a configuration; an angle is represented by the arc at `length` [m].
    pub(crate) fn gradient(&self, system: &System, at: &Kinematics, length: f64, gradient: &mut Gradient) {
        let layout = system.layout();
        let Gradient { columns, local, .. } = gradient;
        columns.resize_with(self.columns.len(), Vec::new);
        columns.iter_mut().for_each(Vec::clear);
        // Adds the entries of one column, of consecutive equations.
        let mut enter = |first: usize, row: usize, is_turn: bool, values: &mut dyn Iterator<Item = f64>| {
            let Ok(column) = self.columns.binary_search(&row) else { return };
            let unit = if is_turn { length } else { 1.0 };
            let entries = values.enumerate().filter(|(_, value)| *value != 0.0);
            columns[column].extend(entries.map(|(own, value)| (first + own, value / unit)));
        };
        let mut equation = 0;
        for &index in &self.constraints {
            let constraint = system.constraint(index);
            let (count, size) = (constraint.equations(), constraint.size());
            local.clear();
            local.resize(count * size, 0.0);
            constraint.gradient(at, local);
            let arrangement = constraint.arrangement(at);
            let mut column = 0;
            for port in (0..constraint.ports()).map(|index| constraint.port(arrangement, index)) {
                for (k, row) in rows_of_port(port, layout).enumerate().filter(|&(_, row)| row != LOCKED) {
                    let row = row as usize;
                    let is_turn = match port {
                        Port::Node(_) | Port::NoNode => k >= 3,
                        Port::Coordinate(_) => layout.quantities()[row] == Quantity::Angle,
                    };
                    let mut values = (0..count).map(|own| local[own * size + column + k]);
                    enter(equation, row, is_turn, &mut values);
                }
                column += port.width();
            }
            equation += count;
        }
    }

    /// Constraints of the loop with the first equation of each.
    pub(crate) fn constraints<'s>(
        &'s self,
        system: &'s System,
    ) -> impl Iterator<Item = (usize, &'s dyn Constraint)> {
        self.constraints.iter().scan(0, |equation, &index| {
            let constraint = system.constraint(index);
            let first = *equation;
            *equation += constraint.equations();
            Some((first, constraint))
        })
    }
}

/// Nonzero derivatives of a loop's equations.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gradient {
    /// Entries of every column: equation and derivative. A joint between two points of one part has two entries in a column.
    pub(crate) columns: Vec<Vec<(usize, f64)>>,
    /// Reciprocal norms of the equations' rows.
    sizes: Vec<f64>,
    /// Derivatives of one constraint, row after row.
    local: Vec<f64>,
}

impl Gradient {
    /// Norms of the rows of B, by equation.
    pub(crate) fn norms(&self, norms: &mut [f64]) {
        norms.fill(0.0);
        for column in &self.columns {
            for (place, &(i, by_i)) in column.iter().enumerate() {
                // Two entries of the same equation: (a + b)² = a² + 2 a b + b².
                let others = column[..place].iter().filter(|(j, _)| *j == i);
                norms[i] += by_i * by_i + others.map(|(_, by_j)| 2.0 * by_i * by_j).sum::<f64>();
            }
        }
        for norm in norms {
            *norm = norm.max(0.0).sqrt();
        }
    }

    /// B Bᵀ with a unit diagonal, in the lower triangle. `square` has as many rows as there are equations.
    pub(crate) fn square(&mut self, square: &mut DMatrix<f64>) {
        let Self { columns, sizes, .. } = self;
        square.fill(0.0);
        for column in columns {
            for (place, &(i, by_i)) in column.iter().enumerate() {
                square[(i, i)] += by_i * by_i;
                for &(j, by_j) in &column[..place] {
                    // Two entries of the same equation: (a + b)² = a² + 2 a b + b².
                    let share = if i == j { 2.0 } else { 1.0 };
                    square[(i.max(j), i.min(j))] += share * by_i * by_j;
                }
            }
        }
        let count = square.nrows();
        sizes.clear();
        sizes.extend(
            (0..count).map(|k| square[(k, k)].sqrt()).map(|size| if size > 0.0 { 1.0 / size } else { 0.0 }),
        );
        for (j, column) in square.as_mut_slice().chunks_exact_mut(count.max(1)).enumerate() {
            for (entry, size) in column[j..].iter_mut().zip(&sizes[j..]) {
                *entry *= size * sizes[j];
            }
        }
    }
}
