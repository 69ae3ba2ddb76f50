use super::*;
use MeshShape::{Line2, Quadrilateral4, Triangle3};

pub(crate) const FLAT: &str = "** A plate\n*Heading\nUnits: m\n*NODE, NSET=all\n1, 0., 0., 0.\n2, 1.\n3, 1., 1.,\n\
    4, , 1.0D0, 0.\n5, 2., .5, 0.\n*Element, type=S4R, elset=Plate\n7, 1, 2,\n3, 4\n*ELEMENT, TYPE=S3, ELSET=PLATE\n\
    9, 2, 5, 3\n*ELEMENT, TYPE=B31\n1, 4, 1, 5\n*ELEMENT, TYPE=MASS, ELSET=tip mass\n2, 5\n*NSET, NSET=left,\n\
    GENERATE\n1, 4, 3\n*NSET, NSET=ends\nLEFT, 5\n*NSET, NSET=tri, ELSET=corner\n*ELSET, ELSET=corner\n9,\n\
    *SHELL SECTION, ELSET=plate, MATERIAL=Steel\n0.01, 5\n*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E11, 0.3\n*DENSITY\n\
    7850.,\n*PLASTIC\n2e8\n*BOUNDARY\nleft, 1, 6\n*STEP\n*STATIC\n*BOUNDARY\nends, 1\n*END STEP\n";

pub(crate) const ASSEMBLED: &str = "*Heading\n*Part, name=Shell\n*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n\
    *Element, type=S3\n1, 1, 2, 3\n*Elset, elset=face, generate\n1, 1, 1\n*Shell Section, elset=face, material=M\n\
    0.1\n*End Part\n*Assembly, name=A\n*Instance, name=Shell-1, part=Shell\n0., 0., 5.\n*End Instance\n*Node\n\
    1, 9, 9, 9\n*Nset, nset=reference\n1,\n*Nset, nset=corner, instance=Shell-1\n1, 2\n*End Assembly\n";

fn message(text: &str) -> String {
    read(text).expect_err("must be rejected").to_string()
}

#[test]
fn a_flat_file_is_read() {
    let mesh = read(FLAT).expect("valid");
    assert_eq!(mesh.node_numbers, [1, 2, 3, 4, 5]);
    assert_eq!(mesh.positions[3], [0.0, 1.0, 0.0]);
    let elements: Vec<_> = mesh.elements.iter().map(|own| (own.number, own.shape, own.nodes.len())).collect();
    assert_eq!(elements, [(7, Quadrilateral4, 4), (9, Triangle3, 3), (1, Line2, 2)]);
    assert_eq!(mesh.element_sets["Plate"], [0, 1]);
    assert_eq!(mesh.element_sets["corner"], [1]);
    assert_eq!(mesh.element_sets["tip mass"], [0_usize; 0]);
    assert_eq!(mesh.node_sets["all"], [0, 1, 2, 3, 4]);
    assert_eq!(mesh.node_sets["left"], [0, 3]);
    assert_eq!(mesh.node_sets["ends"], [0, 3, 4]);
    assert_eq!(mesh.node_sets["tri"], [1, 2, 4]);
    let (thickness, material) = (Some(0.01), Some("STEEL".to_owned()));
    assert_eq!(mesh.sections, [MeshSection { element_set: "Plate".to_owned(), thickness, material }]);
    let (young, poisson, density) = (Some(2.1e11), Some(0.3), Some(7850.0));
    assert_eq!(mesh.materials, [MeshMaterial { name: "STEEL".to_owned(), young, poisson, density }]);
    let expected = [
        "line 36: *BOUNDARY is not read",
        "line 17: *ELEMENT of the type MASS is not read",
        "line 34: *PLASTIC is not read",
        "line 38: *STEP is not read",
    ];
    assert_eq!(mesh.notes, expected);
}

#[test]
fn a_part_with_one_instance_is_read() {
    let mesh = read(ASSEMBLED).expect("valid");
    assert_eq!(mesh.positions, [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]]);
    assert_eq!(mesh.node_sets.keys().collect::<Vec<_>>(), ["corner"]);
    assert_eq!(mesh.node_sets["corner"], [0, 1]);
    assert!(mesh.notes.iter().any(|note| note == "line 18: *NODE of the assembly is not read"));
    let rotated = ASSEMBLED.replace("0., 0., 5.\n", "0., 0., 5.\n0, 0, 0, 0, 0, 1, 90\n");
    assert!(message(&rotated).starts_with("line 17: the instance is rotated"));
}

#[test]
fn faults_are_reported_with_their_lines() {
    let cases = [
        ("3, 4\n*ELEMENT", "3\n*ELEMENT", "line 11: element 7 has 3 nodes, S4R has 4"),
        ("7, 1, 2,\n3, 4", "7, 1, 2, 3, 4, 5", "line 11: element 7 has 5 nodes, S4R has 4"),
        ("9, 2, 5, 3", "9, 2, 6, 3", "line 14: node 6 is not in the file"),
        ("9, 2, 5, 3", "9, 2, , 3", "line 14: `` is no number of a node"),
        ("TYPE=S3,", "TYPE=S8R,", "line 14: element 9 has 3 nodes, S8R has 8"),
        ("TYPE=S3,", "TYPE=B32,", "line 13: elements of the type `B32`"),
        ("TYPE=S3,", "TYPE=C3D5,", "line 13: elements of the type `C3D5`; mesh with C3D4"),
        ("*BOUNDARY", "*INCLUDE, INPUT=a.inp", "line 36: *INCLUDE of another file; insert the text"),
        ("*NODE, NSET=all", "*NODE, INPUT=a.inp", "line 4: *NODE of another file"),
        ("*NODE, NSET=all", "*NODE, SYSTEM=C", "line 4: nodes in cylindrical"),
        ("*MATERIAL, NAME=STEEL", "*PLASTIC", "line 30: *ELASTIC before any *MATERIAL"),
        ("2.1E11, 0.3", "2.1E11", "line 31: *ELASTIC without its 2"),
        ("ELSET=plate,", "ELSET=plat,", "line 27: a section of the unknown set `plat`"),
        ("LEFT, 5", "right, 5", "line 23: no set of nodes `right`"),
        ("0.01, 5", "0, 5", "line 28: a thickness that is not above zero"),
        ("5, 2., .5, 0.", "4, 2., .5, 0.", "line 9: node 4 is there twice"),
        ("*PLASTIC", "*NCOPY", "line 34: *NCOPY, which makes"),
    ];
    for (old, new, expected) in cases {
        assert!(FLAT.contains(old), "{old}");
        let found = message(&FLAT.replace(old, new));
        assert!(found.starts_with(expected), "{found}");
    }
    let part = ASSEMBLED.replace("*Assembly", "*Part, name=Second\n*End Part\n*Assembly");
    assert!(message(&part).starts_with("line 14: a second *PART"), "{}", message(&part));
    assert!(message("1, 2\n").starts_with("line 1: `1, 2` before the first keyword"));
}

#[test]
fn what_is_interpreted_is_noted() {
    let text = "*NODE\n1\n2, 1\n3, 0, 1\n*ELEMENT, TYPE=CPS3, ELSET=a\n1, 1, 2, 3\n*ELSET, ELSET=b\n1, 7, 8\n\
        *SHELL SECTION, ELSET=A, MATERIAL=none, OFFSET=SPOS\n1\n*MATERIAL, NAME=m\n*ELASTIC, TYPE=ENGINEERING\n1\n\
        *DENSITY\n1, 20\n2, 40\n";
    let mesh = read(text).expect("valid");
    let expected = [
        "line 5: elements CPS3 are read as triangles of a surface",
        "line 9: OFFSET `SPOS` of the section is not read",
        "line 12: *ELASTIC of the type `ENGINEERING` is not read",
        "line 15: only the first line of *DENSITY is read",
        "line 8: number 7 and 1 more of the set of elements `b` is not in the mesh and is left out",
        "line 9: the material `none` is not in the file",
    ];
    assert_eq!(mesh.notes, expected);
    assert_eq!(mesh.sections[0].element_set, "a");
    assert_eq!(mesh.materials[0].young, None);
}

/// Twenty nodes of a hexahedron are in two lines.
#[test]
fn solids_are_read() {
    let nodes: Vec<String> = (1..=20).map(|k| format!("{k}, {k}, 0, 0\n")).collect();
    let nodes = nodes.concat();
    let text = format!(
        "*NODE\n{nodes}*ELEMENT, TYPE=C3D20R\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n\
         16, 17, 18, 19, 20,\n2, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n20, 19, 18, 17, 16,\n"
    );
    let mesh = read(&text).expect("valid");
    assert_eq!(mesh.elements[0].nodes, (0..20).collect::<Vec<_>>());
    assert_eq!(mesh.elements[1].nodes[15..], [19, 18, 17, 16, 15]);
}
