//! Puts a system together: nodes, elements, joints; then numbers the unknowns and checks what can be
//! checked without solving.

mod coupling;
mod drawn;
mod groups;
mod motion;
mod rolling;
mod signals;
mod slider;

use std::sync::Arc;

use lissom_motion::{Matrix6, Motion, Vector3, Vector6};
use lissom_solver::{Pattern, Structure};

pub use self::drawn::PlaceOnTip;
use self::drawn::{joint_rotation, start_values};
use self::rolling::Impulse;
use super::batch::{AnyBatch, Batch};
use super::constraints::{Constraints, Placed};
use super::feedback::{Feedback, Target};
use super::places::{Places, free_rows};
use super::state::State;
use super::{CoordinateMass, ElementId, System};
use crate::elements::Element;
use crate::elements::creep_force::CreepForce;
use crate::elements::inertia::{Gravity, Inertia};
use crate::joints::attached::AttachedJoint;
use crate::joints::blocks::Batches;
use crate::joints::derivatives::{LOCAL, OWN, TIP};
use crate::joints::{Build, Geometry, JointKind};
use crate::kinematics::{
    CarriedFrame, CoordinateId, CoordinateMotion, Freedoms, GROUND, Kinematics, LOCKED, Layout, NodeId,
    NodeMotion, Quantity,
};
use crate::registry::{Function, ParameterError, Parameters};
use crate::signals::{Graph, HeldId, SignalId};

/// Why a system could not be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Nothing can move.
    #[error("the model has no unknowns: nothing in it can move")]
    Empty,
    /// A coordinate that no constraint or spring sees, or a structure that cannot be ordered.
    #[error("the equations cannot be ordered: {0}")]
    Structure(String),
    /// A signal depends on too many parts of the model.
    #[error("{0} depends on too many parts: more than 255 unknowns; measure less in one expression")]
    SignalTouchesTooMuch(String),
}

/// Where a joint lies at the start, in inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Base and tip node.
    pub nodes: [NodeId; 2],
    /// The joint's point, on the base [m].
    pub at: Vector3,
    /// The tip's point, for kinds that span a distance; the tip node's place where not given [m].
    pub at_tip: Option<Vector3>,
    /// Direction of the joint's axis, for kinds that have one.
    pub axis: Option<Vector3>,
    /// Direction of the second axis, for kinds that have two.
    pub second_axis: Option<Vector3>,
}

struct Node {
    name: String,
    motion: NodeMotion,
    freedoms: Freedoms,
    mass: Option<Matrix6>,
}

struct Coordinate {
    name: String,
    /// At the start [m, rad].
    value: f64,
    /// Its rate at the start [m/s, rad/s].
    rate: f64,
    quantity: Quantity,
}

/// Collects the parts of a system.
pub struct Builder {
    nodes: Vec<Node>,
    coordinates: Vec<Coordinate>,
    batches: Vec<Box<dyn AnyBatch>>,
    constraints: Constraints,
    multipliers: Vec<(String, &'static str)>,
    multiplier_quantities: Vec<Quantity>,
    gravity: Gravity,
    states: Vec<(CoordinateId, f64)>,
    impulses: Vec<Impulse>,
    coordinate_masses: Vec<CoordinateMass>,
    free_coordinates: Vec<CoordinateId>,
    /// Inputs that engage latches.
    latches: Vec<HeldId>,
    functions: Vec<(String, Function)>,
    graph: Graph,
    targets: Vec<(Target, SignalId)>,
    /// The signal that is the size of the loads being added.
    driver: Option<SignalId>,
    /// The element added last.
    last: Option<ElementId>,
    /// Where parts are given approximately: the values of coordinates at the start that joints are given.
    start_values: Option<Vec<(CoordinateId, f64)>>,
}

impl Default for Builder {
    fn default() -> Self {
        Self::new()
    }
}

impl Builder {
    /// A system with nothing but the ground.
    pub fn new() -> Self {
        let ground = Node {
            name: "ground".to_owned(),
            motion: NodeMotion::at_rest(Motion::identity()),
            freedoms: Freedoms::Fixed,
            mass: None,
        };
        Self {
            nodes: vec![ground],
            coordinates: Vec::new(),
            batches: Vec::new(),
            constraints: Constraints::default(),
            multipliers: Vec::new(),
            multiplier_quantities: Vec::new(),
            gravity: Gravity::constant(Vector3::zeros()),
            states: Vec::new(),
            impulses: Vec::new(),
            coordinate_masses: Vec::new(),
            free_coordinates: Vec::new(),
            latches: Vec::new(),
            functions: Vec::new(),
            graph: Graph::default(),
            targets: Vec::new(),
            driver: None,
            last: None,
            start_values: None,
        }
    }

    /// Sets gravity [m/s²], in inertial axes.
    pub fn set_gravity(&mut self, gravity: Vector3) {
        self.gravity.acceleration = gravity;
    }

    /// Lets gravity act by a factor that is a function of time.
    pub fn set_gravity_factor(&mut self, factor: Function) {
        self.gravity.factor = Some(factor);
    }

    /// Adds a node with its place at the start.
    pub fn add_node(&mut self, name: &str, frame: Motion, freedoms: Freedoms) -> NodeId {
        let motion = NodeMotion::at_rest(frame);
        self.nodes.push(Node { name: name.to_owned(), motion, freedoms, mass: None });
        self.nodes.len() - 1
    }

    /// Sets a node's twist at the start, in its body frame [m/s, rad/s]; locked freedoms stay at rest.
    pub fn set_twist(&mut self, node: NodeId, twist: Vector6) {
        let freedoms = self.nodes[node].freedoms;
        self.nodes[node].motion.twist =
            Vector6::from_fn(|k, _| if freedoms.is_free(k) { twist[k] } else { 0.0 });
    }

    /// Locks all freedoms of a node: it stays where it is.
    pub fn lock(&mut self, node: NodeId) {
        self.nodes[node].freedoms = Freedoms::Fixed;
        self.nodes[node].motion.twist.fill(0.0);
    }

    /// Place of a node at the start.
    pub fn initial_frame(&self, node: NodeId) -> Motion {
        self.nodes[node].motion.frame
    }

    /// Which freedoms of a node are free.
    pub fn freedoms(&self, node: NodeId) -> Freedoms {
        self.nodes[node].freedoms
    }

    /// Adds an algebraic coordinate that no joint has, at zero at the start.
    pub(crate) fn add_coordinate(&mut self, name: &str, quantity: Quantity) -> CoordinateId {
        self.coordinates.push(Coordinate { name: name.to_owned(), value: 0.0, rate: 0.0, quantity });
        self.coordinates.len() - 1
    }

    /// Gravity and the part of it that acts.
    pub(crate) fn gravity(&self) -> &Gravity {
        &self.gravity
    }

    /// Adds to a node's mass matrix: 6x6, in the node's frame, about the node.
    pub fn add_inertia(&mut self, node: NodeId, mass: &Matrix6) {
        *self.nodes[node].mass.get_or_insert_with(Matrix6::zeros) += mass;
    }

    /// Adds an element.
    pub fn add_element<E: Element>(&mut self, element: E) {
        if let Some(signal) = self.driver {
            self.targets.push((Target::Load(Box::new(element)), signal));
            self.last = Some(ElementId { batch: None, item: self.targets.len() - 1 });
            return;
        }
        for (index, batch) in self.batches.iter_mut().enumerate() {
            if let Some(batch) = batch.as_any_mut().downcast_mut::<Batch<E>>() {
                batch.push(element);
                self.last = Some(ElementId { batch: Some(index), item: batch.len() - 1 });
                return;
            }
        }
        let mut batch = Batch::<E>::new();
        batch.push(element);
        self.last = Some(ElementId { batch: Some(self.batches.len()), item: 0 });
        self.batches.push(Box::new(batch));
    }

    /// The element that was added last, if any since this was asked.
    pub fn take_last_element(&mut self) -> Option<ElementId> {
        self.last.take()
    }

    /// Adds a joint of a kind that stands between two nodes; gives its algebraic coordinates.
    ///
    /// # Errors
    /// If a parameter or an axis is missing or makes no sense.
    pub fn add_joint(
        &mut self,
        name: &str,
        kind: &JointKind,
        placement: &Placement,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        self.add_joint_apart(name, kind, (placement, None), parameters)
    }

    /// Adds a joint whose frame on the tip lies elsewhere than its frame on the base, for parts that are given
    /// approximately and assembled.
    ///
    /// # Errors
    /// If a parameter or an axis is missing or makes no sense.
    pub fn add_joint_apart(
        &mut self,
        name: &str,
        kind: &JointKind,
        (placement, on_tip): (&Placement, Option<&PlaceOnTip>),
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        let Build::Relative(frames, build) = kind.build else {
            return Err(ParameterError::new("kind", "acts on another joint's coordinate"));
        };
        let base = Motion::new(joint_rotation(frames, placement)?, placement.at);
        let tip = placement.at_tip.unwrap_or(self.nodes[placement.nodes[1]].motion.frame.position);
        let span = base.inverse_transform_point(&tip);
        let geometry = Geometry { span, planar: self.moves_in_plane(placement, &base), axes: base.rotation };
        let mut joint = build(parameters, &geometry)?;
        let given = start_values(joint.as_ref(), parameters)?;
        let mut base = base;
        if !given.is_empty() {
            let unset = build(
                &parameters.without(given.iter().map(|&(k, _)| joint.coordinates()[k].name)),
                &geometry,
            )?;
            if self.start_values.is_some() {
                joint = unset;
            } else {
                // Values at the start choose from where coordinates are counted: the tip's point stays at the joint's
                // location, and the base's frame moves back.
                let back = unset.initial().1.position - joint.initial().1.position;
                base = base * Motion::translation(back);
            }
        }
        let (values, relative) = joint.initial();
        let places = [base, on_tip.map_or(Ok(base), |place| place.frame(&base, placement))? * relative];
        let carried = [0, 1].map(|side| {
            let node = placement.nodes[side];
            CarriedFrame { node, offset: places[side].relative_to(&self.nodes[node].motion.frame) }
        });
        let coordinates: Vec<CoordinateId> = joint
            .coordinates()
            .iter()
            .enumerate()
            .map(|(k, coordinate)| {
                self.coordinates.push(Coordinate {
                    name: format!("{name}.{}", coordinate.name),
                    value: values[k],
                    rate: 0.0,
                    quantity: coordinate.quantity,
                });
                self.coordinates.len() - 1
            })
            .collect();
        if let Some(start) = &mut self.start_values {
            start.extend(given.into_iter().map(|(k, value)| (coordinates[k], value)));
        }
        let first_multiplier = self.multipliers.len();
        for (k, &equation) in joint.equations().iter().enumerate() {
            self.multipliers.push((name.to_owned(), equation));
            self.multiplier_quantities.push(joint.equation_quantity(k));
        }
        let impulses =
            joint.contact().map_or_else(Vec::new, |contact| self.add_rolling(name, carried, contact));
        if let (Some(contact), Some(law)) = (joint.rail_contact(), joint.creep()) {
            self.add_element(CreepForce::new(carried, first_multiplier, contact.clone(), law.clone()));
            self.last = None;
        }
        self.constraints.joints.push(AttachedJoint {
            name: name.to_owned(),
            kind: kind.name,
            frames: carried,
            output_frames: carried,
            coordinates: coordinates.clone(),
            first_multiplier,
            impulses,
            joint,
        });
        Ok(coordinates)
    }

    /// Whether the tip can only move in the plane of the joint frame's first two axes.
    fn moves_in_plane(&self, placement: &Placement, base: &Motion) -> bool {
        let Freedoms::Planar(a, b) = self.nodes[placement.nodes[1]].freedoms else { return false };
        let frame = self.nodes[placement.nodes[1]].motion.frame;
        let mut normal = Vector3::zeros();
        normal[3 - a - b] = 1.0;
        base.rotation.apply_inverse(&frame.rotation.apply(&normal)).z.abs() > 1.0 - 1e-12
    }

    /// Name of a coordinate.
    pub fn coordinate_name(&self, coordinate: CoordinateId) -> &str {
        &self.coordinates[coordinate].name
    }

    /// Value of a coordinate at the start [m or rad].
    pub(crate) fn coordinate_start(&self, coordinate: CoordinateId) -> f64 {
        self.coordinates[coordinate].value
    }

    /// What a coordinate measures.
    pub fn coordinate_quantity(&self, coordinate: CoordinateId) -> Quantity {
        self.coordinates[coordinate].quantity
    }

    /// Whether a coordinate measures what a drive or spring acts on.
    pub(crate) fn check_quantity(
        &self,
        coordinate: CoordinateId,
        wanted: Quantity,
    ) -> Result<(), ParameterError> {
        if self.coordinates[coordinate].quantity == wanted {
            return Ok(());
        }
        Err(ParameterError::new("coordinate", format!("must be a relative {}", wanted.relative())))
    }

    /// Numbers the unknowns and gives the system with its state at `time` [s]: places and twists as
    /// given, accelerations and multipliers zero.
    ///
    /// # Errors
    /// If nothing can move.
    pub fn build(mut self, time: f64) -> Result<(System, State), BuildError> {
        let layout = self.number();
        if layout.coordinate_count == 0 {
            return Err(BuildError::Empty);
        }
        let inertias: Vec<Inertia> = self
            .nodes
            .iter()
            .enumerate()
            .filter_map(|(node, spec)| spec.mass.map(|mass| Inertia::new(node, mass, self.gravity.clone())))
            .collect();
        if !inertias.is_empty() {
            let mut batch = Batch::<Inertia>::new();
            for inertia in &inertias {
                batch.push(inertia.clone());
            }
            self.batches.push(Box::new(batch));
        }
        for batch in &mut self.batches {
            batch.connect(&layout);
        }
        let targets = std::mem::take(&mut self.targets);
        let mut feedback = Feedback::new(std::mem::take(&mut self.graph), targets, &layout)
            .map_err(|touches| BuildError::SignalTouchesTooMuch(touches.name))?;
        let joint_rows: Vec<Vec<u32>> =
            self.constraints.joints.iter().map(|joint| rows_of(joint, &layout)).collect();
        let mut placed: Vec<Placed> =
            self.constraints.others().map(|constraint| Placed::new(constraint, &layout)).collect();
        let of_others = self.constraints.others().zip(&placed);
        let cliques: Vec<Vec<usize>> = self
            .batches
            .iter()
            .flat_map(|batch| batch.cliques())
            .chain(feedback.cliques())
            .chain(joint_rows.iter().map(|rows| free_rows(rows)))
            .chain(of_others.flat_map(|(constraint, placed)| placed.cliques(constraint, &layout)))
            .collect();
        let pattern = Arc::new(Pattern::from_cliques(layout.size(), cliques.iter().map(Vec::as_slice)));
        for batch in &mut self.batches {
            batch.locate(&pattern);
        }
        feedback.locate(&pattern);
        let mut joint_places = Places::new();
        for rows in &joint_rows {
            joint_places.push(&pattern, rows, LOCAL);
        }
        joint_places.shrink();
        for (constraint, placed) in self.constraints.others().zip(&mut placed) {
            placed.locate(constraint, &layout, &pattern);
        }
        let structure = Structure::new(pattern, self.groups(&layout))
            .map_err(|error| BuildError::Structure(error.to_string()))?;
        let joint_starts = starts(joint_rows.iter().map(Vec::len));
        let mut held = feedback.graph.held_at_start();
        for batch in &mut self.batches {
            let count = batch.hold_sides(held.len());
            held.resize(held.len() + count, 0.0);
        }
        let state = self.initial_state(&layout, time, held);
        let feedback = Arc::new(feedback);
        if !feedback.is_empty() {
            self.batches.push(Box::new(Arc::clone(&feedback)));
        }
        let system = System {
            layout,
            batches: self.batches,
            joint_batches: Batches::new(&self.constraints.joints),
            constraints: self.constraints,
            placed,
            coordinate_masses: self.coordinate_masses,
            free_coordinates: self.free_coordinates,
            latches: self.latches,
            structure,
            joint_places,
            joint_starts,
            joint_rows: joint_rows.concat(),
            inertias,
            gravity: self.gravity,
            feedback,
            functions: self.functions,
        };
        Ok((system, state))
    }

    fn number(&mut self) -> Layout {
        let mut layout = Layout::default();
        let mut next = 0;
        for node in &self.nodes {
            layout.node_rows.push(std::array::from_fn(|k| {
                if node.freedoms.is_free(k) {
                    next += 1;
                    next - 1
                } else {
                    LOCKED
                }
            }));
            layout.node_names.push(node.name.clone());
        }
        for coordinate in &self.coordinates {
            layout.coordinate_rows.push(next);
            layout.coordinate_names.push(coordinate.name.clone());
            next += 1;
        }
        let of_node = |rows: &[u32; 6]| {
            let quantity = |k| if k < 3 { Quantity::Length } else { Quantity::Angle };
            (0..6).filter(|&k| rows[k] != LOCKED).map(quantity).collect::<Vec<_>>()
        };
        layout.quantities = layout.node_rows.iter().flat_map(of_node).collect();
        layout.quantities.extend(self.coordinates.iter().map(|coordinate| coordinate.quantity));
        layout.quantities.append(&mut self.multiplier_quantities);
        layout.coordinate_count = next as usize;
        layout.multiplier_count = self.multipliers.len();
        layout.multiplier_names = std::mem::take(&mut self.multipliers);
        layout.states = std::mem::take(&mut self.states);
        layout.impulses = self.impulses.iter().map(|impulse| impulse.coordinate).collect();
        layout
    }

    fn initial_state(&self, layout: &Layout, time: f64, held: Vec<f64>) -> State {
        let sees_multipliers = self.batches.iter().any(|batch| batch.sees_multipliers());
        let coordinates = self
            .coordinates
            .iter()
            .map(|coordinate| CoordinateMotion {
                value: coordinate.value,
                rate: coordinate.rate,
                acceleration: 0.0,
            })
            .collect();
        State {
            kinematics: Kinematics {
                time,
                elapsed: 0.0,
                nodes: self.nodes.iter().map(|node| node.motion).collect(),
                coordinates,
                held,
                multipliers: if sees_multipliers { vec![0.0; layout.multiplier_count] } else { Vec::new() },
            },
            multipliers: vec![0.0; layout.multiplier_count],
            violations: vec![0.0; layout.multiplier_count],
            algorithmic: vec![0.0; layout.coordinate_count],
            time_remainder: 0.0,
            position_remainders: vec![Vector3::zeros(); self.nodes.len()],
            accumulated: Vec::new(),
        }
    }

    /// Lets a failure name a function of time, in words such as "`scale` of load `push`".
    pub fn name_function(&mut self, words: String, function: Function) {
        self.functions.push((words, function));
    }

    /// The ground's index, for symmetry with [`Self::add_node`].
    pub fn ground(&self) -> NodeId {
        GROUND
    }
}

/// Rows of a joint's local unknowns, locked where there are none, and of its multipliers.
fn rows_of(joint: &AttachedJoint, layout: &Layout) -> Vec<u32> {
    let mut rows = vec![LOCKED; LOCAL];
    for (frame, first) in joint.frames.iter().zip([0, TIP]) {
        rows[first..first + 6].copy_from_slice(&layout.node_rows[frame.node]);
    }
    for (row, &coordinate) in rows[OWN..].iter_mut().zip(&joint.coordinates) {
        *row = layout.coordinate_rows[coordinate];
    }
    let first = layout.coordinate_count + joint.first_multiplier;
    rows.extend((first..first + joint.equations()).map(|row| row as u32));
    rows
}

/// Where each of several lengths begins when they are laid in a row, and where the last one ends.
fn starts(lengths: impl Iterator<Item = usize>) -> Vec<usize> {
    let ends = lengths.scan(0, |end, length| {
        *end += length;
        Some(*end)
    });
    std::iter::once(0).chain(ends).collect()
}
