//! Loads scaled by signals, and first-order states whose derivatives are signals. They are separate from the batches
//! of elements, so that a system without signals has no overhead.
//!
//! Legend: e forces of the unit load, s its signal, x a state.
//!
//! ```text
//! load:   f = s e,      ∂f/∂q = s ∂e/∂q + e ∂s/∂q            state:   x' - s = 0            balance:   0 - s(x') = 0
//! ```
//!
//! The rate of a state with a balance is an algebraic unknown, and the state its integral, which nothing depends on.

use std::sync::Arc;

use lissom_solver::Pattern;

use super::{ElementId, System};
use lissom_mechanics::elements::{Element, Tangents, Unknowns};
use lissom_mechanics::evaluation::batch::{AnyBatch, scatter, through};
use lissom_mechanics::evaluation::scatter_map::{ScatterMap, free_rows};
use lissom_mechanics::evaluation::tangent_assembler::{Slot, TangentAssembler};
use lissom_mechanics::evaluation::work::{power, power_gradient, work};
use lissom_mechanics::joints::evaluation_point::Chart;
use lissom_mechanics::kinematics::{
    CoordinateId, Kinematics, Layout, NodeId, Stressed, Subject, USUAL_UNKNOWNS,
};
use lissom_mechanics::signals::measurement::{Component, Gradient};
use lissom_mechanics::signals::{Argument, DiscreteValueId, Graph, MeasurementId, SignalId};

/// Target of a signal.
pub enum Target {
    /// A unit load.
    Load(Box<dyn Element>),
    /// A first-order state.
    State([CoordinateId; 1]),
    /// A state whose rate makes the signal zero.
    Balance([CoordinateId; 1]),
}

impl Target {
    fn unknowns(&self) -> Unknowns<'_> {
        match self {
            Self::Load(element) => element.unknowns(),
            Self::State(coordinate) | Self::Balance(coordinate) => Unknowns::of_coordinates(coordinate),
        }
    }
}

/// A load or state, and the unknowns on which it and its signal depend: its own first, in the order of its element,
/// then others.
struct Driven {
    target: Target,
    signal: SignalId,
    /// Number of its own unknowns.
    own: usize,
    /// First local unknown of each node and coordinate.
    nodes: Vec<(NodeId, usize)>,
    coordinates: Vec<(CoordinateId, usize)>,
    rows: Vec<u32>,
}

impl Driven {
    fn new(target: Target, signal: SignalId, graph: &Graph, layout: &Layout) -> Option<Self> {
        let (mut nodes, mut coordinates, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        let unknowns = target.unknowns();
        for &node in unknowns.nodes {
            nodes.push((node, rows.len()));
            rows.extend_from_slice(layout.rows_of_node(node));
        }
        for &coordinate in unknowns.coordinates {
            coordinates.push((coordinate, rows.len()));
            rows.push(layout.row_of_coordinate(coordinate) as u32);
        }
        let own = rows.len();
        for measurement in graph.measurements_of(signal).into_iter().map(|id| &graph.measurements[id]) {
            for &node in measurement.of.nodes() {
                if !nodes.iter().any(|&(known, _)| known == node) {
                    nodes.push((node, rows.len()));
                    rows.extend_from_slice(layout.rows_of_node(node));
                }
            }
            for &coordinate in measurement.of.coordinates() {
                if !coordinates.iter().any(|&(known, _)| known == coordinate) {
                    coordinates.push((coordinate, rows.len()));
                    rows.push(layout.row_of_coordinate(coordinate) as u32);
                }
            }
        }
        u8::try_from(rows.len()).is_ok().then_some(Self { target, signal, own, nodes, coordinates, rows })
    }

    /// Adds `factor` times a measurement's gradient to row `row` of the local matrices.
    fn add_gradient(&self, measurement: &Component, at: &Kinematics, factors: &[f64], out: &mut Tangents) {
        let gradient = measurement.gradient(at);
        let size = out.size();
        let mut from = 0;
        let mut add = |column: usize, count: usize| {
            for (row, factor) in factors.iter().enumerate().filter(|&(_, &factor)| factor != 0.0) {
                for k in 0..count {
                    let entry = row * size + column + k;
                    out.stiffness[entry] += factor * gradient.by_place[from + k];
                    out.damping[entry] += factor * gradient.by_rate[from + k];
                }
            }
            from += count;
        };
        for node in measurement.of.nodes() {
            if let Some(&(_, column)) = self.nodes.iter().find(|(known, _)| known == node) {
                add(column, 6);
            }
        }
        for coordinate in measurement.of.coordinates() {
            if let Some(&(_, column)) = self.coordinates.iter().find(|(known, _)| known == coordinate) {
                add(column, 1);
            }
        }
    }

    /// Adds its derivatives; `values` are those of all signals.
    fn linearize(&self, graph: &Graph, at: &Kinematics, values: &[f64], out: &mut Tangents) {
        let mut factors = [0.0; USUAL_UNKNOWNS];
        match &self.target {
            Target::Load(element) => {
                out.clear(self.own);
                element.linearize(at, out);
                out.multiply(values[self.signal.index()]);
                out.widen(self.rows.len());
                element.forces(at, &mut factors[..self.own]);
            }
            Target::State(_) => {
                out.clear(self.rows.len());
                out.damping[0] = 1.0;
                factors[0] = -1.0;
            }
            Target::Balance(_) => {
                out.clear(self.rows.len());
                factors[0] = -1.0;
            }
        }
        graph.differentiate(self.signal, at, values, |measurement, derivative| {
            let scaled = factors.map(|factor| derivative * factor);
            self.add_gradient(&graph.measurements[measurement], at, &scaled[..self.own], out);
        });
    }
}

/// A value with a lower limit, beyond which the model is not valid.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastValue {
    /// Subject of messages.
    pub of: Subject,
    /// The value.
    pub value: MeasurementId,
    /// Lower limit.
    pub least: f64,
}

/// The graph of signals and their targets.
#[derive(Default)]
pub struct Feedback {
    /// The signals.
    pub graph: Graph,
    /// Values with a lower limit.
    pub least_values: Vec<LeastValue>,
    driven: Vec<Driven>,
    places: ScatterMap,
}

/// The signal of this name depends on too many unknowns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TouchesTooMuch {
    pub name: String,
}

impl Feedback {
    /// Signals with their targets.
    ///
    /// # Errors
    /// If a signal depends on more unknowns than a local matrix has.
    pub fn new(
        graph: Graph,
        targets: Vec<(Target, SignalId)>,
        layout: &Layout,
    ) -> Result<Self, TouchesTooMuch> {
        let driven = targets.into_iter().map(|(target, signal)| {
            let touches = || TouchesTooMuch { name: graph.signals[signal].subject.to_string() };
            Driven::new(target, signal, &graph, layout).ok_or_else(touches)
        });
        let driven = driven.collect::<Result<_, _>>()?;
        Ok(Self { graph, least_values: Vec::new(), driven, places: ScatterMap::new() })
    }

    /// Whether signals have no targets.
    pub fn is_empty(&self) -> bool {
        self.driven.is_empty()
    }

    /// Whether there are states with balances.
    pub fn has_balances(&self) -> bool {
        self.driven.iter().any(|driven| matches!(driven.target, Target::Balance(_)))
    }

    /// Whether any signal with a target depends on the motion or a state, continuously or at samples, or there is a
    /// state.
    pub fn depends_on_motion(&self) -> bool {
        let sees_motion = !self.graph.measurements.is_empty() || !self.graph.readings.is_empty();
        !self.is_empty() && sees_motion
    }

    /// Rows of each load or state with those of each node and coordinate on which it depends: its tangent entries.
    pub fn cliques(&self) -> Vec<Vec<usize>> {
        let mut cliques = Vec::new();
        for driven in &self.driven {
            let own = free_rows(&driven.rows[..driven.own]);
            cliques.push(own.clone());
            let nodes = driven.nodes.iter().map(|&(_, column)| (column, 6));
            for (column, count) in nodes.chain(driven.coordinates.iter().map(|&(_, column)| (column, 1))) {
                let mut clique = own.clone();
                clique.extend(free_rows(&driven.rows[column..column + count]));
                clique.sort_unstable();
                clique.dedup();
                cliques.push(clique);
            }
        }
        cliques
    }

    /// Number of loads and states.
    pub fn count(&self) -> usize {
        self.driven.len()
    }

    /// Work of a load between two configurations [J]; none of a state.
    pub fn work(&self, item: usize, from: &Kinematics, to: &Kinematics) -> f64 {
        self.load(item).map_or(0.0, |(signal, load)| {
            work(load, (from, to), [from, to].map(|at| self.graph.value(signal, at)))
        })
    }

    /// Work of all loads between two configurations [J]: signals are evaluated once at each of them.
    pub fn work_of_all(&self, from: &Kinematics, to: &Kinematics) -> f64 {
        if self.driven.is_empty() {
            return 0.0;
        }
        let of = |before: &[f64], after: &[f64], (signal, load): (SignalId, &dyn Element)| {
            work(load, (from, to), [before, after].map(|own| own[signal.index()]))
        };
        self.graph.evaluate(from, |before| {
            self.graph.evaluate(to, |after| self.loads().map(|own| of(before, after, own)).sum())
        })
    }

    /// Power of all loads [W].
    pub fn power_of_all(&self, at: &Kinematics) -> f64 {
        if self.driven.is_empty() {
            return 0.0;
        }
        self.graph.evaluate(at, |values| {
            self.loads().map(|(signal, load)| values[signal.index()] * power(load, at)).sum()
        })
    }

    fn loads(&self) -> impl Iterator<Item = (SignalId, &dyn Element)> {
        (0..self.count()).filter_map(|item| self.load(item))
    }

    /// Power of a load [W]; none of a state.
    pub fn power(&self, item: usize, at: &Kinematics) -> f64 {
        self.load(item).map_or(0.0, |(signal, load)| self.graph.value(signal, at) * power(load, at))
    }

    /// A load and its signal.
    fn load(&self, item: usize) -> Option<(SignalId, &dyn Element)> {
        let driven = self.driven.get(item)?;
        let Target::Load(load) = &driven.target else { return None };
        Some((driven.signal, &**load))
    }

    /// Known breakpoints of signals that drive loads or states, or that are delayed [s].
    pub fn breakpoints(&self) -> Vec<f64> {
        let delayed = self.graph.delays().iter().filter_map(|delay| delay.source);
        self.graph.breakpoints_of(self.driven.iter().map(|driven| driven.signal).chain(delayed))
    }

    /// Determines the positions of local matrices in the tangent's pattern.
    pub fn locate(&mut self, pattern: &Pattern) {
        self.places = ScatterMap::new();
        for driven in &self.driven {
            self.places.push_rows(pattern, &driven.rows, driven.own);
        }
        self.places.shrink();
    }

    fn add_forces(&self, at: &Kinematics, out: &mut [f64]) {
        self.graph.evaluate(at, |values| {
            for driven in &self.driven {
                let mut local = [0.0; USUAL_UNKNOWNS];
                match &driven.target {
                    Target::Load(element) => {
                        element.forces(at, &mut local[..driven.own]);
                        local = local.map(|force| values[driven.signal.index()] * force);
                    }
                    Target::State([coordinate]) => {
                        local[0] = at.coordinates[*coordinate].rate - values[driven.signal.index()];
                    }
                    Target::Balance(_) => local[0] = -values[driven.signal.index()],
                }
                scatter(&driven.rows[..driven.own], &local, out);
            }
        });
    }

    /// Adds the derivative of the residual with respect to a held value.
    fn add_input(&self, held: DiscreteValueId, at: &Kinematics, out: &mut [f64]) {
        self.graph.evaluate(at, |values| {
            for driven in &self.driven {
                let mut factor = 0.0;
                self.graph.differentiate_by_all(driven.signal, at, values, |argument, derivative| {
                    if argument == Argument::Held(held) {
                        factor += derivative;
                    }
                });
                if factor == 0.0 {
                    continue;
                }
                let mut local = [0.0; USUAL_UNKNOWNS];
                match &driven.target {
                    Target::Load(element) => {
                        element.forces(at, &mut local[..driven.own]);
                        local = local.map(|force| factor * force);
                    }
                    Target::State(_) | Target::Balance(_) => local[0] = -factor,
                }
                scatter(&driven.rows[..driven.own], &local, out);
            }
        });
    }

    fn assemble_tangent(
        &self,
        at: &Kinematics,
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        self.graph.evaluate(at, |values| {
            for (index, driven) in self.driven.iter().enumerate() {
                driven.linearize(&self.graph, at, values, scratch);
                through(chart, driven.nodes.iter().copied(), scratch);
                out.add_element(Slot { rows: &driven.rows, segments: self.places.of(index) }, scratch);
            }
        });
    }
}

impl System {
    /// Derivative of the equations of motion and of states with respect to a held value, by row: the change of the
    /// left-hand sides for a unit of an input.
    pub fn input_derivative(&self, held: DiscreteValueId, at: &Kinematics) -> Vec<f64> {
        let mut out = vec![0.0; self.layout.size()];
        self.feedback.add_input(held, at, &mut out);
        for load in self.elements_with(|own| own.load) {
            let unknowns = load.unknowns();
            let mut local = [0.0; USUAL_UNKNOWNS];
            load.add_by_held(held, at, &mut local[..unknowns.force_count()]);
            let nodes =
                unknowns.nodes.iter().flat_map(|&node| self.layout.rows_of_node(node).iter().copied());
            let coordinates =
                unknowns.coordinates.iter().map(|&own| self.layout.row_of_coordinate(own) as u32);
            let rows: Vec<u32> = nodes.chain(coordinates).collect();
            scatter(&rows, &local, &mut out);
        }
        out
    }
}

/// Power of a load that a signal scales: their product.
pub struct ScaledPower<'s> {
    /// The signal.
    pub signal: SignalId,
    /// Value of the signal.
    pub size: f64,
    /// Power of the unit load [W].
    pub unit: f64,
    /// Gradient of the power of the unit load with respect to these nodes and coordinates.
    pub gradient: Gradient,
    /// Nodes of the load.
    pub nodes: &'s [NodeId],
    /// Coordinates of the load.
    pub coordinates: &'s [CoordinateId],
}

impl System {
    /// The power of a load scaled by a signal, with its parts; none of other elements.
    pub fn scaled_power(&self, element: ElementId, at: &Kinematics) -> Option<ScaledPower<'_>> {
        let (signal, load) = self.feedback.load(element.item).filter(|_| element.batch.is_none())?;
        Some(ScaledPower {
            signal,
            size: self.feedback.graph.value(signal, at),
            unit: power(load, at),
            gradient: power_gradient(load, at)?,
            nodes: load.unknowns().nodes,
            coordinates: load.unknowns().coordinates,
        })
    }
}

/// Loads and states with signals, as a batch among those of elements.
#[derive(Clone)]
pub struct DrivenBatch(pub Arc<Feedback>);

impl std::ops::Deref for DrivenBatch {
    type Target = Feedback;

    fn deref(&self) -> &Feedback {
        &self.0
    }
}

impl AnyBatch for DrivenBatch {
    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        self.add_forces(at, out);
    }

    fn linearize(
        &self,
        (at, _): (&Kinematics, Stressed<'_>),
        chart: Chart<'_>,
        scratch: &mut Tangents,
        out: &mut TangentAssembler<'_>,
    ) {
        self.assemble_tangent(at, chart, scratch, out);
    }
}
