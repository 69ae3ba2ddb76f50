//! Elements of one kind stored together: an evaluation is one virtual call per kind with a monomorphic loop inside. Other queries visit
//! the elements.

use std::any::Any;
use std::ops::Range;

use lissom_motion::{Block, Matrix6, WIDTH, lie_bracket_matrix};
use lissom_solver::Pattern;

use super::blocks::Blocks;
use super::capabilities::{Capabilities, ForceLaws};
use super::element::{Element, Tangents, Unknowns, is_same};
use super::scatter_map::{ScatterMap, free_rows};
use super::scratch::with_scratch;
use super::switch_states::SwitchStates;
use super::tangent_assembler::{Slot, TangentAssembler};
use super::threads::Threads;
use crate::joints::derivatives::IncrementTangent;
use crate::joints::evaluation_point::Chart;
use crate::kinematics::lanes::processor_for;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, Layout, NodeId, Stressed};

/// All elements of one kind.
pub struct Batch<E> {
    items: Vec<E>,
    rows: LocalRows,
    /// Positions of each item's local matrix in the pattern.
    places: ScatterMap,
    /// The items in lanes, for kinds that are evaluated several at a time.
    blocks: Option<Box<dyn Blocks>>,
    processor: pulp::Arch,
}

/// Row of every local unknown, item by item, [`LOCKED`] if there is none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LocalRows {
    rows: Vec<u32>,
    starts: Vec<usize>,
}

impl LocalRows {
    const fn none() -> Self {
        Self { rows: Vec::new(), starts: Vec::new() }
    }

    /// Number of items.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Offset of each item's rows, and the end of the last ones.
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// Rows of an item.
    #[inline]
    pub fn of(&self, item: usize) -> &[u32] {
        &self.rows[self.starts[item]..self.starts[item + 1]]
    }

    /// Free rows of each item.
    pub fn cliques(&self) -> impl Iterator<Item = Vec<usize>> {
        self.starts.windows(2).map(|ends| free_rows(&self.rows[ends[0]..ends[1]]))
    }
}

/// A batch of any kind: evaluations of all items together, and each item. Defaults are for forces without items.
pub trait AnyBatch: Any + Send + Sync {
    /// Determines the rows of the items.
    fn connect(&mut self, _layout: &Layout) {}
    /// Determines the positions of local matrices in the tangent's pattern.
    fn locate(&mut self, _pattern: &Pattern) {}
    /// Assigns every item slots for the sides of its switches, from the discrete value `first` on; returns their number.
    fn freeze_switches(&mut self, _first: usize) -> usize {
        0
    }
    /// An item; none beyond the last.
    fn element(&self, _item: usize) -> Option<&dyn Element> {
        None
    }
    /// Rows of the items.
    fn rows(&self) -> &LocalRows {
        static NONE: LocalRows = LocalRows::none();
        &NONE
    }
    /// Adds the forces of all items to the rows of the system [N, N m].
    fn forces(&self, at: &Kinematics, out: &mut [f64]);
    /// Adds the forces of all items on several threads.
    fn forces_side_by_side(&self, at: &Kinematics, _threads: &mut Threads, out: &mut [f64]) {
        self.forces(at, out);
    }
    /// Adds the forces of all items at each stage, for schemes that integrate strains.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [Vec<f64>]) {
        for (at, out) in step.stages.iter().zip(out) {
            self.forces(at, out);
        }
    }
    /// Adds the derivatives of all items; the geometric stiffness uses the stresses of the second configuration.
    fn linearize(
        &self,
        at_stressed: (&Kinematics, Stressed<'_>),
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    );
    /// Difference of these elements from those of neighbouring models, given with the weights of a difference; none if
    /// it cannot be determined.
    fn changed(&self, _neighbours: &[(&dyn AnyBatch, f64)], _layout: &Layout) -> Option<Changed> {
        None
    }
}

impl dyn AnyBatch {
    /// All items.
    pub fn elements(&self) -> impl Iterator<Item = &dyn Element> {
        (0..).map_while(|item| self.element(item))
    }

    /// Capabilities of its kind, those of the first item; none without items.
    pub fn capabilities(&self) -> Capabilities<'_> {
        self.element(0).map(Element::capabilities).unwrap_or_default()
    }

    /// All items with a capability. Ends at the first one without it, since the others are of the same kind.
    pub fn elements_with<'b, C: ?Sized + 'b>(
        &'b self,
        capability: impl Fn(Capabilities<'b>) -> Option<&'b C>,
    ) -> impl Iterator<Item = &'b C> {
        (0..).map_while(move |item| capability(self.element(item)?.capabilities()))
    }

    /// Whether forces of an item depend on multipliers.
    pub fn sees_multipliers(&self) -> bool {
        self.elements().any(|element| !element.unknowns().multipliers.is_empty())
    }

    /// Whether motion that deforms an item may be faster than steps resolve.
    pub fn may_be_stiff(&self) -> bool {
        !self.capabilities().is_body_inertia
    }
}

/// The index of an element in its system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementId {
    /// Batch of the element; none for a load scaled by a signal.
    pub batch: Option<usize>,
    /// Index of the element in the batch, or among loads scaled by signals.
    pub item: usize,
}

/// An element of any kind that is not in a batch yet.
pub trait AnyElement: Send + Sync {
    /// Adds it to the batch of its kind, or begins one.
    fn join(self: Box<Self>, batches: &mut Vec<Box<dyn AnyBatch>>) -> ElementId;
    /// Converts the element to a unit load, scaled by a signal.
    fn into_load(self: Box<Self>) -> Box<dyn Element>;
}

impl<E: Element> AnyElement for E {
    fn join(self: Box<Self>, batches: &mut Vec<Box<dyn AnyBatch>>) -> ElementId {
        let find = |batch: &mut Box<dyn AnyBatch>| (&**batch as &dyn Any).is::<Batch<E>>();
        let index = batches.iter_mut().position(find).unwrap_or_else(|| {
            batches.push(Box::new(Batch::<E>::new()));
            batches.len() - 1
        });
        let batch: &mut dyn Any = &mut *batches[index];
        let own = batch.downcast_mut::<Batch<E>>().expect("found or made above");
        own.items.push(*self);
        ElementId { batch: Some(index), item: own.items.len() - 1 }
    }

    fn into_load(self: Box<Self>) -> Box<dyn Element> {
        self
    }
}

/// Difference between the elements of a kind in two models.
pub enum Changed {
    /// Nothing.
    Nothing,
    /// Elements whose forces are the derivative with respect to the parameter.
    Derivative(Box<dyn AnyBatch>),
    /// Indices of items whose forces are to be compared.
    Items(Vec<usize>),
}

impl<E: Element> Batch<E> {
    fn new() -> Self {
        Self {
            items: Vec::new(),
            rows: LocalRows::none(),
            places: ScatterMap::new(),
            blocks: None,
            processor: pulp::Arch::new(),
        }
    }

    /// Number of an item's nodes and its coordinates, if it is idle.
    #[inline]
    fn idle(&self, item: usize, at: &Kinematics) -> Option<(usize, &[CoordinateId])> {
        let item = &self.items[item];
        let is_idle = item.capabilities().laws.is_some_and(|laws| laws.is_idle(at));
        let Unknowns { nodes, coordinates, .. } = item.unknowns();
        is_idle.then_some((nodes.len(), coordinates))
    }

    fn place(&self, item: usize) -> Slot<'_> {
        Slot { rows: self.rows.of(item), segments: self.places.of(item) }
    }

    /// Transforms an item's derivatives by the chart and passes them on.
    fn receive(
        &self,
        index: usize,
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        let nodes = self.items[index].unknowns().nodes.iter();
        through(chart, nodes.enumerate().map(|(k, &node)| (node, 6 * k)), scratch);
        out.add_element(self.place(index), scratch);
    }

    /// Items in a block of those that are evaluated several at a time.
    fn block_items(&self, block: usize) -> Range<usize> {
        block * WIDTH..self.items.len().min((block + 1) * WIDTH)
    }
}

impl<E: Element> AnyBatch for Batch<E> {
    fn connect(&mut self, layout: &Layout) {
        self.rows = LocalRows { rows: Vec::new(), starts: vec![0] };
        let LocalRows { rows, starts } = &mut self.rows;
        for item in &self.items {
            let Unknowns { nodes, coordinates, multipliers } = item.unknowns();
            for &node in nodes {
                rows.extend_from_slice(layout.rows_of_node(node));
            }
            rows.extend(coordinates.iter().map(|&coordinate| layout.row_of_coordinate(coordinate) as u32));
            let first = layout.coordinate_count();
            rows.extend(multipliers.iter().map(|&multiplier| (first + multiplier) as u32));
            starts.push(rows.len());
        }
        self.blocks = E::blocks(&self.items);
        self.processor = processor_for(self.items.len());
    }

    fn locate(&mut self, pattern: &Pattern) {
        self.places = ScatterMap::new();
        for item in 0..self.items.len() {
            let rows = self.rows.of(item);
            self.places.push(pattern, rows, rows.len());
        }
        self.places.shrink();
    }

    fn freeze_switches(&mut self, first: usize) -> usize {
        let mut next = first;
        for item in &mut self.items {
            let count = item.capabilities().laws.map_or(0, ForceLaws::switch_count);
            if let Some(states) = item.switch_states().filter(|_| count > 0) {
                *states = SwitchStates::held_at(next, count);
            }
            next += count;
        }
        next - first
    }

    fn element(&self, item: usize) -> Option<&dyn Element> {
        self.items.get(item).map(|own| own as &dyn Element)
    }

    fn rows(&self) -> &LocalRows {
        &self.rows
    }

    fn forces_side_by_side(&self, at: &Kinematics, threads: &mut Threads, out: &mut [f64]) {
        let starts = self.rows.starts();
        let locals = threads.side_by_side(starts, &|items, locals| {
            let first = starts[items.start];
            if let Some(blocks) = &self.blocks {
                let range = items.start / WIDTH..items.end.div_ceil(WIDTH);
                blocks.forces(self.processor, at, range, &mut |block, forces| {
                    for (lane, item) in self.block_items(block).enumerate() {
                        let own = &mut locals[starts[item] - first..starts[item + 1] - first];
                        for (local, force) in own.iter_mut().zip(forces) {
                            *local = force[lane];
                        }
                    }
                });
                return;
            }
            for item in items {
                let own = starts[item] - first..starts[item + 1] - first;
                self.items[item].forces(at, &mut locals[own]);
            }
        });
        scatter(&self.rows.rows, locals, out);
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        if let Some(blocks) = &self.blocks {
            let range = 0..self.items.len().div_ceil(WIDTH);
            blocks.forces(self.processor, at, range, &mut |block, forces| {
                for (lane, item) in self.block_items(block).enumerate() {
                    scatter_lane(self.rows.of(item), forces, lane, out);
                }
            });
            return;
        }
        for (index, item) in self.items.iter().enumerate() {
            let rows = self.rows.of(index);
            if let Some((nodes, coordinates)) = self.idle(index, at) {
                for (&row, &coordinate) in rows[6 * nodes..].iter().zip(coordinates) {
                    out[row as usize] += at.coordinates[coordinate].rate;
                }
                continue;
            }
            with_scratch(rows.len(), |local| {
                item.forces(at, local);
                scatter(rows, local, out);
            });
        }
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [Vec<f64>]) {
        for (index, item) in self.items.iter().enumerate() {
            let rows = self.rows.of(index);
            with_scratch(STAGES * rows.len(), |locals| {
                let (first, second) = locals.split_at_mut(rows.len());
                let mut local = [first, second];
                item.stage_forces(step, &mut local);
                for (local, out) in local.iter().zip(out.iter_mut()) {
                    scatter(rows, local, out);
                }
            });
        }
    }

    fn linearize(
        &self,
        (at, stressed): (&Kinematics, Stressed<'_>),
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        if let Some(blocks) = &self.blocks {
            let range = 0..self.items.len().div_ceil(WIDTH);
            let done = blocks.linearize(self.processor, (at, stressed), range, &mut |block, entries| {
                for (lane, item) in self.block_items(block).enumerate() {
                    if matches!(chart, Chart::Body) {
                        out.add_lane(self.place(item), entries, lane);
                        continue;
                    }
                    scratch.clear(self.rows.of(item).len());
                    for (values, entries) in
                        [&mut scratch.stiffness, &mut scratch.damping].into_iter().zip(entries)
                    {
                        values.iter_mut().zip(entries).for_each(|(value, entry)| *value = entry[lane]);
                    }
                    self.receive(item, chart, scratch, out);
                }
            });
            if done {
                return;
            }
        }
        for (index, item) in self.items.iter().enumerate() {
            if let Some((nodes, coordinates)) = self.idle(index, at) {
                if !coordinates.is_empty() {
                    out.add_rates(self.place(index), 6 * nodes);
                }
                continue;
            }
            scratch.clear(self.rows.of(index).len());
            match item.capabilities().deformation {
                Some(deformable) => deformable.linearize_stressed(at, stressed, scratch),
                None => item.linearize(at, scratch),
            }
            self.receive(index, chart, scratch, out);
        }
    }

    fn changed(&self, neighbours: &[(&dyn AnyBatch, f64)], layout: &Layout) -> Option<Changed> {
        let mut others: Vec<(&Self, f64)> = Vec::with_capacity(neighbours.len());
        for (other, weight) in neighbours {
            let other = (*other as &dyn Any).downcast_ref::<Self>()?;
            if other.rows != self.rows {
                return None;
            }
            others.push((other, *weight));
        }
        let neighbours = others;
        let is_changed = |&item: &usize| {
            neighbours.iter().any(|(other, _)| !is_same(&self.items[item], &other.items[item]))
        };
        let items: Vec<usize> = (0..self.items.len()).filter(is_changed).collect();
        if items.is_empty() {
            return Some(Changed::Nothing);
        }
        let derivative = |&item: &usize| {
            let of: Vec<(&E, f64)> =
                neighbours.iter().map(|(other, weight)| (&other.items[item], *weight)).collect();
            E::derivative(&of)
        };
        let Some(derivatives) = items.iter().map(derivative).collect::<Option<Vec<E>>>() else {
            return Some(Changed::Items(items));
        };
        let mut batch = Self { items: derivatives, ..Self::new() };
        batch.connect(layout);
        Some(Changed::Derivative(Box::new(batch)))
    }
}

/// Transforms local derivatives by the chart, for nodes with given offsets of their six columns.
pub fn through(chart: Chart<'_>, nodes: impl Iterator<Item = (NodeId, usize)>, scratch: &mut Tangents) {
    let size = scratch.size();
    for (node, column) in nodes {
        match chart {
            Chart::Body => {}
            Chart::Increments(increments) => {
                through_chart(&mut scratch.stiffness, size, column, &increments[node]);
            }
            Chart::RelativeToDrift(start, spinning) => {
                let Tangents { stiffness, damping, mass, .. } = scratch;
                if let Some(axes) = spinning.iter().find(|axes| axes.node == node) {
                    let [of_velocity, of_acceleration, of_place] = axes.matrices();
                    add_columns(stiffness, damping, size, column, &of_velocity);
                    add_columns(stiffness, mass, size, column, &of_place);
                    add_columns(damping, mass, size, column, &of_acceleration);
                    continue;
                }
                let turning = lie_bracket_matrix(&start[node].twist);
                add_columns(stiffness, damping, size, column, &turning);
                add_columns(damping, mass, size, column, &turning);
            }
        }
    }
}

/// Adds local values to the free rows.
pub fn scatter(rows: &[u32], local: &[f64], out: &mut [f64]) {
    for (&row, value) in rows.iter().zip(local) {
        if row != LOCKED {
            out[row as usize] += value;
        }
    }
}

/// Adds one lane of a block's forces to the free rows, six per node.
#[inline]
pub fn scatter_lane(rows: &[u32], forces: &[Block], lane: usize, out: &mut [f64]) {
    for (rows, forces) in rows.chunks(6).zip(forces.chunks(6)) {
        // Most nodes have all their degrees of freedom, in six consecutive rows.
        if let (&[first, .., last], [a, b, c, d, e, f]) = (rows, forces)
            && first != LOCKED
            && last == first + 5
        {
            let first = first as usize;
            let [u, v, w, x, y, z] = &mut out[first..first + 6] else { unreachable!("six rows") };
            *u += a[lane];
            *v += b[lane];
            *w += c[lane];
            *x += d[lane];
            *y += e[lane];
            *z += f[lane];
            continue;
        }
        for (&row, force) in rows.iter().zip(forces).filter(|&(&row, _)| row != LOCKED) {
            out[row as usize] += force[lane];
        }
    }
}

/// Adds `factor` times six columns of `other` to those of `matrix`.
fn add_columns(matrix: &mut [f64], other: &[f64], size: usize, column: usize, factor: &Matrix6) {
    for (row, source) in matrix.chunks_exact_mut(size).zip(other.chunks_exact(size)) {
        let (row, source) = (&mut row[column..column + 6], &source[column..column + 6]);
        for (i, &value) in source.iter().enumerate().filter(|&(_, &value)| value != 0.0) {
            for j in 0..6 {
                row[j] += value * factor[(i, j)];
            }
        }
    }
}

/// Multiplies the six columns from `column` of a row-major local matrix by T(ψ): from body variations to
/// variations of the increment ψ.
fn through_chart(matrix: &mut [f64], size: usize, column: usize, chart: &IncrementTangent) {
    for row in matrix.chunks_exact_mut(size) {
        chart.through(&mut row[column..column + 6]);
    }
}
