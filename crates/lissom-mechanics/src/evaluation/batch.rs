//! Elements of one kind stored together: one virtual call per kind, a monomorphic loop inside.

use std::any::Any;
use std::ops::Range;

use lissom_motion::{Block, Matrix6, Vector3, WIDTH, lie_bracket_matrix};
use lissom_solver::Pattern;

use super::blocks::Blocks;
use super::element::{Element, Energy, LinearLimit, LinearRange, Tangents, is_same};
use super::scatter_map::{ScatterMap, free_rows};
use super::scratch::with_scratch;
use super::switch_states::SwitchStates;
use super::tangent_assembler::{Slot, TangentAssembler};
use super::threads::Threads;
use super::work::{power, power_gradient, work};
use crate::joints::derivatives::IncrementTangent;
use crate::joints::evaluation_point::Chart;
use crate::kinematics::lanes::processor_for;
use crate::kinematics::step_stages::{STAGES, StepStages};
use crate::kinematics::{CoordinateId, GROUND, Kinematics, LOCKED, Layout, NodeId, Subject, Switch};
use crate::law::VisitLaw;
use crate::signals::measurement::Gradient;

/// All elements of one kind.
pub struct Batch<E> {
    items: Vec<E>,
    /// Row of every local unknown, item by item, [`LOCKED`] if there is none.
    rows: Vec<u32>,
    /// Offset of each item's rows.
    starts: Vec<usize>,
    /// Positions of each item's local matrix in the pattern.
    places: ScatterMap,
    /// The items in lanes, for kinds that are evaluated several at a time.
    blocks: Option<Box<dyn Blocks>>,
    processor: pulp::Arch,
}

/// A batch of any kind.
pub trait AnyBatch: Send + Sync {
    /// Number of items.
    fn count(&self) -> usize;
    /// Whether forces depend on multipliers.
    fn sees_multipliers(&self) -> bool;
    /// Whether motion that deforms an item may be faster than steps resolve.
    fn may_be_stiff(&self) -> bool {
        true
    }
    /// Determines the rows of the items.
    fn connect(&mut self, layout: &Layout);
    /// Determines the positions of local matrices in the tangent's pattern.
    fn locate(&mut self, pattern: &Pattern);
    /// Free rows of each item.
    fn cliques(&self) -> Vec<Vec<usize>>;
    /// Offset of each item's local unknowns, and the end of the last ones.
    fn starts(&self) -> &[usize];
    /// Adds the forces of all items to the rows of the system [N, N m].
    fn forces(&self, at: &Kinematics, out: &mut [f64]);
    /// The same on several threads.
    fn forces_side_by_side(&self, at: &Kinematics, threads: &mut Threads, out: &mut [f64]);
    /// Adds the derivatives of all items; the geometric stiffness uses the stresses of the second configuration.
    fn linearize(
        &self,
        at_stressed: (&Kinematics, &Kinematics),
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    );
    /// Adds the forces of all items at each stage, for schemes that integrate strains.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [Vec<f64>]);
    /// Energy of all items [J].
    fn energy(&self, at: &Kinematics) -> Energy;
    /// Appends the strain energy of every item [J] with its owner.
    fn strain_energies(&self, at: &Kinematics, out: &mut Vec<(Owner, f64)>);
    /// Work of loads between two configurations [J].
    fn work_of_loads(&self, from: &Kinematics, to: &Kinematics) -> f64;
    /// Power of loads [W].
    fn power_of_loads(&self, at: &Kinematics) -> f64;
    /// Angular momentum of items in addition to that of the masses, inertial axes [N m s].
    fn angular_momentum(&self, _at: &Kinematics) -> Vector3 {
        Vector3::zeros()
    }
    /// Elongation, rate and force of a spring-like item.
    fn spring_motion(&self, item: usize, at: &Kinematics) -> Option<[f64; 3]>;
    /// Gradients of these three with respect to the item's local unknowns.
    fn spring_gradients(&self, _item: usize, _at: &Kinematics) -> [Gradient; 3] {
        [Gradient::zero(); 3]
    }
    /// Nodes and coordinates of an item, in the order of its local unknowns.
    fn unknowns(&self, _item: usize) -> (&[NodeId], &[CoordinateId]) {
        (&[], &[])
    }
    /// Passes the derivatives of every item's strain energy to `each`, with their rows; `fall` is the configuration at rest and in
    /// free fall.
    fn strain_slopes(&self, _fall: &Kinematics, _each: &mut dyn FnMut(&[u32], &[f64])) {}
    /// Passes the mass matrix M of every item that has one to `each`, with the derivatives of M v with respect to positions: row by
    /// row of the item's unknowns. `rest` is the configuration at rest, and `thrust` has the velocities v as accelerations.
    fn mass_slopes(
        &self,
        _rest_thrust: (&Kinematics, &Kinematics),
        _each: &mut dyn FnMut(&Mass<'_>, &[f64]),
    ) {
    }
    /// Passes the angular momentum of items in addition to that of the masses to `each`, inertial axes, with the node that turns it.
    fn angular_momenta(&self, _at: &Kinematics, _each: &mut dyn FnMut(NodeId, Vector3)) {}
    /// Power of an item's forces [W].
    fn power(&self, item: usize, at: &Kinematics) -> f64;
    /// Gradient of the power with respect to the item's local unknowns; none if there are more than those of a gradient.
    fn power_gradient(&self, _item: usize, _at: &Kinematics) -> Option<Gradient> {
        None
    }
    /// Work of an item's forces between two configurations [J].
    fn work(&self, item: usize, from: &Kinematics, to: &Kinematics) -> f64;
    /// Known breakpoints of forces [s].
    fn breakpoints(&self) -> Vec<f64>;
    /// Assigns every item slots for the sides of its switches, from the discrete value `first` on; returns their number.
    fn freeze_switches(&mut self, first: usize) -> usize;
    /// Appends numbers that change their sign where forces have a kink or a jump.
    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>);
    /// Passes the scalar laws of all items to `visit`, with their arguments.
    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>);
    /// Appends where each law acts, in words.
    fn name_laws(&self, at: &Kinematics, layout: &Layout, out: &mut Vec<Subject>);
    /// Appends where each switch acts, in words.
    fn name_switches(&self, layout: &Layout, out: &mut Vec<Subject>);
    /// The largest deformation rate of an element [1/s], with one of its nodes.
    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)>;
    /// The largest exceedance of the range of an element's linear law.
    fn linear_range(&self, limit: LinearLimit, at: &Kinematics) -> Option<LinearRange>;
    /// Passes the mass matrix of every item that has one to `each`, row by row: its nodes, its coordinates, its rows.
    fn masses(&self, at: &Kinematics, each: &mut dyn FnMut(&Mass<'_>));
    /// The first node of an item whose kinetic energy is not positive in every motion.
    fn without_positive_mass(&self, at: &Kinematics) -> Option<NodeId>;
    /// The two nodes of an element with the largest relative rotation, and the cosine of half its angle.
    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])>;
    /// Difference of these elements from those of neighbouring models, given with the weights of a difference; none if
    /// it cannot be determined.
    fn changed(&self, neighbours: &[(&dyn AnyBatch, f64)], layout: &Layout) -> Option<Changed>;
    /// Adds the forces of some items only.
    fn forces_of(&self, items: &[usize], at: &Kinematics, out: &mut [f64]);
    /// For comparison with batches of the same kind.
    fn as_any(&self) -> &dyn Any;
    /// For elements that join the batch of their kind.
    fn as_any_mut(&mut self) -> &mut dyn Any;
}

/// The index of an element in its system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementId {
    /// Its batch; none for a load scaled by a signal.
    pub batch: Option<usize>,
    /// Its index in the batch, or among loads scaled by signals.
    pub item: usize,
}

/// An element of any kind that is not in a batch yet.
pub trait AnyElement: Send + Sync {
    /// Adds it to the batch of its kind, or begins one.
    fn join(self: Box<Self>, batches: &mut Vec<Box<dyn AnyBatch>>) -> ElementId;
    /// The same as a unit load, scaled by a signal.
    fn into_load(self: Box<Self>) -> Box<dyn Element>;
}

/// The force of an element, by where it acts.
fn subject(item: &impl Element, layout: &Layout) -> Subject {
    let coordinates = item.coordinates().iter().map(|&own| layout.coordinate_name(own));
    let names: Vec<&str> =
        coordinates.chain(item.nodes().iter().map(|&node| layout.name_of_node(node))).collect();
    let words = format!("the force on `{}`", names.join("` and `"));
    Subject::new("", names.first().copied().unwrap_or_default()).called(words)
}

impl<E: Element> AnyElement for E {
    fn join(self: Box<Self>, batches: &mut Vec<Box<dyn AnyBatch>>) -> ElementId {
        let find = |batch: &mut Box<dyn AnyBatch>| batch.as_any_mut().is::<Batch<E>>();
        let index = batches.iter_mut().position(find).unwrap_or_else(|| {
            batches.push(Box::new(Batch::<E>::new()));
            batches.len() - 1
        });
        let own = batches[index].as_any_mut().downcast_mut::<Batch<E>>().expect("found or made above");
        own.push(*self);
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

/// The mass matrix of an element with mass of its own.
pub struct Mass<'a> {
    /// Its nodes.
    pub nodes: &'a [NodeId],
    /// Of each local unknown.
    pub rows: &'a [u32],
    /// Row by row.
    pub matrix: &'a [f64],
}

impl Mass<'_> {
    /// Each local unknown's component of M x, with its row.
    pub fn times<T: Copy + std::iter::Sum<T> + std::ops::Mul<f64, Output = T>>(
        &self,
        local: &[T],
        mut each: impl FnMut(usize, T),
    ) {
        for (i, row) in self.matrix.chunks_exact(self.rows.len()).enumerate() {
            each(i, local.iter().zip(row).map(|(value, entry)| *value * *entry).sum());
        }
    }
}

/// Owner of an element: its first node that is not the ground, or its first coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Owner {
    /// The first node that is not the ground.
    pub node: Option<NodeId>,
    /// The first coordinate.
    pub coordinate: Option<CoordinateId>,
}

impl<E: Element> Batch<E> {
    fn new() -> Self {
        Self {
            items: Vec::new(),
            rows: Vec::new(),
            starts: Vec::new(),
            places: ScatterMap::new(),
            blocks: None,
            processor: pulp::Arch::new(),
        }
    }

    fn push(&mut self, item: E) {
        self.items.push(item);
    }

    fn place(&self, item: usize) -> Slot<'_> {
        Slot { rows: self.item_rows(item), segments: self.places.of(item) }
    }

    /// Transforms an item's derivatives by the chart and passes them on.
    fn receive(
        &self,
        index: usize,
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        let nodes = self.items[index].nodes().iter();
        through(chart, nodes.enumerate().map(|(k, &node)| (node, 6 * k)), scratch);
        out.add_element(self.place(index), scratch);
    }

    /// Items in a block of those that are evaluated several at a time.
    fn block_items(&self, block: usize) -> Range<usize> {
        block * WIDTH..self.items.len().min((block + 1) * WIDTH)
    }

    fn item_rows(&self, item: usize) -> &[u32] {
        &self.rows[self.starts[item]..self.starts[item + 1]]
    }
}

impl<E: Element> AnyBatch for Batch<E> {
    fn count(&self) -> usize {
        self.items.len()
    }

    fn sees_multipliers(&self) -> bool {
        self.items.iter().any(|item| !item.multipliers().is_empty())
    }

    fn may_be_stiff(&self) -> bool {
        self.items.iter().any(Element::may_be_stiff)
    }

    fn connect(&mut self, layout: &Layout) {
        self.rows.clear();
        self.starts = vec![0];
        for item in &self.items {
            for &node in item.nodes() {
                self.rows.extend_from_slice(layout.rows_of_node(node));
            }
            self.rows.extend(
                item.coordinates().iter().map(|&coordinate| layout.row_of_coordinate(coordinate) as u32),
            );
            let first = layout.coordinate_count();
            self.rows.extend(item.multipliers().iter().map(|&multiplier| (first + multiplier) as u32));
            self.starts.push(self.rows.len());
        }
        self.blocks = E::blocks(&self.items);
        self.processor = processor_for(self.items.len());
    }

    fn locate(&mut self, pattern: &Pattern) {
        self.places = ScatterMap::new();
        for item in 0..self.items.len() {
            let rows = &self.rows[self.starts[item]..self.starts[item + 1]];
            self.places.push(pattern, rows, rows.len());
        }
        self.places.shrink();
    }

    fn cliques(&self) -> Vec<Vec<usize>> {
        (0..self.items.len()).map(|item| free_rows(self.item_rows(item))).collect()
    }

    fn starts(&self) -> &[usize] {
        &self.starts
    }

    fn forces_side_by_side(&self, at: &Kinematics, threads: &mut Threads, out: &mut [f64]) {
        let locals = threads.side_by_side(&self.starts, &|items, locals| {
            let first = self.starts[items.start];
            if let Some(blocks) = &self.blocks {
                let range = items.start / WIDTH..items.end.div_ceil(WIDTH);
                blocks.forces(self.processor, at, range, &mut |block, forces| {
                    for (lane, item) in self.block_items(block).enumerate() {
                        let own = &mut locals[self.starts[item] - first..self.starts[item + 1] - first];
                        for (local, force) in own.iter_mut().zip(forces) {
                            *local = force[lane];
                        }
                    }
                });
                return;
            }
            for item in items {
                let own = self.starts[item] - first..self.starts[item + 1] - first;
                self.items[item].forces(at, &mut locals[own]);
            }
        });
        scatter(&self.rows, locals, out);
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        if let Some(blocks) = &self.blocks {
            let range = 0..self.items.len().div_ceil(WIDTH);
            blocks.forces(self.processor, at, range, &mut |block, forces| {
                for (lane, item) in self.block_items(block).enumerate() {
                    scatter_lane(self.item_rows(item), forces, lane, out);
                }
            });
            return;
        }
        for (index, item) in self.items.iter().enumerate() {
            let rows = self.item_rows(index);
            with_scratch(rows.len(), |local| {
                item.forces(at, local);
                scatter(rows, local, out);
            });
        }
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [Vec<f64>]) {
        for (index, item) in self.items.iter().enumerate() {
            let rows = self.item_rows(index);
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
        (at, stressed): (&Kinematics, &Kinematics),
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        if let Some(blocks) = &self.blocks {
            let range = 0..self.items.len().div_ceil(WIDTH);
            let done = blocks.stiffness(self.processor, (at, stressed), range, &mut |block, entries| {
                for (lane, item) in self.block_items(block).enumerate() {
                    scratch.clear(self.item_rows(item).len());
                    for (value, entry) in scratch.stiffness.iter_mut().zip(entries) {
                        *value = entry[lane];
                    }
                    self.receive(item, chart, scratch, out);
                }
            });
            if done {
                return;
            }
        }
        for (index, item) in self.items.iter().enumerate() {
            scratch.clear(self.item_rows(index).len());
            item.linearize_stressed(at, stressed, scratch);
            self.receive(index, chart, scratch, out);
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let mut sum = Energy::default();
        for item in &self.items {
            sum += item.energy(at);
        }
        sum
    }

    fn strain_energies(&self, at: &Kinematics, out: &mut Vec<(Owner, f64)>) {
        out.extend(self.items.iter().map(|item| {
            let owner = Owner {
                node: item.nodes().iter().copied().find(|&node| node != GROUND),
                coordinate: item.coordinates().first().copied(),
            };
            (owner, item.energy(at).strain)
        }));
    }

    fn work_of_loads(&self, from: &Kinematics, to: &Kinematics) -> f64 {
        let loads = self.items.iter().filter(|item| item.is_load());
        loads.map(|load| work(load, (from, to), [1.0; 2])).sum()
    }

    fn power_of_loads(&self, at: &Kinematics) -> f64 {
        self.items.iter().filter(|item| item.is_load()).map(|load| power(load, at)).sum()
    }

    fn angular_momentum(&self, at: &Kinematics) -> Vector3 {
        self.items.iter().map(|item| item.angular_momentum(at)).sum()
    }

    fn strain_slopes(&self, fall: &Kinematics, each: &mut dyn FnMut(&[u32], &[f64])) {
        for (index, item) in self.items.iter().enumerate() {
            let rows = self.item_rows(index);
            let mut local = vec![0.0; rows.len()];
            item.strain_slopes(fall, &mut local);
            each(rows, &local);
        }
    }

    fn mass_slopes(
        &self,
        (rest, thrust): (&Kinematics, &Kinematics),
        each: &mut dyn FnMut(&Mass<'_>, &[f64]),
    ) {
        let mut matrix = Vec::new();
        for (index, item) in self.items.iter().enumerate() {
            item.mass(thrust, &mut matrix);
            if !matrix.is_empty() {
                let rows = self.item_rows(index);
                let [mut slopes, mut still] = [Tangents::new(rows.len()), Tangents::new(rows.len())];
                item.linearize(thrust, &mut slopes);
                item.linearize(rest, &mut still);
                slopes.stiffness.iter_mut().zip(&still.stiffness).for_each(|(own, still)| *own -= still);
                each(&Mass { nodes: item.nodes(), rows, matrix: &matrix }, &slopes.stiffness);
                matrix.clear();
            }
        }
    }

    fn angular_momenta(&self, at: &Kinematics, each: &mut dyn FnMut(NodeId, Vector3)) {
        for item in &self.items {
            if let Some(&node) = item.nodes().first() {
                each(node, item.angular_momentum(at));
            }
        }
    }

    fn spring_motion(&self, item: usize, at: &Kinematics) -> Option<[f64; 3]> {
        self.items.get(item)?.spring_motion(at)
    }

    fn spring_gradients(&self, item: usize, at: &Kinematics) -> [Gradient; 3] {
        self.items[item].spring_gradients(at)
    }

    fn unknowns(&self, item: usize) -> (&[NodeId], &[CoordinateId]) {
        (self.items[item].nodes(), self.items[item].coordinates())
    }

    fn power(&self, item: usize, at: &Kinematics) -> f64 {
        self.items.get(item).map_or(0.0, |item| power(item, at))
    }

    fn power_gradient(&self, item: usize, at: &Kinematics) -> Option<Gradient> {
        power_gradient(self.items.get(item)?, at)
    }

    fn work(&self, item: usize, from: &Kinematics, to: &Kinematics) -> f64 {
        self.items.get(item).map_or(0.0, |item| work(item, (from, to), [1.0; 2]))
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.items.iter().flat_map(E::breakpoints).collect()
    }

    fn freeze_switches(&mut self, first: usize) -> usize {
        let mut next = first;
        for item in &mut self.items {
            let count = item.switch_count();
            if count > 0 {
                item.freeze_switches(SwitchStates::held_at(next, count));
                next += count;
            }
        }
        next - first
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        self.items.iter().for_each(|item| item.switches(at, out));
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        self.items.iter().for_each(|item| item.laws(at, visit));
    }

    fn name_laws(&self, at: &Kinematics, layout: &Layout, out: &mut Vec<Subject>) {
        for item in &self.items {
            item.laws(at, &mut |_, _| out.push(subject(item, layout)));
        }
    }

    fn name_switches(&self, layout: &Layout, out: &mut Vec<Subject>) {
        for item in &self.items {
            out.extend(std::iter::repeat_n(subject(item, layout), item.switch_count()));
        }
    }

    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let rates = self.items.iter().filter_map(|item| item.deformation_rate(at));
        rates.reduce(|most, rate| if rate.0 > most.0 { rate } else { most })
    }

    fn linear_range(&self, limit: LinearLimit, at: &Kinematics) -> Option<LinearRange> {
        let parts = self.items.iter().filter_map(|item| item.linear_range(limit, at));
        parts.reduce(|most, own| if own.part > most.part { own } else { most })
    }

    fn without_positive_mass(&self, at: &Kinematics) -> Option<NodeId> {
        let found = self.items.iter().find(|item| !item.has_positive_mass(at))?;
        found.nodes().first().copied()
    }

    fn masses(&self, at: &Kinematics, each: &mut dyn FnMut(&Mass<'_>)) {
        let mut matrix = Vec::new();
        for (index, item) in self.items.iter().enumerate() {
            item.mass(at, &mut matrix);
            if !matrix.is_empty() {
                each(&Mass { nodes: item.nodes(), rows: self.item_rows(index), matrix: &matrix });
                matrix.clear();
            }
        }
    }

    fn max_relative_rotation(&self, at: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        let pairs = self.items.iter().filter_map(|item| item.max_relative_rotation(at));
        pairs.reduce(|least, pair| if pair.0 < least.0 { pair } else { least })
    }

    fn changed(&self, neighbours: &[(&dyn AnyBatch, f64)], layout: &Layout) -> Option<Changed> {
        let mut others: Vec<(&Self, f64)> = Vec::with_capacity(neighbours.len());
        for (other, weight) in neighbours {
            let other = other.as_any().downcast_ref::<Self>()?;
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

    fn forces_of(&self, items: &[usize], at: &Kinematics, out: &mut [f64]) {
        for &item in items {
            let rows = self.item_rows(item);
            with_scratch(rows.len(), |local| {
                self.items[item].forces(at, local);
                scatter(rows, local, out);
            });
        }
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
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
            Chart::RelativeToDrift(start) => {
                let turning = lie_bracket_matrix(&start[node].twist);
                let Tangents { stiffness, damping, mass, .. } = scratch;
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
