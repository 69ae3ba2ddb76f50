//! What a model looks like: parts with their shapes, joints with their axes, springs and loads, each at its place in
//! the frames of the nodes. Together with the poses of the nodes it is all that a picture needs. Knows no pictures.
//!
//! Serialises to `scene.json`. Lengths are in metres, angles in radians; places and directions are in the frame of the
//! node they name. Node 0 is the ground.

mod connections;
mod parts;
mod shapes;

use lissom_core::system::NodeId;
use lissom_motion::{Motion, Vector3};
use serde::Serialize;

use crate::document::{Document, NodeReference, OutputSource};
use crate::lower::Lowered;
use crate::report::Located;

pub use connections::{Joint, Load, Spring};
pub use parts::{Beam, Body, PointMass, Station};
pub use shapes::{InertiaBox, Outline};

/// Version of what is written.
const VERSION: usize = 1;

/// A model as it looks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// Version of the format.
    pub lissom_scene: usize,
    /// One line about the model.
    pub title: Option<String>,
    /// Acceleration of gravity [m/s²].
    pub gravity: [f64; 3],
    /// First time [s].
    pub start: f64,
    /// Last time [s].
    pub end: f64,
    /// Whether time stands for the growth of loads.
    pub is_static: bool,
    /// Rigid bodies.
    pub bodies: Vec<Body>,
    /// Point masses.
    pub point_masses: Vec<PointMass>,
    /// Beams.
    pub beams: Vec<Beam>,
    /// Joints and drives.
    pub joints: Vec<Joint>,
    /// Springs.
    pub springs: Vec<Spring>,
    /// Loads.
    pub loads: Vec<Load>,
    /// What is recorded, and of which part.
    pub outputs: Vec<Output>,
}

/// A place carried by a node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Anchor {
    /// The node.
    pub node: NodeId,
    /// Place in its frame [m].
    pub position: [f64; 3],
}

/// What is recorded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Output {
    /// Name; its columns in the table begin with it.
    pub name: String,
    /// Kind, as `position`.
    pub kind: String,
    /// The part or joint it belongs to; none for the whole model.
    pub of: Option<String>,
    /// The point that is observed, if it is carried by a node.
    pub point: Option<Anchor>,
}

impl Scene {
    /// How `document`, lowered to `lowered`, looks.
    pub fn of(document: &Document, lowered: &Lowered) -> Self {
        let places = Places { lowered };
        Self {
            lissom_scene: VERSION,
            title: document.title.clone(),
            gravity: document.gravity.into(),
            start: document.analysis.start,
            end: document.analysis.end,
            is_static: lowered.plan.is_static,
            bodies: parts::bodies(document, &places),
            point_masses: parts::point_masses(document, &places),
            beams: parts::beams(document, &places),
            joints: connections::joints(document, &places),
            springs: connections::springs(document, &places),
            loads: connections::loads(document, &places),
            outputs: document.outputs.iter().map(|output| places.output(output)).collect(),
        }
    }

    /// As a JSON text.
    ///
    /// # Panics
    /// Never: plain numbers and texts can always be said in JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain numbers and texts can always be said in JSON")
    }
}

/// Where named things are among the nodes.
struct Places<'a> {
    lowered: &'a Lowered,
}

impl Places<'_> {
    /// The node a reference means; none where a beam has no node there.
    fn node(&self, reference: &NodeReference) -> Option<NodeId> {
        let names = &self.lowered.names;
        match reference {
            NodeReference::Ground => Some(lissom_core::system::GROUND),
            NodeReference::Body(name) | NodeReference::PointMass(name) => names.nodes.get(name).copied(),
            NodeReference::Beam { beam, fraction } => names.lines.get(beam)?.node_at(*fraction),
        }
    }

    /// Pose of a node as the model describes it.
    fn frame(&self, node: NodeId) -> Motion {
        self.lowered.state.kinematics.nodes[node].frame
    }

    /// The place `at` of the model, carried by a node.
    fn anchor(&self, reference: &Located<NodeReference>, at: &Vector3) -> Option<Anchor> {
        let node = self.node(&reference.value)?;
        Some(Anchor { node, position: self.frame(node).inverse_transform_point(at).into() })
    }

    /// A direction of the model, in the frame of a node, of length one.
    fn direction(&self, node: NodeId, direction: &Vector3) -> [f64; 3] {
        self.frame(node).rotation.apply_inverse(&direction.normalize()).into()
    }

    fn output(&self, output: &crate::document::Output) -> Output {
        let (of, point) = match &output.source {
            OutputSource::Model | OutputSource::Expression(_) => (None, None),
            OutputSource::Joint(name) | OutputSource::Spring(name) | OutputSource::Signal(name) => {
                (Some(name.value.clone()), None)
            }
            OutputSource::Node { node, point } => {
                (Some(part_of(&node.value).to_owned()), self.observed(&node.value, point.as_ref()))
            }
        };
        Output { name: output.name.value.clone(), kind: output.kind.name().to_owned(), of, point }
    }

    /// The point that an output observes: a beam's is that of its section, not of the node.
    fn observed(&self, reference: &NodeReference, point: Option<&Vector3>) -> Option<Anchor> {
        let node = self.node(reference)?;
        let position = match (point, reference) {
            (Some(point), _) => self.frame(node).inverse_transform_point(point),
            (None, NodeReference::Beam { beam, .. }) => {
                let line = self.lowered.names.lines.get(beam)?;
                let index = line.nodes.iter().position(|other| *other == node)?;
                line.offsets[index].position
            }
            (None, _) => Vector3::zeros(),
        };
        Some(Anchor { node, position: position.into() })
    }
}

/// Name of the part that a reference belongs to.
fn part_of(reference: &NodeReference) -> &str {
    match reference {
        NodeReference::Ground => "ground",
        NodeReference::Body(name) | NodeReference::PointMass(name) => name,
        NodeReference::Beam { beam, .. } => beam,
    }
}
