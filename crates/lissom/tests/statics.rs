//! Load steps of chosen size, torques of drives, starts in steady rotation.

use lissom::{Model, Record, Session};

fn record(text: &str) -> (Record, Session) {
    let document = Model::from_text("model.toml", text).document().unwrap_or_else(|error| panic!("{error}"));
    let mut session = Session::new(&document).unwrap_or_else(|error| panic!("{error}"));
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(report.error().is_none(), "{:?}", report.error());
    (record, session)
}

/// A beam of length 1 and bending stiffness 100 N m² under a moment at its end that bends it to a circle of 0.6 turns.
fn rolled(analysis: &str) -> String {
    format!(
        r#"
lissom = 1
[sections.strip]
shape = "general"
stiffness = [1e7, 1e7, 1e7, 100, 100, 100]
mass = [1, 1, 1, 1, 1, 1]
[beams.strip]
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 12
up = [0, 0, 1]
[joints.root]
kind = "clamp"
base = "ground"
tip = "strip.start"
[loads.end]
kind = "moment"
on = "strip.end"
vector = [0, 0, "120*pi"]
[outputs.tip]
kind = "displacement"
of = "strip.end"
[analysis]
kind = "statics"
{analysis}
"#
    )
}

#[test]
fn chosen_load_steps_end_where_given_ones_do() {
    let (chosen, _) = record(&rolled(""));
    let (given, _) = record(&rolled("steps = 40"));
    for component in ["u1", "u2"] {
        let [a, b] =
            [&chosen, &given].map(|record| *record.column("tip", component).unwrap().last().unwrap());
        assert!((a - b).abs() < 1e-6, "{component}: {a} and {b}");
    }
    assert_eq!(chosen.times.last(), Some(&1.0));
    assert!(chosen.times.len() < 60, "{}", chosen.times.len());
    assert!(chosen.times.windows(2).all(|pair| pair[1] > pair[0]), "{:?}", chosen.times);
}

#[test]
fn a_linear_range_takes_few_load_steps() {
    let (record, _) = record(&rolled("").replace("120*pi", "0.001"));
    assert!((4..=8).contains(&record.times.len()), "{:?}", record.times);
}

#[test]
fn steps_and_their_tolerance_are_not_given_together() {
    let text = rolled("steps = 4\nrelative_tolerance = 0.1");
    let refused = Model::from_text("model.toml", &text).document().unwrap_err().render(false);
    assert!(refused.contains("remove one"), "{refused}");
}

/// An arm of two links in a vertical plane, both hinges driven.
const ARM: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[bodies.upper]
mass = 2.0
inertia = [0.1, 0.1, 0.1]
position = [0.4, 0, 0]
[bodies.lower]
mass = 1.5
inertia = [0.1, 0.1, 0.1]
position = [1.1, 0, 0]
[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.elbow]
kind = "revolute"
base = "upper"
tip = "lower"
at = [0.8, 0, 0]
axis = [0, 0, 1]
[joints.first]
kind = "prescribed_rotation"
joint = "shoulder"
rotation = "0.8*sin(2*pi*t)"
[joints.second]
kind = "prescribed_rotation"
joint = "elbow"
rotation = "t"
[outputs.first]
kind = "reaction"
of = "first"
[outputs.second]
kind = "reaction"
of = "second"
[analysis]
kind = "statics"
end = 1
steps = 50
ramp = false
"#;

#[test]
fn statics_along_a_prescribed_motion_gives_the_torques_of_its_drives() {
    let (record, session) = record(ARM);
    let names: Vec<String> = session.columns().iter().map(lissom::Column::name).collect();
    let column = |drive: &str| {
        let name = names.iter().find(|name| name.starts_with(drive)).unwrap();
        let (owner, part) = name.split_once('.').unwrap();
        record.column(owner, part).unwrap()
    };
    let (first, second) = (column("first"), column("second"));
    // The start is an equilibrium as well: no torque is missing there, and no jump is reported.
    assert_eq!(session.warnings().count(), 0);
    for (k, &t) in record.times.iter().enumerate() {
        let (a, b) = (0.8 * (std::f64::consts::TAU * t).sin(), t);
        let lower = 1.5 * 9.81 * 0.3 * (a + b).cos();
        let upper = 9.81 * (2.0 * 0.4 + 1.5 * 0.8) * a.cos() + lower;
        assert!((first[k].abs() - upper.abs()).abs() < 1e-6, "{} for {upper} at {t}", first[k]);
        assert!((second[k].abs() - lower.abs()).abs() < 1e-6, "{} for {lower} at {t}", second[k]);
    }
}

/// A beam that turns about an axis at its root, and lies beside the axis's radius so that it is bent.
fn blade(initial: &str) -> String {
    format!(
        r#"
lissom = 1
[sections.blade]
shape = "general"
stiffness = [1e5, 1e5, 1e5, 50, 50, 50]
mass = [1, 1, 1, 1e-3, 5e-4, 5e-4]
[bodies.hub]
mass = 5.0
inertia = [1, 1, 1]
position = [0, 0, 0]
[joints.axle]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_rotation"
joint = "axle"
rotation = "12*t"
[beams.blade]
section = "blade"
from = [0.1, 0.1, 0]
to = [1.1, 0.1, 0]
elements = 8
up = [0, 0, 1]
[joints.root]
kind = "clamp"
base = "hub"
tip = "blade.start"
[outputs.tip]
kind = "displacement"
of = "blade.end"
[outputs.energy]
kind = "energy"
[initial]
angular_velocity = [0, 0, 12]
{initial}
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 0.2
step = 1e-3
"#
    )
}

#[test]
fn a_run_that_starts_in_steady_rotation_keeps_its_strain() {
    let strain = |initial: &str| {
        let (record, _) = record(&blade(initial));
        let strain = record.column("energy", "strain").unwrap();
        let (least, most) =
            strain.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), value| (a.min(*value), b.max(*value)));
        (least, most)
    };
    let (least, most) = strain("steady_rotation = true");
    assert!(least > 0.01 && (most - least) < 1e-6 * most, "{least} to {most}");
    // Without it the blade vibrates from rest.
    let (least, most) = strain("");
    assert!(least < 0.01 * most, "{least} to {most}");
    let both = blade("steady_rotation = true\nequilibrium = true");
    let refused = Model::from_text("model.toml", &both).document().unwrap_err().render(false);
    assert!(refused.contains("not both"), "{refused}");
    let across =
        blade("steady_rotation = true").replace("lissom = 1\n", "lissom = 1\ngravity = [0, -9.81, 0]\n");
    let document = Model::from_text("model.toml", &across).document().unwrap();
    assert!(Session::new(&document).is_err(), "gravity across the axis");
}

/// A pendulum on a shaft is at cos φ = g/(Ω² L). The rate of its hinge in a rigid rotation is zero to round-off, and
/// nothing is to be said of it.
#[test]
fn a_pendulum_on_a_shaft_starts_at_its_steady_angle_without_a_word() {
    let (rate, length) = (8.0_f64, 0.3_f64);
    let [x, z] = [length * 0.9_f64.sin(), -length * 0.9_f64.cos()];
    let text = format!(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.shaft]
mass = 1
inertia = [0.1, 0.1, 0.1]
[bodies.bob]
mass = 2
inertia = [1e-6, 1e-6, 1e-6]
position = [{x}, 0, {z}]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "shaft"
axis = [0, 0, 1]
[joints.motor]
kind = "prescribed_rotation"
joint = "bearing"
rotation = "{rate}*t"
[joints.hinge]
kind = "revolute"
base = "shaft"
tip = "bob"
at = [0, 0, 0]
axis = [0, -1, 0]
angle = 0.9
[initial]
angular_velocity = [0, 0, {rate}]
steady_rotation = true
[outputs.hinge]
kind = "relative"
of = "hinge"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#
    );
    let mut session = Model::from_text("model.toml", &text).session().unwrap();
    let record = session.run().unwrap();
    assert_eq!(session.warnings().count(), 0, "{:?}", session.warnings().collect::<Vec<_>>());
    // The bob is a point except for its small inertia.
    let steady = (9.81 / (rate * rate * length)).acos();
    for angle in record.column("hinge", "angle").unwrap() {
        assert!((angle - steady).abs() < 1e-8, "{angle} {steady}");
    }
}

/// A shaft that nothing holds against its torque has no equilibrium: no wheel is to blame where there is none.
#[test]
fn a_free_shaft_is_reported_without_a_word_of_wheels() {
    let text = r#"
lissom = 1
[bodies.shaft]
mass = 1
inertia = [0.1, 0.1, 0.1]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "shaft"
axis = [0, 0, 1]
[loads.motor]
kind = "joint_torque"
joint = "bearing"
torque = 1
[analysis]
kind = "statics"
"#;
    let (_, report) = Model::from_text("model.toml", text)
        .session()
        .unwrap()
        .run()
        .unwrap_or_else(lissom::Results::from)
        .into_parts();
    let words = format!("{report:?}");
    assert!(words.contains("it has no resistance") && !words.contains("wheel"), "{words}");
}

/// Drives that move an arm without load do work of round-off alone, which is no jump.
#[test]
fn the_kinematics_of_an_arm_without_loads_has_no_warning() {
    let arm = r#"
lissom = 1
[bodies.upper]
mass = 2
inertia = [0.01, 0.03, 0.03]
position = [0.2, 0, 0]
[bodies.lower]
mass = 1
inertia = [0.005, 0.01, 0.01]
position = [0.4, 0.15, 0]
[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.elbow]
kind = "revolute"
base = "upper"
tip = "lower"
at = [0.4, 0, 0]
axis = [0, 0, 1]
[joints.hand]
kind = "prescribed_motion"
base = "ground"
tip = "lower"
at = [0.4, 0.3, 0]
x = "0.05*t"
y = "0.1*t"
free = ["z", "rx", "ry", "rz"]
[outputs.shoulder]
kind = "relative"
of = "shoulder"
[analysis]
kind = "statics"
ramp = false
"#;
    for steps in ["steps = 50", "relative_tolerance = 1e-6"] {
        let (record, session) = record(&format!("{arm}{steps}\n"));
        // The law of cosines.
        let reach = 0.45_f64.hypot(0.4);
        let angle = 0.4_f64.atan2(0.45) - ((0.16 + reach * reach - 0.09) / (0.8 * reach)).acos();
        let found = record.column("shoulder", "angle").unwrap().last().unwrap();
        assert!((found - angle).abs() < 1e-9, "{steps}: {found} {angle}");
        let warnings: Vec<_> = session.warnings().map(ToString::to_string).collect();
        assert!(warnings.is_empty(), "{steps}: {warnings:?}");
    }
}
