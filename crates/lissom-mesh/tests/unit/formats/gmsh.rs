use super::*;
use crate::mesh::MeshShape::{self, Line2, Quadrilateral4, Triangle3};

/// Triangle and quadrilateral, an edge in two groups, a point.
pub(crate) const VERSION_2: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n0 9 \"tip\"\n\
    1 5 \"left edge\"\n2 7 \"plate\"\n$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n10 0 1 0\n\
    11 2 0.5 0\n$EndNodes\n$Elements\n6\n1 15 2 9 1 11\n2 1 2 5 1 10 1\n3 1 2 6 1 10 1\n4 3 2 7 1 1 2 3 10\n\
    5 2 2 7 1 2 11 3\n6 2 3 0 1 0 1 2 3\n$EndElements\n$NodeData\n1\n\"x\"\n$EndNodeData\n";

pub(crate) const VERSION_4: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 5 \"left edge\"\n\
    2 7 \"plate\"\n$EndPhysicalNames\n$Entities\n1 1 1 0\n4 2 0.5 0 1 9\n1 0 0 0 0 1 0 1 5 2 1 -2\n\
    1 0 0 0 2 1 0 2 -7 8 1 1\n$EndEntities\n$Nodes\n2 5 1 11\n1 1 0 2\n1\n10\n0 0 0\n0 1 0\n2 1 0 3\n2\n3\n11\n\
    1 0 0\n1 1 0\n2 .5 0\n$EndNodes\n$Elements\n4 4 1 5\n0 4 15 1\n1 11\n1 1 1 1\n2 10 1\n2 1 3 1\n4 1 2 3 10\n\
    2 1 2 1\n5 2 11 3\n$EndElements\n";

fn message(text: &str) -> String {
    read(text).expect_err("must be rejected").to_string()
}

#[test]
fn version_2_is_read_with_its_groups() {
    let mesh = read(VERSION_2).expect("valid");
    assert_eq!(mesh.node_numbers, [1, 2, 3, 10, 11]);
    assert_eq!(mesh.positions[4], [2.0, 0.5, 0.0]);
    let shapes: Vec<MeshShape> = mesh.elements.iter().map(|element| element.shape).collect();
    // Element 3 is element 2 in a second group.
    assert_eq!(shapes, [Line2, Quadrilateral4, Triangle3, Triangle3]);
    assert_eq!(mesh.elements[1].nodes, [0, 1, 2, 3]);
    assert_eq!(mesh.element_sets["plate"], [1, 2]);
    assert_eq!(mesh.element_sets["left edge"], mesh.element_sets["curve 6"]);
    assert_eq!(mesh.node_sets["left edge"], [0, 3]);
    assert_eq!(mesh.node_sets["tip"], [4]);
    assert_eq!(mesh.node_sets["plate"], [0, 1, 2, 3, 4]);
    assert!(!mesh.element_sets.contains_key("tip") && !mesh.element_sets.contains_key("surface 0"));
    assert_eq!(mesh.notes, ["line 27: `$NodeData` is not read"]);
}

#[test]
fn version_4_is_read_with_the_groups_of_its_entities() {
    let (mesh, other) = (read(VERSION_4).expect("valid"), read(VERSION_2).expect("valid"));
    assert_eq!(mesh.node_numbers, [1, 10, 2, 3, 11]);
    assert!((mesh.area() - 1.5).abs() < 1e-15);
    assert_eq!(mesh.element_sets["plate"], [1, 2]);
    assert_eq!(mesh.element_sets["surface 8"], [1, 2]);
    assert_eq!(mesh.node_sets["left edge"], [0, 1]);
    assert_eq!(mesh.node_sets["point 9"], [4]);
    assert_eq!(mesh.elements[1].number, other.elements[1].number);
}

/// Points on a line with lines between them, all in so many groups.
fn grouped(points: usize, groups: usize) -> String {
    let tags: Vec<String> = (1..=groups).map(|tag| format!(" {tag}")).collect();
    let tags = tags.concat();
    let numbers: Vec<String> = (1..=points).map(|own| format!("{own}\n")).collect();
    let numbers = numbers.concat();
    let positions: Vec<String> = (1..=points).map(|own| format!("{own} 0 0\n")).collect();
    let positions = positions.concat();
    let lines: Vec<String> = (1..points).map(|own| format!("{own} {own} {}\n", own + 1)).collect();
    let lines = lines.concat();
    format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 1 0 0\n1 0 0 0 1 0 0 {groups}{tags} 0\n$EndEntities\n\
         $Nodes\n1 {points} 1 {points}\n1 1 0 {points}\n{numbers}{positions}$EndNodes\n\
         $Elements\n1 {0} 1 {0}\n1 1 1 {0}\n{lines}$EndElements\n",
        points - 1
    )
}

#[test]
fn groups_that_multiply_their_members_are_rejected() {
    let mesh = read(&grouped(3000, 100)).expect("few enough");
    assert!(mesh.element_sets["curve 100"].len() == 2999 && mesh.node_sets["curve 1"].len() == 3000);
    let found = message(&grouped(3000, 800));
    assert!(found.contains("more than 200 times members"), "{found}");
}

#[test]
fn other_versions_and_binary_files_are_rejected_with_a_remedy() {
    assert!(message("$MeshFormat\n4.1 1 8\n\u{1}").contains("binary; save it in Gmsh as ASCII"));
    assert!(message("$MeshFormat\n4 0 8\n").contains("version `4` of the format; save it"));
    assert!(message("(0 \"FLUENT\")").starts_with("line 1: `(0 \"FLUENT\")` instead of $MeshFormat"));
}

#[test]
fn faults_are_reported_with_their_lines() {
    let cases = [
        ("\n3 1 1 0", "\n3 1 x 0", "line 14: `x` is no finite number"),
        ("5 2 2 7 1 2 11 3", "5 2 2 7 1 2 11", "line 24: a triangle with 2 nodes, it has 3"),
        ("5 2 2 7 1 2 11 3", "5 2 2 7 1 2 12 3", "line 24: node 12 is not in the file"),
        ("$Nodes\n5", "$Nodes\n6", "line 17: `$EndNodes` instead of a line"),
        ("$Nodes\n5", "$Nodes\n4", "line 16: `11 2 0.5 0` where $Nodes ends"),
        ("$Nodes\n5", "$Nodes\n999999999999", "line 17: `$EndNodes` instead of a line"),
        ("6 2 3 0", "6 92 3 0", "line 25: an element of the unknown type `92`"),
    ];
    for (old, new, expected) in cases {
        assert!(VERSION_2.contains(old), "{old}");
        let found = message(&VERSION_2.replace(old, new));
        assert!(found.starts_with(expected), "{found}");
    }
    let found = message(&VERSION_4.replace("\n2 1 0 3\n", "\n2 1 0 999999999999\n"));
    assert!(found.starts_with("line 29: `$EndNodes` instead of a line"), "{found}");
}

#[test]
fn a_file_ends_only_after_a_section() {
    let end = VERSION_4.rfind("$EndElements").expect("there");
    for length in 0..end {
        assert!(read(&VERSION_4[..length]).is_err(), "{length}");
    }
}

/// Solids of second order are read, and the surfaces around them.
#[test]
fn elements_of_second_order() {
    let nodes: Vec<String> = (1..=10).map(|k| format!("{k} {k} {} 0\n", k * k)).collect();
    let nodes = nodes.concat();
    let start = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n{nodes}$EndNodes\n$Elements\n");
    let solid = "1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n";
    let face = "2 9 2 4 1 1 2 3 5 6 7\n";
    let mesh = read(&format!("{start}2\n{solid}{face}$EndElements\n")).expect("valid");
    assert_eq!(mesh.elements[0].nodes, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]);
    assert_eq!(mesh.node_sets["surface 4"], [0, 1, 2, 4, 5, 6]);
    assert_eq!((mesh.elements.len(), mesh.notes.len()), (2, 0));
    let found = message(&format!("{start}1\n3 7 2 4 1 1 2 3 4 5\n$EndElements\n"));
    assert!(found.contains("a pyramid, which is not read; mesh with"), "{found}");
}
