//! Scene of a model: parts with their shapes, joints with their axes, springs and loads, each at its position in
//! the frames of the nodes. With the poses of the nodes it determines a picture. Independent of drawing.
//!
//! Serialises to `scene.json`. Lengths are in metres, angles in radians; positions and directions are in the frame of the
//! node they name. Node 0 is the ground.

mod connections;
mod dimensions;
mod elastic_solids;
mod kinds;
mod parts;
mod path_values;
mod places;
mod shapes;
mod shells;
mod solids;
mod superelements;
mod symbols;

use lissom_mechanics::diagnostics::Diagnose;
use lissom_mechanics::kinematics::{GROUND, NodeId};
use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use crate::document::{Component, Document};
use crate::outputs::entry::{OutputSource, ReactionAxes};
use crate::reading::node_reference::NodeReference;
use crate::text::report::Located;

pub use crate::sections::Outline;
pub use connections::{BeamLoad, DISTRIBUTED_LOCAL_LOAD, Joint, LOCAL_LOAD, Load, Spring};
pub use elastic_solids::ElasticSolid;
pub use parts::{Beam, Body, PointMass, Station};
pub use path_values::PathValues;
pub use places::{Anchor, Placed, Table};
use places::{Places, part_of};
pub use shapes::InertiaBox;
pub use shells::Shell;
pub use solids::{Form, Solid, Tone};
pub use symbols::{Rod, Symbol};

pub use crate::surface::{Painted, Surface, SurfaceError};

/// Version of the format.
const VERSION: usize = 3;

/// A text that is no scene of this version.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum SceneError {
    /// It was written by another version.
    Version(usize),
    /// It is damaged or something else.
    Damaged(String),
}

/// A model as it looks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Whether time represents the growth of loads.
    pub is_static: bool,
    /// Where time represents the length of an equilibrium path: the load factors, or values of a number, along it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<PathValues>,
    /// Rigid bodies.
    pub bodies: Vec<Body>,
    /// Point masses.
    pub point_masses: Vec<PointMass>,
    /// Beams.
    pub beams: Vec<Beam>,
    /// Shells.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shells: Vec<Shell>,
    /// Elastic solids.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elastic_solids: Vec<ElasticSolid>,
    /// Joints, drives, and superelements, which connect their interfaces.
    pub joints: Vec<Joint>,
    /// Springs.
    pub springs: Vec<Spring>,
    /// Loads.
    pub loads: Vec<Load>,
    /// Forces per length of beams.
    pub beam_loads: Vec<BeamLoad>,
    /// Symbols of joints, springs and loads.
    pub symbols: Vec<Symbol>,
    /// Rods of joints that keep the distance of two positions.
    pub rods: Vec<Rod>,
    /// Outputs with their parts.
    pub outputs: Vec<Output>,
}

/// Quantities to be recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Output {
    /// Name; its columns in the table begin with it.
    pub name: String,
    /// Kind, such as `position`.
    pub kind: String,
    /// The part or joint it belongs to; none for the whole model.
    pub of: Option<String>,
    /// Table of that part, if it is drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// The point that is observed, if it is carried by a node.
    pub point: Option<Anchor>,
    /// Whether it is a reaction with components along the global axes.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_global: bool,
}

impl Scene {
    /// How `document` looks with its parts at these positions.
    pub fn of(document: &Document, placed: &Placed<'_>) -> Self {
        let places = Places { of: placed };
        let (mut symbols, mut rods) = symbols::symbols(document, &places);
        let (listed, interfaces, lines) = superelements::superelements(document, &places);
        let mut joints = connections::joints(document, &places);
        joints.extend(listed);
        symbols.extend(interfaces);
        rods.extend(lines);
        Self {
            lissom_scene: VERSION,
            title: document.title.clone(),
            gravity: document.gravity.into(),
            start: document.analysis.start,
            end: document.analysis.end,
            is_static: placed.is_static,
            path: None,
            bodies: parts::bodies(document, &places),
            point_masses: parts::point_masses(document, &places),
            beams: parts::beams(document, &places),
            shells: shells::shells(document, &places),
            elastic_solids: elastic_solids::elastic_solids(document, &places),
            joints,
            springs: connections::springs(document, &places),
            loads: connections::loads(document, &places),
            beam_loads: connections::beam_loads(document, &places),
            symbols,
            rods,
            outputs: document.outputs.iter().map(|output| observed(document, &places, output)).collect(),
        }
    }

    /// Reads the result of [`to_json`](Self::to_json).
    ///
    /// # Errors
    /// If it is something else, or of another version.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        #[derive(Deserialize)]
        struct Version {
            lissom_scene: usize,
        }
        let damaged = |error: serde_json::Error| SceneError::Damaged(error.to_string());
        let Version { lissom_scene } = serde_json::from_str(text).map_err(damaged)?;
        if lissom_scene != VERSION {
            return Err(SceneError::Version(lissom_scene));
        }
        serde_json::from_str(text).map_err(damaged)
    }

    /// Largest number of a node in it.
    pub fn most_node(&self) -> NodeId {
        let anchors = (self.joints.iter().filter_map(|joint| joint.anchors))
            .chain(self.springs.iter().filter_map(|spring| spring.anchors))
            .flatten()
            .chain(self.loads.iter().map(|load| load.anchor))
            .chain(self.symbols.iter().map(|symbol| symbol.anchor));
        let parts = (self.bodies.iter().map(|body| body.node))
            .chain(self.point_masses.iter().map(|mass| mass.node))
            .chain(self.beams.iter().flat_map(|beam| beam.nodes.iter().copied()))
            .chain(self.shells.iter().flat_map(|shell| shell.nodes.iter().copied()))
            .chain(self.elastic_solids.iter().flat_map(|solid| solid.nodes.iter().copied()));
        anchors.map(|anchor| anchor.node).chain(parts).max().unwrap_or(GROUND)
    }

    /// The direction that is upward in a picture: against gravity where that is along an axis, otherwise z.
    pub fn up(&self) -> Vector3 {
        let up = (-Vector3::from(self.gravity)).try_normalize(0.0);
        up.filter(|up| up.amax() > 0.999).unwrap_or_else(Vector3::z)
    }

    /// As a JSON text.
    ///
    /// # Panics
    /// Never: plain numbers and texts can always be written as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain numbers and texts can always be written as JSON")
    }
}

/// An output with its part, and the point that it observes.
fn observed(document: &Document, places: &Places<'_>, output: &crate::outputs::entry::Output) -> Output {
    let is_in = |list: &[Component], name: &str| list.iter().any(|component| component.name.value == name);
    let table_of_actor = |name: &str| match name {
        name if is_in(&document.springs, name) => Table::Springs,
        name if is_in(&document.loads, name) => Table::Loads,
        _ => Table::Joints,
    };
    let named = |name: &Located<String>, table| (Some(name.value.clone()), table, None);
    let (of, table, point) = match &output.source {
        OutputSource::Model | OutputSource::Expression(_) => (None, None, None),
        OutputSource::Joint(name) => named(name, Some(Table::Joints)),
        OutputSource::Spring(name) => named(name, Some(Table::Springs)),
        OutputSource::LocalLoad(name) => named(name, Some(Table::LocalLoads)),
        OutputSource::Actor(name) => named(name, Some(table_of_actor(&name.value))),
        OutputSource::Beam(name) => named(name, Some(Table::Parts)),
        OutputSource::Superelement(name) => named(name, Some(Table::Superelements)),
        OutputSource::Contact(name) | OutputSource::Signal(name) => named(name, None),
        OutputSource::Node { node, point } => {
            let table = match node.value {
                NodeReference::Interface { .. } => Table::Superelements,
                _ => Table::Parts,
            };
            let of = part_of(&node.value).to_owned();
            (Some(of), Some(table), places.observed(&node.value, point.as_ref()))
        }
    };
    let kind = output.kind.name().to_owned();
    let is_global = kind == "reaction" && output.axes == ReactionAxes::Ground;
    Output { name: output.name.value.clone(), kind, of, table, point, is_global }
}
