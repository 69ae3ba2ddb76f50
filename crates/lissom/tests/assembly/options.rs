//! Each option of `[assembly]` changes what it documents, and the report names what has changed.

use std::fmt::Write;

use lissom_motion::Vector3;

use super::{ANALYSIS, END, assembly, lowered, moved, refused};

/// Parts of several kinds, the k-th pinned to the ground at 0.1 k m from its reference point.
fn pinned(count: usize) -> String {
    let mut text = String::new();
    for k in 1..=count {
        let gap = 0.1 * k as f64;
        let _ = writeln!(
            text,
            "[bodies.p{k}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{k}, 0, 0]\n[joints.j{k}]\nkind = \"spherical\"\n\
             base = \"ground\"\ntip = \"p{k}\"\nat = [{k}, {gap}, 0]\nat_tip = [{k}, 0, 0]"
        );
    }
    text
}

const COORDINATES: &str = r#"
[bodies.door]
mass = 1
inertia = [1, 1, 1]
position = [0, 5, 0]
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "door"
at = [0, 4, 0]
axis = [0, 0, 1]
angle = 0.5
[bodies.drawer]
mass = 1
inertia = [1, 1, 1]
position = [0, 7, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "drawer"
at = [0, 7, 0]
axis = [1, 0, 0]
displacement = 0.25
"#;

#[test]
fn the_report_lists_the_four_largest_of_each_kind() {
    let words = |text: &str| assembly(&format!("{text}{END}")).words();
    let six = "moved `p6` by 0.6 m, `p5` by 0.5 m, `p4` by 0.4 m, `p3` by 0.3 m and 2 more; \
               closed `j6` by 0.6 m, `j5` by 0.5 m, `j4` by 0.4 m, `j3` by 0.3 m and 2 more";
    assert_eq!(words(&pinned(6)), six);
    let five = "`p2` by 0.2 m and 1 more; closed";
    assert!(words(&pinned(5)).contains(five), "{}", words(&pinned(5)));
    let four = "moved `p4` by 0.4 m, `p3` by 0.3 m, `p2` by 0.2 m, `p1` by 0.1 m; closed `j4` by 0.4 m, \
                `j3` by 0.3 m, `j2` by 0.2 m, `j1` by 0.1 m";
    assert_eq!(words(&pinned(4)), four);
    let closed = pinned(1).replace("at = [1, 0.1, 0]", "at = [1, 0, 0]");
    assert_eq!(words(&closed), "all joints close as drawn, nothing moved");
    let values = words(COORDINATES);
    assert!(values.starts_with("moved `door` by 0.4948 m and 0.5 rad, `drawer` by 0.25 m; "), "{values}");
    assert!(values.ends_with("; brought hinge.angle = 0.5 rad, rail.displacement = 0.25 m"), "{values}");
}

#[test]
fn every_kind_of_part_can_be_fixed() {
    // Pairs of parts whose reference points coincide when they are assembled.
    let text = r#"
[sections.bar]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 200]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [0, 0, 1]
elements = 2
[point_masses.point]
mass = 1
position = [1, 0, 0]
[bodies.body]
mass = 1
inertia = [1, 1, 1]
position = [2, 0, 0]
[joints.first]
kind = "spherical"
base = "bar.start"
tip = "point"
at = [0, 0, 0]
at_tip = [1, 0, 0]
[joints.second]
kind = "spherical"
base = "body"
tip = "point"
at = [2, 0, 0]
at_tip = [1, 0, 0]
"#;
    for fixed in [vec!["bar"], vec!["point"], vec!["body"]] {
        let list = fixed.iter().map(|part| format!("\"{part}\"")).collect::<Vec<_>>().join(", ");
        let text = format!("{text}[assembly]\nfixed = [{list}]\n{ANALYSIS}");
        let found = lowered(&text);
        let assembly = found.assembly.as_ref().unwrap();
        for part in ["bar", "point", "body"] {
            let (distance, turn) = moved(assembly, part);
            let is_fixed = fixed.contains(&part);
            assert_eq!(
                is_fixed,
                distance == 0.0 && turn == 0.0,
                "{part} with {fixed:?} fixed: {distance} {turn}"
            );
        }
        let at = |node: lissom_core::kinematics::NodeId| found.state.kinematics.nodes[node].frame.position;
        let start = at(found.names.lines["bar"].nodes[0]);
        for part in ["point", "body"] {
            assert!((at(found.names.nodes[part]) - start).norm() < 1e-9, "{part} with {fixed:?} fixed");
        }
        let end = *found.names.lines["bar"].nodes.last().unwrap();
        let length = (at(end) - start).norm();
        assert!((length - 1.0).abs() < 1e-12, "{length}");
        // Drawn frames are those of the model file.
        let drawn = assembly.moved.iter().map(|part| part.distance).fold(0.0, f64::max);
        assert!(drawn > 0.9, "{assembly:?}");
    }
}

/// The least change of a single body is that of its mean: a pin away from the reference point turns it as well.
#[test]
fn displacements_and_turns_are_those_of_the_nodes() {
    let text = r#"
[bodies.bar]
mass = 1
inertia = [1, 1, 1]
position = [3, 0, 0]
[joints.left]
kind = "spherical"
base = "ground"
tip = "bar"
at = [2, 0, 0]
[joints.right]
kind = "inline"
base = "ground"
tip = "bar"
at = [4, 0.5, 0]
at_tip = [4, 0, 0]
axis = [1, 0, 0]
"#;
    let found = lowered(&format!("{text}{END}"));
    let frame = found.state.kinematics.nodes[found.names.nodes["bar"]].frame;
    let assembly = found.assembly.unwrap();
    let (distance, turn) = moved(&assembly, "bar");
    assert!((distance - (frame.position - Vector3::new(3.0, 0.0, 0.0)).norm()).abs() < 1e-12);
    assert!((turn - frame.rotation.logarithm().norm()).abs() < 1e-12);
    assert!((turn - 0.25_f64.asin()).abs() < 1e-9 && distance > 0.1, "{assembly:?}");
}

#[test]
fn gaps_within_the_tolerance_are_closed() {
    // Two joints that contradict each other by 1e-4 of the size of the model.
    let text = |tolerance: &str| {
        let mut text = pinned(2).replace("0.1, 0]", "0, 0]").replace("0.2, 0]", "0, 0]");
        writeln!(
            text,
            "[joints.other]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"p1\"\nat = [1, 1e-4, 0]\nat_tip = [1, 0, 0]"
        )
        .unwrap();
        format!("{text}[assembly]\n{tolerance}\n{ANALYSIS}")
    };
    let words = refused(&text(""));
    assert!(words.contains("cannot be assembled"), "{words}");
    assert!(refused(&text("tolerance = 1e-5")).contains("cannot be assembled"));
    let found = assembly(&text("tolerance = 1e-3"));
    assert!(found.left < 1.1e-4, "{found:?}");
}
