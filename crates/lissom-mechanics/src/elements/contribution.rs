//! Contribution of a model entry to the system: nodes, coordinates, elements.

use lissom_motion::{Matrix6, Motion};
use nalgebra::DMatrix;

use super::Element;
use super::initial_model::{Coordinate, InitialModel, Node};
use crate::evaluation::batch::AnyElement;
use crate::kinematics::{CoordinateId, DiscreteValueId, Freedoms, NodeId, NodeMotion, Quantity};

/// A mass matrix on coordinates, contained in the equations of one of their elements.
#[derive(Clone, Debug)]
pub struct CoordinateMass {
    /// Coordinates, in the order of the matrix.
    pub coordinates: Vec<CoordinateId>,
    /// Symmetric, one row per coordinate.
    pub matrix: DMatrix<f64>,
}

/// Contribution of an entry to a model. Its nodes and coordinates are numbered after those of the model for which it
/// was built.
pub struct Contribution {
    first_node: usize,
    first_coordinate: usize,
    /// New nodes.
    pub nodes: Vec<Node>,
    /// New coordinates.
    pub coordinates: Vec<Coordinate>,
    /// Mass matrices that are added to those of nodes: 6x6, in the node's frame, about the node.
    pub inertias: Vec<(NodeId, Matrix6)>,
    /// First-order states with their usual magnitude.
    pub states: Vec<(CoordinateId, f64)>,
    /// New latches: coordinates, and the inputs that engage them.
    pub latches: Vec<(CoordinateId, DiscreteValueId)>,
    /// Mass matrices of coordinates within its elements.
    pub coordinate_masses: Vec<CoordinateMass>,
    /// New elements.
    pub elements: Vec<Box<dyn AnyElement>>,
    /// Whether outputs of the entry are those of its last element.
    pub has_outputs: bool,
}

impl Contribution {
    /// An empty contribution to a model.
    pub fn to(model: &InitialModel) -> Self {
        Self {
            first_node: model.nodes.len(),
            first_coordinate: model.coordinates.len(),
            nodes: Vec::new(),
            coordinates: Vec::new(),
            inertias: Vec::new(),
            states: Vec::new(),
            latches: Vec::new(),
            coordinate_masses: Vec::new(),
            elements: Vec::new(),
            has_outputs: true,
        }
    }

    /// With one element.
    pub fn of<E: Element>(model: &InitialModel, element: E) -> Self {
        Self::to(model).with(element)
    }

    /// Adds another element.
    pub fn with<E: Element>(mut self, element: E) -> Self {
        self.elements.push(Box::new(element));
        self
    }

    /// Adds a node with its initial pose.
    pub fn add_node(&mut self, name: &str, frame: Motion, freedoms: Freedoms) -> NodeId {
        let motion = NodeMotion::at_rest(frame);
        self.nodes.push(Node { name: name.to_owned(), motion, freedoms, mass: None });
        NodeId::new(self.first_node + self.nodes.len() - 1)
    }

    /// Adds to a node's mass matrix: 6x6, in the node's frame, about the node.
    pub fn add_inertia(&mut self, node: NodeId, mass: Matrix6) {
        self.inertias.push((node, mass));
    }

    /// Adds a coordinate with its initial value [m or rad], at rest.
    pub fn add_coordinate(&mut self, name: String, value: f64, quantity: Quantity) -> CoordinateId {
        self.coordinates.push(Coordinate { name, value, rate: 0.0, quantity });
        CoordinateId::new(self.first_coordinate + self.coordinates.len() - 1)
    }

    /// Adds a first-order state with its initial value and its usual magnitude.
    pub fn add_state(&mut self, name: String, value: f64, magnitude: f64) -> CoordinateId {
        let state = self.add_coordinate(name, value, Quantity::State);
        self.states.push((state, magnitude));
        state
    }

    /// This contribution for an entry without outputs of its own.
    pub fn without_outputs(self) -> Self {
        Self { has_outputs: false, ..self }
    }

    /// Whether nodes and coordinates are numbered after those of this model.
    pub fn fits(&self, model: &InitialModel) -> bool {
        (self.nodes.is_empty() || self.first_node == model.nodes.len())
            && (self.coordinates.is_empty() || self.first_coordinate == model.coordinates.len())
    }
}
