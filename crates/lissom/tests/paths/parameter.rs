//! Equilibrium paths along a number of the model against closed forms.

use crate::support::paths;
use crate::support::truss;

use lissom::analyses::path::PathEnd;
use lissom_core::path::CriticalKind;
use paths::{follow, near, start};
use truss::truss;

/// Two springs lean on each other under a load. They are as long as they are drawn, so that their height is a geometry.
fn given_truss() -> String {
    let rest = "[analysis]\nkind = \"path\"\nvary = \"parameters.force\"\nend = 60\n";
    truss("\"height\"", "\"-force\"", rest)
        .replace("lissom = 1\n", "lissom = 1\n[parameters]\nheight = 0.3\nstiffness = 1000.0\nforce = 0.0\n")
        .replace("stiffness = 1000.0\n[", "stiffness = \"stiffness\"\n[")
}

#[test]
fn a_force_is_a_number_like_the_load_factor() {
    let (record, report) = follow(&given_truss(), &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    assert_eq!(report.name, "parameters.force");
    let forces = record.column("parameters.force", "").unwrap();
    let heights = record.column("top", "y").unwrap();
    let free = 1.09_f64.sqrt();
    for (&force, &y) in forces.iter().zip(heights) {
        let exact = 2000.0 * (free / (1.0 + y * y).sqrt() - 1.0) * y;
        assert!((force - exact).abs() < 1e-8, "{force} at {y}, not {exact}");
    }
    near(*forces.last().unwrap(), 60.0, 1e-12);
    let length = free.cbrt();
    let limit = 2000.0 * (free / length - 1.0) * (length * length - 1.0).sqrt();
    assert_eq!(report.critical.len(), 2, "{:?}", report.critical);
    for (point, sign) in report.critical.iter().zip([1.0, -1.0]) {
        assert_eq!(point.kind, CriticalKind::Limit);
        near(point.load_factor, sign * limit, 1e-8);
        assert!(point.is_located);
    }
}

#[test]
fn a_geometry_has_a_limit_point() {
    // Where it is low it does not carry the load: ℓ₀² = 1 + h² = (1 + (F/2k)^(2/3))³.
    let set = [
        ("parameters.height", "0.5"),
        ("parameters.force", "20"),
        ("analysis.vary", "parameters.height"),
        ("analysis.end", "0.05"),
        ("analysis.steps", "60"),
    ];
    let (record, report) = follow(&given_truss(), &set);
    let PathEnd::Failed(error) = &report.end else { panic!("{:?}", report.end) };
    assert!(error.to_string().contains("parameters.height"), "{error}");
    let limit = ((1.0 + (20.0_f64 / 2000.0).powf(2.0 / 3.0)).powi(3) - 1.0).sqrt();
    let point = &report.critical[0];
    assert_eq!((point.kind, point.unstable), (CriticalKind::Limit, [0, 1]));
    near(point.load_factor, limit, 1e-8);
    let heights = record.column("parameters.height", "").unwrap();
    let places = record.column("top", "y").unwrap();
    near(heights[0], 0.5, 1e-15);
    for (&height, &y) in heights.iter().zip(places) {
        let load = 2000.0 * ((1.0 + height * height).sqrt() / (1.0 + y * y).sqrt() - 1.0) * y;
        near(load, 20.0, 1e-7);
    }
}

/// A column under a load of its own.
const COLUMN: &str = r#"
lissom = 1
[parameters]
length = 1.0
load = 1.0
[sections.bar]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 1e4, 100, 300]
mass = [1, 1, 1, 1, 1, 1]
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = ["length", 0, 0]
up = [0, 0, 1]
elements = 4
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[loads.push]
kind = "force"
on = "bar.end"
vector = ["-load", 0, 0]
[analysis]
kind = "path"
end = 400
step = 50
"#;

#[test]
fn a_column_that_grows_buckles_at_the_length_that_its_load_says() {
    let (_, by_load) = follow(COLUMN, &[]);
    let critical = &by_load.critical[0];
    assert_eq!(critical.kind, CriticalKind::Bifurcation);
    let load = format!("{:?}", critical.load_factor);
    let set = [
        ("parameters.load", load.as_str()),
        ("parameters.length", "0.9"),
        ("analysis.vary", "parameters.length"),
        ("analysis.end", "1.06"),
        ("analysis.step", "0.05"),
    ];
    let (record, report) = follow(COLUMN, &set);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    let lengths = record.column("parameters.length", "").unwrap();
    near(*lengths.last().unwrap(), 1.06, 1e-12);
    assert_eq!(report.critical.len(), 1, "{:?}", report.critical);
    assert_eq!((report.critical[0].kind, report.critical[0].unstable), (CriticalKind::Bifurcation, [0, 1]));
    near(report.critical[0].load_factor, 1.0, 1e-7);
    // Beyond it the loads alone buckle it: what is varied begins nowhere.
    let [load, _, vary, end, step] = set;
    let error = start(COLUMN, &[load, ("parameters.length", "1.2"), vary, end, step]).err().unwrap();
    assert!(error.contains("critical point at load factor"), "{error}");
}

/// A four-bar whose crank is driven and cannot go round.
const FOUR_BAR: &str = r#"
lissom = 1
[parameters]
angle = 0.0
[bodies.crank]
mass = 1
inertia = [1, 1, 1]
position = [0, 0.5, 0]
[bodies.coupler]
mass = 1
inertia = [1, 1, 1]
position = [0.5, 1, 0]
[bodies.rocker]
mass = 1
inertia = [1, 1, 1]
position = [1, 0.5, 0]
[joints.a]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.b]
kind = "spherical"
base = "crank"
tip = "coupler"
at = [0, 1, 0]
[joints.c]
kind = "universal"
base = "coupler"
tip = "rocker"
at = [1, 1, 0]
axis = [0, 0, 1]
second_axis = [0, 1, 0]
[joints.d]
kind = "revolute"
base = "ground"
tip = "rocker"
at = [1.2, 0, 0]
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "a"
rotation = "angle"
[outputs.rocker]
kind = "position"
of = "rocker"
[analysis]
kind = "path"
vary = "parameters.angle"
end = 3
steps = 100
"#;

#[test]
fn the_range_that_a_drive_can_reach_ends_at_limit_points() {
    // Coupler and rocker in one line: the pin of the crank is as far from the fixed pivot as both are long.
    let (crank, ground, coupler, rocker) = (1.0_f64, 1.2_f64, 1.0_f64, 1.04_f64.sqrt());
    let cosine = (crank * crank + ground * ground - (coupler + rocker).powi(2)) / (2.0 * crank * ground);
    let [highest, lowest] = [1.0, -1.0].map(|side| side * cosine.acos() - std::f64::consts::FRAC_PI_2);
    let (record, report) = follow(FOUR_BAR, &[]);
    // It turns back before the end that was asked for, and says so.
    assert!(matches!(report.end, PathEnd::Failed(_)), "{:?}", report.end);
    assert!(report.critical.len() >= 2, "{:?}", report.critical);
    assert!(report.critical.iter().all(|point| point.kind == CriticalKind::Limit));
    near(report.critical[0].load_factor, highest, 1e-9);
    near(report.critical[1].load_factor, lowest, 1e-9);
    let angles = record.column("parameters.angle", "").unwrap();
    assert!(angles.iter().all(|&angle| (lowest - 1e-9..=highest + 1e-9).contains(&angle)));
    // The bars keep their lengths.
    let at = |component: &str| record.column("rocker", component).unwrap();
    for (x, y) in at("x").iter().zip(at("y")) {
        near((x - 1.2).hypot(*y), (0.04_f64 + 0.25).sqrt(), 1e-9);
    }
}

#[test]
fn numbers_that_cannot_be_varied_are_refused() {
    let refuse = |set: &[(&str, &str)]| start(&given_truss(), set).err().unwrap_or_default();
    let words = refuse(&[("analysis.vary", "parameters.heigt")]);
    assert!(words.contains("has no number at `parameters.heigt`"), "{words}");
    let words = refuse(&[("analysis.vary", "analysis.steps")]);
    assert!(words.contains("belongs to the analysis"), "{words}");
    let words = refuse(&[("analysis.end", "0")]);
    assert!(words.contains("already"), "{words}");
    let words = refuse(&[("analysis.vary", "point_masses.top.mass"), ("parameters.force", "5")]);
    assert!(words.contains("does not change the equilibrium"), "{words}");
    // A stiffness has no negative value.
    let set = [
        ("parameters.force", "-10"),
        ("springs.left.stiffness", "1000.0"),
        ("analysis.vary", "springs.left.stiffness"),
        ("analysis.end", "-100"),
    ];
    let (record, report) = follow(&given_truss(), &set);
    let PathEnd::Failed(error) = &report.end else { panic!("{:?}", report.end) };
    assert!(error.to_string().contains("invalid beyond"), "{error}");
    assert!(record.times.len() > 5);
}
