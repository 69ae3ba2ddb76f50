//! Kinds of joints against closed forms, and all of them with every scheme, with chosen steps and restarted.

use lissom::{Model, Record};

use crate::support::refused::refused;
use crate::support::runs;
use runs::{SCHEMES, column, goes_on_from_a_snapshot, last, run, session};

pub(crate) const EVERY_KIND: &str = include_str!("../models/every_kind.toml");
const OUTPUTS: &str = "
[outputs.nut]
kind = \"position\"
of = \"nut\"
[outputs.half_shaft]
kind = \"position\"
of = \"half_shaft\"
[outputs.carriage]
kind = \"position\"
of = \"carriage\"
[outputs.table]
kind = \"reaction\"
of = \"table\"
";

#[test]
fn all_kinds_run_with_every_scheme_and_with_chosen_steps() {
    let text = format!("{EVERY_KIND}{OUTPUTS}");
    let reference =
        run(&text, &[("analysis.end", "0.2"), ("analysis.step", "2e-4"), ("analysis.scheme", "radau-iia")]);
    let ends = |record: &Record| {
        ["nut", "half_shaft", "carriage"]
            .iter()
            .flat_map(|body| ["x", "y", "z"].map(|axis| last(record, body, axis)))
            .collect::<Vec<_>>()
    };
    let near = |record: &Record, tolerance: f64, what: &str| {
        for (a, b) in ends(record).iter().zip(ends(&reference)) {
            assert!((a - b).abs() < tolerance, "{what}: {a} {b}");
        }
    };
    for scheme in SCHEMES {
        let overrides = [("analysis.end", "0.2"), ("analysis.step", "1e-3"), ("analysis.scheme", scheme)];
        near(&run(&text, &overrides), 2e-5, scheme);
    }
    let chosen = EVERY_KIND
        .replace("step = 2e-3", "relative_tolerance = 1e-5")
        .replace("scheme = \"energy-decaying\"\n", "");
    near(&run(&format!("{chosen}{OUTPUTS}"), &[("analysis.end", "0.2")]), 1e-4, "chosen steps");
}

#[test]
fn all_kinds_go_on_from_a_snapshot_to_the_last_bit() {
    goes_on_from_a_snapshot(&format!("{EVERY_KIND}{OUTPUTS}"), [0.1, 0.2]);
}

/// A nut on a thread, released: with p = lead/2π, d̈ = -g m / (m + J/p²).
#[test]
fn a_nut_falls_as_its_lead_lets_it() {
    let record = run(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.nut]
mass = 2
inertia = [0.01, 0.01, 0.003]
[joints.spindle]
kind = "screw"
base = "ground"
tip = "nut"
at = [0, 0, 0]
axis = [0, 0, 1]
lead = 0.1
[outputs.nut]
kind = "position"
of = "nut"
[outputs.spindle]
kind = "relative"
of = "spindle"
[outputs.thread]
kind = "reaction"
of = "spindle"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.01
"#,
        &[],
    );
    let pitch = 0.1 / std::f64::consts::TAU;
    let acceleration = -9.81 * 2.0 / (2.0 + 0.003 / (pitch * pitch));
    let (z, angle) = (last(&record, "nut", "z"), last(&record, "spindle", "angle"));
    assert!((z - 0.5 * acceleration).abs() < 1e-10, "{z} {}", 0.5 * acceleration);
    assert!((z - pitch * angle).abs() < 1e-14, "{z} {angle}");
    // On the nut: m (d̈ + g) along the axis, and J φ̈ about it.
    let (force, moment) = (last(&record, "thread", "f3"), last(&record, "thread", "m3"));
    assert!((force - 2.0 * (acceleration + 9.81)).abs() < 1e-8, "{force}");
    assert!((moment - 0.003 * acceleration / pitch).abs() < 1e-8, "{moment}");
}

/// Two shafts bent by 0.6 rad: the output turns as the input, at any angle.
#[test]
fn a_constant_velocity_joint_keeps_the_velocity() {
    let text = r#"
lissom = 1
[bodies.input]
mass = 1
inertia = [0.01, 0.01, 0.01]
[bodies.output]
mass = 1
inertia = [0.01, 0.01, 0.01]
[joints.bearing]
kind = "revolute"
base = "ground"
tip = "input"
at = [0, 0, 0]
axis = [1, 0, 0]
[joints.motor]
kind = "prescribed_rotation"
joint = "bearing"
rotation = "3*t + 0.5*sin(5*t)"
[joints.end_bearing]
kind = "parallel_axes"
base = "ground"
tip = "output"
axis = ["cos(0.6)", "sin(0.6)", 0]
[joints.rzeppa]
kind = "constant_velocity"
base = "input"
tip = "output"
at = [0, 0, 0]
axis = [1, 0, 0]
tip_axis = ["-cos(0.6)", "-sin(0.6)", 0]
[outputs.in]
kind = "relative"
of = "bearing"
[outputs.out]
kind = "relative"
of = "end_bearing"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2.0
step = 0.01
"#;
    let record = run(text, &[]);
    let (angles, turned) = (column(&record, "in", "angle"), column(&record, "out", "angle"));
    assert!(angles.iter().zip(turned).all(|(a, b)| (a - b).abs() < 1e-11));
    assert!(turned.last().copied().unwrap_or(0.0) > 5.0);
    let square = text.replace("tip_axis = [\"-cos(0.6)\", \"-sin(0.6)\", 0]", "tip_axis = [0, 0, 1]");
    assert!(refused(&square).contains("perpendicular"));
}

fn sliding(joint: &str, outputs: &str) -> Record {
    run(
        &format!(
            r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.block]
mass = 3
inertia = [0.01, 0.02, 0.03]
[joints.slide]
base = "ground"
tip = "block"
at = [0, 0, 0]
{joint}
[outputs.block]
kind = "position"
of = "block"
[outputs.slide]
kind = "reaction"
of = "slide"
{outputs}
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.01
"#
        ),
        &[],
    )
}

/// On a plane sloping by 0.3 rad: ½ g sin 0.3 t² along it, and the weight's part across it as reaction.
#[test]
fn blocks_slide_down_planes_and_lines() {
    let (sine, cosine) = 0.3_f64.sin_cos();
    let way = 0.5 * 9.81 * sine;
    for kind in ["planar", "point_in_plane", "generic"] {
        let axes = if kind == "generic" {
            // z is across both axes.
            "locked = [\"z\", \"rx\"]\naxis = [\"cos(0.3)\", 0, \"-sin(0.3)\"]\nsecond_axis = [0, 1, 0]"
        } else {
            "axis = [\"sin(0.3)\", 0, \"cos(0.3)\"]"
        };
        let record = sliding(&format!("kind = \"{kind}\"\n{axes}"), "");
        for (axis, wanted) in [("x", way * cosine), ("y", 0.0), ("z", -way * sine)] {
            let found = last(&record, "block", axis);
            assert!((found - wanted).abs() < 1e-11, "{kind}: {axis} {found} {wanted}");
        }
        for (axis, wanted) in [("f1", sine), ("f2", 0.0), ("f3", cosine), ("m1", 0.0), ("m2", 0.0)] {
            let (found, wanted) = (last(&record, "slide", axis), 3.0 * 9.81 * cosine * wanted);
            assert!((found - wanted).abs() < 1e-8, "{kind}: {axis} {found} {wanted}");
        }
    }
    let line = "axis = [\"cos(0.3)\", 0, \"-sin(0.3)\"]";
    for kind in ["point_on_line", "inline"] {
        let outputs = "[outputs.way]\nkind = \"relative\"\nof = \"slide\"";
        let has_coordinate = kind == "point_on_line";
        let record =
            sliding(&format!("kind = \"{kind}\"\n{line}"), if has_coordinate { outputs } else { "" });
        assert!((last(&record, "block", "x") - way * cosine).abs() < 1e-11, "{kind}");
        if has_coordinate {
            assert!((last(&record, "way", "displacement") - way).abs() < 1e-11);
            assert!((last(&record, "way", "velocity") - 2.0 * way).abs() < 1e-10);
        }
    }
}

/// Thrown with a spin about all axes: of it the joint leaves what its axes allow.
#[test]
fn axes_stay_parallel_or_perpendicular() {
    let thrown = |joint: &str| {
        run(
            &format!(
                r#"
lissom = 1
[bodies.a]
mass = 1
inertia = [0.01, 0.02, 0.03]
angular_velocity = [1, 2, 3]
[joints.j]
base = "ground"
tip = "a"
{joint}
[outputs.spin]
kind = "angular_velocity"
of = "a"
[outputs.centre]
kind = "position"
of = "a"
[outputs.arm]
kind = "position"
of = "a"
point = [0, 1, 0]
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.005
"#
            ),
            &[],
        )
    };
    let parallel = thrown("kind = \"parallel_axes\"\naxis = [0, 0, 1]");
    for (component, wanted) in [("w1", 0.0), ("w2", 0.0), ("w3", 3.0)] {
        assert!((last(&parallel, "spin", component) - wanted).abs() < 1e-12, "{component}");
    }
    // The tip's y stays across global x: it has no x component, though it leaves y.
    let perpendicular = thrown("kind = \"perpendicular_axes\"\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]");
    let along = |axis: &str| last(&perpendicular, "arm", axis) - last(&perpendicular, "centre", axis);
    assert!(along("x").abs() < 1e-12, "{}", along("x"));
    assert!(along("y") < 0.9, "{}", along("y"));
}

/// The generic joint with the degrees of freedom of another one moves as that one.
#[test]
fn the_generic_joint_is_any_of_the_others() {
    let pendulum = |joint: &str| {
        let record = run(
            &format!(
                r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.a]
mass = 1
inertia = [0.01, 0.02, 0.03]
position = [0.5, 0.1, 0]
[joints.j]
base = "ground"
tip = "a"
at = [0, 0, 0]
{joint}
[outputs.a]
kind = "position"
of = "a"
[outputs.j]
kind = "reaction"
of = "j"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.002
"#
            ),
            &[],
        );
        let places = ["x", "y", "z"].map(|axis| last(&record, "a", axis)).to_vec();
        let forces = ["f1", "f2", "f3", "m1", "m2", "m3"].map(|axis| last(&record, "j", axis)).to_vec();
        [places, forces]
    };
    let axes = "axis = [1, 0, 0.2]\nsecond_axis = [0, 1, 0]";
    for (locked, other) in [
        ("[\"x\", \"y\", \"z\", \"rx\", \"rz\"]", "kind = \"revolute\"\naxis = [0, 1, 0]"),
        ("[\"x\", \"y\", \"z\"]", "kind = \"spherical\""),
        ("[\"y\", \"z\", \"rx\", \"ry\", \"rz\"]", "kind = \"prismatic\"\naxis = [1, 0, 0.2]"),
        ("[\"y\", \"z\", \"ry\", \"rz\"]", "kind = \"cylindrical\"\naxis = [1, 0, 0.2]"),
        ("[\"x\", \"y\", \"z\", \"rz\"]", &format!("kind = \"universal\"\n{axes}")),
    ] {
        let generic = pendulum(&format!("kind = \"generic\"\nlocked = {locked}\n{axes}"));
        for (a, b) in generic.iter().flatten().zip(pendulum(other).iter().flatten()) {
            assert!((a - b).abs() < 1e-6 * (1.0 + b.abs()), "{locked}: {a}, {b} of {other}");
        }
    }
}

#[test]
fn wrong_locks_are_reported() {
    let told_of = |lines: &str| {
        let text = format!(
            "lissom = 1\n[bodies.a]\nmass = 1\ninertia = [1, 1, 1]\n[joints.j]\nkind = \"generic\"\n\
             base = \"ground\"\ntip = \"a\"\n{lines}\n[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.1\n"
        );
        refused(&text)
    };
    for (lines, words) in [
        ("locked = []", "is empty"),
        ("locked = [\"x\", \"x\"]", "twice"),
        ("locked = [\"rw\"]", "cannot contain `rw`"),
        ("locked = \"x\"", "list of words"),
        ("locked = [\"x\"]\naxis = [1, 0, 0]", "specify both axes"),
        ("locked = [\"x\"]\naxis = [1, 0, 0]\nsecond_axis = [1, 1, 0]", "not at 90"),
    ] {
        let error = told_of(lines);
        assert!(error.contains(words), "{lines}: {error}");
    }
}

/// A slider on an arm that turns at a constant rate: r̈ = ω² r, and the guide's side force is Coriolis's, 2 m ω ṙ. The
/// reaction is reported in global axes, in those of the arm and in those of the slider.
#[test]
fn a_slider_on_a_turning_arm_feels_coriolis() {
    let record = run(
        r#"
lissom = 1
[bodies.arm]
mass = 1
inertia = [0.01, 0.1, 0.1]
[bodies.slider]
mass = 0.5
inertia = [0.001, 0.001, 0.001]
position = [0.2, 0, 0]
[joints.hub]
kind = "revolute"
base = "ground"
tip = "arm"
at = [0, 0, 0]
axis = [0, 0, 1]
[joints.motor]
kind = "prescribed_rotation"
joint = "hub"
rotation = "2*t"
[joints.guide]
kind = "prismatic"
base = "arm"
tip = "slider"
axis = [1, 0, 0]
[outputs.guide]
kind = "relative"
of = "guide"
[outputs.pull]
kind = "relative_acceleration"
of = "guide"
[outputs.from_arm]
kind = "relative_motion"
of = "guide"
[outputs.global]
kind = "reaction"
of = "guide"
[outputs.along]
kind = "reaction"
of = "guide"
axes = "base"
[outputs.on_slider]
kind = "reaction"
of = "guide"
axes = "tip"
[outputs.motor]
kind = "reaction"
of = "motor"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.0
step = 0.001
"#,
        &[],
    );
    let (rate, time) = (2.0_f64, 1.0);
    let radius = 0.2 * (rate * time).cosh();
    let speed = 0.2 * rate * (rate * time).sinh();
    assert!((last(&record, "guide", "displacement") - (radius - 0.2)).abs() < 1e-8);
    assert!((last(&record, "pull", "a") - rate * rate * radius).abs() < 1e-5);
    // The joint frame's third axis is along the arm, the first across it.
    assert!((last(&record, "from_arm", "z") - (radius - 0.2)).abs() < 1e-8);
    for component in ["x", "y", "r1", "r2", "r3"] {
        assert!(last(&record, "from_arm", component).abs() < 1e-11, "{component}");
    }
    let coriolis = 2.0 * 0.5 * rate * speed;
    let force = |output: &str| ["f1", "f2", "f3"].map(|axis| last(&record, output, axis));
    let global = force("global");
    let side = -global[0] * rate.sin() + global[1] * rate.cos();
    assert!((side - coriolis).abs() < 1e-3 * coriolis, "{side} {coriolis}");
    assert!((global[0] * rate.cos() + global[1] * rate.sin()).abs() < 1e-6 * coriolis);
    for output in ["along", "on_slider"] {
        let [first, second, third] = force(output);
        assert!(third.abs() < 1e-6 * coriolis, "{output}: {third}");
        assert!((first.hypot(second) - side.abs()).abs() < 1e-9 * coriolis, "{output}");
        assert!(first.abs() < 1e-6 || second.abs() < 1e-6, "{output}: one of them is normal to the plane");
    }
    // The motor bears the moment of that force.
    assert!((last(&record, "motor", "moment") - coriolis * radius).abs() < 1e-2 * coriolis);
}

/// A plane across the fall bears nothing: its multiplier is round-off of how far the body goes, however it is turned.
#[test]
fn a_turned_body_falls_along_a_plane_that_bears_nothing() {
    let model = |locked: &str| {
        format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.a]\nmass = 1\ninertia = [0.012, 0.018, 0.019]\n\
             position = [0, 0, 0]\nrotation = [-1.0, -0.76, -0.43]\n\
             [joints.plane]\nkind = \"generic\"\nbase = \"ground\"\ntip = \"a\"\nlocked = {locked}\n\
             [outputs.a]\nkind = \"position\"\nof = \"a\"\n\
             [analysis]\nkind = \"dynamics\"\nend = 0.2\nstep = 1e-3\n"
        )
    };
    for locked in ["[\"x\"]", "[\"x\", \"rx\", \"ry\", \"rz\"]", "[\"x\", \"y\"]"] {
        for scheme in SCHEMES {
            let text = model(locked);
            let mut session = session(&text, &[("analysis.scheme", scheme)]);
            let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
            assert!(report.is_complete(), "{locked} {scheme}: {:?}", report.error());
            let fallen = last(&record, "a", "z");
            assert!((fallen + 0.5 * 9.81 * 0.2 * 0.2).abs() < 1e-5, "{locked} {scheme}: {fallen}");
            let factorizations = report.totals.factorizations;
            assert!(factorizations < 40, "{locked} {scheme}: {factorizations} tangents");
        }
    }
}

/// Records at distances of the longest step are met without a step as long as a rounding.
#[test]
fn chosen_steps_are_never_round_off() {
    let text = "lissom = 1\n[bodies.a]\nmass = 1\ninertia = [0.01, 0.02, 0.02]\nposition = [0.3, 0, 0]\n\
                [loads.push]\nkind = \"force\"\non = \"a\"\nvector = [1e-9, 0, 0]\n\
                [outputs.a]\nkind = \"position\"\nof = \"a\"\n\
                [analysis]\nkind = \"dynamics\"\nend = 0.4\nrelative_tolerance = 1e-4\noutput_step = 0.02\nscheme = \"radau-iia\"\n";
    let mut session = Model::from_text("rests.toml", text).session().unwrap();
    let mut before = 0.0;
    while !session.is_finished() {
        session.advance().unwrap();
        let time = session.progress().time;
        assert!(time - before > 1e-9, "a step of {:e} s at {time}", time - before);
        before = time;
    }
}

const TELESCOPE: &str = r#"
lissom = 1
[bodies.bob]
mass = 2
inertia = [0.1, 0.1, 0.1]
position = [1.5, 0, 0]
velocity = [0.3, 2, 0]
[joints.rod]
kind = "telescopic_rod"
base = "ground"
tip = "bob"
displacement = 1.5
ALONG
[outputs.bob]
kind = "position"
of = "bob"
[outputs.speed]
kind = "velocity"
of = "bob"
[outputs.rod]
kind = "relative"
of = "rod"
[outputs.line]
kind = "distance"
of = "bob"
[outputs.reaction]
kind = "reaction"
of = "rod"
[analysis]
kind = "dynamics"
end = 1.2
relative_tolerance = 1e-9
"#;

/// A rod of prescribed length ℓ about a fixed point conserves ℓ² ω, and its tension is m (ℓ ω² - ℓ'').
#[test]
fn a_rod_of_prescribed_length_conserves_the_angular_momentum() {
    let drive = "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"rod\"\ndisplacement = \"1.5 + 0.3*t - 0.4*t^2\"\n";
    let record = run(&TELESCOPE.replace("ALONG", drive), &[]);
    let end = 1.2_f64;
    let length = 1.5 + 0.3 * end - 0.4 * end * end;
    let rate = 1.5 * 2.0 / (length * length);
    let [vx, vy] = ["v1", "v2"].map(|component| last(&record, "speed", component));
    let [x, y] = ["x", "y"].map(|component| last(&record, "bob", component));
    assert!(
        (x.hypot(y) - length).abs() < 1e-9 && (last(&record, "rod", "displacement") - length).abs() < 1e-9
    );
    assert!(((x * vy - y * vx) / (x * x + y * y) - rate).abs() < 1e-6);
    let force = ["f1", "f2"].map(|component| last(&record, "reaction", component));
    let tension = -(force[0] * x + force[1] * y) / length;
    let wanted = 2.0 * (length * rate * rate + 0.8);
    assert!((tension - wanted).abs() < 1e-5 * wanted, "{tension} {wanted}");
}

/// A spring on its coordinate is a spring between the points.
#[test]
fn a_rod_of_variable_length_with_a_spring_is_a_spring_between_points() {
    let along =
        "[springs.own]\nkind = \"axial\"\njoint = \"rod\"\ndisplacement = 1.2\nstiffness = 40\ndamping = 3\n";
    let point = "[springs.own]\nkind = \"point\"\nbase = \"ground\"\ntip = \"bob\"\nlength = 1.2\nstiffness = 40\ndamping = 3\n";
    let with_rod = run(&TELESCOPE.replace("ALONG", along), &[]);
    let rod = TELESCOPE.find("[joints.rod]").unwrap()..TELESCOPE.find("ALONG").unwrap();
    let mut alone = TELESCOPE.replace("ALONG", point);
    alone.replace_range(rod, "");
    for output in ["rod", "reaction"] {
        let start = alone.find(&format!("[outputs.{output}]")).unwrap();
        let end = start + alone[start + 1..].find('[').unwrap() + 1;
        alone.replace_range(start..end, "");
    }
    let alone = run(&alone, &[]);
    for component in ["x", "y"] {
        let [a, b] = [&with_rod, &alone].map(|record| last(record, "bob", component));
        assert!((a - b).abs() < 1e-7, "{component}: {a} {b}");
    }
}

const CARRIED: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[bodies.bob]
mass = 2
inertia = [0.02, 0.03, 0.04]
position = [0.1, -0.6, 0.2]
[joints.support]
kind = "prescribed_motion"
base = "ground"
tip = "bob"
at = [0, 0, 0]
x = "0.2*(1 - cos(3*t))"
FREE
[outputs.bob]
kind = "position"
of = "bob"
[analysis]
kind = "dynamics"
end = 1
relative_tolerance = 1e-8
"#;

/// Free components are those of joints in series with the prescribed ones.
#[test]
fn prescribed_motions_leave_free_what_is_free() {
    let falls = run(&CARRIED.replace("FREE", "free = [\"y\"]"), &[]);
    assert!((last(&falls, "bob", "y") - (-0.6 - 0.5 * 9.81)).abs() < 1e-6);
    assert!((last(&falls, "bob", "x") - (0.1 + 0.2 * (1.0 - 3.0_f64.cos()))).abs() < 1e-8);
    for (free, joint) in [
        ("[\"rx\", \"ry\", \"rz\"]", "kind = \"spherical\""),
        ("[\"rz\"]", "kind = \"revolute\"\naxis = [0, 0, 1]"),
        ("[\"rz\", \"y\"]", "kind = \"generic\"\nlocked = [\"x\", \"z\", \"rx\", \"ry\"]"),
    ] {
        let one = run(&CARRIED.replace("FREE", &format!("free = {free}")), &[]);
        // The same with a carriage, whose mass has no effect.
        let carriage = format!(
            "[bodies.carriage]\nmass = 1\ninertia = [1, 1, 1]\n[joints.own]\n{joint}\nbase = \"carriage\"\ntip = \"bob\"\nat = [0, 0, 0]\n"
        );
        let text =
            CARRIED.replace("tip = \"bob\"\nat = [0, 0, 0]", "tip = \"carriage\"").replace("FREE", &carriage);
        let other = run(&text, &[]);
        for component in ["x", "y", "z"] {
            let [a, b] = [&one, &other].map(|record| last(record, "bob", component));
            assert!((a - b).abs() < 2e-6, "{free} {component}: {a} {b}");
        }
    }
    assert!(refused(&CARRIED.replace("FREE", "free = [\"x\"]")).contains("is prescribed and in `free`"));
}

#[test]
fn drives_of_joints_without_a_coordinate_are_refused() {
    let drive = "[joints.drive]\nkind = \"prescribed_displacement\"\njoint = \"rod\"\ndisplacement = \"t\"\n";
    let distance = TELESCOPE
        .replace("ALONG", drive)
        .replace("telescopic_rod", "distance")
        .replace("displacement = 1.5\n", "");
    let words = refused(&distance).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("joint `rod` has no relative displacement") && words.contains("telescopic_rod joint"),
        "{words}"
    );
}
