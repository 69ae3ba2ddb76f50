//! Tests of `gmsh_types`, a module of it.

use super::*;

/// Orders in the figures of the manual of Gmsh, and those that follow from them for Abaqus.
#[test]
fn middle_nodes_are_between_the_corners_of_abaqus() {
    let orders: [&[u64]; 3] = [
        &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
        &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
        &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
    ];
    for (kind, order) in SOLID_KINDS.into_iter().zip(orders) {
        let nodes: Vec<u64> = (0..order.len() as u64).collect();
        assert_eq!(in_order_of_abaqus(kind.shapes[1], &nodes), order, "{}", kind.word);
    }
}

#[test]
fn shapes_have_as_many_nodes_as_their_types() {
    for element_type in (0..40).filter_map(element_type) {
        if let Some(shape) = element_type.shape {
            // Nodes in the middle of faces and of the element are left out.
            let count = match element_type.node_count {
                27 => 20,
                18 => 15,
                other => other,
            };
            assert_eq!(shape.node_count(), count, "{}", element_type.name);
            assert_eq!(shape.dimension(), element_type.dimension, "{}", element_type.name);
        }
    }
}
