//! Shells in contact with balls, planes and rollers: against closed forms, point loads and rigid surfaces; and wrong models.

use lissom::Record;

use crate::support::refused::refused;
use crate::support::runs::{column, last, run, run_without_warnings};

const STEEL: &str = r"
lissom = 1
gravity = [0, 0, -9.81]
[materials.steel]
E = 200e9
nu = 0.3
density = 7800
";

const GRAVITY: f64 = 9.81;

/// A ball of 1.5 kg on the middle of a sheet that is clamped at two sides, or its weight as a load there.
fn loaded_sheet(is_ball: bool) -> String {
    let load = if is_ball {
        r#"
[bodies.ball]
mass = 1.5
inertia = { sphere = 0.03 }
shape = { sphere = 0.03 }
position = [0.2, 0.2, 0.03099]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "ball"
axis = [0, 0, 1]
[contacts.touch]
base = "ball"
tip = "sheet"
stiffness = 1e6
[outputs.touch]
kind = "contact_force"
of = "touch"
[outputs.ball]
kind = "displacement"
of = "ball"
"#
    } else {
        r#"
[loads.weight]
kind = "force"
on = "sheet@0.5,0.5"
vector = [0, 0, "-1.5*9.81"]
"#
    };
    format!(
        r#"{STEEL}
[shells.sheet]
corners = [[0, 0, 0], [0.4, 0, 0], [0.4, 0.4, 0], [0, 0.4, 0]]
divisions = [8, 8]
thickness = 0.002
material = "steel"
[joints.west]
kind = "clamp"
base = "ground"
tip = "sheet.west"
[joints.east]
kind = "clamp"
base = "ground"
tip = "sheet.east"
[outputs.middle]
kind = "displacement"
of = "sheet@0.5,0.5"
[analysis]
kind = "statics"
steps = 1
{load}"#
    )
}

#[test]
fn a_ball_rests_on_a_sheet_as_a_point_load() {
    let [ball, load] = [true, false].map(|is_ball| run_without_warnings(&loaded_sheet(is_ball), &[]));
    let weight = 1.5 * GRAVITY;
    let normal = last(&ball, "touch", "normal");
    assert!((normal / weight - 1.0).abs() < 1e-8, "{normal}");
    assert!((last(&ball, "touch", "f3") + weight).abs() < 1e-7 * weight);
    let [under, wanted] = [&ball, &load].map(|record| last(record, "middle", "u3"));
    assert!(wanted < -1e-5 && (under / wanted - 1.0).abs() < 1e-6, "{under} {wanted}");
    // The penetration is the weight over the stiffness.
    let depth = under - last(&ball, "ball", "u3") + 1e-5;
    assert!((depth - weight / 1e6).abs() < 1e-8 * 1e-3, "{depth}");
    assert!((last(&ball, "touch", "gap") + weight / 1e6).abs() < 1e-10);
    assert_eq!(last(&ball, "touch", "points"), 1.0);
}

/// A plate that fell on a plane lies on it with its weight, on either face, on a mesh of unequal elements.
#[test]
fn a_plate_rests_on_a_plane_with_its_weight() {
    let text = format!(
        r#"{STEEL}
[ground]
shape = {{ kind = "plane" }}
[shells.plate]
surface = ["0.2*u + 0.2*u^2", "0.3*v", "0.0051"]
divisions = [6, 4]
thickness = "0.01"
material = "steel"
[contacts.floor]
base = "ground"
tip = "plate"
stiffness_per_area = 1e8
dissipation = 100
friction = 0.3
[outputs.floor]
kind = "contact_force"
of = "floor"
[outputs.middle]
kind = "position"
of = "plate@0,0"
[analysis]
kind = "dynamics"
end = 0.3
"#
    );
    let weight = 7800.0 * 0.4 * 0.3 * 0.01 * GRAVITY;
    for side in ["0.3*v", "-0.3*v"] {
        let record = run(&text.replace("0.3*v", side), &[]);
        let normal = last(&record, "floor", "normal");
        assert!((normal / weight - 1.0).abs() < 1e-8, "{normal} {weight}");
        // ρ g h over the stiffness per area.
        let depth = 7800.0 * GRAVITY * 0.01 / 1e8;
        assert!((last(&record, "middle", "z") - 0.005 + depth).abs() < 0.05 * depth);
        assert_eq!(last(&record, "floor", "points"), 35.0);
    }
}

/// A ball in a trough, a part of a cylinder whose nodes are fixed.
fn trough(more: &str) -> String {
    format!(
        r#"{STEEL}
[parameters]
radius = 0.03
tilt = 0.4
[shells.trough]
surface = ["0.5*sin(2*u - 1)", "0.2*(v - 0.5)", "-0.5*cos(2*u - 1)"]
divisions = [24, 1]
thickness = 0.002
material = "steel"
[joints.hold]
kind = "clamp"
base = "ground"
tip = "trough.all"
[bodies.ball]
mass = 1.5
inertia = {{ sphere = "radius" }}
shape = {{ sphere = "radius" }}
position = ["(0.499 - radius)*sin(tilt)", 0.01, "-(0.499 - radius)*cos(tilt)"]
[contacts.touch]
base = "ball"
tip = "trough"
stiffness = 1e6
{more}
[outputs.touch]
kind = "contact_force"
of = "touch"
[outputs.ball]
kind = "position"
of = "ball"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 0.42
"#
    )
}

/// Distance of the ball's centre from the axis.
const LENGTH: f64 = 0.469;

/// Time at which a ball crosses the bottom.
fn crossing(record: &Record) -> f64 {
    let x = column(record, "ball", "x");
    let k = (1..x.len()).find(|&k| x[k] <= 0.0).expect("it crosses");
    let [before, after] = [record.times[k - 1], record.times[k]];
    before + (after - before) * x[k - 1] / (x[k - 1] - x[k])
}

/// A quarter of the period of a pendulum, by the arithmetic-geometric mean.
fn quarter(length: f64, tilt: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (0.5 * tilt).cos());
    for _ in 0..6 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * std::f64::consts::PI * (length / GRAVITY).sqrt() / a
}

/// It slides as a pendulum, over the borders of elements, and neither gains nor loses energy.
#[test]
fn a_ball_slides_through_a_trough_as_a_pendulum() {
    let record = run_without_warnings(&trough(""), &[]);
    let (found, wanted) = (crossing(&record), quarter(LENGTH, 0.4));
    assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    let energy = column(&record, "energy", "total");
    let most = 1.5 * GRAVITY * LENGTH * (1.0 - 0.4_f64.cos());
    let changed = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
    assert!(changed < 1e-5 * most, "{changed} of {most}");
}

/// A ball that rolls is slower by √(7/5), and its normal force is that of a smooth surface on every element and between them.
#[test]
fn a_ball_rolls_through_a_trough_with_a_steady_force() {
    let record = run_without_warnings(&trough("dissipation = 300\nfriction = 0.5"), &[]);
    let (found, wanted) = (crossing(&record), 1.4_f64.sqrt() * quarter(LENGTH, 0.4));
    assert!((found / wanted - 1.0).abs() < 5e-4, "{found} {wanted}");
    let [x, z] = ["x", "z"].map(|component| column(&record, "ball", component));
    let [normal, points] = ["normal", "points"].map(|component| column(&record, "touch", component));
    let energy = column(&record, "energy", "total");
    // N = m g cos φ + m v²/l, with v² = (10/7) g l (cos φ - cos φ₀). It starts without a penetration.
    for k in (0..x.len()).filter(|&k| record.times[k] > 0.1) {
        let cosine = -z[k] / x[k].hypot(z[k]);
        let wanted = 1.5 * GRAVITY * (cosine + 10.0 / 7.0 * (cosine - 0.4_f64.cos()));
        assert!((normal[k] / wanted - 1.0).abs() < 0.02, "{}: {} {wanted}", record.times[k], normal[k]);
        assert_eq!(points[k], 1.0, "{}", record.times[k]);
        assert!(energy[k] < energy[0] + 1e-6, "{}: {}", record.times[k], energy[k] - energy[0]);
    }
}

/// A ball bounces on a sheet whose nodes are fixed as on a plane, on its upper and its lower face.
#[test]
fn a_ball_rebounds_from_a_rigid_sheet_as_from_a_plane() {
    let text = |side: f64, target: &str| {
        format!(
            r#"lissom = 1
gravity = [0, 0, {}]
[ground]
shape = {{ kind = "plane", position = [0, 0, 0.001] }}
[materials.steel]
E = 200e9
nu = 0.3
density = 7800
[shells.sheet]
corners = [[-0.11, -0.07, 0], [0.09, -0.07, 0], [0.09, 0.13, 0], [-0.11, 0.13, 0]]
divisions = [5, 5]
thickness = 0.002
material = "steel"
[joints.hold]
kind = "clamp"
base = "ground"
tip = "sheet.all"
[bodies.ball]
mass = 0.5
inertia = {{ sphere = 0.05 }}
shape = {{ sphere = 0.05 }}
position = [0, 0, {}]
velocity = [0.3, 0.1, {}]
[contacts.touch]
{target}
stiffness = 1e6
exponent = 1.5
dissipation = 0.3
friction = 0.2
[outputs.ball]
kind = "velocity"
of = "ball"
[analysis]
kind = "dynamics"
end = 0.02
"#,
            -GRAVITY * side,
            0.056 * side,
            -side
        )
    };
    let velocity = |text: &str| {
        let record = run(text, &[]);
        ["v1", "v2", "v3"].map(|component| last(&record, "ball", component))
    };
    let plane = velocity(&text(1.0, "base = \"ground\"\ntip = \"ball\""));
    assert!(plane[2] > 0.5, "{plane:?}");
    for side in [1.0, -1.0] {
        let sheet = velocity(&text(side, "base = \"ball\"\ntip = \"sheet\""));
        for k in 0..3 {
            let wanted = if k == 2 { side * plane[k] } else { plane[k] };
            assert!((sheet[k] - wanted).abs() < 1e-6, "{side} {k}: {} {wanted}", sheet[k]);
        }
    }
}

/// A leaf on a roller: a cantilever with a support at x, F L³/(3 E I) of a plate that is wide and without lateral contraction.
#[test]
fn a_leaf_rests_on_a_roller() {
    let text = r#"
lissom = 1
[materials.steel]
E = 200e9
nu = 0
density = 7800
[ground]
shape = { kind = "cylinder", radius = 0.03, length = 0.2, position = [0.2, 0.02, -0.031], axis = [0, 1, 0] }
[shells.leaf]
corners = [[0, 0, 0], [0.4, 0, 0], [0.4, 0.04, 0], [0, 0.04, 0]]
divisions = [40, 3]
thickness = 0.002
material = "steel"
[joints.root]
kind = "clamp"
base = "ground"
tip = "leaf.west"
[loads.press]
kind = "force"
on = "leaf.east"
vector = [0, 0, -1]
[contacts.roller]
base = "ground"
tip = "leaf"
stiffness_per_area = 1e12
[outputs.roller]
kind = "contact_force"
of = "roller"
[analysis]
kind = "statics"
steps = 1
"#;
    // F at L, support at a without a deflection: R = F (3 L - a)/(2 a).
    let found = last(&run(text, &[]), "roller", "f3");
    let wanted = (3.0 * 0.4 - 0.2) / (2.0 * 0.2);
    assert!((found / wanted - 1.0).abs() < 0.01, "{found} {wanted}");
}

/// Beyond the rim a ball touches the round edge of the sheet.
#[test]
fn a_ball_leans_on_the_rim_of_a_sheet() {
    let text = loaded_sheet(true)
        .replace("position = [0.2, 0.2, 0.03099]", "position = [0.2, -0.02, 0.02367]")
        .replace("tip = \"sheet.west\"", "tip = \"sheet.all\"")
        .replace("[joints.east]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"sheet.east\"\n", "");
    let record = run_without_warnings(&text, &[]);
    // Distance 0.031 from the rim, at 0.02 from it.
    let normal = last(&record, "touch", "normal");
    let height = last(&record, "ball", "u3") + 0.02367;
    let wanted = 1.5 * GRAVITY * 0.02_f64.hypot(height) / height;
    assert!((normal / wanted - 1.0).abs() < 1e-6, "{normal} {wanted}");
}

#[test]
fn wrong_contacts_of_shells_are_rejected() {
    let text = loaded_sheet(true);
    let cases = [
        ("stiffness = 1e6", "", "neither `stiffness` nor `stiffness_per_area`"),
        (
            "stiffness = 1e6",
            "stiffness = 1e6\nstiffness_per_area = 1",
            "both `stiffness` and `stiffness_per_area`",
        ),
        ("stiffness = 1e6", "stiffness = 1e6\nrestitution = 0.5", "give `dissipation` instead"),
        (
            "stiffness = 1e6",
            "stiffness = 1e6\nradius = 0.5",
            "`radius` of contact `touch` is for a beam as tip",
        ),
        ("stiffness = 1e6", "stiffness_per_area = 1e9", "points of the shell are 0.05"),
        (
            "base = \"ball\"\ntip = \"sheet\"\nstiff",
            "base = \"sheet\"\ntip = \"ball\"\nstiff",
            "the shell is the tip",
        ),
        (
            "base = \"ball\"\ntip = \"sheet\"\nstiff",
            "base = \"sheet\"\ntip = \"sheet\"\nstiff",
            "between two flexible parts",
        ),
        ("shape = { sphere = 0.03 }", "shape = { box = [0.1, 0.1, 0.1] }", "`stiffness_per_area` instead"),
        ("thickness = 0.002", "thickness = \"0.002 + 0.001*u\"", "is not the same everywhere"),
        ("shape = { sphere = 0.03 }\n", "", "has no solid that could touch"),
    ];
    for (from, to, wanted) in cases {
        assert!(text.contains(from), "{from}");
        let report = refused(&text.replace(from, to));
        let flat = report.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(wanted), "{to}:\n{report}");
    }
    let of_bodies = text.replace("tip = \"sheet\"\nstiffness", "tip = \"ground\"\nstiffness_per_area");
    let report = refused(&format!("{of_bodies}\n[ground]\nshape = {{ kind = \"plane\" }}\n"));
    assert!(report.contains("of kind `compliant`, which has no `stiffness_per_area`"), "{report}");
}

/// A sheet that is laid on another one rests on it with its weight.
#[test]
fn a_sheet_rests_on_another_sheet() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[materials.plastic]
E = 2e9
nu = 0.3
density = 7800
[shells.lower]
material = "plastic"
thickness = 0.005
damping = 1e-2
corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
divisions = [6, 6]
[joints.west]
kind = "clamp"
base = "ground"
tip = "lower.west"
[joints.east]
kind = "clamp"
base = "ground"
tip = "lower.east"
[shells.upper]
material = "plastic"
thickness = 0.005
damping = 1e-2
corners = [[0.3, 0.3, 0.006], [0.7, 0.3, 0.006], [0.7, 0.7, 0.006], [0.3, 0.7, 0.006]]
divisions = [2, 2]
[contacts.stack]
base = "lower"
tip = "upper"
stiffness_per_area = 1e8
dissipation = 1
[outputs.stack]
kind = "contact_force"
of = "stack"
[analysis]
kind = "dynamics"
end = 1.5
scheme = "backward-euler"
step = 1e-3
"#;
    // The scheme damps the first touches, which its warning reports.
    let record = run(text, &[]);
    let weight = 0.4 * 0.4 * 0.005 * 7800.0 * 10.0;
    let force = last(&record, "stack", "f3");
    assert!((force / weight - 1.0).abs() < 1e-4, "{force} {weight}");
    assert!((last(&record, "stack", "x1") - 0.5).abs() < 1e-6);
    let depth = last(&record, "stack", "gap");
    assert!(depth < 0.0 && depth > -1e-5, "{depth}");
}

/// The turns of a soft spiral fall onto each other: they do not pass through each other, and no energy is gained.
#[test]
fn a_spiral_touches_itself() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[materials.soft]
E = 2e8
nu = 0.3
density = 1000
[shells.spring]
material = "soft"
thickness = 0.002
surface = ["(0.2 - 0.08*u)*cos(4*pi*u)", "0.05*v", "(0.2 - 0.08*u)*sin(4*pi*u)"]
divisions = [20, 1]
damping = 1e-2
[joints.end]
kind = "clamp"
base = "ground"
tip = "spring.west"
[contacts.turns]
base = "spring"
tip = "spring"
stiffness_per_area = 1e7
dissipation = 1
[outputs.turns]
kind = "contact_force"
of = "turns"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 0.31
relative_tolerance = 1e-3
"#;
    let record = run_without_warnings(text, &[]);
    let largest = column(&record, "turns", "normal").iter().copied().fold(0.0, f64::max);
    let deepest = column(&record, "turns", "gap").iter().copied().fold(0.0, f64::min);
    assert!(largest > 0.3 && deepest > -5e-4, "{largest} {deepest}");
    let rise =
        column(&record, "energy", "total").windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(rise < 1e-5, "{rise:e}");
}
