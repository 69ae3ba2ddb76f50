//! Types of elements of Gmsh, and the order of their nodes.

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
    use MeshShape::{
        Hexahedron8, Hexahedron20, Line2, Quadrilateral4, Tetrahedron4, Tetrahedron10, Triangle3,
    };
    let (name, dimension, node_count, shape) = match number {
        1 => ("line", 1, 2, Some(Line2)),
        2 => ("triangle", 2, 3, Some(Triangle3)),
        3 => ("quadrilateral", 2, 4, Some(Quadrilateral4)),
        4 => ("tetrahedron", 3, 4, Some(Tetrahedron4)),
        5 => ("hexahedron", 3, 8, Some(Hexahedron8)),
        6 => ("prism", 3, 6, None),
        7 => ("pyramid", 3, 5, None),
        8 => ("line of 3 nodes", 1, 3, None),
        9 => ("triangle of 6 nodes", 2, 6, None),
        10 => ("quadrilateral of 9 nodes", 2, 9, None),
        11 => ("tetrahedron of 10 nodes", 3, 10, Some(Tetrahedron10)),
        12 => ("hexahedron of 27 nodes", 3, 27, None),
        13 => ("prism of 18 nodes", 3, 18, None),
        14 => ("pyramid of 14 nodes", 3, 14, None),
        15 => ("point", 0, 1, None),
        16 => ("quadrilateral of 8 nodes", 2, 8, None),
        17 => ("hexahedron of 20 nodes", 3, 20, Some(Hexahedron20)),
        18 => ("prism of 15 nodes", 3, 15, None),
        19 => ("pyramid of 13 nodes", 3, 13, None),
        _ => return None,
    };
    Some(ElementType { name, dimension, node_count, shape })
}

/// The nodes of Gmsh in the order of Abaqus.
pub(crate) fn in_order_of_abaqus(shape: MeshShape, nodes: &[u64]) -> Vec<u64> {
    const TETRAHEDRON: [usize; 10] = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8];
    const HEXAHEDRON: [usize; 20] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15];
    let order: &[usize] = match shape {
        MeshShape::Tetrahedron10 => &TETRAHEDRON,
        MeshShape::Hexahedron20 => &HEXAHEDRON,
        _ => return nodes.to_vec(),
    };
    order.iter().filter_map(|&index| nodes.get(index).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners at both ends of each edge, in the order of the middle nodes of Gmsh, from the figures of its manual.
    const OF_GMSH: [&[[u64; 2]]; 2] = [
        &[[0, 1], [1, 2], [2, 0], [3, 0], [2, 3], [1, 3]],
        &[[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]],
    ];
    /// The same of Abaqus.
    const OF_ABAQUS: [&[[u64; 2]]; 2] = [
        &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]],
        &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
    ];

    #[test]
    fn middle_nodes_are_between_the_corners_of_abaqus() {
        let shapes = [MeshShape::Tetrahedron10, MeshShape::Hexahedron20];
        for (case, shape) in shapes.into_iter().enumerate() {
            // A node is named after its corners.
            let name = |[a, b]: [u64; 2]| 100 + 10 * a.min(b) + a.max(b);
            let corners = shape.node_count() - OF_GMSH[case].len();
            let nodes = |edges: &[[u64; 2]]| -> Vec<u64> {
                (0..corners as u64).chain(edges.iter().map(|&edge| name(edge))).collect()
            };
            assert_eq!(in_order_of_abaqus(shape, &nodes(OF_GMSH[case])), nodes(OF_ABAQUS[case]));
        }
    }

    #[test]
    fn shapes_have_as_many_nodes_as_their_types() {
        for element_type in (0..40).filter_map(element_type) {
            if let Some(shape) = element_type.shape {
                assert_eq!(shape.node_count(), element_type.node_count, "{}", element_type.name);
                assert_eq!(shape.dimension(), element_type.dimension, "{}", element_type.name);
            }
        }
    }
}
