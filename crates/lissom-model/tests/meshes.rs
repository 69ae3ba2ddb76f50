//! Shells and solids from files of meshes: sections and sets, what is not read, and faults.

use std::sync::Arc;

use lissom_model::document::Document;
use lissom_model::{Library, ModelText};

use crate::support::registry;

const PLATE: &str = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*Element, type=S4, elset=P\n1, 1, 2, 3, 4\n\
                     *Shell section, elset=P, material=M\n0.01\n*Material, name=M\n*Elastic\n2e11, 0.3\n*Density\n7800\n";

fn of_shell(shell: &str, mesh: &str) -> Result<Document, String> {
    let text = format!(
        "lissom = 1\n[shells.p]\nmesh = \"p.inp\"\n{shell}\n[analysis]\nkind = \"dynamics\"\nend = 1\n"
    );
    let library = Library::of_texts([("p.inp".to_owned(), mesh.to_owned())]);
    let read = ModelText::read_with(&text, "model.toml", &[], Arc::new(library));
    let document = read.and_then(|text| text.document(&registry(), &[]));
    document.map_err(|report| report.render(false))
}

#[test]
fn a_section_of_the_file_is_that_of_the_shell() {
    let shell = &of_shell("", PLATE).expect("a good model").shells[0];
    assert_eq!((shell.thickness(0), shell.layers[0].ply.young), (0.01, [2e11; 2]));
    // Of a file in millimetres the units of the material are unknown.
    assert!(of_shell("scale = 0.001", PLATE).expect_err("no section").contains("lacks `thickness`"));
    let part = PLATE.replace("elset=P\n1,", "elset=Q\n1,").replace("*Shell", "*Elset, elset=P\n*Shell");
    assert!(of_shell("", &part).is_err());
}

#[test]
fn what_is_not_read_of_a_mesh_is_reported() {
    let warnings = |mesh: &str| of_shell("", mesh).expect("a good model").warnings.render(false);
    assert!(!warnings(PLATE).contains("read in part"));
    let more = PLATE.replace(
        "*Material",
        "*Element, type=B31, elset=B\n2, 1, 2\n*Element, type=MASS, elset=C\n3, 1\n*Material",
    );
    assert!(warnings(&more).contains("read in part"), "{}", warnings(&more));
}

#[test]
fn sides_that_do_not_lie_at_each_other_are_reported() {
    let joint = |tip: &str| {
        let square = |name: &str, x: f64| {
            format!(
                "[shells.{name}]\ncorners = [[{x}, 0, 0], [{0}, 0, 0], [{0}, 1, 0], [{x}, 1, 0]]\ndivisions = [2, 2]\nthickness = 0.01\nmaterial = \"m\"\n",
                x + 1.0
            )
        };
        let text = format!(
            "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n{}{}[joints.j]\nkind = \"clamp\"\nbase = \"a.east\"\n\
             tip = \"b.{tip}\"\n[analysis]\nkind = \"dynamics\"\nend = 1\n",
            square("a", 0.0),
            square("b", 1.0)
        );
        Document::parse(&text, "model.toml", &registry()).expect("a good model").warnings.render(false)
    };
    assert!(!joint("west").contains("rigid arms"));
    assert!(joint("east").contains("rigid arms"), "{}", joint("east"));
}

/// Two cubes along x.
const CUBES: &str = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n\
                     9, 2, 0, 0\n10, 2, 1, 0\n11, 2, 0, 1\n12, 2, 1, 1\n\
                     *Element, type=C3D8, elset=A\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Element, type=C3D8, elset=B\n2, 2, 9, 10, 3, 6, 11, 12, 7\n\
                     *Nset, nset=A\n1, 4, 5, 8\n";

fn solid(mesh: &str) -> Result<Document, String> {
    let text = "lissom = 1\n[materials.m]\nE = 1e9\nnu = 0.3\ndensity = 1000\n[solids.s]\nmesh = \"s.inp\"\nmaterial = \"m\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 1\n";
    let library = Library::of_texts([("s.inp".to_owned(), mesh.to_owned())]);
    let read = ModelText::read_with(text, "model.toml", &[], Arc::new(library));
    let document = read.and_then(|text| text.document(&registry(), &[]));
    document.map_err(|report| report.render(false))
}

/// As Abaqus writes a face: its nodes, and the elements behind it, by one name.
#[test]
fn nodes_of_a_face_are_those_of_the_set_of_nodes() {
    let document = solid(CUBES).expect("a good model");
    let mesh = &document.elastic_solids[0].mesh;
    assert_eq!((mesh.sets["A"].len(), mesh.sets["B"].len()), (8, 20));
    assert!(mesh.sets["A"].iter().all(|&node| mesh.positions[node].x == 0.0));
}

#[test]
fn elements_must_share_whole_faces() {
    let with = |more: &str| solid(&format!("{CUBES}{more}")).expect_err("no good mesh");
    let twice = with("*Element, type=C3D8, elset=C\n3, 1, 2, 3, 4, 5, 6, 7, 8\n");
    assert!(twice.contains("two elements with the same nodes"), "{twice}");
    let tetrahedron = with("*Node\n13, 3, 0.5, 0.5\n*Element, type=C3D4, elset=C\n3, 9, 10, 11, 13\n");
    assert!(tetrahedron.contains("a face of four corners on one of three"), "{tetrahedron}");
    // Of second order, the middle of whose edge is a corner of the cubes.
    let hanging = with(
        "*Node\n13, 0, 0, 3\n14, 0.5, 1, 2\n15, 0.5, 0.5, 2.5\n16, 0.25, 0.5, 1.5\n17, 0.25, 0.5, 2.5\n18, 0.5, 0.5, 1\n\
         *Element, type=C3D10, elset=C\n3, 1, 2, 14, 13, 5, 6, 16, 15, 17, 18\n",
    );
    assert!(hanging.contains("a corner at the middle of an edge"), "{hanging}");
}

#[test]
fn several_materials_of_a_file_are_reported() {
    let sections = "*Solid section, elset=A, material=X\n*Solid section, elset=B, material=Y\n\
                    *Material, name=X\n*Elastic\n1e9, 0.3\n*Material, name=Y\n*Elastic\n2e9, 0.3\n";
    let warnings = |text: &str| solid(text).expect("a good model").warnings.render(false);
    assert!(warnings(&format!("{CUBES}{sections}")).contains("sections of 2 materials"));
    assert!(!warnings(CUBES).contains("materials"));
}

#[test]
fn files_as_large_as_buildings_are_probably_in_millimetres() {
    let plate = PLATE.replace("2, 1, 0, 0", "2, 1000, 0, 0").replace("3, 1, 1, 0", "3, 1000, 1000, 0");
    let plate = plate.replace("4, 0, 1, 0", "4, 0, 1000, 0");
    let warnings = |scale: &str| {
        let shell = format!(
            "{scale}\nthickness = 0.01\nmaterial = \"m\"\n[materials.m]\nE = 2e11\nnu = 0.3\ndensity = 7800"
        );
        of_shell(&shell, &plate).expect("a good model").warnings.render(false)
    };
    assert!(warnings("").contains("is 1.4e3 m large"), "{}", warnings(""));
    assert!(!warnings("scale = 1e-3").contains("m large"), "{}", warnings("scale = 1e-3"));
}
