//! Description of a kind of spring or load, and of its attachment.

use lissom_motion::Vector3;

use super::contribution::Contribution;
use super::initial_model::InitialModel;
use crate::kinematics::{CoordinateId, NodeId};
use crate::ports::Ports;
use crate::registry::{Parameter, ParameterError, Parameters};

/// A node and a point in its body frame [m].
pub type Carried = (NodeId, Vector3);

/// What a spring or load is attached to, in the order of the ports of its kind.
#[derive(Clone, Debug, Default)]
pub struct Attached {
    /// Nodes, each with a point in its body frame [m]; a node may occur several times.
    pub nodes: Vec<Carried>,
    /// Algebraic coordinates, all different: first those of joints of drums among the sheaves.
    pub coordinates: Vec<CoordinateId>,
    /// Sheaves of a rope, each with the position of its node among the nodes, ascending.
    pub sheaves: Vec<(usize, Sheave)>,
}

/// A sheave over which a rope passes, or a drum at its end, on which it is wound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheave {
    /// Radius [m].
    pub radius: f64,
    /// Direction of the axis at the start, global axes.
    pub axis: Vector3,
    /// Whether the rope, from its first point to its last, turns about the axis in the positive sense; none if its neighbours determine it.
    pub is_positive: Option<bool>,
    /// Sign with which the coordinate of its joint turns it about the axis; none without a joint.
    pub turns: Option<f64>,
}

impl Attached {
    /// An attachment to nodes, each at a point in its body frame [m].
    pub fn to_nodes(nodes: impl IntoIterator<Item = Carried>) -> Self {
        Self { nodes: nodes.into_iter().collect(), ..Self::default() }
    }

    /// An attachment to algebraic coordinates.
    pub fn to_coordinates(coordinates: impl IntoIterator<Item = CoordinateId>) -> Self {
        Self { coordinates: coordinates.into_iter().collect(), ..Self::default() }
    }

    /// The only node and its point.
    ///
    /// # Errors
    /// If there is another number of nodes.
    pub(crate) fn one_node(self) -> Result<Carried, ParameterError> {
        let [carried] = self.nodes[..] else { return Err(ParameterError::new("on", "must name one node")) };
        Ok(carried)
    }

    /// Base and tip with their points.
    ///
    /// # Errors
    /// If there is another number of nodes.
    pub fn two_nodes(self) -> Result<([NodeId; 2], [Vector3; 2]), ParameterError> {
        let [base, tip] = self.nodes[..] else {
            return Err(ParameterError::new("base", "and `tip` must name two nodes"));
        };
        Ok(([base.0, tip.0], [base.1, tip.1]))
    }

    /// The only coordinate.
    ///
    /// # Errors
    /// If there is another number of coordinates.
    pub fn coordinate(self) -> Result<CoordinateId, ParameterError> {
        let [coordinate] = self.coordinates[..] else {
            return Err(ParameterError::new("joint", "must name a joint with a relative coordinate"));
        };
        Ok(coordinate)
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
    /// Parameters in addition to its ports.
    pub parameters: &'static [Parameter],
    /// Ports of the kind.
    pub ports: Ports,
    /// Constructor of the elements, states and coordinates, for the model built so far.
    pub build: fn(&InitialModel, Attached, &Parameters) -> Result<Contribution, ParameterError>,
}

impl ElementKind {
    /// Elements, states and coordinates of the kind, for the model built so far.
    ///
    /// # Errors
    /// If a parameter or a port is missing or invalid, or a node is a point mass where a rotation is needed.
    pub fn contribution(
        &self,
        model: &InitialModel,
        attached: Attached,
        parameters: &Parameters,
    ) -> Result<Contribution, ParameterError> {
        for (k, &carried) in attached.nodes.iter().enumerate() {
            let (key, axes) = self.ports.node_port(k);
            model.check_carried(key, carried, axes)?;
        }
        (self.build)(model, attached, &parameters.declared(self.parameters))
    }
}
