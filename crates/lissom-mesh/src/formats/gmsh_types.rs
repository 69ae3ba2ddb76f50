//! Types of elements of Gmsh, and the order of their nodes.

use crate::kinds::SOLID_KINDS;
use crate::mesh::MeshShape;

/// What a number of a type stands for.
pub(crate) struct ElementType {
    pub(crate) name: &'static str,
    pub(crate) dimension: u8,
    pub(crate) node_count: usize,
    /// Shape of elements that are read.
    pub(crate) shape: Option<MeshShape>,
}

/// The type of a number; `None` for those of third and higher order.
pub(crate) fn element_type(number: u64) -> Option<ElementType> {
    use MeshShape::{Line2, Line3, Quadrilateral4, Quadrilateral8, Quadrilateral9, Triangle3, Triangle6};
    let (name, dimension, node_count, surface) = match number {
        1 => ("line", 1, 2, Some(Line2)),
        2 => ("triangle", 2, 3, Some(Triangle3)),
        3 => ("quadrilateral", 2, 4, Some(Quadrilateral4)),
        4 => ("tetrahedron", 3, 4, None),
        5 => ("hexahedron", 3, 8, None),
        6 => ("prism", 3, 6, None),
        7 => ("pyramid", 3, 5, None),
        8 => ("line of 3 nodes", 1, 3, Some(Line3)),
        9 => ("triangle of 6 nodes", 2, 6, Some(Triangle6)),
        10 => ("quadrilateral of 9 nodes", 2, 9, Some(Quadrilateral9)),
        11 => ("tetrahedron of 10 nodes", 3, 10, None),
        12 => ("hexahedron of 27 nodes", 3, 27, None),
        13 => ("prism of 18 nodes", 3, 18, None),
        14 => ("pyramid of 14 nodes", 3, 14, None),
        15 => ("point", 0, 1, None),
        16 => ("quadrilateral of 8 nodes", 2, 8, Some(Quadrilateral8)),
        17 => ("hexahedron of 20 nodes", 3, 20, None),
        18 => ("prism of 15 nodes", 3, 15, None),
        19 => ("pyramid of 13 nodes", 3, 13, None),
        _ => return None,
    };
    let mut solids = SOLID_KINDS.iter().flat_map(|kind| kind.gmsh.into_iter().zip(kind.shapes));
    // Of complete elements of second order nodes in the middle of faces and of the element are left out.
    let read_as = match number {
        12 => 17,
        13 => 18,
        other => other,
    };
    let solid = solids.find_map(|(own, shape)| (own == read_as).then_some(shape));
    let shape = surface.or(solid);
    Some(ElementType { name, dimension, node_count, shape })
}

/// The nodes of Gmsh in the order of Abaqus.
pub(crate) fn in_order_of_abaqus(shape: MeshShape, nodes: &[u64]) -> Vec<u64> {
    let Some((kind, true)) = shape.solid_kind() else { return nodes.to_vec() };
    let corners = kind.corners.len();
    let middle = |[a, b]: &[usize; 2]| {
        let own = kind.gmsh_edges.iter().position(|ends| ends == &[*a, *b] || ends == &[*b, *a])?;
        nodes.get(corners + own).copied()
    };
    nodes.iter().take(corners).copied().chain(kind.edges.iter().filter_map(middle)).collect()
}

#[cfg(test)]
#[path = "../../tests/unit/formats/gmsh_types.rs"]
mod tests;
