//! Bodies, point masses and beams as they look.

use lissom_contact::forms::{Form, PlacedSolid, Solid};
use lissom_mechanics::kinematics::{GROUND, NodeId};
use lissom_motion::{Matrix3, Motion, Vector3};
use serde::{Deserialize, Serialize};

use super::places::Places;
use super::shapes::InertiaBox;
use crate::document::Document;
use crate::sections::Outline;
use crate::surface::Surface;

/// Side of a drawn plane over the diagonal of the model.
const LARGER: f64 = 1.6;
/// Tiles along a side of a drawn plane.
const TILES: usize = 12;
/// Thickness of a drawn plane over its side.
const THINNER: f64 = 0.005;

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Node of the body.
    pub node: NodeId,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the centre of mass in body axes [kg m²], by rows.
    pub inertia: [[f64; 3]; 3],
    /// The box that has this mass and inertia.
    pub shape: InertiaBox,
    /// Shape to be drawn instead, if the model specifies it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<Surface>,
}

/// A point mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointMass {
    /// Name.
    pub name: String,
    /// Node of the point mass.
    pub node: NodeId,
    /// Mass [kg].
    pub mass: f64,
    /// Shape to be drawn, if the model specifies it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<Surface>,
}

/// A section at a position along a beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Station {
    /// Fraction of the beam, 0 to 1.
    pub at: f64,
    /// Name of the section.
    pub section: String,
    /// Outline of the section.
    pub outline: Outline,
    /// Stiffness of the section by rows, 6 x 6 [N, N m, N m²], linear between stations; empty if it is unknown.
    #[serde(default)]
    pub stiffness: Vec<f64>,
}

/// A beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beam {
    /// Name.
    pub name: String,
    /// Nodes of the beam from start to end.
    pub nodes: Vec<NodeId>,
    /// Fraction of the beam at each node.
    pub places: Vec<f64>,
    /// Section frames in the frames of the nodes, where they are not those: index among the nodes, position [m] and
    /// quaternion, scalar first.
    pub offsets: Vec<(usize, [f64; 3], [f64; 4])>,
    /// Number of elements.
    pub elements: usize,
    /// Polynomial order of the elements.
    pub order: usize,
    /// Outlines from 0 to 1, linear between; a single one for a uniform beam.
    pub stations: Vec<Station>,
    /// Length of the reference line [m].
    pub length: f64,
    /// Mass per length at the start [kg/m].
    pub mass_per_length: f64,
    /// Diagonal of the stiffness at the start: EA, GA₂, GA₃ [N], GJ, EI₂, EI₃ [N m²].
    pub stiffness: [f64; 6],
}

pub(super) fn bodies(document: &Document, places: &Places<'_>) -> Vec<Body> {
    let nodes = &places.of.names.nodes;
    let drawn = |body: &crate::document::Body| {
        let row = |k: usize| [0, 1, 2].map(|j| body.inertia[(k, j)]);
        Some(Body {
            name: body.name.value.clone(),
            node: *nodes.get(&body.name.value)?,
            mass: body.mass,
            inertia: [row(0), row(1), row(2)],
            shape: InertiaBox::of(body.mass, &symmetric(&body.inertia), &body.center_of_mass),
            surface: body.surface.as_deref().cloned(),
        })
    };
    document.bodies.iter().filter_map(drawn).collect()
}

/// Without differences of the halves due to round-off.
fn symmetric(matrix: &Matrix3) -> Matrix3 {
    0.5 * (matrix + matrix.transpose())
}

pub(super) fn point_masses(document: &Document, places: &Places<'_>) -> Vec<PointMass> {
    let nodes = &places.of.names.nodes;
    let drawn = |mass: &crate::document::PointMass| {
        let name = mass.name.value.clone();
        let surface = mass.surface.as_deref().cloned();
        Some(PointMass { node: *nodes.get(&name)?, name, mass: mass.mass, surface })
    };
    // The ground is drawn as a part that does not move.
    let mut surface = document.ground.surface.as_deref().cloned().unwrap_or_default();
    surface.append(&planes(document, places));
    let ground = (!surface.triangles.is_empty()).then(|| PointMass {
        name: "ground".to_owned(),
        node: GROUND,
        mass: 0.0,
        surface: Some(surface),
    });
    document.point_masses.iter().filter_map(drawn).chain(ground).collect()
}

/// A square slab below the plane z = 0. It consists of tiles, so that pictures can arrange them before and behind what is on it.
fn slab(side: f64) -> Surface {
    let tile = side / TILES as f64;
    let solid = Surface::of_solid(&Solid::Box([tile, tile, THINNER * side]), &Vector3::zeros());
    let mut all = Surface::default();
    for index in 0..TILES * TILES {
        let of = |k: usize| (k as f64 + 0.5) * tile - 0.5 * side;
        let place = Vector3::new(of(index / TILES), of(index % TILES), -0.5 * THINNER * side);
        all.append(&solid.moved(&Motion::translation(place), &Vector3::repeat(1.0)));
    }
    all
}

/// The planes of the ground, as thin slabs below the model that are somewhat larger than it.
fn planes(document: &Document, places: &Places<'_>) -> Surface {
    let mut all = Surface::default();
    let is_plane = |solid: &&PlacedSolid| matches!(solid.form, Form::HalfSpace);
    let planes: Vec<_> = document.ground.solids.iter().filter(is_plane).collect();
    if planes.is_empty() {
        return all;
    }
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let mut include = |point: Vector3| (low, high) = (low.inf(&point), high.sup(&point));
    let nodes = places.of.nodes;
    nodes.iter().skip(1).for_each(|node| include(node.frame.position));
    for body in &document.bodies {
        let (Some(surface), Some(node)) = (&body.surface, places.of.names.nodes.get(&body.name.value)) else {
            continue;
        };
        for point in &surface.points {
            include(nodes[*node].frame.transform_point(&Vector3::from(point.map(f64::from))));
        }
    }
    let side = LARGER * (high - low).norm();
    if !side.is_finite() || side == 0.0 {
        return all;
    }
    let slab = slab(side);
    for plane in planes {
        let center = plane.frame.inverse_transform_point(&(0.5 * (low + high)));
        let frame = plane.frame * Motion::translation(Vector3::new(center.x, center.y, 0.0));
        all.append(&slab.moved(&frame, &Vector3::repeat(1.0)));
    }
    all
}

pub(super) fn beams(document: &Document, places: &Places<'_>) -> Vec<Beam> {
    let drawn = |beam: &crate::document::Beam| {
        let line = places.of.names.lines.get(&beam.name.value)?;
        let is_carried = |(_, offset): &(usize, &Motion)| **offset != Motion::identity();
        let offset =
            |(k, offset): (usize, &Motion)| (k, offset.position.into(), offset.rotation.quaternion());
        let station = |station: &crate::document::Station| {
            let section = document.section(&station.section.value)?;
            let outline = section.outline;
            // By columns is by rows: the matrix is symmetric.
            let stiffness = section.properties.stiffness.as_slice().to_vec();
            Some(Station { at: station.at, section: station.section.value.clone(), outline, stiffness })
        };
        let start = beam.properties(document, 0.0, 1.0)?;
        Some(Beam {
            name: beam.name.value.clone(),
            nodes: line.nodes.clone(),
            places: line.places.clone(),
            offsets: line.offsets.iter().enumerate().filter(is_carried).map(offset).collect(),
            elements: line.elements.len(),
            order: line.order,
            stations: beam.stations.iter().filter_map(station).collect(),
            length: beam.line.length(),
            mass_per_length: start.mass[(0, 0)],
            stiffness: std::array::from_fn(|k| start.stiffness[(k, k)]),
        })
    };
    document.beams.iter().filter_map(drawn).collect()
}
