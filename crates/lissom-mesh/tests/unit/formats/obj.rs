use super::*;

pub(crate) const SAMPLE: &str = "# A plate\nmtllib a.mtl\no plate\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n\
    g left all\nf 1//1 2//1 3//1 \\\n 4//1\nv 2 0.5 0\ng right all\nf -4 -1 3\nl 1 2 3\ncurv 1 2\n";

#[test]
fn faces_lines_and_groups_are_read() {
    let mesh = read(SAMPLE).expect("valid");
    assert_eq!(mesh.node_numbers, [1, 2, 3, 4, 5]);
    assert_eq!(mesh.elements[0].nodes, [0, 1, 2, 3]);
    assert_eq!(mesh.elements[1].nodes, [1, 4, 2]);
    assert_eq!(mesh.elements[3].nodes, [1, 2]);
    assert_eq!(mesh.element_sets["left"], [0]);
    assert_eq!(mesh.element_sets["plate"], [0, 1, 2, 3]);
    assert_eq!(mesh.element_sets["all"], mesh.element_sets["plate"]);
    assert_eq!(mesh.node_sets["right"], [0, 1, 2, 4]);
    assert_eq!(mesh.notes, ["line 16: `curv` is not read"]);
}

#[test]
fn faults_are_reported_with_their_lines() {
    let cases = [
        ("f -4 -1 3", "f -4 -1", "line 14: a face of 2 vertices"),
        ("f -4 -1 3", "f 1 2 3 4 5", "line 14: a face of 5 vertices; divide it"),
        ("f -4 -1 3", "f -6 -1 3", "line 14: `-6` is no number of a vertex"),
        ("f -4 -1 3", "f 0 -1 3", "line 14: `0` is no number of a vertex"),
        ("f -4 -1 3", "f 2 6 3", "line 14: node 6 is not in the file"),
        ("v 2 0.5 0", "v 2 0.5", "line 12: a vertex of 2 coordinates"),
    ];
    for (old, new, expected) in cases {
        let found = read(&SAMPLE.replace(old, new)).expect_err("must be rejected").to_string();
        assert!(found.starts_with(expected), "{found}");
    }
}
