//! Elastic solids as they look.

use std::collections::BTreeMap;

use lissom_flexible::solid::law::SolidModel;
use lissom_mechanics::kinematics::NodeId;
use lissom_mesh::kinds::SOLID_KINDS;
use lissom_mesh::{MeshShape, MeshedPart};
use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use super::places::Places;
use crate::document::Document;

/// Cosine of the angle [36°] between faces up to which their common edge is round.
const ROUND: f64 = 0.81;

/// An elastic solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ElasticSolid {
    /// Name.
    pub name: String,
    /// Nodes of the solid.
    pub nodes: Vec<NodeId>,
    /// Position of each node in the stress-free state [m].
    pub positions: Vec<[f64; 3]>,
    /// Nodes of each element among its nodes, in the order of Abaqus, by the name of the element's kind.
    #[serde(default)]
    pub cells: BTreeMap<String, Vec<Vec<usize>>>,
    /// Number of elements.
    #[serde(default)]
    pub element_count: usize,
    /// Surface as it is drawn: corners of quadrilaterals among the nodes, counterclockwise seen from outside; triangles have the last
    /// corner twice.
    pub elements: Vec<[usize; 4]>,
    /// Normal of the smooth surface at each corner, in the stress-free state.
    pub directors: Vec<[[f64; 3]; 4]>,
    /// Whether its law is that of rubber, otherwise of St. Venant and Kirchhoff.
    pub is_rubber: bool,
    /// Shear modulus [Pa].
    pub shear: f64,
    /// Bulk modulus [Pa].
    pub bulk: f64,
    /// Part of the shear modulus in the second term of rubber [Pa].
    #[serde(default)]
    pub second: f64,
    /// Strain without stress at each node; none if there is none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub free_strains: Vec<f64>,
    /// Volume in the stress-free state [m³].
    pub volume: f64,
    /// Mass [kg].
    pub mass: f64,
}

/// Nodes of the elements of a shape.
fn cells(mesh: &MeshedPart, shape: MeshShape) -> Vec<Vec<usize>> {
    mesh.elements.iter().filter(|own| own.shape == shape).map(|own| own.nodes.clone()).collect()
}

/// Outer faces, divided at the middles of their sides.
fn surface(mesh: &MeshedPart) -> Vec<[usize; 4]> {
    let of = |face: &Vec<usize>| {
        let corners = face.len() / 2;
        let corner = |i: usize| {
            let before = face[corners + (i + corners - 1) % corners];
            [face[i], face[corners + i], before, before]
        };
        let middle = [0, 1, 2, 3].map(|i| face[corners + i.min(corners - 1)]);
        (0..corners).map(corner).chain([middle]).collect::<Vec<_>>()
    };
    mesh.faces.iter().flat_map(of).collect()
}

/// Normals at the corners: the mean of those of the faces around the node that belong to one round surface.
fn directors(positions: &[Vector3], elements: &[[usize; 4]]) -> Vec<[[f64; 3]; 4]> {
    let normal = |own: &[usize; 4]| {
        let p = own.map(|node| positions[node]);
        (p[2] - p[0]).cross(&(p[3] - p[1]))
            + (p[1] - p[0]).cross(&(p[2] - p[0])) * f64::from(u8::from(own[2] == own[3]))
    };
    let normals: Vec<Vector3> =
        elements.iter().map(|own| normal(own).try_normalize(0.0).unwrap_or_else(Vector3::z)).collect();
    let mut around = vec![Vec::new(); positions.len()];
    for (index, element) in elements.iter().enumerate() {
        for &node in element {
            around[node].push(index);
        }
    }
    let at = |own: &Vector3, node: usize| {
        let others = around[node].iter().map(|&other| normals[other]);
        let sum: Vector3 = others.filter(|other| other.dot(own) > ROUND).sum();
        sum.try_normalize(0.0).unwrap_or(*own).into()
    };
    elements.iter().zip(&normals).map(|(element, own)| element.map(|node| at(own, node))).collect()
}

pub(super) fn elastic_solids(document: &Document, places: &Places<'_>) -> Vec<ElasticSolid> {
    let drawn = |solid: &crate::document::ElasticSolid| {
        let built = places.of.names.meshes.solids.get(&solid.name.value)?;
        let elements = surface(&solid.mesh);
        let volume = built.elements.iter().map(|element| element.volume()).sum::<f64>();
        Some(ElasticSolid {
            name: solid.name.value.clone(),
            nodes: built.nodes.nodes.clone(),
            positions: solid.mesh.positions.iter().map(|position| (*position).into()).collect(),
            element_count: solid.mesh.elements.len(),
            cells: SOLID_KINDS
                .iter()
                .map(|kind| (kind.word.to_owned(), cells(&solid.mesh, kind.shapes[1])))
                .filter(|(_, cells)| !cells.is_empty())
                .collect(),
            directors: directors(&solid.mesh.positions, &elements),
            elements,
            is_rubber: solid.material.law.model == SolidModel::Rubber,
            shear: solid.material.law.shear,
            bulk: solid.material.law.bulk,
            second: solid.material.law.second,
            free_strains: solid.free_strains.clone(),
            volume,
            mass: solid.material.density * volume,
        })
    };
    document.elastic_solids.iter().filter_map(drawn).collect()
}
