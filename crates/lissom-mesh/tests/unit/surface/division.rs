//! Tests of `division`, a module of it.

use super::*;
use crate::formats::{gmsh, obj};
use crate::surface::edges::{edges, shared};

/// Number of nodes less edges plus elements of a surface.
fn euler_characteristic(mesh: &Mesh) -> i64 {
    let count = |length: usize| i64::try_from(length).expect("small");
    let surface = mesh.part(None, MeshShape::is_surface).expect("valid");
    let edge_count = shared(&edges(&surface)).count();
    count(surface.positions.len()) - count(edge_count) + count(surface.elements.len())
}

#[test]
fn area_topology_and_sets_are_kept() {
    let mesh = gmsh::read(gmsh::tests::VERSION_2).expect("valid");
    let divided = mesh.divided_into_quadrilaterals();
    assert!((divided.area() - mesh.area()).abs() < 1e-14);
    assert_eq!(euler_characteristic(&divided), euler_characteristic(&mesh));
    let mut numbers: Vec<u64> = divided.elements.iter().map(|element| element.number).collect();
    assert_eq!(numbers[..4], [2, 7, 4, 8]);
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers.len(), divided.elements.len());
    assert_eq!(divided.element_sets["plate"], [2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(divided.element_sets["left edge"], [0, 1]);
    let left = &divided.node_sets["left edge"];
    assert_eq!(left[..2], [0, 3]);
    assert_eq!(divided.positions[left[2]], [0.0, 0.5, 0.0]);
    assert_eq!(left.len(), 3);
    // All nodes of the original were in it.
    assert_eq!(divided.node_sets["plate"].len(), divided.positions.len());
    assert_eq!(divided.divided_into_quadrilaterals(), divided);
}

#[test]
fn a_closed_surface_remains_closed_without_faults() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    let mesh = obj::read(text).expect("valid");
    let divided = mesh.divided_into_quadrilaterals();
    assert_eq!(divided.elements.len(), 4 + 4 * 3);
    assert_eq!([euler_characteristic(&mesh), euler_characteristic(&divided)], [2, 2]);
    assert!(divided.surface_faults().is_empty(), "{:?}", divided.surface_faults());
    assert!((divided.area() - mesh.area()).abs() < 1e-14);
}
