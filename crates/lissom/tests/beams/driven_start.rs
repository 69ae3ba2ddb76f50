//! Beams that drives set in motion start with the rigid motion of their part.

use crate::support::runs::column as column_of;
use crate::support::sessions::{finished, session};
use lissom::Session;

/// A beam on a driven hub, with a body at its tip: it turns at 20 rad/s from the start.
const ROTOR: &str = r#"
lissom = 1
gravity = [0, 0, 0]
[materials.steel]
E = 210e9
nu = 0.3
density = 7850
[sections.bar]
shape = "rectangle"
material = "steel"
width = 0.02
height = 0.02
[bodies.hub]
mass = 2
inertia = [0.01, 0.01, 0.01]
[beams.arm]
section = "bar"
from = [0.1, 0, 0]
to = [1.1, 0, 0]
elements = 8
up = [0, 0, 1]
[bodies.tip]
mass = 1
inertia = [1e-3, 1e-3, 1e-3]
position = [1.1, 0, 0]
[joints.root]
kind = "clamp"
base = "hub"
tip = "arm.start"
[joints.end]
kind = "clamp"
base = "arm.end"
tip = "tip"
[joints.axle]
kind = "revolute"
base = "ground"
tip = "hub"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.motor]
kind = "prescribed_rotation"
joint = "axle"
rotation = "20*t"
[outputs.speed]
kind = "velocity"
of = "tip"
[outputs.spin]
kind = "angular_velocity"
of = "arm@0.5"
[outputs.moment]
kind = "section_moment"
of = "arm@0"
[outputs.force]
kind = "section_force"
of = "arm@0"
INITIAL
[analysis]
kind = "dynamics"
end = 0.05
step = 1e-4
"#;

/// A slider crank of flexible crank and rod, at an angle where nothing is symmetric.
const CRANK: &str = r#"
lissom = 1
gravity = [0, 0, 0]
[materials.steel]
E = 210e9
nu = 0.3
density = 7850
[sections.bar]
shape = "rectangle"
material = "steel"
width = 0.008
height = 0.008
[beams.crank]
section = "bar"
from = [0, 0, 0]
to = [0.09, 0.12, 0]
elements = 3
up = [0, 0, 1]
[beams.rod]
section = "bar"
from = [0.09, 0.12, 0]
to = [0.59, 0, 0]
elements = 6
up = [0, 0, 1]
[bodies.block]
mass = 0.075
inertia = [1e-5, 1e-5, 1e-5]
position = [0.59, 0, 0]
[joints.main]
kind = "revolute"
base = "ground"
tip = "crank.start"
axis = [0, 0, 1]
[joints.pin]
kind = "revolute"
base = "crank.end"
tip = "rod.start"
axis = [0, 0, 1]
[joints.wrist]
kind = "generic"
base = "block"
tip = "rod.end"
locked = ["x", "y"]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "block"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_rotation"
joint = "main"
rotation = "50*t"
[outputs.block]
kind = "velocity"
of = "block"
[outputs.rod]
kind = "angular_velocity"
of = "rod@0.5"
INITIAL
[analysis]
kind = "dynamics"
end = 0.01
step = 1e-5
"#;

const AT_REST: &str = "[initial]\nfollow_drives = false";

fn with(model: &str, initial: &str) -> String {
    model.replace("INITIAL", initial)
}

fn first(session: &Session, column: &str) -> f64 {
    let column = session.columns().iter().position(|own| own.name() == column).expect(column);
    let mut values = Vec::new();
    session.values(&mut values);
    values[column]
}

fn jolts(session: &Session) -> usize {
    session.warnings().filter(|warning| warning.to_string().contains("instantaneously")).count()
}

/// Largest magnitude of a column along the run.
fn largest(model: &str, column: &str) -> f64 {
    let record = session(model).run().unwrap();
    let (output, component) = column.split_once('.').expect("a component");
    column_of(&record, output, component).iter().fold(0.0, |most, value| most.max(value.abs()))
}

#[test]
fn a_beam_starts_with_the_rotation_of_its_drive() {
    let driven = session(&with(ROTOR, ""));
    assert!((first(&driven, "speed.v2") - 22.0).abs() < 1e-6, "{}", first(&driven, "speed.v2"));
    assert!((first(&driven, "spin.w3") - 20.0).abs() < 1e-6, "{}", first(&driven, "spin.w3"));
    assert_eq!(jolts(&driven), 0);
    let at_rest = session(&with(ROTOR, AT_REST));
    assert!(first(&at_rest, "speed.v2").abs() < 1.0 && jolts(&at_rest) == 1);
    // A part with a velocity of its own keeps it.
    let given = "[initial.tip]\nparts = [\"tip\"]\nvelocity = [0, 1, 0]";
    assert!(first(&session(&with(ROTOR, given)), "speed.v2") < 2.0);
}

#[test]
fn a_rotor_that_starts_at_speed_bends_little() {
    let [driven, at_rest] = ["", AT_REST].map(|initial| largest(&with(ROTOR, initial), "moment.m3"));
    assert!(driven < 1e-4 * at_rest, "{driven} N m, and {at_rest} N m from rest");
    // What remains is the axial vibration about the centrifugal stretching: m ω² r twice at the most.
    let axial = largest(&with(ROTOR, ""), "force.f1");
    let centrifugal = 400.0 * (1.1 + 7850.0 * 4e-4 * 0.6);
    assert!((centrifugal..2.3 * centrifugal).contains(&axial), "{axial} N, steady {centrifugal} N");
}

#[test]
fn a_slider_crank_starts_as_a_mechanism_of_rigid_links() {
    let driven = session(&with(CRANK, ""));
    let [x, y] = [0.09, 0.12];
    // The rod turns such that its end stays on the axis.
    let rod = -50.0 * x / (0.5 * 1.0);
    let block = -50.0 * y + rod * y;
    assert!((first(&driven, "rod.w3") - rod).abs() < 1e-6 * 50.0, "{} for {rod}", first(&driven, "rod.w3"));
    assert!(
        (first(&driven, "block.v1") - block).abs() < 1e-6 * 6.0,
        "{} for {block}",
        first(&driven, "block.v1")
    );
    assert_eq!(jolts(&driven), 0);
    finished(&with(CRANK, ""));
}

#[test]
fn a_driven_rotor_starts_in_steady_rotation() {
    let model = with(ROTOR, "[initial]\nsteady_rotation = true");
    let steady = session(&model);
    let force = first(&steady, "force.f1");
    let record = session(&model).run().unwrap();
    let forces = column_of(&record, "force", "f1");
    let change = forces.iter().fold(0.0_f64, |most, value| most.max((value - force).abs()));
    assert!(force > 400.0 && change < 1e-4 * force, "{force} N changes by {change} N");
}
