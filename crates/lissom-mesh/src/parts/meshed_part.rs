//! The mesh of a shell or solid in metres: quadrilaterals, or solid elements of second order with their outer faces.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use lissom_motion::{Motion, Vector3};

use crate::mesh::{Mesh, MeshShape};

/// An element of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Shape.
    pub shape: MeshShape,
    /// Indices of its nodes, in the order of Abaqus.
    pub nodes: Vec<usize>,
}

/// The mesh of a shell or solid.
#[derive(Clone, Debug, Default)]
pub struct MeshedPart {
    /// Number of coordinates of a place: two on a shell, three in a solid.
    pub coordinates: usize,
    /// Positions of the nodes [m].
    pub positions: Vec<Vector3>,
    /// u and v of each node, and w in a solid, from 0 to 1; none of a mesh from a file.
    pub places: Option<Vec<[f64; 3]>>,
    /// Unit normals of a shell at its nodes, where they are known.
    pub normals: Option<Vec<Vector3>>,
    /// Elements: quadrilaterals counterclockwise about the normal, or solid elements.
    pub elements: Vec<Element>,
    /// Outer faces of solid elements: corners counterclockwise seen from outside, then the middles of the sides.
    pub faces: Vec<Vec<usize>>,
    /// Sets of nodes by name.
    pub sets: BTreeMap<String, Vec<usize>>,
}

impl MeshedPart {
    /// The quadrilaterals of a mesh, with nodes and elements of its sets.
    pub fn of_surface(mesh: &Mesh, frame: &Motion, scale: f64) -> Self {
        let mut sets = mesh.node_sets.clone();
        for (name, elements) in &mesh.element_sets {
            sets.entry(name.clone()).or_insert_with(|| mesh.nodes_of(elements));
        }
        let quadrilaterals = mesh.elements.iter().filter(|own| own.shape == MeshShape::Quadrilateral4);
        Self {
            coordinates: 2,
            positions: positions(mesh, frame, scale),
            elements: quadrilaterals
                .map(|own| Element { shape: own.shape, nodes: own.nodes.clone() })
                .collect(),
            sets,
            ..Self::default()
        }
    }

    /// Corners of an element of a shell.
    pub fn corners(&self, element: usize) -> [usize; 4] {
        self.elements[element].nodes.first_chunk().copied().unwrap_or_default()
    }

    /// Corners of all elements of a shell.
    pub fn quadrilaterals(&self) -> impl ExactSizeIterator<Item = [usize; 4]> + Clone {
        (0..self.elements.len()).map(|element| self.corners(element))
    }

    /// u and v of a node, and w in a solid; none of a mesh from a file.
    pub fn place(&self, node: usize) -> Option<&[f64]> {
        self.places.as_ref().map(|places| &places[node][..self.coordinates])
    }

    /// Mean u and v of an element of a shell; the mean of the range for a mesh from a file.
    pub fn middle(&self, element: usize) -> [f64; 2] {
        let Some(places) = &self.places else { return [0.5; 2] };
        let own = self.corners(element).map(|node| places[node]);
        [0, 1].map(|k| own.iter().map(|place| place[k]).sum::<f64>() / 4.0)
    }

    /// Finds the faces that belong to one element only.
    pub fn find_faces(&mut self) {
        let corners = |face: &[usize]| {
            let mut corners = face[..face.len() / 2].to_vec();
            corners.sort_unstable();
            corners
        };
        let faces = || {
            self.elements.iter().flat_map(|own| {
                let faces = own.shape.solid_kind().map_or(&[][..], |(kind, _)| kind.faces);
                faces.iter().map(|face| face.iter().map(|&node| own.nodes[node]).collect::<Vec<_>>())
            })
        };
        let mut counts: HashMap<Vec<usize>, usize> = HashMap::new();
        faces().for_each(|face| *counts.entry(corners(&face)).or_default() += 1);
        self.faces = faces().filter(|face| counts[&corners(face)] == 1).collect();
    }

    /// Outer faces with all their nodes in a set.
    pub fn faces_in(&self, nodes: &[usize]) -> Vec<Vec<usize>> {
        let set: BTreeSet<usize> = nodes.iter().copied().collect();
        self.faces.iter().filter(|face| face.iter().all(|node| set.contains(node))).cloned().collect()
    }

    /// Positions of nodes [m].
    pub fn positions_of(&self, nodes: &[usize]) -> Vec<Vector3> {
        nodes.iter().map(|&node| self.positions[node]).collect()
    }

    /// Largest distance between neighbours on quadrilaterals or outer faces [m].
    pub fn longest_side<'f>(&self, faces: impl IntoIterator<Item = &'f [usize]>) -> f64 {
        let of_face = |own: &[usize]| {
            let sides =
                (0..own.len()).map(|i| self.positions[own[i]] - self.positions[own[(i + 1) % own.len()]]);
            sides.map(|side| side.norm()).fold(0.0, f64::max)
        };
        faces.into_iter().map(of_face).fold(0.0, f64::max)
    }
}

/// Positions of the nodes of a file in metres.
pub(crate) fn positions(mesh: &Mesh, frame: &Motion, scale: f64) -> Vec<Vector3> {
    mesh.positions.iter().map(|own| frame.transform_point(&(scale * Vector3::from(*own)))).collect()
}
