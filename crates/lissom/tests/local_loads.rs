//! Loads that depend on the motion of their own points, beside closed forms and published flutter.

use lissom::modes::{ModeRequest, OperatingPoint, modes};
use lissom::{Model, Override, Record};

fn run(text: &str, set: &[(&str, &str)]) -> Record {
    let set: Vec<Override> = set.iter().map(|&(path, value)| (path.to_owned(), value.to_owned())).collect();
    let mut session = Model::from_text("model.toml", text).session(&set).unwrap_or_else(|e| panic!("{e}"));
    let (record, report) = session.record();
    assert!(report.error().is_none(), "{}", report.error().unwrap());
    let warnings: Vec<_> = session.warnings().map(|warning| warning.to_string()).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    record
}

fn last(record: &Record, output: &str, component: &str) -> f64 {
    *record.column(output, component).unwrap().last().unwrap()
}

fn problems(text: &str) -> String {
    let problem =
        Model::from_text("model.toml", text).session(&[]).err().expect("it is rejected").to_string();
    // Excerpts are wrapped.
    problem.split_whitespace().collect::<Vec<_>>().join(" ")
}

const FALL: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]

[parameters]
c = 0.1

[inputs]
wind = 0

[bodies.ball]
mass = 2
inertia = [1, 1, 1]
rotation = [0.4, -0.3, 0.9]

[local_loads.drag]
on = "ball"
flow = [0, 0, "wind"]
variables = { speed = "sqrt(u1^2 + u2^2 + u3^2)" }
force = ["c*speed*u1", "c*speed*u2", "c*speed*u3"]

[outputs.ball]
kind = "velocity"
of = "ball"

[outputs.drag]
kind = "local_load"
of = "drag"

[analysis]
kind = "dynamics"
end = 3
relative_tolerance = 1e-8
"#;

/// m v' = m g - c v²: v = w - V tanh(g t/V) in a rising wind w, with V² = m g/c, from v = w on.
#[test]
fn a_ball_falls_against_its_drag() {
    let limit = (2.0 * 9.81 / 0.1_f64).sqrt();
    for (wind, axes) in [("0", "section"), ("0", "global"), ("3", "section"), ("3", "global")] {
        let quoted = format!("\"{axes}\"");
        let velocity = format!("[0, 0, {wind}]");
        let set =
            [("inputs.wind", wind), ("local_loads.drag.axes", &quoted), ("bodies.ball.velocity", &velocity)];
        let record = run(FALL, &set);
        let relative = -limit * (9.81 * 3.0 / limit).tanh();
        let found = last(&record, "ball", "v3");
        let expected = wind.parse::<f64>().unwrap() + relative;
        assert!((found - expected).abs() < 1e-6, "{wind} {axes}: {found} {expected}");
        assert!((last(&record, "drag", "f3") - 0.1 * relative * relative).abs() < 1e-5);
        assert!((last(&record, "drag", "power") - 0.1 * relative * relative * found).abs() < 1e-4);
    }
}

const CABLE: &str = r#"
lissom = 1

[sections.cable]
shape = "general"
stiffness = [1e6, 1e5, 1e5, 1e-3, 1e-3, 1e-3]
mass = { per_length = 0.3, inertia = [2e-5, 1e-5, 1e-5], center = [0, 0] }

[beams.cable]
section = "cable"
curve = ["10*s", "2.32*s*(1 - s)", 0]
elements = 40
order = 2

[joints.left]
kind = "spherical"
base = "ground"
tip = "cable.start"

[joints.right]
kind = "spherical"
base = "ground"
tip = "cable.end"

[local_loads.wind]
on = "cable"
flow = [0, 20, 0]
variables = { across = "sqrt(u2^2 + u3^2)" }
force = [0, "0.01*across*u2", "0.01*across*u3"]

[outputs.middle]
kind = "position"
of = "cable@0.5"

[outputs.pull]
kind = "section_force"
of = "cable@0.5"

[outputs.end]
kind = "section_force"
of = "cable@0.05"

[analysis]
kind = "statics"
"#;

/// A weightless cable across a wind whose force per length is q cos²φ normal to it has the same tension T everywhere. With
/// φ' = q cos²φ/T its line is a catenary: y = c (cosh(x/c) - 1), c = T/q.
#[test]
fn a_cable_across_the_wind_is_a_catenary() {
    let record = run(CABLE, &[]);
    let [tension, at_end] = ["pull", "end"].map(|output| last(&record, output, "f1"));
    assert!((tension - at_end).abs() < 3e-3 * tension, "{tension} {at_end}");
    let c = tension / (0.01 * 20.0 * 20.0);
    let sag = c * ((5.0 / c).cosh() - 1.0);
    let found = last(&record, "middle", "y");
    assert!((found - sag).abs() < 3e-3 * sag, "{found} {sag}");
}

const BLADE: &str = r#"
lissom = 1

[parameters]
omega = 30
chord = 0.3
slope = 5.7
pitch = 0.05

[bodies.hub]
mass = 1
inertia = [1, 1, 1]

[initial]
angular_velocity = [0, 0, "omega"]

[joints.shaft]
kind = "revolute"
base = "ground"
tip = "hub"
axis = [0, 0, 1]

[joints.speed]
kind = "prescribed_rotation"
joint = "shaft"
rotation = "omega*t"

[sections.blade]
shape = "general"
stiffness = [1e9, 1e9, 1e9, 1e7, 1e7, 1e7]
mass = { per_length = 6, inertia = [0.02, 0.01, 0.01], center = [0, 0] }

[beams.blade]
section = "blade"
from = [0, 0, 0]
to = [5, 0, 0]
elements = 16
order = 1
up = [0, 0, 1]

[joints.flap]
kind = "revolute"
base = "hub"
tip = "blade.start"
axis = [0, -1, 0]

[local_loads.lift]
on = "blade"
force = [0, 0, "0.5*1.2*chord*slope*(pitch*u2^2 + u3*abs(u2))"]

[outputs.flap]
kind = "relative"
of = "flap"

[analysis]
kind = "dynamics"
end = 3
"#;

/// A hinged blade in hover, without inflow: β'' + (γ/8) Ω β' + Ω² β = (γ/8) Ω² θ with Lock's number γ = ρ a c R⁴/J, a coning angle
/// γ θ/8 and a damping ratio γ/16. The velocity at the hub is round-off, and `abs` has its kink there.
#[test]
fn a_hinged_blade_has_the_angle_and_damping_of_its_lock_number() {
    let lock = 1.2 * 5.7 * 0.3 * 5.0_f64.powi(3) * 3.0 * 5.0 / (6.0 * 125.0);
    let record = run(BLADE, &[]);
    let found = last(&record, "flap", "angle");
    assert!((found - lock * 0.05 / 8.0).abs() < 2e-3 * found, "{found} {}", lock * 0.05 / 8.0);
    let flap = record.column("flap", "angle").unwrap();
    // From rest it overshoots by exp(-π ζ/√(1 - ζ²)).
    let ratio = lock / 16.0;
    let most = flap.iter().copied().fold(0.0, f64::max);
    let overshoot = (-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt()).exp();
    assert!((most / found - 1.0 - overshoot).abs() < 0.02, "{} {overshoot}", most / found - 1.0);
}

const WING: &str = r#"
lissom = 1

[parameters]
U = 137
b = 0.9144       # semi-chord [m]
a = -0.34        # elastic axis behind mid-chord, in semi-chords
m = 35.71        # mass per length [kg/m]
cg = -0.18288    # centre of mass before the elastic axis [m]
am = "pi*1.225*b^2"
mid = "a*b"      # mid-chord before the elastic axis [m]
J = "8.64 + am*(mid^2 + b^2/8)"

[sections.wing]
shape = "general"
stiffness = [1e10, 1e10, 1e10, 9.87e5, 9.77e6, 1e10]
mass = [
  ["m", 0, 0, 0, 0, "-m*cg"],
  [0, "m", 0, 0, 0, 0],
  [0, 0, "m + am", "m*cg + am*mid", 0, 0],
  [0, 0, "m*cg + am*mid", "J", 0, 0],
  [0, 0, 0, 0, 0.1, 0],
  ["-m*cg", 0, 0, 0, 0, "J"],
]

[beams.wing]
section = "wing"
from = [0, 0, 0]
to = [0, 6.096, 0]
elements = 8
up = [0, 0, 1]

[joints.root]
kind = "clamp"
base = "ground"
tip = "wing.start"

[local_loads.air]
on = "wing"
flow = ["U", 0, 0]
variables = { w = "u3 + b*(0.5 - a)*w1", lift = "2*pi*1.225*b*U*(0.5*w + z1 + z2)" }
force = [0, 0, "lift + am*U*w1"]
moment = ["lift*b*(0.5 + a) - am*U*b*(0.5 - a)*w1", 0, 0]
states.z1 = { derivative = "U/b*0.0455*(0.165*w - z1)" }
states.z2 = { derivative = "U/b*0.3*(0.335*w - z2)" }

[analysis]
kind = "dynamics"
end = 1
"#;

/// Goland's wing flutters at 137 m/s and 70 rad/s [Goland 1945; Goland and Luke 1948]. Theodorsen's forces, with Wagner's function by
/// Jones' two states at each point; the apparent mass is part of the section.
#[test]
fn golands_wing_flutters_at_its_speed() {
    let growing = |speed: &str| {
        let set = vec![("parameters.U".to_owned(), speed.to_owned())];
        let request = ModeRequest {
            count: Some(6),
            shift: Some(11.0),
            about: Some(OperatingPoint::Undeformed),
            ..ModeRequest::default()
        };
        let report = modes(&Model::from_text("wing.toml", WING), &set, &request).unwrap();
        let modes = report.modes.iter().filter(|mode| mode.frequency > 5.0);
        let unstable: Vec<f64> = modes.filter(|mode| mode.damping < 0.0).map(|mode| mode.frequency).collect();
        unstable
    };
    assert_eq!(growing("136.5"), Vec::<f64>::new());
    let found = growing("138");
    assert!(found.len() == 1 && (found[0] - 70.0 / std::f64::consts::TAU).abs() < 0.15, "{found:?}");
}

#[test]
fn wrong_loads_are_rejected_with_a_remedy() {
    for (change, with, cause, remedy) in [
        ("c*speed*u1", "c*speed*u4", "cannot name `u4`", "did you mean `u1`"),
        ("\"wind\"]", "\"v1\"]", "cannot name `v1`", "function of x, y, z, t and inputs"),
        ("on = \"ball\"", "on = \"ground\"", "acts on the ground", "specify a beam"),
        ("sqrt(u1^2 + u2^2 + u3^2)", "speed + u1", "needs its own value", "let it be one of `states`"),
        ("c = 0.1", "c = 0.1\nspeed = 3", "the name of a parameter too", "another name"),
        ("speed = \"", "v1 = \"", "cannot contain the name `v1`", "another meaning"),
        ("c*speed*u1", "c*s*u1", "cannot name `s`", "only loads along a beam"),
        (
            "force = [\"c*speed*u1\", \"c*speed*u2\", \"c*speed*u3\"]\n",
            "",
            "neither `force` nor `moment`",
            "add `force",
        ),
    ] {
        let problem = problems(&FALL.replace(change, with));
        assert!(problem.contains(cause), "{cause}: {problem}");
        assert!(problem.contains(remedy), "{remedy}: {problem}");
    }
}
