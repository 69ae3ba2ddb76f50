//! A mesh: nodes, elements, sets of both, and what the file states about thickness and material.

use std::collections::BTreeMap;

use crate::vectors::{cross, difference, length};

/// A finite-element mesh. Indices are from zero and below the length of the list that they refer to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions of the nodes, in the units of the file.
    pub positions: Vec<[f64; 3]>,
    /// Numbers of the nodes in the file.
    pub node_numbers: Vec<u64>,
    /// Elements of all shapes.
    pub elements: Vec<MeshElement>,
    /// Named sets of nodes: indices into `positions`, ascending, each once.
    pub node_sets: BTreeMap<String, Vec<usize>>,
    /// Named sets of elements: indices into `elements`, ascending, each once.
    pub element_sets: BTreeMap<String, Vec<usize>>,
    /// Thickness and material of sets of elements.
    pub sections: Vec<MeshSection>,
    /// Materials of the file.
    pub materials: Vec<MeshMaterial>,
    /// What was left out or interpreted, one line each.
    pub notes: Vec<String>,
}

/// An element of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshElement {
    /// Number in the file.
    pub number: u64,
    /// Shape, which determines the number of nodes.
    pub shape: MeshShape,
    /// Indices of its nodes, in the order of Abaqus.
    pub nodes: Vec<usize>,
}

/// Shape of an element. Nodes are in the order of Abaqus for files of all formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MeshShape {
    /// Two nodes.
    Line2,
    /// Two ends, then the middle.
    Line3,
    /// Three nodes, around the normal.
    Triangle3,
    /// Three corners, then the middles of the sides 12, 23, 31.
    Triangle6,
    /// Four nodes, around the normal.
    Quadrilateral4,
    /// Four corners, then the middles of the sides 12, 23, 34, 41.
    Quadrilateral8,
    /// Four corners and four middles of the sides, then the node at the centre.
    Quadrilateral9,
    /// Three nodes of a face, and the one opposite.
    Tetrahedron4,
    /// Four corners, then the middles of the edges 12, 23, 31, 14, 24, 34.
    Tetrahedron10,
    /// Four nodes of a face, then the four opposite.
    Hexahedron8,
    /// Eight corners, then the middles of the edges 12, 23, 34, 41, 56, 67, 78, 85, 15, 26, 37, 48.
    Hexahedron20,
    /// Three nodes of a face, then the three opposite.
    Wedge6,
    /// Six corners, then the middles of the edges 12, 23, 31, 45, 56, 64, 14, 25, 36.
    Wedge15,
}

impl MeshShape {
    /// Number of nodes.
    pub fn node_count(self) -> usize {
        match (self, self.solid_kind()) {
            (_, Some((kind, true))) => kind.node_count(),
            (_, Some((kind, false))) => kind.corners.len(),
            (Self::Line3, _) => 3,
            (Self::Triangle6, _) => 6,
            (Self::Quadrilateral8, _) => 8,
            (Self::Quadrilateral9, _) => 9,
            _ => self.corner_count(),
        }
    }

    /// Number of corners, which are its first nodes.
    pub fn corner_count(self) -> usize {
        match (self, self.solid_kind()) {
            (_, Some((kind, _))) => kind.corners.len(),
            (Self::Line2 | Self::Line3, _) => 2,
            (Self::Triangle3 | Self::Triangle6, _) => 3,
            _ => 4,
        }
    }

    /// Number of dimensions: 1 for lines, 2 for surfaces, 3 for solids.
    pub fn dimension(self) -> u8 {
        match self {
            Self::Line2 | Self::Line3 => 1,
            _ if self.solid_kind().is_some() => 3,
            _ => 2,
        }
    }

    /// Whether it is a triangle or quadrilateral.
    pub fn is_surface(self) -> bool {
        self.dimension() == 2
    }

    /// Whether it is one without nodes on its sides.
    pub(crate) fn has_corners_only(self) -> bool {
        self.is_surface() && self.node_count() == self.corner_count()
    }
}

/// Thickness and material of the elements of a set.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSection {
    /// Name of the set of elements.
    pub element_set: String,
    /// Thickness of shells and membranes, in the units of the file.
    pub thickness: Option<f64>,
    /// Name of the material.
    pub material: Option<String>,
}

/// A linear elastic material, in the units of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshMaterial {
    /// Name.
    pub name: String,
    /// Young's modulus.
    pub young: Option<f64>,
    /// Poisson's ratio.
    pub poisson: Option<f64>,
    /// Mass per volume.
    pub density: Option<f64>,
}

impl Mesh {
    /// Area of the triangles and quadrilaterals.
    pub fn area(&self) -> f64 {
        self.elements.iter().map(|element| length(self.area_vector(element))).sum()
    }

    /// Whether a triangle or quadrilateral has nodes on its sides.
    pub fn has_nodes_on_sides(&self) -> bool {
        self.elements.iter().any(|own| own.shape.is_surface() && !own.shape.has_corners_only())
    }

    /// Diagonal of the box around all nodes.
    pub fn size(&self) -> f64 {
        let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for position in &self.positions {
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
        if self.positions.is_empty() { 0.0 } else { length(difference(high, low)) }
    }

    /// Nodes of the elements of these indices, ascending, each once.
    pub fn nodes_of(&self, elements: &[usize]) -> Vec<usize> {
        let mut nodes: Vec<usize> =
            elements.iter().flat_map(|&element| self.elements[element].nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Normal of a triangle or quadrilateral, as long as its area; zero for other shapes.
    pub(crate) fn area_vector(&self, element: &MeshElement) -> [f64; 3] {
        let (from, to) = match *element.nodes.as_slice() {
            [a, b, c] => ([a, a], [b, c]),
            [a, b, c, d] if element.shape == MeshShape::Quadrilateral4 => ([a, b], [c, d]),
            _ => return [0.0; 3],
        };
        let [first, second] =
            [0, 1].map(|side| difference(self.positions[to[side]], self.positions[from[side]]));
        cross(first, second).map(|component| 0.5 * component)
    }
}
