//! Surfaces of second order: their nodes on sides, and centres on the curved surface, become corners of quadrilaterals.

use lissom_mesh::{MeshShape, read};

/// A quarter of a cylinder of radius 1 and height 1: one quadrilateral with eight nodes, and a triangle with six beside it.
fn quarter(second: &str) -> String {
    let half = 0.5_f64.sqrt();
    format!(
        "*Node\n1, 1, 0, 0\n2, 0, 1, 0\n3, 0, 1, 1\n4, 1, 0, 1\n5, {half}, {half}, 0\n6, 0, 1, 0.5\n7, {half}, {half}, 1\n8, 1, 0, 0.5\n\
         9, 2, 0, 0\n10, 1.5, 0, 0\n11, 1.5, 0, 0.5\n*Element, type=S8R, elset=A\n1, 1, 2, 3, 4, 5, 6, 7, 8\n\
         *Element, type={second}, elset=B\n2, 9, 1, 4, 10, 8, 11\n*Nset, nset=SEAM\n1, 4, 8\n"
    )
}

#[test]
fn nodes_on_sides_become_corners() {
    let mesh = read(quarter("STRI65").as_bytes(), "inp").expect("valid");
    assert!(mesh.has_nodes_on_sides());
    let divided = mesh.divided_into_quadrilaterals();
    assert_eq!(divided.elements.len(), 4 + 3);
    assert!(divided.elements.iter().all(|own| own.shape == MeshShape::Quadrilateral4));
    // Nodes are added at both centres only, and neighbours share those of their side.
    assert_eq!(divided.positions.len(), 13);
    assert!(divided.surface_faults().is_empty(), "{:?}", divided.surface_faults());
    // Of the parabola through 1, 5 and 2.
    let (half, centre) = (0.5_f64.sqrt(), divided.positions[11]);
    assert!((centre[0] - half).abs() < 1e-12 && (centre[2] - 0.5).abs() < 1e-12, "{centre:?}");
    assert_eq!(divided.node_sets["SEAM"], [0, 3, 7]);
    assert_eq!(divided.element_sets["A"].len(), 4);
}

#[test]
fn meshes_of_gmsh_are_those_of_abaqus() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 1 0 0\n6 2 1 0\n7 1 2 0\n8 0 1 0\n9 1 1 0.2\n\
                $EndNodes\n$Elements\n2\n1 10 2 1 1 1 2 3 4 5 6 7 8 9\n2 8 2 2 2 1 2 5\n$EndElements\n";
    let divided = read(text.as_bytes(), "msh").expect("valid").divided_into_quadrilaterals();
    let shapes: Vec<MeshShape> = divided.elements.iter().map(|own| own.shape).collect();
    assert_eq!(shapes.iter().filter(|shape| **shape == MeshShape::Quadrilateral4).count(), 4);
    assert_eq!(shapes.iter().filter(|shape| **shape == MeshShape::Line2).count(), 2);
    // The node at the centre is the given one.
    assert_eq!(divided.positions.len(), 9);
}
