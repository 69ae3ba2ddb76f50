//! Contacts of solids at their nodes.

use crate::support::refused::refused;
use crate::support::runs::{last, run, run_without_warnings};

/// A pad on the ground, on which a plate or a ball is pressed.
fn pad(shape: &str, height: f64, rest: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -10]
[materials.rubber]
E = 1e6
nu = 0
density = 1e-3
[solids.pad]
size = [0.2, 0.2, 0.1]
divisions = [4, 4, 2]
material = "rubber"
[joints.glued]
kind = "clamp"
base = "ground"
tip = "pad.bottom"
[bodies.weight]
mass = 8
inertia = [0.1, 0.1, 0.1]
shape = {shape}
position = [0.1, 0.1, {height}]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "weight"
axis = [0, 0, 1]
[springs.holder]
kind = "axial"
joint = "guide"
stiffness = 1000
[contacts.seat]
base = "weight"
tip = "pad"
faces = "top"
stiffness_per_area = 1e8
{rest}
[outputs.seat]
kind = "contact_force"
of = "seat"
[outputs.weight]
kind = "position"
of = "weight"
[analysis]
kind = "statics"
"#
    )
}

/// Vertical force of the weight on the pad [N], which the holder reduces, and how far the weight has sunk [m].
fn pressed(text: &str, height: f64) -> [f64; 2] {
    let record = run_without_warnings(text, &[]);
    let sunk = height - last(&record, "weight", "z");
    let force = -last(&record, "seat", "f3");
    assert!((force + 1000.0 * sunk - 80.0).abs() < 1e-6, "{force} {sunk}");
    [force, sunk]
}

/// A plate sinks by F h/(E A) + F/(k A). Forces at nodes are not those of a uniform pressure, so that coarse meshes are softer.
#[test]
fn a_plate_on_a_pad_sinks_by_its_compliance() {
    let text = pad("{ box = [0.4, 0.4, 0.2] }", 0.2, "");
    for (divisions, allowed) in [("[4, 4, 2]", 0.065), ("[8, 8, 4]", 0.035)] {
        let [force, sunk] = pressed(&text.replace("[4, 4, 2]", divisions), 0.2);
        let wanted = force * (0.1 / (1e6 * 0.04) + 1.0 / (1e8 * 0.04));
        assert!(sunk > wanted && sunk < (1.0 + allowed) * wanted, "{divisions}: {sunk} {wanted}");
    }
}

/// A ball sinks with F = 4/3 E* sqrt(R d³), E* = E/(1 - ν²), on a thick pad; its touching circle here is as wide as one element.
#[test]
fn a_ball_on_a_pad_is_carried_at_several_nodes() {
    let [force, sunk] = pressed(
        &pad("{ sphere = 0.2 }", 0.3, "").replace("[4, 4, 2]", "[8, 8, 4]").replace("1e8", "1e9"),
        0.3,
    );
    let hertz = (force / (4.0 / 3.0 * 1e6 * 0.2_f64.sqrt())).powf(2.0 / 3.0);
    assert!(sunk > 0.9 * hertz && sunk < 1.1 * hertz, "{sunk} {hertz}");
}

/// A block of rubber dropped on the ground rests on all nodes of its lower face, with friction.
#[test]
fn a_dropped_block_comes_to_rest() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[ground]
shape = { kind = "plane" }
[materials.rubber]
E = 1e6
nu = 0.3
density = 1000
[solids.block]
size = [0.2, 0.2, 0.1]
origin = [0, 0, 0.01]
divisions = [2, 2, 1]
material = "rubber"
[contacts.floor]
base = "ground"
tip = "block"
stiffness_per_area = 1e8
dissipation = 1
friction = 0.3
[outputs.floor]
kind = "contact_force"
of = "floor"
[analysis]
kind = "dynamics"
end = 0.4
scheme = "backward-euler"
step = 1e-3
"#;
    // The scheme damps the impact, which its warning reports.
    let record = run(text, &[]);
    assert!((last(&record, "floor", "normal") - 40.0).abs() < 0.4, "{}", last(&record, "floor", "normal"));
    assert!((last(&record, "floor", "x1") - 0.1).abs() < 1e-6);
}

#[test]
fn wrong_contacts_of_solids_are_rejected() {
    let text = pad("{ box = [0.4, 0.4, 0.2] }", 0.2, "");
    let cases = [
        ("faces = \"top\"", "faces = \"lid\"", "lid"),
        ("stiffness_per_area = 1e8", "stiffness = 1e8", "of kind `nearest`, which has no `faces`"),
        ("faces = \"top\"\nstiffness_per_area = 1e8", "stiffness = 1e8", "`nodes` for shells and solids"),
        ("stiffness_per_area = 1e8", "", "neither `stiffness` nor `stiffness_per_area`"),
        ("{ box = [0.4, 0.4, 0.2] }", "{ sphere = 0.05 }", "points of the solid are 0.05"),
    ];
    for (from, to, wanted) in cases {
        let report = refused(&text.replace(from, to));
        let flat = report.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(wanted), "{to}:\n{report}");
    }
}
