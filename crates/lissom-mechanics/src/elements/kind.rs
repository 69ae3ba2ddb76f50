//! Description of a kind of spring or load, and of its attachment.

use lissom_motion::Vector3;

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use crate::kinematics::{CoordinateId, NodeId, Quantity};
use crate::registry::{Parameter, ParameterError, Parameters};

/// Attachment of a kind of spring or load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attachment {
    /// One node and a point fixed to it.
    OneNode,
    /// Two nodes, base and tip, and a point fixed to each.
    TwoNodes,
    /// A joint's algebraic coordinate of this quantity.
    Coordinate(Quantity),
    /// A sequence of positions, each fixed to a node, and algebraic coordinates if there are any.
    Places,
    /// Several algebraic coordinates, of any quantity.
    Coordinates,
}

/// A node and a point in its body frame [m].
pub type Carried = (NodeId, Vector3);

/// Attachment of a component, resolved to indices.
#[derive(Clone, Debug)]
pub enum Attached {
    /// A node and a point in its body frame [m].
    OneNode(NodeId, Vector3),
    /// Base and tip node, each with a point in its body frame [m].
    TwoNodes([NodeId; 2], [Vector3; 2]),
    /// An algebraic coordinate.
    Coordinate(CoordinateId),
    /// Nodes in their order, each with a point in its body frame [m]; a node may occur several times. Then algebraic
    /// coordinates in their order, all different.
    Places(Vec<(NodeId, Vector3)>, Vec<CoordinateId>),
    /// Algebraic coordinates in their order, all different.
    Coordinates(Vec<CoordinateId>),
}

impl Attached {
    /// The node and point of a one-node attachment.
    ///
    /// # Errors
    /// If the attachment is of another form.
    pub(crate) fn one_node(self) -> Result<(NodeId, Vector3), ParameterError> {
        match self {
            Self::OneNode(node, point) => Ok((node, point)),
            _ => Err(ParameterError::new("on", "must name one node")),
        }
    }

    /// Nodes and points of a two-node attachment.
    ///
    /// # Errors
    /// If the attachment is of another form.
    pub fn two_nodes(self) -> Result<([NodeId; 2], [Vector3; 2]), ParameterError> {
        match self {
            Self::TwoNodes(nodes, points) => Ok((nodes, points)),
            _ => Err(ParameterError::new("base", "and `tip` must name two nodes")),
        }
    }

    /// Nodes and points of an attachment to positions, and the coordinates.
    ///
    /// # Errors
    /// If the attachment is of another form.
    pub fn places(self) -> Result<(Vec<Carried>, Vec<CoordinateId>), ParameterError> {
        match self {
            Self::Places(places, coordinates) => Ok((places, coordinates)),
            _ => Err(ParameterError::new("along", "must list positions")),
        }
    }

    /// The coordinates of an attachment to several.
    ///
    /// # Errors
    /// If the attachment is of another form, or names no coordinate.
    pub fn coordinates(self) -> Result<Vec<CoordinateId>, ParameterError> {
        match self {
            Self::Coordinates(coordinates) if !coordinates.is_empty() => Ok(coordinates),
            _ => Err(ParameterError::new("coordinates", "must list coordinates of joints")),
        }
    }

    /// The coordinate of a coordinate attachment.
    ///
    /// # Errors
    /// If the attachment is of another form.
    pub fn coordinate(self) -> Result<CoordinateId, ParameterError> {
        match self {
            Self::Coordinate(coordinate) => Ok(coordinate),
            _ => Err(ParameterError::new("joint", "must name a joint with a relative coordinate")),
        }
    }
}

/// A kind of spring or load, as used by the model file and the tests.
#[derive(Clone, Copy, Debug)]
pub struct ElementKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// A minimal model-file entry of its own parameters.
    pub sample: &'static str,
    /// Parameters beyond the attachment.
    pub parameters: &'static [Parameter],
    /// Its attachment.
    pub attachment: Attachment,
    /// Its elements, states and coordinates, for the model built so far.
    pub build: fn(&InitialModel, Attached, &Parameters) -> Result<Contribution, ParameterError>,
}
