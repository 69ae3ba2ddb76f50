//! Shells as they look.

use lissom_mechanics::kinematics::NodeId;
use serde::{Deserialize, Serialize};

use super::places::Places;
use crate::document::Document;

/// A shell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shell {
    /// Name.
    pub name: String,
    /// Nodes of the shell; the third axis of their frames is the normal of the surface at the start.
    pub nodes: Vec<NodeId>,
    /// Position of each node in the stress-free state [m].
    pub positions: Vec<[f64; 3]>,
    /// Corners of each element among its nodes, counterclockwise about the normal.
    pub elements: Vec<[usize; 4]>,
    /// Thickness of each element [m]; one for all if it is the same.
    pub thickness: Vec<f64>,
    /// Place of the middle of its thickness along the normal [m].
    #[serde(default)]
    pub offset: f64,
    /// Axes of each node in the stress-free state: a quaternion, scalar first.
    pub axes: Vec<[f64; 4]>,
    /// Normals that the four nodes of each element carry, in the axes of the nodes; empty if all are the third axis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub directors: Vec<[[f64; 3]; 4]>,
    /// Direction whose projection on each element is its first local axis; one for all if it is the same.
    pub directions: Vec<[f64; 3]>,
    /// Stiffness of each element by rows, 8 x 8: N11, N22, N12 [N/m], M11, M22, M12 [N], Q13, Q23 [N/m] for ε11, ε22, 2 ε12, κ11, κ22,
    /// 2 κ12, 2 ε13, 2 ε23; one for all if it is the same.
    pub stiffness: Vec<Vec<f64>>,
    /// Strains ε11, ε22, 2 ε12, κ11, κ22, 2 κ12 of each element without forces; one for all if it is the same.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub free_strains: Vec<[f64; 6]>,
    /// Whether it consists of one layer, so that stresses are linear over the thickness.
    pub is_homogeneous: bool,
    /// Area of the surface in the stress-free state [m²].
    pub area: f64,
    /// Mass [kg].
    pub mass: f64,
}

/// A single value where all are the same.
fn once<T: PartialEq>(mut values: Vec<T>) -> Vec<T> {
    if values.windows(2).all(|pair| pair[0] == pair[1]) {
        values.truncate(1);
    }
    values
}

pub(super) fn shells(document: &Document, places: &Places<'_>) -> Vec<Shell> {
    let drawn = |shell: &crate::document::Shell| {
        let built = places.of.names.meshes.shells.get(&shell.name.value)?;
        let count = shell.mesh.elements.len();
        let elements = &built.elements;
        let nodes = &built.nodes.nodes;
        let areas = elements.iter().map(|element| element.area());
        let mut directors: Vec<[[f64; 3]; 4]> =
            elements.iter().map(|element| element.directors().map(Into::into)).collect();
        let is_third = |director: &[f64; 3]| (director[2] - 1.0).abs() < 1e-9;
        if directors.iter().flatten().all(is_third) {
            directors.clear();
        }
        let stiffness = elements.iter().map(|element| element.law().stiffness.as_slice().to_vec());
        let mut free_strains = once(elements.iter().map(|element| element.law().free).collect());
        if free_strains == [[0.0; 6]] {
            free_strains.clear();
        }
        let mass = |(element, area): (usize, f64)| {
            let per_area: f64 = shell.plies(element).iter().map(|ply| ply.density * ply.thickness).sum();
            per_area * area
        };
        Some(Shell {
            name: shell.name.value.clone(),
            nodes: nodes.clone(),
            positions: shell.mesh.positions.iter().map(|position| (*position).into()).collect(),
            elements: shell.mesh.quadrilaterals().collect(),
            thickness: once((0..count).map(|element| shell.thickness(element)).collect()),
            offset: shell.offset,
            axes: nodes.iter().map(|&node| places.frame(node).rotation.quaternion()).collect(),
            directors,
            directions: once(elements.iter().map(|element| element.first_direction().into()).collect()),
            stiffness: once(stiffness.collect()),
            free_strains,
            is_homogeneous: shell.layers.len() == 1,
            area: areas.clone().sum(),
            mass: areas.enumerate().map(mass).sum(),
        })
    };
    document.shells.iter().filter_map(drawn).collect()
}
