//! Nodes, coordinates and gravity of a model under construction, as input to kinds of elements.

use lissom_motion::{Matrix6, Motion};

use super::inertia::Gravity;
use super::kind::Carried;
use crate::kinematics::{CoordinateId, Freedoms, NodeId, NodeMotion, Quantity, indexed_by};
use crate::number::Written;
use crate::registry::ParameterError;
use crate::round_off::COINCIDENT;

/// Initial state of a node.
#[derive(Clone, Debug)]
pub struct Node {
    /// Name in messages and outputs.
    pub name: String,
    /// Pose and twist.
    pub motion: NodeMotion,
    /// Degrees of freedom that are not locked.
    pub freedoms: Freedoms,
    /// 6x6, in the node's frame, about the node.
    pub mass: Option<Matrix6>,
}

/// Initial state of a coordinate.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// Name in messages and outputs.
    pub name: String,
    /// [m, rad].
    pub value: f64,
    /// [m/s, rad/s].
    pub rate: f64,
    /// Quantity of the coordinate.
    pub quantity: Quantity,
}

indexed_by! {
    NodeId: Node;
    CoordinateId: Coordinate;
}

/// The part of a model under construction to which later entries refer.
#[derive(Clone, Debug)]
pub struct InitialModel {
    /// Nodes; the ground is the first.
    pub nodes: Vec<Node>,
    /// Coordinates of joints, states.
    pub coordinates: Vec<Coordinate>,
    /// Gravity.
    pub gravity: Gravity,
}

impl InitialModel {
    /// Adds a node.
    pub fn add_node(&mut self, node: Node) -> NodeId {
        self.nodes.push(node);
        NodeId::new(self.nodes.len() - 1)
    }

    /// Adds a coordinate.
    pub fn add_coordinate(&mut self, coordinate: Coordinate) -> CoordinateId {
        self.coordinates.push(coordinate);
        CoordinateId::new(self.coordinates.len() - 1)
    }

    /// Pose of a node.
    pub fn frame(&self, node: NodeId) -> Motion {
        self.nodes[node].motion.frame
    }

    /// Checks what an entry requires of the node that `key` names: that it has a rotation, if its `axes` are used, and otherwise
    /// that a point mass is at the location, `at` in its axes [m].
    ///
    /// # Errors
    /// If the node is a point mass, and its axes are used or the location is elsewhere.
    pub fn check_carried(&self, key: &str, (node, at): Carried, axes: bool) -> Result<(), ParameterError> {
        let Node { freedoms, motion, .. } = &self.nodes[node];
        let distance = at.norm();
        if !freedoms.is_point() || (!axes && distance <= COINCIDENT * (1.0 + motion.frame.position.norm())) {
            return Ok(());
        }
        let problem = if axes {
            "is a point mass or a node of a solid, which has no rotation: make it a body, or clamp the solid to one"
                .to_owned()
        } else {
            let distance = Written(distance);
            format!(
                "is a point mass or of a solid, {distance:.4} m away, and has no rotation: \
                 make it a body, or move the location to it"
            )
        };
        Err(ParameterError::new(key, problem))
    }

    /// Name of a coordinate.
    pub fn coordinate_name(&self, coordinate: CoordinateId) -> &str {
        &self.coordinates[coordinate].name
    }

    /// Value of a coordinate [m or rad].
    pub fn coordinate_value(&self, coordinate: CoordinateId) -> f64 {
        self.coordinates[coordinate].value
    }

    /// Quantity of a coordinate.
    pub fn coordinate_quantity(&self, coordinate: CoordinateId) -> Quantity {
        self.coordinates[coordinate].quantity
    }

    /// Checks that a coordinate has the quantity that a drive or spring requires.
    ///
    /// # Errors
    /// If it has another one.
    pub fn check_quantity(&self, coordinate: CoordinateId, wanted: Quantity) -> Result<(), ParameterError> {
        if self.coordinates[coordinate].quantity == wanted {
            return Ok(());
        }
        Err(ParameterError::new("coordinate", format!("must be a relative {}", wanted.relative())))
    }
}
