//! Edges of triangles and quadrilaterals, with the elements that share them.

use crate::mesh::{Mesh, MeshElement};

/// An edge of an element of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Edge {
    /// Nodes of the edge, ascending.
    pub(crate) nodes: [usize; 2],
    pub(crate) element: usize,
    /// Whether the element runs from the first node to the second.
    pub(crate) is_forward: bool,
}

impl Edge {}

/// Pairs of nodes around a triangle or quadrilateral; none of other shapes.
pub(crate) fn sides(element: &MeshElement) -> impl Iterator<Item = [usize; 2]> {
    let nodes = if element.shape.has_corners_only() { element.nodes.as_slice() } else { &[] };
    nodes.iter().enumerate().map(|(index, &node)| [node, nodes[(index + 1) % nodes.len()]])
}

/// All edges between different nodes, in ascending order: those that elements share are neighbours.
pub(crate) fn edges(mesh: &Mesh) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (element, own) in mesh.elements.iter().enumerate() {
        let sides = sides(own).filter(|[from, to]| from != to);
        edges.extend(sides.map(|[from, to]| Edge {
            nodes: [from.min(to), from.max(to)],
            element,
            is_forward: from < to,
        }));
    }
    edges.sort_unstable();
    edges
}

/// The edges that elements share, together: one for a boundary, two for neighbours, more for a branch.
pub(crate) fn shared(edges: &[Edge]) -> impl Iterator<Item = &[Edge]> {
    edges.chunk_by(|a, b| a.nodes == b.nodes)
}
