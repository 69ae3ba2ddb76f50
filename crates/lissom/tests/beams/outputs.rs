//! Outputs of positions within the elements of a beam: those of the rigid body that it turns with.

use std::fmt::Write;

use lissom::Record;
use lissom_motion::Vector3;

use crate::support::runs::run;

fn vector(record: &Record, output: &str, names: [&str; 3], row: usize) -> Vector3 {
    let column = |name| record.column(output, name).unwrap_or_else(|| panic!("{output}.{name}"));
    Vector3::from(names.map(|name| column(name)[row]))
}

const KINDS: [(&str, [&str; 3]); 5] = [
    ("position", ["x", "y", "z"]),
    ("displacement", ["u1", "u2", "u3"]),
    ("velocity", ["v1", "v2", "v3"]),
    ("acceleration", ["a1", "a2", "a3"]),
    ("angular_velocity", ["w1", "w2", "w3"]),
];

/// A body that turns faster and faster about an axis askew, and a stiff, light, twisted beam of three elements on it, whose first node
/// is that of another beam, with other axes, where `is_shared`.
fn turning(order: usize, is_shared: bool, point: &str) -> String {
    let (from, clamped) = if is_shared { ("\"stub.end\"", "stub") } else { ("[0.7, -0.2, 0.1]", "bar") };
    let stub =
        "[beams.stub]\nsection = \"bar\"\nfrom = [0.5, 0.1, 0.3]\nto = [0.7, -0.2, 0.1]\nelements = 1\n";
    let clamp = format!(
        "{}[joints.clamp]\nkind = \"clamp\"\nbase = \"hub\"\ntip = \"{clamped}.start\"\n",
        if is_shared { stub } else { "" }
    );
    let mut text = format!(
        r#"
lissom = 1
[bodies.hub]
mass = 1
inertia = [1, 1, 1]
position = [0.3, -0.2, 0.1]
rotation = [0.4, 0.5, -0.6]
[joints.axle]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [1, 2, 2]
at = [0, 0.3, 0]
[joints.motor]
kind = "prescribed_rotation"
joint = "axle"
rotation = "2*t + t^2"
[initial]
angular_velocity = ["2/3", "4/3", "4/3"]
about = [0, 0.3, 0]
[sections.bar]
shape = "general"
stiffness = [1e9, 1e9, 1e9, 1e8, 1e8, 1e8]
mass = {{ per_length = 1e-3, inertia = [2e-6, 1e-6, 1e-6] }}
[beams.bar]
section = "bar"
from = {from}
to = [1.7, 1.8, -0.9]
up = [0, 0, 1]
twist = "0.8*s"
elements = 3
order = {order}
{clamp}
"#
    );
    for (kind, _) in KINDS {
        for part in ["bar@0.2", "hub"] {
            // On the line, or beside it.
            let place = match (point, part, kind) {
                (_, _, "angular_velocity") | ("", "bar@0.2", _) => String::new(),
                ("", ..) => "point = [0.9, 0.2, -0.1]\n".to_owned(),
                (own, ..) => format!("point = {own}\n"),
            };
            let name = part.replace("@0.2", "");
            writeln!(text, "[outputs.{name}_{kind}]\nkind = \"{kind}\"\nof = \"{part}\"\n{place}").unwrap();
        }
    }
    text + "[analysis]\nkind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 0.5\nstep = 5e-3\n"
}

#[test]
fn places_within_elements_move_with_the_body_that_the_beam_is_fixed_to() {
    for order in [1, 2, 3] {
        for is_shared in [false, true] {
            for point in ["", "[1.1, 0.0, 0.1]"] {
                let record = run(&turning(order, is_shared, point), &[]);
                for (kind, names) in KINDS {
                    // The beam is not strained at the start: what it takes along then has no acceleration yet.
                    let first = if kind == "acceleration" { record.times.len() / 2 } else { 0 };
                    let mut worst = 0.0_f64;
                    for row in first..record.times.len() {
                        let [bar, hub] =
                            ["bar", "hub"].map(|part| vector(&record, &format!("{part}_{kind}"), names, row));
                        worst = worst.max((bar - hub).norm());
                    }
                    assert!(worst < 1e-6, "order {order}, {is_shared}, {point}, {kind}: {worst:e}");
                }
            }
        }
    }
}

/// A straight cantilever and an arc that sag under their weight, and one that swings: section forces at the clamp are what the
/// clamp holds, with few elements as well, and moments between the Gauss points follow the weight.
#[test]
fn section_forces_at_a_clamp_are_its_reaction() {
    let text = |beam: &str, analysis: &str| {
        format!(
            r#"
lissom = 1
gravity = [0, 0, -9.81]
[sections.bar]
shape = "general"
stiffness = [1e7, 1e6, 1e6, 1e4, 2e4, 4e4]
mass = {{ per_length = 5, inertia = [1e-3, 5e-4, 5e-4] }}
[beams.bar]
section = "bar"
up = [0, 0, 1]
{beam}
[joints.clamp]
kind = "clamp"
base = "ground"
tip = "bar.start"
[outputs.held]
kind = "reaction"
of = "clamp"
axes = "tip"
[outputs.force]
kind = "section_force"
of = "bar@0"
[outputs.moment]
kind = "section_moment"
of = "bar@0"
[outputs.middle]
kind = "section_moment"
of = "bar@0.5"
{analysis}
"#
        )
    };
    let weight = 5.0 * 9.81;
    let straight = "from = [0, 0, 0]\nto = [2, 0, 0]";
    let arc = "curve = [\"2*sin(s)\", \"2 - 2*cos(s)\", \"0.3*s\"]";
    let statics = "[analysis]\nkind = \"statics\"\nsteps = 1";
    for (beam, order, elements, allowed) in [
        (straight, 1, 1, 2e-3),
        (straight, 2, 1, 2e-3),
        (straight, 3, 1, 2e-3),
        (straight, 1, 8, 1e-3),
        (straight, 2, 8, 1e-4),
        (arc, 2, 4, 1e-3),
        (arc, 3, 4, 1e-4),
    ] {
        let record = run(&text(&format!("{beam}\norder = {order}\nelements = {elements}"), statics), &[]);
        let row = record.times.len() - 1;
        let held = vector(&record, "held", ["m1", "m2", "m3"], row);
        let found = vector(&record, "moment", ["m1", "m2", "m3"], row);
        // The arc's sections are not in the axes of the clamp.
        let missed = if beam == arc { held.norm() - found.norm() } else { (held + found).norm() };
        assert!(
            missed.abs() < allowed * held.norm(),
            "order {order}, {elements} elements of {beam}: {held} {found}"
        );
        if beam == straight {
            let middle = record.column("middle", "m2").unwrap()[row];
            // Half way the moment is a quarter of that at the clamp. Between two nodes alone it is a straight line.
            let exact = if (order, elements) == (1, 1) { 0.5 } else { 0.25 } * 2.0 * weight;
            assert!(
                (middle / exact - 1.0).abs() < 5e-3,
                "order {order}, {elements} elements: {middle} {exact}"
            );
        }
    }
    let thrown = "[analysis]\nkind = \"dynamics\"\nend = 0.2\nrelative_tolerance = 1e-6\noutput_step = 0.01";
    let record = run(&text(&format!("{straight}\norder = 2\nelements = 6"), thrown), &[]);
    let most = (0..record.times.len())
        .map(|row| vector(&record, "held", ["m1", "m2", "m3"], row).norm())
        .fold(0.0_f64, f64::max);
    for row in 0..record.times.len() {
        let held = vector(&record, "held", ["m1", "m2", "m3"], row);
        let found = vector(&record, "moment", ["m1", "m2", "m3"], row);
        assert!((held + found).norm() < 0.01 * most, "t = {}: {held} {found}", record.times[row]);
    }
}
