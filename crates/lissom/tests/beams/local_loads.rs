//! Loads that depend on the motion of their own points, beside closed forms and published flutter.

use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::{Model, SessionError};

use crate::support::refused::refused;
use crate::support::runs::{last, run_without_warnings as run, session};
use crate::support::starts::record;

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

/// A chain that hangs in a uniform current is straight, at the angle of drag and weight per length, if its drag does not depend on the angle;
/// the tension grows from the free end on. The added mass of the water has no weight.
#[test]
fn a_chain_in_a_current_hangs_at_the_angle_of_drag_and_weight() {
    let text = CABLE
        .replace("lissom = 1", "lissom = 1\ngravity = [0, -9.81, 0]")
        .replace("curve = [\"10*s\", \"2.32*s*(1 - s)\", 0]", "curve = [\"2.2*s\", \"-5.6*s\", 0]")
        .replace("per_length = 0.3", "per_length = 0.5");
    let right = text.find("[joints.right]").unwrap()..text.find("[local_loads.wind]").unwrap();
    let mut text = text.replace("flow = [0, 20, 0]", "flow = [2, 0, 0]\naxes = \"global\"").replace(
        "variables = { across = \"sqrt(u2^2 + u3^2)\" }\nforce = [0, \"0.01*across*u2\", \"0.01*across*u3\"]",
        // 0.2 kg/m of the mass are those of the water.
        "force = [\"0.3*abs(u1)*u1\", \"0.2*9.81\", 0]",
    );
    text.replace_range(right, "");
    // Nothing but the support holds the chain against a rotation about itself.
    let text = text.replace(
        "kind = \"spherical\"\nbase = \"ground\"\ntip = \"cable.start\"",
        "kind = \"revolute\"\nbase = \"ground\"\ntip = \"cable.start\"\naxis = [0, 0, 1]",
    );
    // From the first load on, however small, the chain turns from its given line to that of equilibrium: a jump, which is reported.
    let mut session = Model::from_text("model.toml", &text).session().unwrap();
    let record = session.run().unwrap();
    let (drag, weight) = (0.3 * 4.0, 0.3 * 9.81);
    let [x, y] = ["x", "y"].map(|component| last(&record, "middle", component));
    assert!((x / -y - drag / weight).abs() < 1e-3, "{x} {y}");
    let tension = last(&record, "pull", "f1");
    let length = 0.5 * f64::hypot(2.2, 5.6);
    assert!((tension - length * f64::hypot(drag, weight)).abs() < 2e-3 * tension, "{tension}");
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
        let report = modes(&Model::from_text("wing.toml", WING).with_overrides(&set), &request).unwrap();
        let unstable = report.modes.iter().filter(|mode| mode.frequency > 5.0 && mode.damping < 0.0);
        unstable.map(|mode| mode.frequency).collect::<Vec<f64>>()
    };
    assert_eq!(growing("136.5"), Vec::<f64>::new());
    let found = growing("138");
    assert!(found.len() == 1 && (found[0] - 70.0 / std::f64::consts::TAU).abs() < 0.15, "{found:?}");
}

#[test]
fn wrong_loads_are_rejected_with_a_remedy() {
    for (change, with, cause, remedy) in [
        ("c*speed*u1", "c*speed*u4", "cannot name `u4`", "known here"),
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
        let problem = refused(&FALL.replace(change, with));
        let words = problem.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(cause) && words.contains(remedy), "{cause}: {problem}");
    }
}

/// A coefficient that grows in proportion to the speed: the quadratic drag of the first test.
#[test]
fn tables_over_two_expressions_are_interpolated() {
    let aerodyn = "! polars\n2 NumTabs\n0 Re\n2 NumAlf\n-180 0 0 0\n180 0 0 0\n0.0001 Re\n2 NumAlf\n-180 0 10 0\n180 0 10 0\n";
    let hawc2 =
        "1 set\n2 profiles\n1 2 0 thin\n-180 0 0 0\n180 0 0 0\n2 2 100 thick\n-180 0 10 0\n180 0 10 0\n";
    let limit = (2.0 * 9.81 / 0.1_f64).sqrt();
    for table in [
        "tables = [{ at = 0, table = [[-4, 0], [4, 0]] }, { at = 100, table = [[-4, 10], [4, 10]] }]",
        "polar = \"aerodyn.dat\", coefficient = \"cd\"",
        "polar = \"hawc2.dat\", coefficient = \"cd\"",
    ] {
        let text = FALL
            .replace("c*speed*u", "cd*u")
            .replace("[local_loads.drag]", "[local_loads.drag]\nvariables.angle = \"atan2(u3, 1 + u1^2)\"")
            .replace(
                "variables = { speed = \"sqrt(u1^2 + u2^2 + u3^2)\" }",
                "variables.speed = \"sqrt(u1^2 + u2^2 + u3^2)\"",
            )
            .replace(
                "force =",
                &format!("variables.cd = {{ of = [\"angle\", \"speed\"], {table} }}\nforce ="),
            );
        let files = [("aerodyn.dat", aerodyn), ("hawc2.dat", hawc2)];
        let files = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
        let mut session = Model::from_text("model.toml", &text).with_included(files).session().unwrap();
        let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
        assert!(report.error().is_none(), "{}", report.error().unwrap());
        let (found, expected) = (last(&record, "ball", "v3"), -limit * (9.81 * 3.0 / limit).tanh());
        assert!((found - expected).abs() < 1e-6, "{table}: {found} {expected}");
        for (change, with, cause, remedy) in [
            ("[\"angle\", \"speed\"]", "\"angle\"", "", "write two expressions"),
            ("at = 100", "at = 0", "do not ascend strictly", "ascending order"),
            (", coefficient = \"cd\"", "", "lacks `coefficient`", "\"cm\""),
            ("hawc2.dat\"", "hawc2.dat\", set = 2", "there is no set 2, but 1", "HAWC2"),
            (
                "coefficient",
                "columns = [\"a\", \"b\"], coefficient",
                "both `polar` and `columns`",
                "remove one",
            ),
        ] {
            let changed = text.replace(change, with);
            if changed != text {
                let model = Model::from_text("model.toml", &changed);
                let files = [("aerodyn.dat", aerodyn), ("hawc2.dat", hawc2)];
                let files = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
                let Err(SessionError::Model(report)) = model.with_included(files).session() else {
                    panic!("{changed} is accepted")
                };
                let problem = report.render(false);
                let words = problem.split_whitespace().collect::<Vec<_>>().join(" ");
                assert!(words.contains(cause) && words.contains(remedy), "{cause}: {problem}");
            }
        }
    }
}

#[test]
fn an_expression_without_a_value_ends_the_run_with_its_name() {
    for (expression, when) in [("sqrt(10 + v3)", "t = "), ("sqrt(-1 + 0*v3)", "t = 0")] {
        let text = FALL.replace("\"c*speed*u2\"", &format!("\"0*{expression}\""));
        let problem = match Model::from_text("model.toml", &text).session() {
            Ok(mut session) => session.run().expect_err("a failure").to_string(),
            Err(error) => error.to_string(),
        };
        let name = format!("`force` of local load `drag` = 0*{expression}");
        assert!(problem.contains(&name) && problem.contains(when), "{problem}");
    }
}

const WING_IN_WIND: &str = r#"
lissom = 1
[parameters]
wind = 15

chord = 0.1
rho = 1.2
[materials.aluminium]
E = 70e9
nu = 0.33
density = 2700
[sections.plate]
shape = "rectangle"
material = "aluminium"
width = 0.1
height = 0.001
[beams.wing]
section = "plate"
from = [0, 0, 0]
to = [0, 0, 0.6]
elements = 12
order = 1
up = [0, -1, 0]
[joints.root]
kind = "clamp"
base = "ground"
tip = "wing.start"
[local_loads.air]
on = "wing"
flow = ["wind", -0.3, 0]
force = [0, 0, "lift + apparent"]
moment = ["b/2*(lift - apparent)", 0, 0]
[local_loads.air.variables]
b = "chord/2"
apparent = "pi*rho*b^2*wind*w1"
w = "u3 + b*w1"
effective = "0.5*w + z1 + z2"
lift = "2*pi*rho*b*wind*effective/(1 + (effective/(0.25*wind))^2)"
[local_loads.air.states]
z1 = { derivative = "wind/(chord/2)*0.0455*(0.165*w - z1)" }
z2 = { derivative = "wind/(chord/2)*0.3*(0.335*w - z2)" }
[outputs.tip]
kind = "displacement"
of = "wing.end"
[analysis]
kind = "statics"
"#;

/// At rest the states of Wagner's function are those of the quasi-steady air; a motion from this equilibrium stays there.
#[test]
fn states_are_at_rest_in_statics() {
    let record = run(WING_IN_WIND, &[]);
    let quasi_steady = WING_IN_WIND.replace("0.5*w + z1 + z2", "w");
    let states =
        quasi_steady.find("[local_loads.air.states]").unwrap()..quasi_steady.find("[outputs.tip]").unwrap();
    let mut quasi_steady = quasi_steady;
    quasi_steady.replace_range(states, "");
    let quasi_steady = run(&quasi_steady, &[]);
    for component in ["u1", "u2", "u3"] {
        let [found, wanted] = [&record, &quasi_steady].map(|record| last(record, "tip", component));
        assert!((found - wanted).abs() < 1e-9 && wanted.abs() > 1e-5, "{component}: {found} {wanted}");
    }
    let moving = WING_IN_WIND.replace(
        "kind = \"statics\"",
        "kind = \"dynamics\"\nend = 0.5\nrelative_tolerance = 1e-6\n[initial]\nequilibrium = true",
    );
    let moving = run(&moving, &[]);
    for component in ["u1", "u2", "u3"] {
        let [found, wanted] = [&moving, &record].map(|record| last(record, "tip", component));
        assert!((found - wanted).abs() < 1e-6, "{component}: {found} {wanted}");
    }
}

const ACTUATOR: &str = r#"
lissom = 1

[bodies.a]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.3, 0, 0]

[bodies.b]
mass = 3
inertia = [0.1, 0.1, 0.1]
position = [0.3, 1.2, 0.9]
velocity = [0.2, 0, 0]

[outputs.line]
kind = "distance"
of = "b"
relative_to = "a"

[outputs.b]
kind = "position"
of = "b"

[loads.actuator]
kind = "force_between"
base = "a"
tip = "b"
force = "80*(1.2 - line.distance) - 3*line.rate"

[springs.same]
kind = "point"
base = "a"
tip = "b"
length = 1.2
stiffness = 80
damping = 3

[analysis]
kind = "dynamics"
end = 2
relative_tolerance = 1e-9
"#;

/// A force over distance and rate is a spring with a damper.
#[test]
fn a_force_between_points_that_names_their_distance_is_a_spring() {
    let spring = ACTUATOR.find("[springs.same]").unwrap();
    let load = ACTUATOR.find("[loads.actuator]").unwrap();
    let analysis = ACTUATOR.find("[analysis]").unwrap();
    let with_load = format!("{}{}", &ACTUATOR[..spring], &ACTUATOR[analysis..]);
    let with_spring = format!("{}{}", &ACTUATOR[..load], &ACTUATOR[spring..]);
    let [one, other] = [with_load, with_spring].map(|text| run(&text, &[]));
    for (output, component) in [("b", "x"), ("b", "y"), ("b", "z"), ("line", "distance"), ("line", "rate")] {
        let [one, other] = [&one, &other].map(|record| last(record, output, component));
        assert!((one - other).abs() < 1e-7, "{output}.{component}: {one} {other}");
    }
}

const ROTOR: &str = r#"
lissom = 1

[parameters]
m = 10
load = 98.1
k = 1e5

[bodies.rotor]
mass = "m"
inertia = [0.2, 0.1, 0.1]
rotation = [0, 0, 0]

[joints.plane]
kind = "planar"
base = "ground"
tip = "rotor"
axis = [1, 0, 0]

# A bearing whose matrices of stiffness and damping are not symmetric.
[local_loads.bearing]
on = "rotor"
axes = "global"
force = [0, "-k*dy - q*dz - c*v2", "q*dy - k*dz - c*v3"]

[analysis]
kind = "dynamics"
end = 1
"#;

/// A rigid rotor on a bearing with stiffness k, damping c and cross coupling q: m s² + c s + k ± i q = 0 is unstable beyond
/// q = c √(k/m).
#[test]
fn a_rotor_whirls_beyond_the_cross_coupling_that_damping_can_bear() {
    let onset = 40.0 * (1e5_f64 / 10.0).sqrt();
    for (share, is_stable) in [(0.99, true), (1.01, false)] {
        let text = ROTOR.replace("k = 1e5\n", &format!("k = 1e5\nc = 40\nq = {}\n", share * onset));
        let request = ModeRequest { about: Some(OperatingPoint::Undeformed), ..ModeRequest::default() };
        let report = modes(&Model::from_text("rotor.toml", &text), &request).unwrap();
        let least = report.modes.iter().filter(|mode| mode.frequency > 1.0).map(|mode| mode.damping);
        let least = least.fold(f64::INFINITY, f64::min);
        assert_eq!(least > 0.0, is_stable, "{share}: {least}");
    }
}

/// A beam that shares its end with a body, whose axes are others: a load on the end is in the axes of the section and at its end.
#[test]
fn a_load_on_a_shared_node_is_in_the_axes_of_the_section() {
    let text = r#"
lissom = 1

[bodies.mast]
mass = 1
inertia = [1, 1, 1]
rotation = [0, 0, 0.7]
position = [0, 0, 0]

[sections.boom]
shape = "general"
stiffness = [1e6, 1e6, 1e6, 1e4, 1e4, 1e4]
mass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3], center = [0, 0] }

[beams.boom]
section = "boom"
from = [0, 2, 0]
to = "mast"
elements = 4
up = [0, 0, 1]

[joints.root]
kind = "clamp"
base = "ground"
tip = "boom.start"

[local_loads.push]
on = "boom.end"
force = [3, 0, 0]

[outputs.push]
kind = "local_load"
of = "push"

[analysis]
kind = "statics"
"#;
    let record = run(text, &[]);
    // The section's axis 1 is from the start to the end.
    let [f1, f2] = ["f1", "f2"].map(|component| last(&record, "push", component));
    assert!(f1.abs() < 1e-3 && (f2 + 3.0).abs() < 1e-6, "{f1} {f2}");
}

/// A load that grows along a cantilever, with a name for its size.
const CANTILEVER: &str = r#"
lissom = 1
[sections.s]
shape = "general"
stiffness = [1e6, 4e5, 4e5, 100, 2000, 2000]
mass = { per_length = 1, inertia = [2e-4, 1e-4, 1e-4] }
[beams.wing]
section = "s"
from = [0, 0, 0]
to = [2, 0, 0]
elements = 4
[joints.root]
kind = "clamp"
base = "ground"
tip = "wing.start"
[local_loads.air]
on = "wing"
axes = "global"
variables = { lift = "5*(1 + s)" }
force = [0, 0, "lift"]
moment = [0.25, 0, 0]
[outputs.whole]
kind = "local_load"
of = "air"
[outputs.middle]
kind = "local_load"
of = "air"
station = 0.5
[analysis]
kind = "statics"
"#;

/// Per length at a station what the load says there, and in all what a trapezoidal rule over the nodes makes of it.
#[test]
fn a_load_is_recorded_at_a_station_and_as_a_whole() {
    let record = run(CANTILEVER, &[]);
    let at = |output, component| last(&record, output, component);
    for (component, exact) in [("f1", 0.0), ("f3", 7.5), ("m1", 0.25), ("lift", 7.5)] {
        assert!((at("middle", component) - exact).abs() < 1e-12, "{component}");
    }
    assert!((at("whole", "f3") - 15.0).abs() < 1e-9, "{}", at("whole", "f3"));
    let units: Vec<(String, String)> = session(CANTILEVER, &[])
        .columns()
        .iter()
        .filter(|column| column.output == "middle")
        .map(|column| (column.component.clone(), column.unit.clone()))
        .collect();
    let unit =
        |component: &str| units.iter().find(|(own, _)| own == component).map(|(_, unit)| unit.as_str());
    assert_eq!([unit("f3"), unit("m1"), unit("lift")], [Some("N/m"), Some("N"), Some("")]);
}

#[test]
fn stations_without_a_load_are_refused_with_the_nearest() {
    for (station, load, words) in [
        ("0.55", "on = \"wing\"", "does not act on `wing` at 0.55"),
        ("0.55", "on = \"wing\"", "it acts at the nodes of the beam, the nearest at 0.5690983 and 0.5"),
        ("0.5", "on = \"wing.end\"", "acts on a node, so it has no stations"),
    ] {
        let text = CANTILEVER.replace("station = 0.5", &format!("station = {station}"));
        let text = text.replace("on = \"wing\"", load).replace("5*(1 + s)", "5");
        let message = refused(&text);
        assert!(message.contains(words), "{message}");
    }
}

const RELATIVE: &str = r#"
lissom = 1

[bodies.hub]
mass = 5
inertia = [1, 1, 1]
position = [1, 2, 3]
rotation = [0.3, -0.2, 0.5]

[bodies.blade]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [1.5, 2.4, 3.7]
rotation = [-0.4, 0.1, 0.2]

[joints.carriage]
kind = "prescribed_motion"
base = "ground"
tip = "hub"
x = "0.2*t"
y = "0.5*t^2"
z = "-0.3*t"

[joints.shaft]
kind = "revolute"
base = "hub"
tip = "blade"
at = [1, 2, 3]
axis = [2, 1, 2]

[joints.drive]
kind = "prescribed_rotation"
joint = "shaft"
rotation = "0.7*t"

[local_loads.place]
on = "blade"
about = "hub"
axis = [2, 1, 2]
force = ["r1", "r2", "r3"]

[local_loads.motion]
on = "blade"
about = "hub"
axis = [2, 1, 2]
force = ["n2*r3 - n3*r2", "n3*r1 - n1*r3", "n1*r2 - n2*r1"]

[outputs.place]
kind = "local_load"
of = "place"

[outputs.motion]
kind = "local_load"
of = "motion"

[outputs.hub]
kind = "position"
of = "hub"

[outputs.blade]
kind = "position"
of = "blade"

[outputs.of_hub]
kind = "velocity"
of = "hub"

[outputs.of_blade]
kind = "velocity"
of = "blade"

[analysis]
kind = "dynamics"
end = 2
step = 0.01
"#;

/// In whichever axes the load is written, r is the distance of both origins, and n × r times the rate of a shaft along n the difference
/// of their velocities.
#[test]
fn a_load_has_the_position_relative_to_another_node() {
    for axes in ["\"section\"", "\"global\"", "\"part\""] {
        let record = run(RELATIVE, &[("local_loads.place.axes", axes), ("local_loads.motion.axes", axes)]);
        for k in 0..3 {
            let [force, place, rate] = [["f1", "f2", "f3"][k], ["x", "y", "z"][k], ["v1", "v2", "v3"][k]];
            let between = last(&record, "blade", place) - last(&record, "hub", place);
            let moved = last(&record, "of_blade", rate) - last(&record, "of_hub", rate);
            let [found, turned] = ["place", "motion"].map(|output| last(&record, output, force));
            assert!((found - between).abs() < 1e-9, "{axes} {place}: {found} {between}");
            assert!(between.abs() > 0.1, "{axes} {place}: {between}");
            assert!((0.7 * turned - moved).abs() < 1e-6, "{axes} {rate}: {turned} {moved}");
        }
    }
}

/// The axis of a load in a part is given in the axes of the part, whatever the axes of the load are.
#[test]
fn the_axis_of_a_load_turns_with_its_part() {
    let load = r#"
[parts.turned]
rotation = [0, 0, "pi/2"]

[parts.turned.local_loads.axis]
on = "ball"
about = "ball"
axis = [2, 0, 0]
axes = "section"
force = ["n1", "n2", "n3"]

[outputs.axis]
kind = "local_load"
of = "turned.axis"
"#;
    let text = format!("{FALL}{load}");
    for axes in ["section", "global", "part"] {
        let record = run(&text.replace("\"section\"", &format!("\"{axes}\"")), &[]);
        for (component, expected) in [("f1", 0.0), ("f2", 1.0), ("f3", 0.0)] {
            let found = record.column("axis", component).unwrap()[0];
            assert!((found - expected).abs() < 1e-12, "{axes} {component}: {found}");
        }
    }
}

/// A box with the velocity w = 3 + 0.02 z + 0.5 t + 0.1 y upwards from the height -40 m on.
fn wind_box(format: i16) -> Vec<u8> {
    let mut bytes = format.to_le_bytes().to_vec();
    bytes.extend([2_i32, 3, 0, 6].iter().flat_map(|count| count.to_le_bytes()));
    bytes.extend([50.0_f32, 5.0, 1.0, 0.0, 0.0, -40.0].iter().flat_map(|real| real.to_le_bytes()));
    bytes.extend([1.0_f32, 0.0, 1.0, 0.0, 1000.0, -500.0].iter().flat_map(|real| real.to_le_bytes()));
    bytes.extend(0_i32.to_le_bytes());
    for (instant, z, y) in (0..6).flat_map(|t| (0..6).map(move |place| (t, place / 3, place % 3))) {
        let w = 3000 + 20 * (50 * z - 40) + 500 * instant + 500 * (y - 1);
        bytes.extend([0, 0, w - 500].iter().flat_map(|own| i16::try_from(*own).unwrap().to_le_bytes()));
    }
    bytes
}

/// The ball of the first test in wind of a file, and in the same wind as an expression; beyond the file the run fails.
#[test]
fn wind_of_a_file_is_that_of_an_expression() {
    let folder = std::env::temp_dir().join(format!("lissom-wind-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("wind.bts"), wind_box(7)).unwrap();
    let ball = FALL
        .replace("inertia = [1, 1, 1]", "inertia = [1, 1, 1]\nposition = [0, 1, 0]\nvelocity = [0, 0.3, 0]")
        .replace(
            "variables = { speed = \"sqrt(u1^2 + u2^2 + u3^2)\" }",
            "variables.speed = \"sqrt(u1^2 + u2^2 + u3^2)\"",
        );
    let wind = "variables.w = { of = [\"y\", \"z\", \"t\"], wind = \"wind.bts\", component = \"w\" }\nforce";
    let of_file = ball.replace("\"wind\"]", "\"w\"]").replace("force", wind);
    let of_expression = ball.replace("\"wind\"]", "\"3 + 0.02*z + 0.5*t + 0.1*y\"]");
    let run = |text: &str| {
        let path = folder.join("model.toml");
        std::fs::write(&path, text).unwrap();
        let mut session = Model::read(&path).unwrap().session()?;
        let record = session.run().map_err(|failure| failure.to_string()).map(|done| done.into_parts().0);
        Ok::<_, SessionError>(record)
    };
    let [found, expected] = [&of_file, &of_expression].map(|text| run(text).unwrap().unwrap());
    for component in ["v2", "v3"] {
        let [found, expected] = [&found, &expected].map(|record| last(record, "ball", component));
        assert!((found - expected).abs() < 1e-6, "{component}: {found} {expected}");
        assert!((found - 0.3).abs() > 0.01);
    }
    for (text, words) in [
        (of_file.replace("end = 3", "end = 6"), "z = -40 to 10 m and t = 0 to 5 s"),
        (of_file.replace("[0, 1, 0]", "[0, 6, 0]"), "y = -5 to 5 m"),
    ] {
        let problem = match run(&text) {
            Ok(result) => result.expect_err("a failure"),
            Err(error) => error.to_string(),
        };
        assert!(
            problem.contains("variable `w` of local load `drag`") && problem.contains(words),
            "{problem}"
        );
    }
    for (text, words) in [
        (of_file.replace("wind.bts", "calm.bts"), "cannot be read"),
        (of_file.replace(", component = \"w\"", ""), "lacks `component`"),
        (of_file.replace("[\"y\", \"z\", \"t\"]", "[\"z\", \"t\"]"), "has `wind` over 2 expressions"),
        (of_file.replace("\"z\", \"t\"]", "\"z\", \"t\"], polar = \"a\""), "has both `wind` and a table"),
    ] {
        let Err(SessionError::Model(report)) = run(&text) else { panic!("{words}: accepted") };
        let problem = report.render(false);
        let problem = problem.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(problem.contains(words), "{words}: {problem}");
    }
    // A model that is kept with its texts, as in a checkpoint, needs no file.
    std::fs::write(folder.join("model.toml"), &of_file).unwrap();
    let model = Model::read(&folder.join("model.toml")).unwrap();
    model.session().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let kept = Model::from_text("model.toml", &of_file).with_included(model.included());
    let again = record(&mut kept.session().unwrap());
    assert!((last(&again, "ball", "v3") - last(&found, "ball", "v3")).abs() < 1e-12);
}

const STALL: &str = r#"
lissom = 1

[parameters]
speed = 20
chord = 0.5

[bodies.section]
mass = 1
inertia = [1, 1, 1]

[joints.root]
kind = "clamp"
base = "ground"
tip = "section"

[local_loads.air]
on = "section"
flow = ["-speed*cos(angle)", 0, "speed*sin(angle)"]
force = [0, 0, "cl"]

[local_loads.air.variables]
angle = "0.15 + 0.15*smoothstep((t - 0.1)/1e-6)"
alpha = "atan2(u3, -u1)"
steady = { of = "alpha", table = [[-0.1, -0.6], [0.2, 1.2], [0.4, 0.9]] }
attached = "2*pi*sin(alpha)"
cl = "attached - gap"

[local_loads.air.states]
gap = { derivative = "(attached - steady - gap)*speed/(4*chord)" }

[outputs.air]
kind = "local_load"
of = "air"

[initial]
equilibrium = true

[analysis]
kind = "dynamics"
end = 0.2
relative_tolerance = 1e-8
"#;

/// The recipe of the manual for dynamic stall: after a jump of the angle of attack the lift follows the attached flow, and approaches the
/// polar with the time constant 4 c/U.
#[test]
fn lift_approaches_the_polar_after_a_jump_of_the_angle() {
    let gap = |alpha: f64, steady: f64| 2.0 * std::f64::consts::PI * alpha.sin() - steady;
    let record = run(STALL, &[]);
    let (before, after) = (gap(0.15, 0.9), gap(0.3, 1.05));
    assert!((record.column("air", "f3").unwrap()[0] - 0.9).abs() < 1e-9);
    let expected = 2.0 * std::f64::consts::PI * 0.3_f64.sin() - (after + (before - after) * (-1.0_f64).exp());
    let found = last(&record, "air", "f3");
    assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    assert!((found - 1.05).abs() > 0.1);
}
