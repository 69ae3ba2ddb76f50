//! Closed loops of joints: where else than in them constraints can repeat each other. The rest is taken away from the
//! ends: a node that one joint alone holds, with this joint; a coordinate that one relation alone knows, with this
//! relation; a slider whose tip, or whose beams, nothing else holds.

use nalgebra::DMatrix;

use crate::joints::derivatives::{OWN, TIP};
use crate::joints::slider;
use crate::kinematics::{Kinematics, LOCKED, Quantity};
use crate::system::System;

/// Joints, sliders, drives and couplings that close loops with each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Loop {
    joints: Vec<usize>,
    sliders: Vec<usize>,
    drives: Vec<usize>,
    couplings: Vec<usize>,
    /// Multiplier of every equation.
    pub(crate) multipliers: Vec<usize>,
    /// Rows of the layout that its equations know, in ascending order.
    columns: Vec<usize>,
}

/// The closed loops of a system; those that have a moving part in common are one.
pub(crate) fn of(system: &System) -> Vec<Loop> {
    let kept = Kept::of(system);
    // By row of the layout, the first row of the loop that it belongs to.
    let mut parents: Vec<usize> = (0..system.layout().coordinate_count()).collect();
    let relations = kept.relations(system);
    for (_, columns) in &relations {
        for &column in &columns[1..] {
            let [a, b] = [columns[0], column].map(|row| root(&mut parents, row));
            parents[a.max(b)] = a.min(b);
        }
    }
    let mut loops: std::collections::BTreeMap<usize, Loop> = std::collections::BTreeMap::new();
    for (relation, columns) in relations {
        let found = loops.entry(root(&mut parents, columns[0])).or_default();
        match relation {
            Relation::Joint(index) => {
                let joint = &system.joints[index];
                found.joints.push(index);
                found.multipliers.extend(joint.first_multiplier..joint.first_multiplier + joint.equations());
            }
            Relation::Slider(index) => {
                let slider = &system.sliders[index];
                let first = slider.first_multiplier;
                found.sliders.push(index);
                found.multipliers.extend(first..first + slider.equations());
            }
            Relation::Drive(index) => {
                found.drives.push(index);
                found.multipliers.push(system.drives[index].multiplier);
            }
            Relation::Coupling(index) => {
                found.couplings.push(index);
                found.multipliers.push(system.couplings[index].multiplier);
            }
        }
        found.columns.extend(columns);
    }
    let sorted = |mut found: Loop| {
        found.columns.sort_unstable();
        found.columns.dedup();
        found
    };
    // Relations without a joint between nodes close no loop that could change.
    loops
        .into_values()
        .filter(|found| !(found.joints.is_empty() && found.sliders.is_empty()))
        .map(sorted)
        .collect()
}

#[derive(Clone, Copy)]
enum Relation {
    Joint(usize),
    Slider(usize),
    Drive(usize),
    Coupling(usize),
}

/// What has not been taken away.
struct Kept {
    joints: Vec<bool>,
    sliders: Vec<bool>,
    drives: Vec<bool>,
    couplings: Vec<bool>,
}

impl Kept {
    fn of(system: &System) -> Self {
        let layout = system.layout();
        let mut kept = Self {
            joints: system.joints.iter().map(|joint| joint.equations() > 0).collect(),
            sliders: vec![true; system.sliders.len()],
            drives: vec![true; system.drives.len()],
            couplings: vec![true; system.couplings.len()],
        };
        let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); layout.node_count()];
        for (index, joint) in system.joints.iter().enumerate() {
            for frame in joint.frames {
                at_node[frame.node].push(index);
            }
        }
        let mut sliders_at: Vec<Vec<usize>> = vec![Vec::new(); layout.node_count()];
        for (index, slider) in system.sliders.iter().enumerate() {
            for node in slider.carriers() {
                sliders_at[node].push(index);
            }
        }
        let freedoms = |node: usize| layout.rows_of_node(node).iter().filter(|&&row| row != LOCKED).count();
        let mut open: Vec<usize> = (0..layout.node_count()).collect();
        while let Some(node) = open.pop() {
            let mut here = at_node[node].iter().copied().filter(|&joint| kept.joints[joint]);
            let mut sliders = sliders_at[node].iter().copied().filter(|&slider| kept.sliders[slider]);
            let joint = match (here.next(), here.next(), sliders.next(), sliders.next()) {
                (Some(joint), None, None, _) => joint,
                (None, _, Some(index), None) => {
                    let slider = &system.sliders[index];
                    let is_alone = |&node: &usize| {
                        !at_node[node].iter().any(|&joint| kept.joints[joint])
                            && !sliders_at[node].iter().any(|&other| other != index && kept.sliders[other])
                    };
                    let is_end = (node == slider.tip.node && slider.equations() <= freedoms(node))
                        || slider.nodes.iter().all(|point| is_alone(&point.node));
                    if is_end {
                        kept.sliders[index] = false;
                        open.extend(slider.carriers());
                    }
                    continue;
                }
                _ => continue,
            };
            // Equations on fewer freedoms than they are may repeat each other without any loop.
            if system.joints[joint].equations() <= freedoms(node) {
                kept.joints[joint] = false;
                open.extend(system.joints[joint].frames.map(|frame| frame.node));
            }
        }
        while kept.take_relation(system) {}
        kept
    }

    /// Takes away a drive or coupling with a coordinate that nothing else knows, if there is one.
    fn take_relation(&mut self, system: &System) -> bool {
        let mut known = vec![0_usize; system.layout().coordinate_count()];
        for (_, columns) in self.relations(system) {
            for column in columns {
                known[column] += 1;
            }
        }
        for (relation, columns) in self.relations(system) {
            let is_end = columns.iter().any(|&column| known[column] == 1);
            match relation {
                Relation::Drive(index) if is_end => self.drives[index] = false,
                Relation::Coupling(index) if is_end => self.couplings[index] = false,
                _ => continue,
            }
            return true;
        }
        false
    }

    /// All that is kept, with the rows of the layout that each knows; none without rows.
    fn relations(&self, system: &System) -> Vec<(Relation, Vec<usize>)> {
        let layout = system.layout();
        let mut all = Vec::new();
        for (index, joint) in system.joints.iter().enumerate().filter(|(index, _)| self.joints[*index]) {
            let nodes = joint.frames.iter().flat_map(|frame| layout.rows_of_node(frame.node));
            let mut rows: Vec<usize> = nodes.filter(|&&row| row != LOCKED).map(|&row| row as usize).collect();
            rows.extend(joint.coordinates.iter().map(|&own| layout.row_of_coordinate(own)));
            all.push((Relation::Joint(index), rows));
        }
        for (index, slider) in system.sliders.iter().enumerate().filter(|(index, _)| self.sliders[*index]) {
            let nodes = slider.carriers().flat_map(|node| layout.rows_of_node(node));
            let mut rows: Vec<usize> = nodes.filter(|&&row| row != LOCKED).map(|&row| row as usize).collect();
            rows.push(layout.row_of_coordinate(slider.coordinate));
            all.push((Relation::Slider(index), rows));
        }
        for (index, drive) in system.drives.iter().enumerate().filter(|(index, _)| self.drives[*index]) {
            let row = layout.row_of_coordinate(drive.prescribed.coordinate);
            all.push((Relation::Drive(index), vec![row]));
        }
        for (index, coupling) in system.couplings.iter().enumerate().filter(|(k, _)| self.couplings[*k]) {
            let rows = coupling.coordinates.iter().map(|&own| layout.row_of_coordinate(own)).collect();
            all.push((Relation::Coupling(index), rows));
        }
        all.retain(|(_, rows)| !rows.is_empty());
        all
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
    /// Derivatives of its equations at a configuration; an angle counts as an arc at `length`.
    pub(crate) fn gradient(&self, system: &System, at: &Kinematics, length: f64, gradient: &mut Gradient) {
        let layout = system.layout();
        gradient.columns.resize_with(self.columns.len(), Vec::new);
        gradient.columns.iter_mut().for_each(Vec::clear);
        // The entries of one column, of equations that follow each other.
        let mut enter = |first: usize, row: usize, is_turn: bool, values: &mut dyn Iterator<Item = f64>| {
            let Ok(column) = self.columns.binary_search(&row) else { return };
            let unit = if is_turn { length } else { 1.0 };
            let entries = values.enumerate().filter(|(_, value)| *value != 0.0);
            gradient.columns[column].extend(entries.map(|(own, value)| (first + own, value / unit)));
        };
        let is_turn = |row: usize| layout.quantities()[row] == Quantity::Angle;
        let mut equation = 0;
        for &index in &self.joints {
            let joint = &system.joints[index];
            let local = &joint.gradient_at(&joint.outright(at));
            let of = |column: usize| (0..joint.equations()).map(move |own| local[(own, column)]);
            for (frame, first) in joint.frames.iter().zip([0, TIP]) {
                for (k, &row) in layout.rows_of_node(frame.node).iter().enumerate() {
                    if row != LOCKED {
                        enter(equation, row as usize, k >= 3, &mut of(first + k));
                    }
                }
            }
            for (k, &coordinate) in joint.coordinates.iter().enumerate() {
                let row = layout.row_of_coordinate(coordinate);
                enter(equation, row, is_turn(row), &mut of(OWN + k));
            }
            equation += joint.equations();
        }
        for &index in &self.sliders {
            let slider = &system.sliders[index];
            let position = slider.place(at);
            let local = slider.gradient(&position, at);
            let of = |column: usize| (0..slider.equations()).map(move |own| local[own][column]);
            let nodes = slider.nodes_of(position.interval);
            for (which, node) in nodes.into_iter().enumerate().filter_map(|(k, node)| Some((k, node?))) {
                for (k, &row) in
                    layout.rows_of_node(node).iter().enumerate().filter(|(_, row)| **row != LOCKED)
                {
                    enter(equation, row as usize, k >= 3, &mut of(6 * which + k));
                }
            }
            let row = layout.row_of_coordinate(slider.coordinate);
            enter(equation, row, is_turn(row), &mut of(slider::OWN));
            equation += slider.equations();
        }
        for &index in &self.drives {
            let row = layout.row_of_coordinate(system.drives[index].prescribed.coordinate);
            enter(equation, row, is_turn(row), &mut std::iter::once(1.0));
            equation += 1;
        }
        for &index in &self.couplings {
            let coupling = &system.couplings[index];
            for (&coordinate, by) in coupling.coordinates.iter().zip(coupling.gradient(at)) {
                let row = layout.row_of_coordinate(coordinate);
                enter(equation, row, is_turn(row), &mut std::iter::once(by));
            }
            equation += 1;
        }
    }
}

/// Derivatives of a loop's equations, without those that vanish.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gradient {
    /// Of every column the equations that know it, each with its derivative. A joint between two places of one part
    /// enters a column twice.
    columns: Vec<Vec<(usize, f64)>>,
    /// Reciprocals of the equations' sizes.
    sizes: Vec<f64>,
}

impl Gradient {
    /// B Bᵀ over its diagonal, below and on the diagonal. `square` has as many rows as there are equations.
    pub(crate) fn square(&mut self, square: &mut DMatrix<f64>) {
        let Self { columns, sizes } = self;
        square.fill(0.0);
        for column in columns {
            for (place, &(i, by_i)) in column.iter().enumerate() {
                square[(i, i)] += by_i * by_i;
                for &(j, by_j) in &column[..place] {
                    // Twice where one equation has entered twice: (a + b)² = a² + 2 a b + b².
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
