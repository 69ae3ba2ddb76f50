//! Tests of `orientation`, a module of it.

use crate::formats::obj;
use crate::surface::fault::MeshFaultKind;

const STRIP: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\n";

#[test]
fn the_smaller_part_is_flipped() {
    let mut mesh = obj::read(&format!("{STRIP}f 6 5 1 2\nf 2 6 7 3\nf 3 7 8\nf 3 4 8\n")).expect("valid");
    let before = mesh.clone();
    assert_eq!(mesh.orient(), 2);
    assert!(mesh.surface_faults().is_empty());
    assert_eq!(mesh.elements[1].nodes, [1, 2, 6, 5]);
    assert_eq!([&mesh.elements[0], &mesh.elements[3]], [&before.elements[0], &before.elements[3]]);
    assert_eq!(mesh.orient(), 0);
    // The first element is the only opposite one.
    let mut mesh = obj::read(&format!("{STRIP}f 1 5 6 2\nf 2 3 7 6\nf 3 4 8 7\n")).expect("valid");
    assert_eq!(mesh.orient(), 1);
    assert_eq!(mesh.elements[0].nodes, [0, 1, 5, 4]);
}

#[test]
fn a_strip_with_one_side_remains_with_a_fault() {
    let text = format!("{STRIP}f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 5 1 8\n");
    let mut mesh = obj::read(&text).expect("valid");
    mesh.orient();
    let is_opposite = |kind| kind == MeshFaultKind::OppositeOrientation;
    assert_eq!(mesh.surface_faults().iter().filter(|fault| is_opposite(fault.kind)).count(), 1);
}
