//! Adds joints of all kinds, with what their ports are attached to.

use lissom_motion::Vector3;

use super::{Builder, PlaceOnTip, Placement};
use lissom_mechanics::joints::slider::{CarriedPoint, Orientation};
use lissom_mechanics::joints::{Build, JointKind};
use lissom_mechanics::kinematics::{CoordinateId, NodeId};
use lissom_mechanics::ports::Ports;
use lissom_mechanics::registry::{ParameterError, Parameters};

/// A chain of beams.
#[derive(Clone, Debug, Default)]
pub struct BeamChain {
    /// Nodes in their order, each with its point on the line.
    pub nodes: Vec<CarriedPoint>,
    /// Arc length from the start to each node [m].
    pub arc_lengths: Vec<f64>,
    /// Axis 2 of the section at each node, in axes of the node.
    pub sections: Vec<Vector3>,
}

/// What a joint is attached to, in the order of the ports of its kind.
#[derive(Clone, Debug, Default)]
pub struct JointAttachment {
    /// Nodes, each with its location [m] at the start; none for that of the node.
    pub nodes: Vec<(NodeId, Option<Vector3>)>,
    /// Directions at the start.
    pub axes: Vec<Vector3>,
    /// Joint frame on the tip, if it differs from that on the base.
    pub on_tip: Option<PlaceOnTip>,
    /// Coordinates of other joints.
    pub coordinates: Vec<CoordinateId>,
    /// Share of each node of a set, which are the first nodes; their sum is one.
    pub shares: Vec<f64>,
    /// Beams.
    pub beams: BeamChain,
}

impl JointAttachment {
    fn placement(&self, ports: Ports) -> Result<Placement, ParameterError> {
        let &[(base, Some(at)), (tip, at_tip)] = self.nodes.as_slice() else {
            return Err(ParameterError::new("base", "and `tip` must name two nodes"));
        };
        Ok(Placement {
            nodes: [base, tip],
            at,
            at_tip: at_tip.filter(|_| !ports.have_one_location()),
            axis: self.axes.first().copied(),
            second_axis: self.axes.get(1).copied(),
        })
    }
}

impl Builder {
    /// Adds a joint, drive, relation or slider of any kind; returns its algebraic coordinates, which are those of the
    /// other joint for a drive, and none for a relation.
    ///
    /// # Errors
    /// If a parameter or a port is missing or invalid.
    pub fn add_joint_of_kind(
        &mut self,
        name: &str,
        kind: &JointKind,
        attachment: JointAttachment,
        parameters: &Parameters,
    ) -> Result<Vec<CoordinateId>, ParameterError> {
        match kind.build {
            Build::Relative(_) => {
                let placement = attachment.placement(kind.ports)?;
                self.add_joint_apart(name, kind, (&placement, attachment.on_tip.as_ref()), parameters)
            }
            Build::Motion if attachment.on_tip.is_some() => {
                let problem = "must be omitted: the motion begins where the parts are placed";
                Err(ParameterError::new("at_tip", problem))
            }
            Build::Motion => self.add_motion(name, &attachment.placement(kind.ports)?, parameters),
            Build::Coordinate(_) => {
                let [coordinate] = attachment.coordinates[..] else {
                    return Err(ParameterError::new("joint", "must name a joint with a relative coordinate"));
                };
                self.add_drive(name, kind, coordinate, parameters).map(|()| vec![coordinate])
            }
            Build::AlongBeams => {
                let BeamChain { nodes, arc_lengths, sections } = attachment.beams;
                let [(tip, Some(at))] = attachment.nodes[..] else {
                    return Err(ParameterError::new("tip", "must name one node"));
                };
                let parameters = parameters.declared(kind.parameters);
                let orientation = match parameters.word("orientation")? {
                    "tangent" => Orientation::Tangent,
                    "section" => Orientation::Section(sections),
                    _ => Orientation::Free,
                };
                let added = self.add_slider(name, (nodes, arc_lengths), (tip, at), &orientation);
                added.map(|coordinate| vec![coordinate])
            }
            Build::MeanOfSet => self.add_mean_motion(name, &attachment).map(|()| Vec::new()),
            Build::Free(_) => self.add_free_coordinates(name, kind, parameters),
            Build::Coupling(_) => {
                self.add_coupling(name, kind, &attachment.coordinates, parameters).map(|()| Vec::new())
            }
        }
    }
}
