//! Beams in contact: on planes, balls, cylinders and in bores, with each other, belts round pulleys, and wrong models.

use crate::support::refused::refused;
use crate::support::runs::run;
use crate::support::series::{last, series};

const MATERIAL: &str = r#"
lissom = 1
[materials.steel]
E = 200e9
nu = 0.3
density = 8000
[sections.rod]
shape = "circle"
material = "steel"
radius = 0.01
damping = "damping"
"#;

/// A straight rod of this radius, density and length: its weight.
fn weight(length: f64) -> f64 {
    8000.0 * std::f64::consts::PI * 1e-4 * length * 9.81
}

/// Bending stiffness of the rod [N m²].
const BENDING: f64 = 200e9 * std::f64::consts::PI / 4.0 * 1e-8;

fn rod_on_plane(order: usize, more: &str) -> String {
    format!(
        r#"{MATERIAL}
[parameters]
damping = 0
dissipation = 0
[ground]
shape = {{ kind = "plane" }}
[beams.rod]
section = "rod"
from = [0, 0, 0.0102]
to = [1, 0, 0.0102]
elements = 8
order = {order}
[contacts.floor]
base = "ground"
tip = "rod"
stiffness_per_length = 1e6
dissipation = "dissipation"
{more}
[outputs.floor]
kind = "contact_force"
of = "floor"
[outputs.energy]
kind = "energy"
[outputs.middle]
kind = "displacement"
of = "rod@0.5"
"#
    )
}

/// A rod that falls on a plane bounces without a loss, and with dissipation ends at rest where the plane carries its weight.
#[test]
fn a_rod_rests_on_a_plane_with_its_weight() {
    let dynamics = "[analysis]\nkind = \"dynamics\"\nend = 0.08\n";
    for order in [1, 2, 3] {
        let text = rod_on_plane(order, "").replace("lissom = 1", "lissom = 1\ngravity = [0, 0, -9.81]");
        let record = run(&format!("{text}{dynamics}"), &[]);
        let energy = series(&record, "energy.total");
        let scale = weight(1.0) * 2e-4;
        let changed = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
        assert!(changed < 2e-3 * scale, "order {order}: {changed} of {scale}");
        assert!(series(&record, "floor.gap").iter().any(|gap| *gap < 0.0), "{order}");
        // k δ per length: the weight of a metre over its stiffness.
        let set = [("parameters.dissipation", "2000"), ("analysis.end", "1")];
        let record = run(&format!("{text}{dynamics}"), &set);
        let found = last(&record, "floor.normal");
        assert!((found - weight(1.0)).abs() < 1e-4 * weight(1.0), "order {order}: {found} {}", weight(1.0));
        assert!((last(&record, "floor.f3") - found).abs() < 1e-9 * found);
        let depth = weight(1.0) / 1e6;
        assert!((last(&record, "middle.u3") + 2e-4 + depth).abs() < 0.05 * depth, "{order}");
    }
}

/// The share of each point of its length does not depend on their number.
#[test]
fn the_stiffness_of_a_rod_on_a_plane_is_that_of_its_length() {
    for points in [1, 3] {
        let text = rod_on_plane(2, &format!("points = {points}"))
            .replace("0.0102", "0.0099")
            .replace("length = 1e6", "length = 200");
        // Held at its middle, so that nothing but the plane resists to its stretch and turns.
        let held = "[joints.hold]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"rod@0.5\"\n";
        let record = run(&format!("{text}{held}[analysis]\nkind = \"statics\"\nsteps = 1\n"), &[]);
        let wanted = 200.0 * 1e-4;
        let found = last(&record, "floor.normal");
        assert!((found - wanted).abs() < 5e-3 * wanted, "{points}: {found} {wanted}");
    }
}

fn pressed(body: &str, base: &str, contact: &str) -> String {
    format!(
        r#"{MATERIAL}
[parameters]
damping = 0
{body}
[beams.rod]
section = "rod"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
order = 3
[joints.wall]
kind = "clamp"
base = "ground"
tip = "rod.start"
[loads.press]
kind = "force"
on = "rod.end"
vector = [0, 0, -100]
[contacts.touch]
base = "{base}"
tip = "rod"
{contact}
[outputs.touch]
kind = "contact_force"
of = "touch"
[outputs.end]
kind = "displacement"
of = "rod.end"
[analysis]
kind = "statics"
steps = 4
"#
    )
}

/// A cantilever whose end is pressed on a support: the support carries what its deflection does not, N = (F - c h)/(1 + c/k) with
/// c = 3EI/L³ at a height h above it.
#[test]
fn a_cantilever_is_supported_by_a_ball_a_capsule_and_a_plane() {
    let soft = 3.0 * BENDING;
    let (height, stiffness) = (2e-3, 1e6);
    let wanted = (100.0 - soft * height) / (1.0 + soft / stiffness);
    // Nearest points, at the end of the rod and the top of the solid.
    for (kind, solid) in [
        ("ball", "{ kind = \"sphere\", radius = 0.05, position = [1, 0, -0.062] }"),
        (
            "capsule",
            "{ kind = \"capsule\", radius = 0.05, length = 0.3, axis = [0, 1, 0], position = [1, 0, -0.062] }",
        ),
    ] {
        let ground = format!("[ground]\nshape = {solid}");
        let record = run(&pressed(&ground, "ground", "stiffness = 1e6"), &[]);
        let found = last(&record, "touch.normal");
        // Shear and the slope at the end: the ball is touched beside its top.
        assert!((found - wanted).abs() < 0.01 * wanted, "{kind}: {found} {wanted}");
        let deflected = (100.0 - found) / soft;
        assert!((last(&record, "end.u3") + deflected).abs() < 0.01 * deflected, "{kind}");
    }
}

/// Two clamped beams that cross in the middle, the upper one under a uniform load: they deflect by the force between them,
/// N = (q L⁴/384EI - h)/(L³/96EI + 1/k) at a distance h, whatever the angle between them and wherever nodes are.
#[test]
fn crossing_beams_share_the_load() {
    for (elements, angle, shift) in [(4, 90.0_f64, 0.0), (5, 90.0, 0.0), (4, 40.0, 0.0), (4, 90.0, 0.013)] {
        let (sine, cosine) = angle.to_radians().sin_cos();
        let beam = |name: &str, height: f64, [x, y]: [f64; 2], shift: f64, load: &str| {
            let joint = |end: &str| {
                format!(
                    "[joints.{name}_{end}]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{name}.{end}\"\n"
                )
            };
            format!(
                "[beams.{name}]\nsection = \"rod\"\nfrom = [{}, {}, {height}]\nto = [{}, {y}, {height}]\n\
                 elements = {elements}\n{load}\n{}{}",
                shift - x,
                -y,
                shift + x,
                joint("start"),
                joint("end")
            )
        };
        let text = format!(
            "{MATERIAL}[parameters]\ndamping = 0\n{}{}{}",
            beam("lower", 0.0, [0.5, 0.0], shift, ""),
            beam("upper", 0.0201, [0.5 * cosine, 0.5 * sine], 0.0, "force_per_length = [0, 0, -200]"),
            r#"
[contacts.cross]
base = "lower"
tip = "upper"
stiffness = 1e6
[outputs.cross]
kind = "contact_force"
of = "cross"
[analysis]
kind = "statics"
steps = 4
"#
        );
        let record = run(&text, &[]);
        let wanted = (200.0 / (384.0 * BENDING) - 1e-4) / (1.0 / (96.0 * BENDING) + 1e-6);
        let found = last(&record, "cross.normal");
        assert!((found - wanted).abs() < 0.01 * wanted, "{elements} {angle} {shift}: {found} {wanted}");
        assert!((last(&record, "cross.f3") - found).abs() < 1e-3 * found, "the upper beam is pushed up");
    }
}

/// Two equal leaves that lie on each other, without friction, share a uniform load on the upper one: w = q L⁴/(16 EI).
#[test]
fn leaves_that_lie_on_each_other_share_the_load() {
    let leaf = |name: &str, height: f64, load: &str| {
        format!(
            "[beams.{name}]\nsection = \"rod\"\nfrom = [0, 0, {height}]\nto = [0.4, 0, {height}]\nelements = 8\norder = 2\n\
             {load}\n[joints.{name}]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"{name}.start\"\n\
             [outputs.{name}]\nkind = \"displacement\"\nof = \"{name}.end\"\n"
        )
    };
    let text = format!(
        "{MATERIAL}[parameters]\ndamping = 0\n{}{}{}",
        leaf("lower", 0.0, ""),
        leaf("upper", 0.02, "force_per_length = [0, 0, -2000]"),
        r#"
[contacts.leaf]
base = "lower"
tip = "upper"
stiffness_per_length = 1e8
points = 5
[analysis]
kind = "statics"
"#
    );
    let record = run(&text, &[]);
    let wanted = 2000.0 * 0.4_f64.powi(4) / (16.0 * BENDING);
    for name in ["lower", "upper"] {
        let found = -last(&record, &format!("{name}.u3"));
        assert!((found - wanted).abs() < 0.01 * wanted, "{name}: {found} {wanted}");
    }
}

/// A ball that slides along a beam from node to node conserves energy and momentum: it is handed over from interval to interval.
#[test]
fn a_ball_slides_along_a_beam_without_a_loss() {
    let text = format!(
        "{MATERIAL}{}",
        r#"
[parameters]
damping = 0
[beams.rod]
section = "rod"
from = [-0.5, 0, 0]
to = [0.5, 0, 0]
elements = 4
[bodies.ball]
mass = 0.5
inertia = { sphere = 0.05 }
shape = { sphere = 0.05 }
position = [-0.35, 0, 0.0605]
velocity = [4, 0, -0.2]
[contacts.touch]
base = "ball"
tip = "rod"
stiffness = 1e5
exponent = 1.5
[joints.left]
kind = "clamp"
base = "ground"
tip = "rod.start"
[joints.right]
kind = "clamp"
base = "ground"
tip = "rod.end"
[outputs.touch]
kind = "contact_force"
of = "touch"
[outputs.energy]
kind = "energy"
[outputs.ball]
kind = "velocity"
of = "ball"
[analysis]
kind = "dynamics"
end = 0.15
"#
    )
    .replace("lissom = 1", "lissom = 1\ngravity = [0, 0, -200]");
    let record = run(&text, &[]);
    let energy = series(&record, "energy.total");
    // Of the kinetic energy, 4 J.
    let changed = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
    assert!(changed < 4e-3, "{changed}");
    assert!(series(&record, "touch.normal").iter().filter(|normal| **normal > 1.0).count() > 20);
    // It meets nothing that would hold it, such as a kink between two elements.
    assert!((last(&record, "ball.v1") - 4.0).abs() < 0.2, "{}", last(&record, "ball.v1"));
}

/// A rope that is held at one end and slack at the other, on a drum that turns.
const BAND: &str = r#"
lissom = 1
[parameters]
friction = 0.3
sense = 1
[materials.fibre]
E = 1e10
nu = 0.3
density = 1000
[sections.rope]
shape = "circle"
material = "fibre"
radius = 0.001
damping = 1e-4
[beams.rope]
section = "rope"
from = [-0.10099, 0, 0]
through = [0, 0, 0.10099]
to = [0.10099, 0, 0]
elements = 40
order = 1
up = [0, 1, 0]
[bodies.drum]
mass = 1
inertia = [0.01, 0.01, 0.01]
shape = { kind = "cylinder", radius = 0.1, length = 0.05, axis = [0, 1, 0] }
[joints.shaft]
kind = "revolute"
base = "ground"
tip = "drum"
axis = [0, 1, 0]
[joints.turn]
kind = "prescribed_rotation"
joint = "shaft"
rotation = "2*sense*t"
[loads.slack]
kind = "force"
on = "rope.end"
vector = [0, 0, -10]
[springs.anchor]
kind = "point"
base = "ground"
tip = "rope.start"
at_base = [-0.10099, 0, -0.1]
stiffness = 1e4
damping = 20
length = 0.1
[contacts.wrap]
base = "drum"
tip = "rope"
stiffness_per_length = 1e7
dissipation = 10
friction = "friction"
points = 1
[outputs.anchor]
kind = "spring"
of = "anchor"
[outputs.shaft]
kind = "reaction"
of = "shaft"
[outputs.wrap]
kind = "contact_force"
of = "wrap"
[analysis]
kind = "dynamics"
end = 0.3
"#;

/// The law of Euler and Eytelwein, T₂/T₁ = exp(μ α) at the radius R of the drum: friction acts at R, tension at R + r. It holds in
/// both directions of sliding, and with points between the nodes.
#[test]
fn a_rope_on_a_drum_has_the_tensions_of_euler_and_eytelwein() {
    for (sense, friction, points) in [("1", 0.3_f64, "1"), ("-1", 0.3, "1"), ("1", 0.1, "2"), ("1", 0.0, "1")]
    {
        let text = BAND.replace("points = 1", &format!("points = {points}"));
        let friction_text = friction.to_string();
        let set = [("parameters.sense", sense), ("parameters.friction", friction_text.as_str())];
        let record = run(&text, &set);
        let ratio = last(&record, "anchor.force") / 10.0;
        let exponent = friction * std::f64::consts::PI / 1.01;
        let wanted = if sense == "1" { exponent.exp() } else { (-exponent).exp() };
        assert!((ratio - wanted).abs() < 0.005 * wanted, "{sense} {friction}: {ratio} {wanted}");
    }
}

/// A rod in the bore of a tube: its weight is carried by the wall below, its energy is conserved when it swings, and it stays inside.
#[test]
fn a_rod_rests_and_swings_in_a_bore() {
    let text = |damping: &str, dissipation: &str, end: &str| {
        format!(
            r#"{MATERIAL}
[parameters]
damping = "{damping}"
[ground]
shape = {{ kind = "tube", radius = 0.1, inner_radius = 0.05, length = 2, axis = [1, 0, 0] }}
[beams.rod]
section = "rod"
from = [-0.5, 0.02, 0]
to = [0.5, 0.02, 0]
elements = 8
order = 2
[contacts.bore]
base = "ground"
tip = "rod"
stiffness_per_length = 1e6
dissipation = {dissipation}
points = 6
[outputs.bore]
kind = "contact_force"
of = "bore"
[outputs.energy]
kind = "energy"
[outputs.middle]
kind = "displacement"
of = "rod@0.5"
[analysis]
kind = "dynamics"
end = {end}
"#
        )
        .replace("lissom = 1", "lissom = 1\ngravity = [0, 0, -9.81]")
    };
    let record = run(&text("0", "0", "0.4"), &[]);
    let energy = series(&record, "energy.total");
    let changed = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
    assert!(changed < 1e-2 * weight(1.0) * 0.03, "{changed}");
    let (across, up) = (series(&record, "middle.u2"), series(&record, "middle.u3"));
    let distance = across.iter().zip(up).map(|(y, z)| (0.02 + y).hypot(*z)).fold(0.0, f64::max);
    // The axis of the rod is within 4 cm of that of the tube, except for the penetration of a fall by 4 cm.
    let depth = (2.0 * weight(1.0) * 0.04 / 1e6).sqrt();
    assert!(distance > 0.0399 && distance < 0.04 + 1.2 * depth, "{distance}");
    let record = run(
        &text("1e-4", "20000", "3").replace("-0.5, 0.02", "-0.5, 0").replace("[0.5, 0.02", "[0.5, 0"),
        &[],
    );
    let found = last(&record, "bore.normal");
    assert!((found - weight(1.0)).abs() < 1e-3 * weight(1.0), "{found} {}", weight(1.0));
}

/// Beams that share a node are joined there, and have no distance.
#[test]
fn beams_that_share_a_node_are_rejected() {
    let text = format!(
        "{MATERIAL}[parameters]\ndamping = 0\n{}",
        r#"
[beams.one]
section = "rod"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[beams.other]
section = "rod"
from = "one.end"
to = [1, 1, 0]
elements = 2
[contacts.corner]
base = "one"
tip = "other"
stiffness = 1e6
[analysis]
kind = "dynamics"
end = 1
"#
    );
    assert!(refused(&text).contains("base and tip share a node"));
}

/// What is not available is rejected with a remedy.
#[test]
fn wrong_contacts_of_beams_are_rejected() {
    let on_plane = rod_on_plane(2, "");
    let analysis = "[analysis]\nkind = \"dynamics\"\nend = 1\n";
    let good = format!("{on_plane}{analysis}");
    for (from, to, expected) in [
        (
            "stiffness_per_length = 1e6",
            "stiffness = 1e6",
            "`stiffness` of a beam on a plane is not available",
        ),
        ("stiffness_per_length = 1e6", "", "neither `stiffness` nor `stiffness_per_length`"),
        ("stiffness_per_length = 1e6", "stiffness_per_length = 1e6\nstiffness = 1e6", "both `stiffness`"),
        ("tip = \"rod\"", "tip = \"rod\"\nrestitution = 0.5", "of kind `along`, which has no `restitution`"),
        ("tip = \"rod\"", "tip = \"rod\"\nbase_radius = 0.5", "is for a beam as base"),
        ("base = \"ground\"\ntip = \"rod\"", "base = \"rod\"\ntip = \"ground\"", "the beam is the tip"),
        ("tip = \"rod\"", "tip = \"rod.end\"", "of kind `compliant`, which has no `stiffness_per_length`"),
        ("{ kind = \"plane\" }", "{ sphere = 0.02 }", "the points of the beam are"),
        (
            "stiffness_per_length = 1e6",
            "stiffness_per_length = 1e6\nexponent = 0.5",
            "`exponent` of contact `floor` is below 1",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let found = refused(&good.replace(from, to));
        let words: String = found.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(expected), "{to}: {found}");
    }
}
