//! Outputs of places within the elements of a beam: those of the rigid body that it turns with.

use std::fmt::Write;

use lissom::{Model, Record, SessionError};
use lissom_motion::Vector3;

fn run(text: &str) -> Record {
    let mut session = match Model::from_text("beam.toml", text).session(&[]) {
        Ok(session) => session,
        Err(SessionError::Model(report)) => panic!("{}", report.render(false)),
        Err(error) => panic!("{error}"),
    };
    let (record, report) = session.record();
    assert!(report.is_complete(), "{:?}", report.error());
    record
}

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
                let record = run(&turning(order, is_shared, point));
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
