//! Tests of `part`, a module of it.

use super::*;
use crate::formats::abaqus;

#[test]
fn a_part_has_its_own_nodes_and_sets() {
    let mesh = abaqus::read(abaqus::tests::FLAT).expect("valid");
    let part = mesh.part(Some("corner"), MeshShape::is_surface).expect("valid");
    assert_eq!(part.node_numbers, [2, 3, 5]);
    assert_eq!(part.positions[2], [2.0, 0.5, 0.0]);
    assert_eq!(part.elements[0].nodes, [0, 2, 1]);
    assert_eq!(part.element_sets["Plate"], [0]);
    assert_eq!(part.node_sets["ends"], [2]);
    assert!(!part.node_sets.contains_key("left") && !part.element_sets.contains_key("tip mass"));
    assert_eq!(part.sections, mesh.sections);
    let lines = mesh.part(None, |shape| shape == MeshShape::Line2).expect("valid");
    assert_eq!((lines.sections.len(), lines.elements.len()), (0, 1));
    let surface = mesh.part(None, MeshShape::is_surface).expect("valid");
    assert_eq!(surface.elements, mesh.elements[..2]);
}

#[test]
fn unknown_sets_and_empty_parts_are_rejected() {
    let mesh = abaqus::read(abaqus::tests::FLAT).expect("valid");
    let message = |set, keep: fn(MeshShape) -> bool| mesh.part(set, keep).expect_err("empty").to_string();
    let found = message(Some("plate"), MeshShape::is_surface);
    assert_eq!(found, "there is no set of elements `plate`; there are: `Plate`, `corner`, `tip mass`");
    let found = message(Some("Plate"), |shape| shape == MeshShape::Line2);
    assert!(found.ends_with("its elements: 1 Triangle3, 1 Quadrilateral4"), "{found}");
    assert!(message(Some("tip mass"), |_| true).ends_with("none"));
}
