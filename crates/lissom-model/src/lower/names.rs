//! Nodes, coordinates and signals of the system by the names of the model.

use std::collections::BTreeMap;

use lissom_flexible::beam::line::BeamLine;
use lissom_mechanics::kinematics::{CoordinateId, NodeId, Quantity};
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::Argument;
use lissom_system::ElementId;

use super::signal_references::SignalReferences;
use crate::document::Component;
use crate::outputs::contact_point::PointsOfContacts;
use crate::outputs::local_load_points::LocalLoadPoints;
use crate::outputs::meshes::BuiltMeshes;
use crate::outputs::{Deformed, Resolver};
use crate::reading::node_reference::{NodeReference, interface_name};
use crate::text::report::{Located, Problem};

/// Nodes, coordinates and signals by the names of the model.
#[derive(Clone, Default)]
pub struct Names {
    /// Node of each body and point mass.
    pub nodes: BTreeMap<String, NodeId>,
    /// Nodes of each superelement, in the order of its interfaces; they are also among `nodes`, as `superelement.interface`.
    pub superelements: BTreeMap<String, Vec<NodeId>>,
    /// Deformation of each superelement.
    pub deformations: BTreeMap<String, Deformed>,
    /// Nodes and elements of each beam.
    pub lines: BTreeMap<String, BeamLine>,
    /// Shells and solids.
    pub meshes: BuiltMeshes,
    /// Joints in the order of the file.
    pub joints: Vec<String>,
    /// Inputs in the order of the file.
    pub inputs: Vec<String>,
    /// Coordinates of each joint; a drive has those of the joint it drives.
    pub coordinates: BTreeMap<String, Vec<CoordinateId>>,
    /// Springs that have an elongation, and whether it is a length or an angle.
    pub springs: BTreeMap<String, (ElementId, Quantity)>,
    /// Index of each latch among the springs.
    pub latches: BTreeMap<String, usize>,
    /// Springs, loads and joints' friction, whose power can be determined: one element, or one for each node of a set.
    pub powers: BTreeMap<String, Vec<ElementId>>,
    /// Points of each contact.
    pub(crate) contacts: PointsOfContacts,
    /// Elements of each local load.
    pub(crate) local_loads: BTreeMap<String, LocalLoadPoints>,
    /// Loads on coordinates of joints; those of size zero have no element.
    pub actuators: Vec<(CoordinateId, Option<ElementId>)>,
    /// Signals, inputs and states.
    pub signals: BTreeMap<String, Argument>,
    /// What expressions of signals name besides them.
    pub(super) references: SignalReferences,
}

impl Names {
    /// The node a reference means.
    pub(super) fn node(&self, reference: &Located<NodeReference>) -> Result<NodeId, Problem> {
        let unknown = |name: &str| {
            Problem::error(reference.span, format!("there is no part called `{name}`"))
                .help("name a body, a point mass, a beam's end or `ground`")
        };
        match &reference.value {
            NodeReference::Ground => Ok(lissom_mechanics::kinematics::GROUND),
            NodeReference::Body(name) | NodeReference::PointMass(name) => {
                self.nodes.get(name).copied().ok_or_else(|| unknown(name))
            }
            NodeReference::Interface { superelement, interface } => {
                let name = interface_name(superelement, interface);
                self.nodes.get(&name).copied().ok_or_else(|| unknown(&name))
            }
            NodeReference::Mesh { part, .. } => {
                self.meshes.nodes_of(part).ok_or_else(|| unknown(part))?.one(reference)
            }
            NodeReference::Beam { beam, fraction } => {
                let line = self.lines.get(beam).ok_or_else(|| unknown(beam))?;
                line.node_at(*fraction).ok_or_else(|| no_node(reference, beam, line, *fraction))
            }
        }
    }
}

impl Names {
    /// All nodes a reference means: several for a set of a shell or solid, otherwise one. With their shares of what is spread over them.
    pub(super) fn nodes(&self, reference: &Located<NodeReference>) -> Result<Vec<(NodeId, f64)>, Problem> {
        let NodeReference::Mesh { part, .. } = &reference.value else {
            return Ok(vec![(self.node(reference)?, 1.0)]);
        };
        let Some(built) = self.meshes.nodes_of(part) else { return Ok(vec![(self.node(reference)?, 1.0)]) };
        let indices = built.indices(reference)?;
        let shares = built.mesh.shares(&indices);
        Ok(indices.iter().zip(shares).map(|(&index, share)| (built.nodes[index], share)).collect())
    }
}

/// A position on a beam where something is attached has no node.
fn no_node(reference: &Located<NodeReference>, beam: &str, line: &BeamLine, fraction: f64) -> Problem {
    let nearest = line
        .places
        .iter()
        .copied()
        .min_by(|a, b| (a - fraction).abs().total_cmp(&(b - fraction).abs()))
        .unwrap_or(0.0);
    Problem::error(reference.span, format!("beam `{beam}` has no node at {fraction}"))
        .label("nothing can be attached here")
        .help(format!("the nearest node is at {nearest:.6}; or choose the number of elements to suit"))
}

/// A core complaint about a component's parameter, underlined.
pub(super) fn parameter_problem(component: &Component, error: &ParameterError) -> Problem {
    Problem::error(component.span_of(&error.parameter), format!("`{}`: {error}", component.name.value))
}

impl Names {
    /// What outputs refer to.
    pub(super) fn resolver(&self) -> Resolver<'_> {
        Resolver {
            nodes: &self.nodes,
            lines: &self.lines,
            meshes: &self.meshes,
            deformations: &self.deformations,
            coordinates: &self.coordinates,
            springs: &self.springs,
            latches: &self.latches,
            powers: &self.powers,
            contacts: &self.contacts,
            local_loads: &self.local_loads,
            signals: &self.signals,
        }
    }
}
