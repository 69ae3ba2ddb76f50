//! Builds a system from nodes, elements and joints; then numbers the unknowns and checks what can be checked without
//! solving.

mod coupling;
mod drawn;
mod groups;
mod joint;
mod mean_motion;
mod motion;
mod rigid_contact;
mod signals;
mod slider;
mod velocity_constraints;

use std::sync::Arc;

use lissom_motion::{Matrix6, Motion, Vector3, Vector6};
use lissom_solver::{Pattern, Structure};

pub use self::drawn::PlaceOnTip;
use self::drawn::{joint_rotation, start_rates, start_values};
pub use self::joint::{BeamChain, JointAttachment};
use super::constraints::{Constraints, Placed};
use super::element_quantity::ElementQuantity;
use super::feedback::{DrivenBatch, Feedback, LeastValue, Target};
use super::state::State;
use super::{ElementId, GivenVelocities, JointLanes, System};
use lissom_contact::set::ContactSet;
use lissom_flexible::beam::section_error::ExaminedBeams;
use lissom_mechanics::elements::contribution::{Contribution, CoordinateMass};
use lissom_mechanics::elements::creep_force::CreepForce;
use lissom_mechanics::elements::inertia::{Gravity, Inertia};
use lissom_mechanics::elements::initial_model::{Coordinate, InitialModel, Node};
use lissom_mechanics::elements::{Attached, Element, ElementKind};
use lissom_mechanics::evaluation::batch::{AnyBatch, AnyElement};
use lissom_mechanics::evaluation::scatter_map::{ScatterMap, free_rows};
use lissom_mechanics::joints::attached::AttachedJoint;
use lissom_mechanics::joints::blocks::Batches;
use lissom_mechanics::joints::derivatives::{LOCAL, OWN, TIP};
use lissom_mechanics::joints::spherical::Spherical;
use lissom_mechanics::joints::{Build, Geometry, JointKind};
use lissom_mechanics::kinematics::{
    CarriedFrame, CoordinateId, CoordinateMotion, Freedoms, GROUND, Kinematics, LOCKED, Layout, NodeId,
    NodeMotion, Quantity, Subject,
};
use lissom_mechanics::registry::{Function, ParameterError, Parameters};
use lissom_mechanics::signals::{Graph, SignalId};

/// Why a system could not be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Nothing can move.
    #[error("the model has no unknowns: none of its parts can move")]
    Empty,
    /// A coordinate without constraint or spring, or a structure that cannot be ordered.
    #[error("the equations cannot be ordered: {0}")]
    Structure(String),
    /// A signal depends on too many parts of the model.
    #[error("{0} depends on too many parts: more than 255 unknowns; measure less in one expression")]
    SignalTouchesTooMuch(String),
}

/// Initial location of a joint, in inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Base and tip node.
    pub nodes: [NodeId; 2],
    /// The joint's point on the base [m].
    pub at: Vector3,
    /// The point on the tip, for kinds that span a distance; by default the tip node's position [m].
    pub at_tip: Option<Vector3>,
    /// Direction of the joint's axis, for kinds with an axis.
    pub axis: Option<Vector3>,
    /// Direction of the second axis, for kinds with two.
    pub second_axis: Option<Vector3>,
}

/// Collects the parts of a system.
pub struct Builder {
    model: InitialModel,
    batches: Vec<Box<dyn AnyBatch>>,
    constraints: Constraints,
    multipliers: Vec<(String, &'static str)>,
    multiplier_quantities: Vec<Quantity>,
    states: Vec<(CoordinateId, f64)>,
    /// Multipliers of constraints of velocities.
    of_velocities: Vec<usize>,
    coordinate_masses: Vec<CoordinateMass>,
    free_coordinates: Vec<CoordinateId>,
    given_velocities: GivenVelocities,
    functions: Vec<(Subject, Function)>,
    graph: Graph,
    targets: Vec<(Target, SignalId)>,
    least_values: Vec<LeastValue>,
    contacts: ContactSet,
    /// Quantities of elements that signals depend on, with the batch of each.
    element_quantities: Vec<(usize, Arc<ElementQuantity>)>,
    /// If parts are given approximately: the given initial values of joint coordinates.
    start_values: Option<Vec<(CoordinateId, f64)>>,
}

impl Default for Builder {
    fn default() -> Self {
        Self::new()
    }
}

impl Builder {
    /// A system that contains only the ground.
    pub fn new() -> Self {
        let ground = Node {
            name: "ground".to_owned(),
            motion: NodeMotion::at_rest(Motion::identity()),
            freedoms: Freedoms::Fixed,
            mass: None,
        };
        Self {
            model: InitialModel {
                nodes: vec![ground],
                coordinates: Vec::new(),
                gravity: Gravity::constant(Vector3::zeros()),
            },
            batches: Vec::new(),
            constraints: Constraints::default(),
            multipliers: Vec::new(),
            multiplier_quantities: Vec::new(),
            states: Vec::new(),
            of_velocities: Vec::new(),
            coordinate_masses: Vec::new(),
            free_coordinates: Vec::new(),
            given_velocities: GivenVelocities::default(),
            functions: Vec::new(),
            graph: Graph::default(),
            targets: Vec::new(),
            least_values: Vec::new(),
            contacts: ContactSet::default(),
            element_quantities: Vec::new(),
            start_values: None,
        }
    }

    /// Sets gravity [m/s²], in inertial axes.
    pub fn set_gravity(&mut self, gravity: Vector3) {
        self.model.gravity.acceleration = gravity;
    }

    /// Multiplies gravity by a function of time.
    pub fn set_gravity_factor(&mut self, factor: Function) {
        self.model.gravity.factor = Some(factor);
    }

    /// Adds a node with its initial frame.
    pub fn add_node(&mut self, name: &str, frame: Motion, freedoms: Freedoms) -> NodeId {
        let motion = NodeMotion::at_rest(frame);
        self.model.add_node(Node { name: name.to_owned(), motion, freedoms, mass: None })
    }

    /// Sets a node's initial twist, in its body frame [m/s, rad/s]; locked degrees of freedom have zero rates.
    pub fn set_twist(&mut self, node: NodeId, twist: Vector6) {
        let freedoms = self.model.nodes[node].freedoms;
        self.model.nodes[node].motion.twist =
            Vector6::from_fn(|k, _| if freedoms.is_free(k) { twist[k] } else { 0.0 });
    }

    /// Locks all degrees of freedom of a node: it cannot move.
    pub fn lock(&mut self, node: NodeId) {
        self.model.nodes[node].freedoms = Freedoms::Fixed;
        self.model.nodes[node].motion.twist.fill(0.0);
    }

    /// Initial frame of a node.
    pub fn initial_frame(&self, node: NodeId) -> Motion {
        self.model.frame(node)
    }

    /// Which degrees of freedom of a node are free.
    pub fn freedoms(&self, node: NodeId) -> Freedoms {
        self.model.nodes[node].freedoms
    }

    /// The nodes, coordinates and gravity added so far.
    pub fn model(&self) -> &InitialModel {
        &self.model
    }

    /// Adds to a node's mass matrix: 6x6, in the node's frame, about the node.
    pub fn add_inertia(&mut self, node: NodeId, mass: &Matrix6) {
        *self.model.nodes[node].mass.get_or_insert_with(Matrix6::zeros) += mass;
    }

    /// Parts that touch without elements, for schemes that solve for all touches of a step at once.
    pub fn contacts_mut(&mut self) -> &mut ContactSet {
        &mut self.contacts
    }

    /// Adds an element.
    pub fn add_element<E: Element>(&mut self, element: E) {
        self.add(Contribution::of(&self.model, element));
    }

    /// Adds the parts of a model entry; returns the element to which its outputs refer.
    ///
    /// # Panics
    /// If it was built for another model, or for this one before other nodes or coordinates were added.
    pub fn add(&mut self, contribution: Contribution) -> Option<ElementId> {
        let batches = |builder: &mut Self, element: Box<dyn AnyElement>| element.join(&mut builder.batches);
        self.add_each(contribution, batches)
    }

    /// Adds an entry of a kind of springs or loads; returns the element to which its outputs refer.
    ///
    /// # Errors
    /// If a parameter is missing or invalid.
    pub fn add_of_kind(
        &mut self,
        kind: &ElementKind,
        attached: Attached,
        parameters: &Parameters,
    ) -> Result<Option<ElementId>, ParameterError> {
        kind.contribution(&self.model, attached, parameters).map(|contribution| self.add(contribution))
    }

    /// Adds an entry whose elements are unit loads, multiplied by a signal.
    ///
    /// # Panics
    /// As [`Self::add`].
    pub fn add_driven(&mut self, signal: SignalId, contribution: Contribution) -> Option<ElementId> {
        self.add_each(contribution, |builder, element| {
            builder.targets.push((Target::Load(element.into_load()), signal));
            ElementId { batch: None, item: builder.targets.len() - 1 }
        })
    }

    fn add_each(
        &mut self,
        contribution: Contribution,
        mut add: impl FnMut(&mut Self, Box<dyn AnyElement>) -> ElementId,
    ) -> Option<ElementId> {
        assert!(contribution.fits(&self.model), "a contribution is added to the model that it was made for");
        let Contribution { nodes, coordinates, inertias, states, latches, .. } = contribution;
        self.model.nodes.extend(nodes);
        self.model.coordinates.extend(coordinates);
        for (node, mass) in inertias {
            self.add_inertia(node, &mass);
        }
        self.states.extend(states);
        self.coordinate_masses.extend(contribution.coordinate_masses);
        for (coordinate, engaged) in latches {
            self.add_latch(coordinate, engaged);
        }
        let last = contribution.elements.into_iter().map(|element| add(self, element)).last();
        last.filter(|_| contribution.has_outputs)
    }

    /// Adds a joint between two nodes; returns its algebraic coordinates.
    ///
    /// # Errors
    /// If a parameter or an axis is missing or invalid.
    pub fn add_joint(
        &mut self,
        name: &str,
        kind: &JointKind,
        placement: &Placement,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        self.add_joint_apart(name, kind, (placement, None), parameters)
    }

    /// Adds a joint whose frame on the tip differs from its frame on the base, for parts that are given approximately
    /// and assembled.
    ///
    /// # Errors
    /// If a parameter or an axis is missing or invalid.
    pub fn add_joint_apart(
        &mut self,
        name: &str,
        kind: &JointKind,
        (placement, on_tip): (&Placement, Option<&PlaceOnTip>),
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        let Build::Relative(build) = kind.build else {
            return Err(ParameterError::new("kind", "acts on another joint's coordinate"));
        };
        let base = Motion::new(joint_rotation(kind.ports, placement)?, placement.at);
        let tip = placement.at_tip.unwrap_or(self.model.nodes[placement.nodes[1]].motion.frame.position);
        let span = base.inverse_transform_point(&tip);
        let geometry = Geometry { span, planar: self.moves_in_plane(placement, &base), axes: base.rotation };
        let parameters = &parameters.declared(kind.parameters);
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
                // Initial values determine the zero of the coordinates: the tip's point remains at the joint's
                // location, and the base's frame moves back.
                let back = unset.initial().1.position - joint.initial().1.position;
                base = base * Motion::translation(back);
            }
        }
        let points = placement.nodes.map(|node| self.model.nodes[node].freedoms.is_point());
        if points.contains(&true) && joint.equations().len() == 6 && joint.coordinates().is_empty() {
            // What locks everything fixes the position of a point mass in the frame of the other node.
            joint = Box::new(Spherical);
            if on_tip.is_none() {
                let point = placement.nodes[usize::from(!points[0])];
                base.position = self.model.nodes[point].motion.frame.position;
            }
        }
        let (values, relative) = joint.initial();
        let places = [base, on_tip.map_or(Ok(base), |place| place.frame(&base, placement))? * relative];
        let carried = [0, 1].map(|side| {
            let node = placement.nodes[side];
            CarriedFrame { node, offset: places[side].relative_to(&self.model.nodes[node].motion.frame) }
        });
        let turns = joint.contact().is_some()
            || joint.rail_contact().is_some()
            || (0..joint.equations().len()).any(|k| joint.equation_quantity(k) == Quantity::Angle);
        for (side, CarriedFrame { node, offset }) in carried.into_iter().enumerate() {
            let axes = turns || (side == 0 && kind.ports.directions() > 0);
            self.model.check_carried(["base", "tip"][side], (node, offset.position), axes).map_err(
                |error| ParameterError::new(&error.parameter, error.problem + ", or use `distance`"),
            )?;
        }
        let rates = start_rates(joint.as_ref(), parameters)?;
        let coordinates: Vec<CoordinateId> = joint
            .coordinates()
            .iter()
            .enumerate()
            .map(|(k, coordinate)| {
                self.model.add_coordinate(Coordinate {
                    name: format!("{name}.{}", coordinate.name),
                    value: values[k],
                    rate: rates[k].unwrap_or(0.0),
                    quantity: coordinate.quantity,
                })
            })
            .collect();
        let with_rate = coordinates.iter().zip(&rates).filter(|(_, rate)| rate.is_some());
        self.given_velocities.coordinates.extend(with_rate.map(|(&coordinate, _)| coordinate));
        if let Some(start) = &mut self.start_values {
            start.extend(given.into_iter().map(|(k, value)| (coordinates[k], value)));
        }
        let first_multiplier = self.multipliers.len();
        for (k, &equation) in joint.equations().iter().enumerate() {
            self.multipliers.push((name.to_owned(), equation));
            self.multiplier_quantities.push(joint.equation_quantity(k));
        }
        if let Some(contact) = joint.contact() {
            self.add_rolling(name, carried, contact);
        }
        if let (Some(contact), Some(law)) = (joint.rail_contact(), joint.creep()) {
            self.add_element(CreepForce::new(carried, first_multiplier, contact.clone(), law.clone()));
        }
        self.constraints.joints.push(AttachedJoint {
            name: name.to_owned(),
            kind: kind.name,
            frames: carried,
            output_frames: carried,
            coordinates: coordinates.clone(),
            first_multiplier,
            joint,
        });
        Ok(coordinates)
    }

    /// Whether the tip can move only in the plane of the joint frame's first two axes.
    fn moves_in_plane(&self, placement: &Placement, base: &Motion) -> bool {
        let Freedoms::Planar(a, b) = self.model.nodes[placement.nodes[1]].freedoms else { return false };
        let frame = self.model.nodes[placement.nodes[1]].motion.frame;
        let mut normal = Vector3::zeros();
        normal[3 - a - b] = 1.0;
        base.rotation.apply_inverse(&frame.rotation.apply(&normal)).z.abs() > 1.0 - 1e-12
    }

    /// Number of latches so far.
    pub fn latch_count(&self) -> usize {
        self.constraints.latches.len()
    }

    /// Name of a coordinate.
    pub fn coordinate_name(&self, coordinate: CoordinateId) -> &str {
        self.model.coordinate_name(coordinate)
    }

    /// Quantity of a coordinate.
    pub fn coordinate_quantity(&self, coordinate: CoordinateId) -> Quantity {
        self.model.coordinate_quantity(coordinate)
    }

    /// Numbers the unknowns and returns the system with its state at `time` [s]: positions and twists as given,
    /// accelerations and multipliers zero.
    ///
    /// # Errors
    /// If nothing can move.
    pub fn build(mut self, time: f64) -> Result<(System, State), BuildError> {
        let layout = self.number();
        if layout.coordinate_count == 0 {
            return Err(BuildError::Empty);
        }
        let inertias: Vec<Inertia> = NodeId::enumerate(&self.model.nodes)
            .filter_map(|(node, spec)| {
                spec.mass.map(|mass| Inertia::new(node, mass, self.model.gravity.clone()))
            })
            .collect();
        for inertia in &inertias {
            Box::new(inertia.clone()).join(&mut self.batches);
        }
        for batch in &mut self.batches {
            batch.connect(&layout);
        }
        let targets = std::mem::take(&mut self.targets);
        let mut feedback = Feedback::new(std::mem::take(&mut self.graph), targets, &layout)
            .map_err(|touches| BuildError::SignalTouchesTooMuch(touches.name))?;
        feedback.least_values = std::mem::take(&mut self.least_values);
        let joint_rows: Vec<Vec<u32>> =
            self.constraints.joints.iter().map(|joint| rows_of(joint, &layout)).collect();
        let mut placed: Vec<Placed> =
            self.constraints.others().map(|constraint| Placed::new(constraint, &layout)).collect();
        let of_others = self.constraints.others().zip(&placed);
        let cliques: Vec<Vec<usize>> = self
            .batches
            .iter()
            .flat_map(|batch| batch.rows().cliques())
            .chain(feedback.cliques())
            .chain(joint_rows.iter().map(|rows| free_rows(rows)))
            .chain(of_others.flat_map(|(constraint, placed)| placed.cliques(constraint, &layout)))
            .collect();
        let pattern = Arc::new(Pattern::from_cliques(layout.size(), cliques.iter().map(Vec::as_slice)));
        for batch in &mut self.batches {
            batch.locate(&pattern);
        }
        feedback.locate(&pattern);
        let mut positions = ScatterMap::new();
        for rows in &joint_rows {
            positions.push(&pattern, rows, LOCAL);
        }
        positions.shrink();
        for (constraint, placed) in self.constraints.others().zip(&mut placed) {
            placed.locate(constraint, &layout, &pattern);
        }
        let structure = Structure::new(pattern, self.groups(&layout))
            .map_err(|error| BuildError::Structure(error.to_string()))?;
        let starts = starts(joint_rows.iter().map(Vec::len));
        let mut held = feedback.graph.held_at_start();
        for batch in &mut self.batches {
            let count = batch.freeze_switches(held.len());
            held.resize(held.len() + count, 0.0);
        }
        let mut state = self.initial_state(&layout, time, held);
        feedback.graph.fill_windows_before_start(&mut state.kinematics);
        let feedback = DrivenBatch(Arc::new(feedback));
        let mut batches: Vec<Arc<dyn AnyBatch>> = self.batches.into_iter().map(Arc::from).collect();
        for (batch, quantity) in &self.element_quantities {
            quantity.find_in(&batches[*batch]);
        }
        if !feedback.is_empty() {
            batches.push(Arc::new(feedback.clone()));
        }
        let mut system = System {
            layout,
            batches,
            joint_lanes: JointLanes {
                batches: Batches::new(&self.constraints.joints),
                rows: joint_rows.concat(),
                starts,
                positions,
            },
            constraints: self.constraints,
            placed,
            contacts: Arc::new(self.contacts),
            coordinate_masses: self.coordinate_masses,
            free_coordinates: self.free_coordinates,
            structure,
            inertias,
            gravity: self.model.gravity,
            feedback,
            readings: Vec::new(),
            beams: ExaminedBeams::default(),
            given_velocities: self.given_velocities,
            functions: self.functions,
        };
        system.layout.rotors = system.find_rotors(&state.kinematics);
        Ok((system, state))
    }

    fn number(&mut self) -> Layout {
        let mut layout = Layout::default();
        let mut next = 0;
        for node in &self.model.nodes {
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
        for coordinate in &self.model.coordinates {
            layout.coordinate_rows.push(next);
            layout.coordinate_names.push(coordinate.name.clone());
            next += 1;
        }
        let of_node = |rows: &[u32; 6]| {
            let quantity = |k| if k < 3 { Quantity::Length } else { Quantity::Angle };
            (0..6).filter(|&k| rows[k] != LOCKED).map(quantity).collect::<Vec<_>>()
        };
        layout.quantities = layout.node_rows.iter().flat_map(of_node).collect();
        layout.quantities.extend(self.model.coordinates.iter().map(|coordinate| coordinate.quantity));
        layout.quantities.append(&mut self.multiplier_quantities);
        layout.coordinate_count = next as usize;
        layout.multiplier_count = self.multipliers.len();
        layout.multiplier_names = std::mem::take(&mut self.multipliers);
        layout.states = std::mem::take(&mut self.states);
        layout.of_velocities = std::mem::take(&mut self.of_velocities);
        layout
    }

    fn initial_state(&self, layout: &Layout, time: f64, held: Vec<f64>) -> State {
        // Events of rigid contacts depend on normal forces.
        let sees_multipliers = self.batches.iter().any(|batch| batch.sees_multipliers())
            || !self.constraints.rigid_contacts.is_empty();
        let coordinates = self
            .model
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
                nodes: self.model.nodes.iter().map(|node| node.motion).collect(),
                coordinates,
                held,
                multipliers: if sees_multipliers { vec![0.0; layout.multiplier_count] } else { Vec::new() },
                units: Vec::new(),
            },
            multipliers: vec![0.0; layout.multiplier_count],
            violations: vec![0.0; layout.multiplier_count],
            algorithmic: vec![0.0; layout.coordinate_count],
            time_remainder: 0.0,
            position_remainders: vec![Vector3::zeros(); self.model.nodes.len()],
            accumulated: Vec::new(),
            touches: Vec::new(),
        }
    }

    /// Names a function of time for messages about failures, in words such as "`scale` of load `push`".
    pub fn name_function(&mut self, subject: Subject, function: Function) {
        self.functions.push((subject, function));
    }

    /// The ground's index, for symmetry with [`Self::add_node`].
    pub fn ground(&self) -> NodeId {
        GROUND
    }
}

/// Rows of a joint's local unknowns, or the locked row, and of its multipliers.
fn rows_of(joint: &AttachedJoint, layout: &Layout) -> Vec<u32> {
    let mut rows = vec![LOCKED; LOCAL];
    for (frame, first) in joint.frames.iter().zip([0, TIP]) {
        rows[first..first + 6].copy_from_slice(&layout.node_rows[frame.node]);
    }
    for (row, &coordinate) in rows[OWN..].iter_mut().zip(&joint.coordinates) {
        *row = layout.row_of_coordinate(coordinate) as u32;
    }
    let first = layout.coordinate_count + joint.first_multiplier;
    rows.extend((first..first + joint.equations()).map(|row| row as u32));
    rows
}

/// Offsets of consecutive ranges of these lengths, and the end of the last one.
fn starts(lengths: impl Iterator<Item = usize>) -> Vec<usize> {
    let ends = lengths.scan(0, |end, length| {
        *end += length;
        Some(*end)
    });
    std::iter::once(0).chain(ends).collect()
}

#[cfg(test)]
#[path = "../tests/unit/builder.rs"]
mod tests;
