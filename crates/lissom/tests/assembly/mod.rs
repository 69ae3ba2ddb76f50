//! Approximate positions are closed with the least change, or rejected with the joints that stay open.

mod options;

use std::fmt::Write;

use lissom::start::{Assembly, Lowered, lower};
use lissom::{Model, SessionError};
use lissom_motion::{Rotation, Vector3};

/// Numbers that look like chance, the same every time.
struct Dice(u64);

impl Dice {
    /// Between -1 and 1.
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3 {
        Vector3::new(self.roll(), self.roll(), self.roll())
    }
}

fn list(vector: &Vector3) -> String {
    format!("[{:.17e}, {:.17e}, {:.17e}]", vector.x, vector.y, vector.z)
}

const END: &str = "[assembly]\n[analysis]\nkind = \"dynamics\"\nend = 1e-3\nstep = 1e-3\n";

/// A closed loop from the ground through bodies back to the ground; `corners` are where its joints are, one more than bodies.
/// Every body is displaced and turned by chance; parallel revolute joints where `is_planar`, else spherical ones.
fn ring(name: &str, corners: &[Vector3], is_planar: bool, disorder: f64, dice: &mut Dice) -> String {
    let mut text = String::new();
    let count = corners.len() - 1;
    let placed: Vec<(Vector3, Vector3, Rotation)> = (0..count)
        .map(|k| {
            let center = 0.5 * (corners[k] + corners[k + 1]);
            (center, center + disorder * dice.vector(), Rotation::exponential(&(disorder * dice.vector())))
        })
        .collect();
    for (k, (_, position, rotation)) in placed.iter().enumerate() {
        let (position, turn) = (list(position), list(&rotation.logarithm()));
        writeln!(
            text,
            "[bodies.{name}{k}]\nmass = 1\ninertia = [0.1, 0.2, 0.3]\nposition = {position}\nrotation = {turn}"
        )
        .unwrap();
    }
    // Where a corner lies, and an axis points, on a body as placed.
    let on = |body: Option<usize>, corner: &Vector3| {
        body.map_or(*corner, |body| placed[body].1 + placed[body].2.apply(&(corner - placed[body].0)))
    };
    let axis = |body: Option<usize>| body.map_or(Vector3::z(), |body| placed[body].2.apply(&Vector3::z()));
    let called = |body: Option<usize>| body.map_or("ground".to_owned(), |body| format!("{name}{body}"));
    for (k, corner) in corners.iter().enumerate() {
        let (base, tip) = (k.checked_sub(1), (k < count).then_some(k));
        let (at, at_tip) = (list(&on(base, corner)), list(&on(tip, corner)));
        let kind = if is_planar { "revolute" } else { "spherical" };
        writeln!(
            text,
            "[joints.{name}_j{k}]\nkind = \"{kind}\"\nbase = \"{}\"\ntip = \"{}\"",
            called(base),
            called(tip)
        )
        .unwrap();
        writeln!(text, "at = {at}\nat_tip = {at_tip}").unwrap();
        if is_planar {
            writeln!(text, "axis = {}\naxis_at_tip = {}", list(&axis(base)), list(&axis(tip))).unwrap();
        }
    }
    text
}

/// Corners by chance, none too near to the last.
fn corners(count: usize, is_planar: bool, dice: &mut Dice) -> Vec<Vector3> {
    let mut corners: Vec<Vector3> = Vec::new();
    while corners.len() < count {
        let mut corner = dice.vector();
        if is_planar {
            corner.z = 0.0;
        }
        if corners.iter().all(|other| (other - corner).norm() > 0.4) {
            corners.push(corner);
        }
    }
    corners
}

fn lowered(text: &str) -> Lowered {
    let text = format!("lissom = 1\n{text}");
    match Model::from_text("model.toml", &text).document().and_then(|document| lower(&document)) {
        Ok(lowered) => lowered,
        Err(report) => panic!("{}\n{text}", report.render(false)),
    }
}

fn assembly(text: &str) -> Assembly {
    lowered(text).assembly.expect("asked for")
}

fn moved(assembly: &Assembly, part: &str) -> (f64, f64) {
    let found = assembly.moved.iter().find(|moved| moved.part == part);
    found.map_or((0.0, 0.0), |moved| (moved.distance, moved.turn))
}

/// The tip of a slider is brought onto its beam, with the least change: straight across.
#[test]
fn a_slider_is_brought_onto_its_beam() {
    let text = format!(
        r#"
[sections.bar]
shape = "general"
stiffness = [1e6, 4e4, 4e4, 300, 100, 150]
mass = {{ per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }}
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = 2
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[bodies.ring]
mass = 1
inertia = [1, 1, 1]
position = [0.4, 0.02, -0.01]
[joints.slide]
kind = "slider"
beams = ["bar"]
tip = "ring"
at = [0.4, 0.02, -0.01]
{END}"#
    );
    let Lowered { state, .. } = lowered(&text);
    let ring = (state
        .kinematics
        .nodes
        .iter()
        .find(|node| node.frame.position.y.abs() < 1e-9 && (node.frame.position.x - 0.4).abs() < 0.05))
    .expect("on the beam")
    .frame;
    assert!((ring.position - Vector3::new(0.4, 0.0, 0.0)).norm() < 1e-9, "{}", ring.position);
    assert!(ring.rotation.logarithm().norm() < 1e-9);
}

/// Complaint about a model that cannot be assembled.
fn refused(text: &str) -> String {
    let document = Model::from_text("model.toml", &format!("lissom = 1\n{text}")).document().unwrap();
    match lower(&document) {
        Ok(lowered) => panic!("assembled: {:?}\n{text}", lowered.assembly),
        Err(report) => report.render(false),
    }
}

#[test]
fn two_hundred_closed_loops_that_are_drawn_roughly_close() {
    let mut dice = Dice(7);
    for case in 0..200 {
        let is_planar = case % 2 == 0;
        let corners = corners(4 + case % 4, is_planar, &mut dice);
        // Size of a loop is about two.
        let text = ring("r", &corners, is_planar, 0.1, &mut dice) + END;
        let Lowered { system, state, assembly, .. } = lowered(&text);
        let mut violations = vec![0.0; system.layout().multiplier_rows().len()];
        system.violations(&state.kinematics, &mut violations);
        let worst = violations.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!(worst < 2e-10, "case {case}: {worst:e}\n{text}");
        let assembly = assembly.unwrap();
        assert!(assembly.is_least, "case {case}\n{text}");
        let farthest = assembly.moved[0].distance;
        // Bodies were drawn up to 0.17 from a position where all close.
        assert!(farthest > 1e-3 && farthest < 0.6, "case {case}: {farthest}\n{text}");
    }
}

#[test]
fn fifty_loops_that_cannot_close_are_refused_by_their_joints() {
    let mut dice = Dice(11);
    for case in 0..50 {
        let is_planar = case % 2 == 0;
        // Two links of 1 and up to 0.3 less between pins that are farther apart.
        let reach = 1.7 + 0.3 * dice.roll();
        let apart = reach + 0.3 + 0.2 * dice.roll();
        let middle = Vector3::new(0.5 * reach, 0.05, 0.0);
        let end = Vector3::new(reach, 0.0, 0.0);
        let open = ring("open", &[Vector3::zeros(), middle, end], is_planar, 0.02, &mut dice);
        // The last pin of the ground is moved away.
        let (before, after) = open.rsplit_once("\nat_tip = ").unwrap();
        let (_, rest) = after.split_once('\n').unwrap();
        let open = format!("{before}\nat_tip = {}\n{rest}", list(&Vector3::new(apart, 0.0, 0.0)));
        let whole = corners(5, is_planar, &mut dice);
        let text = open + &ring("closed", &whole, is_planar, 0.02, &mut dice) + END;
        let words = refused(&text);
        assert!(words.contains("cannot be assembled"), "case {case}: {words}");
        assert!(words.contains("`open_j"), "case {case}: {words}");
        assert!(!words.contains("`closed_j"), "case {case}: {words}");
    }
}

/// Two free bodies whose reference points shall coincide: each goes half the way.
const PAIR: &str = r#"
[bodies.a]
mass = 1
inertia = [1, 1, 1]
[bodies.b]
mass = 100
inertia = [1, 1, 1]
position = [1, 0, 0]
[joints.pin]
kind = "spherical"
base = "a"
tip = "b"
at = [0, 0, 0]
at_tip = [1, 0, 0]
[assembly]
"#;

const ANALYSIS: &str = "\n[analysis]\nkind = \"dynamics\"\nend = 1e-3\nstep = 1e-3\n";

#[test]
fn parts_share_a_gap_and_fixed_ones_stay() {
    let both = assembly(&format!("{PAIR}{ANALYSIS}"));
    for part in ["a", "b"] {
        assert!((moved(&both, part).0 - 0.5).abs() < 1e-9, "{both:?}");
    }
    assert!((both.closed[0].distance.unwrap() - 1.0).abs() < 1e-12);
    let one = assembly(&format!("{PAIR}fixed = [\"a\"]\n{ANALYSIS}"));
    assert!(moved(&one, "a").0 == 0.0 && (moved(&one, "b").0 - 1.0).abs() < 1e-9, "{one:?}");
}

/// A slider crank with its rod too short by `gap` as drawn: crank of 1 standing up, rod of 2.
fn four_bar(scale: f64, turn: &Rotation, rocker: f64) -> String {
    let place = |x: f64, y: f64| list(&turn.apply(&(scale * Vector3::new(x, y, 0.0))));
    let axis = list(&turn.apply(&Vector3::z()));
    let mut text = String::new();
    let middle = 0.5 * rocker;
    for (name, x, y) in [("crank", 0.0, 0.5), ("coupler", 1.0, 1.0), ("rocker", 2.0, middle)] {
        writeln!(text, "[bodies.{name}]\nmass = 1\ninertia = [1, 1, 1]\nposition = {}", place(x, y)).unwrap();
    }
    let joints = [
        ("a", "ground", "crank", (0.0, 0.0), (0.0, 0.0)),
        ("b", "crank", "coupler", (0.0, 1.0), (0.0, 1.05)),
        ("c", "coupler", "rocker", (2.1, 1.1), (2.0, rocker)),
        ("d", "rocker", "ground", (2.0, 0.0), (2.0, 0.0)),
    ];
    for (name, base, tip, at, at_tip) in joints {
        writeln!(
            text,
            "[joints.{name}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"{tip}\"\naxis = {axis}"
        )
        .unwrap();
        writeln!(text, "at = {}\nat_tip = {}", place(at.0, at.1), place(at_tip.0, at_tip.1)).unwrap();
    }
    text + END
}

#[test]
fn units_and_axes_change_nothing() {
    let plain = assembly(&four_bar(1.0, &Rotation::identity(), 1.2));
    let turned = Rotation::exponential(&Vector3::new(0.3, -0.8, 0.5));
    for (scale, turn) in [(1e3, Rotation::identity()), (1e-3, Rotation::identity()), (1.0, turned)] {
        let other = assembly(&four_bar(scale, &turn, 1.2));
        for part in ["crank", "coupler", "rocker"] {
            let ((distance, angle), (one, two)) = (moved(&plain, part), moved(&other, part));
            assert!((one / scale - distance).abs() < 1e-7 * distance, "{part}: {distance} {one}");
            assert!((two - angle).abs() < 1e-7, "{part}: {angle} {two}");
        }
    }
}

/// The weighted change grows in both directions along the way that the mechanism can go.
#[test]
fn no_neighbouring_position_is_nearer() {
    let of = |angle: Option<f64>| {
        let text = four_bar(1.0, &Rotation::identity(), 1.2);
        let drive = |angle: f64| {
            format!(
                "[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"a\"\nrotation = \"{angle:.17e}\"\n[assembly]"
            )
        };
        let text = angle.map_or_else(|| text.clone(), |angle| text.replace("[assembly]", &drive(angle)));
        let Lowered { state, assembly, names, .. } = lowered(&text);
        let kinematics = &state.kinematics;
        let drawn = [("crank", 0.0, 0.5), ("coupler", 1.0, 1.0), ("rocker", 2.0, 0.6)];
        let points: [&[(f64, f64)]; 3] = [
            &[(0.0, 0.5), (0.0, 0.0), (0.0, 1.0)],
            &[(1.0, 1.0), (0.0, 1.05), (2.1, 1.1)],
            &[(2.0, 0.6), (2.0, 1.2), (2.0, 0.0)],
        ];
        let mut sum = 0.0;
        for ((name, x, y), points) in drawn.iter().zip(points) {
            let frame = kinematics.nodes[names.nodes[*name]].frame;
            let all: Vec<Vector3> = points.iter().map(|(x, y)| Vector3::new(*x, *y, 0.0)).collect();
            let center = all.iter().sum::<Vector3>() / 3.0;
            let radius = all.iter().map(|point| (point - center).norm_squared()).sum::<f64>() / 3.0;
            let now = frame.transform_point(&(center - Vector3::new(*x, *y, 0.0)));
            sum += (now - center).norm_squared() + radius * frame.rotation.logarithm().norm_squared();
        }
        (sum, kinematics.coordinates[names.coordinates["a"][0]].value, assembly.unwrap().is_least)
    };
    let (least, angle, is_least) = of(None);
    assert!(is_least);
    for aside in [1e-2, 1e-3] {
        for sign in [1.0, -1.0] {
            let (other, ..) = of(Some(angle + sign * aside));
            assert!(other > least, "{least} {other} at {aside}");
        }
    }
}

#[test]
fn a_loop_closes_in_the_way_that_is_drawn() {
    let end = |rocker: f64| {
        let Lowered { state, names, .. } = lowered(&four_bar(1.0, &Rotation::identity(), rocker));
        state.kinematics.nodes[names.nodes["rocker"]].frame.position.y
    };
    assert!(end(1.2) > 0.3);
    // The same lengths with the rocker below: the coupler as drawn does not change.
    let text = four_bar(1.0, &Rotation::identity(), 1.2)
        .replace(&list(&Vector3::new(2.0, 0.6, 0.0)), &list(&Vector3::new(2.0, -0.6, 0.0)))
        .replace(&list(&Vector3::new(2.0, 1.2, 0.0)), &list(&Vector3::new(2.0, -1.2, 0.0)));
    let Lowered { state, names, assembly, .. } = lowered(&text);
    assert!(state.kinematics.nodes[names.nodes["rocker"]].frame.position.y < -0.3, "{assembly:?}");
}

/// An arm of two links drawn straight along x.
const ARM: &str = r#"
[bodies.upper]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0, 0]
[bodies.fore]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1.5, 0, 0]
[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.elbow]
kind = "revolute"
base = "upper"
tip = "fore"
at = [1, 0, 0]
axis = [0, 0, 1]
"#;

#[test]
fn a_value_at_the_start_turns_what_hangs_on_the_joint() {
    let arm = ARM.replace("at = [1, 0, 0]", "at = [1, 0, 0]\nangle = \"3*pi/4\"");
    // Without [assembly] the value names what is drawn.
    let drawn = lowered(&format!("{arm}{ANALYSIS}"));
    let fore = |lowered: &Lowered| lowered.state.kinematics.nodes[lowered.names.nodes["fore"]].frame;
    assert!(drawn.assembly.is_none() && fore(&drawn).position == Vector3::new(1.5, 0.0, 0.0));
    let found = lowered(&format!("{arm}{END}"));
    let (sine, cosine) = (0.75 * std::f64::consts::PI).sin_cos();
    let wanted = Vector3::new(1.0 + 0.5 * cosine, 0.5 * sine, 0.0);
    assert!((fore(&found).position - wanted).norm() < 1e-11, "{:?}", fore(&found).position);
    let assembly = found.assembly.as_ref().unwrap();
    assert_eq!(moved(assembly, "upper"), (0.0, 0.0), "{assembly:?}");
    assert!((moved(assembly, "fore").1 - 0.75 * std::f64::consts::PI).abs() < 1e-11);
    // The shoulder turns both, base and tip the other way round the same.
    for arm in
        [arm.clone(), arm.replace("base = \"ground\"\ntip = \"upper\"", "base = \"upper\"\ntip = \"ground\"")]
    {
        let is_other = arm.contains("base = \"upper\"\ntip = \"ground\"");
        let angle = if is_other { "-pi/2" } else { "pi/2" };
        let arm = arm.replace("at = [0, 0, 0]", &format!("at = [0, 0, 0]\nangle = \"{angle}\""));
        let found = lowered(&format!("{arm}{END}"));
        let wanted = Vector3::new(-0.5 * sine, 1.0 + 0.5 * cosine, 0.0);
        assert!((fore(&found).position - wanted).norm() < 1e-11, "{:?}", fore(&found).position);
    }
}

#[test]
fn a_drive_starts_where_it_says_and_velocities_belong_to_the_places() {
    let drive = r#"
[joints.drive]
kind = "prescribed_rotation"
joint = "shoulder"
rotation = "1 + 2*t"
[initial]
angular_velocity = [0, 0, 2]
"#;
    let text = format!("lissom = 1\n{ARM}{drive}{END}");
    let session = Model::from_text("model.toml", &text).session().unwrap();
    assert_eq!(session.warnings().count(), 0);
    assert!(session.simulation().velocity_correction() < 1e-12);
    let without = text.replace("[assembly]", "");
    let error = Model::from_text("model.toml", &without).session();
    assert!(matches!(error, Err(SessionError::Model(_))), "a drive that starts elsewhere");
}

#[test]
fn beams_move_without_being_strained() {
    let text = r#"
[sections.bar]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 200, 200]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
[beams.one]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[beams.two]
section = "bar"
from = "one.end"
to = [1, 1, 0]
elements = 2
[joints.root]
kind = "spherical"
base = "ground"
tip = "one.start"
at = [0, 0, 0]
[joints.end]
kind = "distance"
base = "ground"
tip = "two.end"
at_base = [3, 1, 0]
[joints.top]
kind = "point_in_plane"
base = "ground"
tip = "two.end"
at = [1, 1, 0.2]
at_tip = [1, 1, 0]
axis = [0, 0, 1]
"#;
    let found = lowered(&format!("{text}{END}"));
    let energy = found.system.energy_of(&found.state);
    assert!(energy.strain < 1e-18, "{energy:?}");
    let assembly = found.assembly.unwrap();
    assert!(moved(&assembly, "one").1 > 0.1 && moved(&assembly, "two").0 > 0.1, "{assembly:?}");
}

/// A body that turns about its own reference point has moved as well.
#[test]
fn a_part_that_only_turns_is_reported() {
    let text = PAIR
        .replace("\"spherical\"", "\"revolute\"")
        .replace("position = [1, 0, 0]", "")
        .replace("at_tip = [1, 0, 0]", "at_tip = [0, 0, 0]\naxis = [0, 0, 1]\naxis_at_tip = [0, 0.3, 1]");
    let found = assembly(&format!("{text}fixed = [\"a\"]\n{ANALYSIS}"));
    assert_eq!(found.moved.len(), 1, "{found:?}");
    let (distance, turn) = moved(&found, "b");
    assert!(distance < 1e-12 && (turn - 0.3_f64.atan()).abs() < 1e-9, "{found:?}");
    assert!(found.words().starts_with("moved `b` by "), "{}", found.words());
    assert!(found.words().contains(" m and 0.2915 rad"), "{}", found.words());
}

#[test]
fn joints_do_not_close_with_axes_that_point_opposite_ways() {
    let text = ARM.replace(
        "at = [1, 0, 0]\naxis = [0, 0, 1]",
        "at = [1, 0, 0]\nat_tip = [1, 0, 0]\naxis = [0, 0, 1]\naxis_at_tip = [0, 0.1, -1]",
    );
    let words = refused(&format!("{text}{END}"));
    assert!(words.contains("90 degrees or more"), "{words}");
}
