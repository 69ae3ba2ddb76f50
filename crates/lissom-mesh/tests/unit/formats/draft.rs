//! Tests of `draft`, a module of it.

use super::*;

#[test]
fn numbers_stand_for_one_node_and_one_element() {
    let mut draft = Draft::default();
    assert_eq!(draft.add_node(1, 7, [0.0; 3]), Ok(0));
    assert_eq!(draft.add_node(2, 7, [0.0; 3]), Ok(0));
    assert!(draft.add_node(3, 7, [1.0; 3]).is_err());
    assert_eq!(draft.add_element(4, 1, MeshShape::Line2, vec![7, 8]), Ok(0));
    assert_eq!(draft.add_element(5, 1, MeshShape::Line2, vec![7, 8]), Ok(0));
    assert!(draft.add_element(6, 1, MeshShape::Line2, vec![8, 7]).is_err());
    let error = draft.connect(6).expect_err("node 8 is missing").to_string();
    assert!(error.starts_with("line 4: node 8 is not in the file"), "{error}");
}

#[test]
fn a_file_without_elements_is_rejected() {
    assert!(Draft::default().connect(3).is_err());
}
