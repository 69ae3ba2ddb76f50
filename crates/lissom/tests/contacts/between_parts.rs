//! Contacts between parts: restitution, friction that sticks, rolling, clearance, chains of balls, and wrong models.

use lissom::Model;
use lissom::analyses::gradient::{GradientError, Method, gradient};
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};

use crate::support::refused::refused;
use crate::support::runs::run;
use crate::support::series::{last, series};

const DROP: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[ground]
shape = { kind = "plane" }
[bodies.ball]
mass = 1
inertia = { sphere = 0.1 }
shape = { sphere = 0.1 }
position = [0, 0, 1.1]
[contacts.floor]
base = "ground"
tip = "ball"
stiffness = 1e7
exponent = 1.5
restitution = 0.5
[outputs.energy]
kind = "energy"
[outputs.floor]
kind = "contact_force"
of = "floor"
[analysis]
kind = "dynamics"
end = 0.46
"#;

/// The velocity after an impact is that before times the restitution, whatever the velocity and the exponent.
#[test]
fn impacts_have_the_given_restitution() {
    for (index, restitution) in [1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.2, 0.05].into_iter().enumerate() {
        let height = [0.3, 1.0, 5.0][index % 3];
        let exponent = [1.0, 1.5, 2.0][index / 4];
        let stiffness = [3e6, 1e8, 1e11][index / 4];
        let end = (2.0_f64 * height / 9.81).sqrt() + 0.006;
        let set = [
            ("bodies.ball.position", format!("[0, 0, {}]", height + 0.1)),
            ("contacts.floor.restitution", restitution.to_string()),
            ("contacts.floor.exponent", exponent.to_string()),
            ("contacts.floor.stiffness", stiffness.to_string()),
            ("analysis.end", end.to_string()),
        ];
        let record = run(DROP, &set.each_ref().map(|(path, value)| (*path, value.as_str())));
        assert!(last(&record, "floor.gap") > 0.0 || restitution < 0.1, "{restitution}: still in contact");
        // Above the floor.
        let energy = last(&record, "energy.total") - 0.1 * 9.81;
        let found = (energy / (9.81 * height)).max(0.0).sqrt();
        assert!((found - restitution).abs() < 0.01, "{restitution} at {height} m: {found}");
    }
}

/// Hertz's theory for a ball of steel that rests on a plane of steel.
#[test]
fn a_ball_of_steel_rests_at_the_depth_of_hertz() {
    let text = DROP
        .replace(
            "stiffness = 1e7\nexponent = 1.5\nrestitution = 0.5",
            "material = \"steel\"\ndissipation = 1e5",
        )
        .replace("1.1]", "0.0999999]")
        .replace("[ground]", "[materials.steel]\nE = 210e9\nnu = 0.3\ndensity = 7800\n[ground]");
    let record = run(&text, &[("analysis.end", "0.5")]);
    let stiffness = 4.0 / 3.0 * 210e9 / (2.0 * (1.0 - 0.3 * 0.3)) * 0.1_f64.sqrt();
    let depth = (9.81 / stiffness).powf(2.0 / 3.0);
    let found = -last(&record, "floor.gap");
    assert!((found - depth).abs() < 1e-3 * depth, "{found} {depth}");
    assert!((last(&record, "floor.normal") - 9.81).abs() < 1e-3, "{}", last(&record, "floor.normal"));
}

/// A ball and a block on a slope, which start in the penetration of rest.
fn slope(friction: f64, end: f64) -> String {
    let angle = 0.3_f64;
    let (sine, cosine) = angle.sin_cos();
    let at = |height: f64, y: f64, count: f64| {
        let height = height - 9.81 * cosine / (1e6 * count);
        format!("position = [{}, {y}, {}]", height * sine, height * cosine)
    };
    format!(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[ground]
shape = {{ kind = "plane", normal = [{sine}, 0, {cosine}] }}
[bodies.ball]
mass = 1
inertia = {{ sphere = 0.1 }}
shape = {{ sphere = 0.1 }}
{}
[bodies.block]
mass = 1
inertia = {{ box = [0.2, 0.2, 0.1] }}
shape = {{ box = [0.2, 0.2, 0.1] }}
{}
rotation = [0, {angle}, 0]
[contacts.ball]
base = "ground"
tip = "ball"
stiffness = 1e6
dissipation = 10
friction = {friction}
[contacts.block]
base = "ground"
tip = "block"
stiffness = 1e6
dissipation = 10
friction = {friction}
[outputs.ball]
kind = "displacement"
of = "ball"
[outputs.block]
kind = "displacement"
of = "block"
[outputs.force]
kind = "contact_force"
of = "block"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = {end}
"#,
        at(0.1, 0.0, 1.0),
        at(0.05, 1.0, 4.0)
    )
}

#[test]
fn balls_roll_and_blocks_slide_down_a_slope() {
    let record = run(&slope(0.2, 1.0), &[]);
    let (sine, cosine) = 0.3_f64.sin_cos();
    let path = |name: &str| last(&record, &format!("{name}.u1")).hypot(last(&record, &format!("{name}.u3")));
    let rolled = 0.5 * 9.81 * sine * 5.0 / 7.0;
    assert!((path("ball") - rolled).abs() < 1e-3 * rolled, "{} {rolled}", path("ball"));
    let slid = 0.5 * 9.81 * (sine - 0.2 * cosine);
    // While its friction grows over the first 1e-5 m it gains 5 mm/s.
    assert!((0.0..5e-3).contains(&(path("block") - slid)), "{} {slid}", path("block"));
    // What is lost is the work of sliding friction.
    let energy = series(&record, "energy.total");
    let lost = energy[0] - energy[energy.len() - 1];
    let work = 0.2 * 9.81 * cosine * path("block");
    assert!((lost - work).abs() < 2e-3 * work, "{lost} {work}");
}

/// A block at rest stays at rest for an hour, to 1e-9 m after it has settled.
#[test]
fn a_block_that_sticks_does_not_creep() {
    let text = slope(0.5, 3600.0);
    let (before, after) =
        (text.find("[bodies.ball]").expect("there"), text.find("[bodies.block]").expect("there"));
    let text = format!("{}{}", &text[..before], &text[after..]);
    let (before, after) =
        (text.find("[contacts.ball]").expect("there"), text.find("[contacts.block]").expect("there"));
    let text = format!("{}{}", &text[..before], &text[after..])
        .replace("[outputs.ball]\nkind = \"displacement\"\nof = \"ball\"\n", "");
    let record = run(&text, &[]);
    let (times, places) = (&record.times, series(&record, "block.u1"));
    let settled = times.iter().position(|&time| time > 1.0).expect("later");
    let moved = (places[places.len() - 1] - places[settled]).abs();
    assert!(moved < 1e-9 && places.iter().all(|place| place.abs() < 1e-4), "{moved} m");
    let friction = 9.81 * 0.3_f64.sin();
    assert!((last(&record, "force.friction") - friction).abs() < 1e-6 * friction);
}

/// Balls in a row pass the velocity on; what flies past a ball is deflected however long the run is.
#[test]
fn balls_collide_in_runs_of_any_length() {
    let ball = |name: &str, x: f64, v: f64| {
        format!(
            "[point_masses.{name}]\nmass = 1\nposition = [{x}, 0, 0]\nvelocity = [{v}, 0, 0]\nshape = {{ sphere = 0.1 }}\n\
             [outputs.{name}]\nkind = \"velocity\"\nof = \"{name}\"\n"
        )
    };
    let contact = |base: &str, tip: &str| {
        format!(
            "[contacts.{base}_{tip}]\nbase = \"{base}\"\ntip = \"{tip}\"\nstiffness = 1e6\nexponent = 1.5\n"
        )
    };
    let row = format!(
        "lissom = 1\n{}{}{}{}{}[analysis]\nkind = \"dynamics\"\nend = 50\n",
        ball("a", -5.0, 1.0),
        ball("b", 0.0, 0.0),
        ball("c", 0.21, 0.0),
        contact("a", "b"),
        contact("b", "c")
    );
    let record = run(&row, &[]);
    for (name, wanted) in [("a.v1", 0.0), ("b.v1", 0.0), ("c.v1", 1.0)] {
        assert!((last(&record, name) - wanted).abs() < 1e-6, "{name} {}", last(&record, name));
    }
    let past = "lissom = 1\n[ground]\nshape = { sphere = 0.2 }\n[point_masses.b]\nmass = 1\nposition = [-5, 0.1, 0]\n\
                velocity = [1, 0, 0]\nshape = { sphere = 0.1 }\n[contacts.c]\nbase = \"ground\"\ntip = \"b\"\nstiffness = 100\n\
                [outputs.b]\nkind = \"velocity\"\nof = \"b\"\n[analysis]\nkind = \"dynamics\"\nend = 100\n";
    for end in ["10", "100", "1000"] {
        let record = run(past, &[("analysis.end", end)]);
        // Of a spring between the centres that only pushes, at 1e-10.
        assert!((last(&record, "b.v1") + 0.365_736_67).abs() < 1e-6, "{end}: {}", last(&record, "b.v1"));
    }
}

/// A ball in a bore with clearance swings as a pendulum of the length of the clearance.
#[test]
fn a_pin_swings_in_its_bore() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[ground]
shape = { kind = "tube", radius = 0.4, inner_radius = 0.3, length = 1, axis = "y" }
[point_masses.pin]
mass = 1
position = [0.002, 0, -0.24999]
plane = "zx"
shape = { sphere = 0.05 }
[contacts.bore]
base = "ground"
tip = "pin"
stiffness = 1e6
[outputs.pin]
kind = "position"
of = "pin"
[analysis]
kind = "dynamics"
end = 1
"#;
    let quarter = 0.5 * std::f64::consts::PI * (0.25_f64 / 9.81).sqrt();
    let record = run(text, &[("analysis.end", &(5.0 * quarter).to_string())]);
    // After five quarters of a period it passes the lowest position.
    assert!(last(&record, "pin.x").abs() < 2e-5, "{}", last(&record, "pin.x"));
}

/// In statics a part sinks in until the contact carries it, and it vibrates on the stiffness of the contact.
#[test]
fn statics_and_modes_know_contacts() {
    let text = DROP.replace("exponent = 1.5\nrestitution = 0.5\n", "").replace(
        "1.1]",
        "0.0999]\n[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"ball\"\naxis = \"z\"",
    );
    let record = run(&text.replace("kind = \"dynamics\"\nend = 0.46", "kind = \"statics\""), &[]);
    assert!((last(&record, "floor.gap") + 9.81e-7).abs() < 1e-12, "{}", last(&record, "floor.gap"));
    let request =
        ModeRequest { count: Some(1), about: Some(OperatingPoint::Static), shift: None, no_plots: true };
    let report = modes(&Model::from_text("contact.toml", &text), &request);
    let frequency = report.unwrap_or_else(|error| panic!("{error}")).modes[0].frequency;
    let wanted = 1e7_f64.sqrt() / std::f64::consts::TAU;
    assert!((frequency - wanted).abs() < 1e-9 * wanted, "{frequency} {wanted}");
}

/// A box that tumbles and a rod lose energy in every impact until they are at rest.
#[test]
fn what_tumbles_loses_energy_until_it_rests() {
    let body = |name: &str, shape: &str, y: f64| {
        format!(
            "[bodies.{name}]\nmass = 1\ninertia = [0.002, 0.0025, 0.003]\nshape = {shape}\nposition = [0, {y}, 0.4]\n\
             rotation = [0.5, 0.4, 0.1]\nvelocity = [0.5, 0, 0]\n[contacts.{name}]\nbase = \"{name}\"\ntip = \"ground\"\n\
             stiffness = 1e5\nrestitution = 0.3\nfriction = 0.5\n[outputs.{name}]\nkind = \"contact_force\"\nof = \"{name}\"\n"
        )
    };
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[ground]\nshape = {{ kind = \"plane\" }}\n{}{}[outputs.energy]\nkind = \"energy\"\n\
         [analysis]\nkind = \"dynamics\"\nend = 2\n",
        body("die", "{ box = [0.1, 0.1, 0.1] }", 0.0),
        body("rod", "{ kind = \"capsule\", radius = 0.03, length = 0.2, axis = \"x\" }", 1.0)
    );
    let record = run(&text, &[]);
    let energy = series(&record, "energy.total");
    let largest = energy.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(largest < energy[0] * (1.0 + 1e-5), "{largest} {}", energy[0]);
    assert!((last(&record, "die.normal") - 9.81).abs() < 1e-3, "{}", last(&record, "die.normal"));
    // On the base, the force is opposite to that on the tip, the ground.
    assert!((last(&record, "die.f3") + 9.81).abs() < 1e-3, "{}", last(&record, "die.f3"));
}

#[test]
fn wrong_contacts_are_rejected_with_a_remedy() {
    for (old, new, message) in [
        ("shape = { sphere = 0.1 }\n", "", "`ball` has no solid that could touch"),
        ("[ground]\nshape = { kind = \"plane\" }\n", "", "the ground has no solid that could touch"),
        ("stiffness = 1e7\n", "", "has neither `stiffness` nor `material`"),
        ("exponent = 1.5", "exponent = 0.5", "`exponent` of contact `floor` is below 1"),
        ("restitution = 0.5", "restitution = 0.5\ndissipation = 1", "both `restitution` and `dissipation`"),
        (
            "restitution = 0.5",
            "friction = 0.5\nstatic_friction = 0.3",
            "`static_friction` of contact `floor` is below",
        ),
        ("tip = \"ball\"", "tip = \"ground\"", "connects a node to itself"),
    ] {
        let text = DROP.replace(old, new);
        assert_ne!(text, DROP, "{old}");
        let found = refused(&text);
        assert!(found.contains(message), "{message}: {found}");
    }
}

/// A ball that falls through a soft plate is reported; one on a stiff plate is not.
#[test]
fn parts_that_pass_through_each_other_are_reported() {
    let plate = DROP
        .replace("shape = { kind = \"plane\" }", "shape = { box = [1, 1, 0.1] }")
        .replace("exponent = 1.5\nrestitution = 0.5\n", "")
        .replace("end = 0.46", "end = 0.8");
    for (stiffness, is_reported) in [("100", true), ("1e6", false)] {
        let set = [("contacts.floor.stiffness".to_owned(), stiffness.to_owned())];
        let mut session =
            Model::from_text("plate.toml", &plate).with_overrides(&set).session().expect("valid");
        session.run().unwrap();
        let codes: Vec<_> = session.warnings().map(lissom_core::errors::Warning::code).collect();
        assert_eq!(codes.contains(&"contact-too-deep"), is_reported, "{stiffness}: {codes:?}");
    }
}

/// A ball that cannot rotate, in the penetration of rest, under a gravity with a component `pull` along the plane.
fn pressed(pull: f64, friction: f64, speed: f64, end: f64) -> String {
    let depth = 9.81 / 1e5;
    format!(
        r#"
lissom = 1
gravity = [{pull}, 0, -9.81]
[ground]
shape = {{ kind = "plane" }}
[bodies.block]
mass = 1
inertia = {{ sphere = 0.1 }}
shape = {{ sphere = 0.1 }}
position = [0, 0, {}]
velocity = [{speed}, 0, 0]
[joints.guide]
kind = "generic"
base = "ground"
tip = "block"
locked = ["rx", "ry", "rz"]
[contacts.floor]
base = "ground"
tip = "block"
stiffness = 1e5
friction = {friction}
[outputs.block]
kind = "displacement"
of = "block"
[outputs.motion]
kind = "velocity"
of = "block"
[analysis]
kind = "dynamics"
end = {end}
"#,
        0.1 - depth
    )
}

fn modes_about(text: &str, about: OperatingPoint) -> lissom::analyses::modes::ModeReport {
    let request =
        ModeRequest { count: Some(30), about: Some(about), no_plots: true, ..ModeRequest::default() };
    modes(&Model::from_text("contact.toml", text), &request).unwrap_or_else(|error| panic!("{error}"))
}

/// A part that sticks vibrates on its bristles: with the deflection z, λ² + (1 - z²/z_c²) μ g/v_s λ + μ g/z_c = 0 in both directions.
#[test]
fn modes_of_a_sticking_part_are_those_of_its_bristles() {
    let (coefficient, slip, stribeck) = (0.4, 1e-5_f64, 0.01);
    for (pull, about) in [(0.0, OperatingPoint::Static), (0.5 * 0.4 * 9.81, OperatingPoint::Time(1.0))] {
        let report = modes_about(&pressed(pull, coefficient, 0.0, 1.0), about);
        let points = report.friction.expect("a contact with friction");
        assert_eq!((points.sticking, points.sliding), (1, 0), "{about:?}");
        // Vibrations have decayed, so that it is at rest. There are fewer modes than requested.
        assert_eq!(report.warnings.len(), 1, "{about:?}: {:?}", report.warnings);
        let rate = (coefficient * 9.81 / slip).sqrt();
        let share = pull / (coefficient * 9.81);
        // Across the deflection the damping is the same: it depends on its length alone.
        let damping = (1.0 - share * share) * coefficient * 9.81 / stribeck / (2.0 * rate);
        let of_bristles = |mode: &&lissom_core::linearized::Mode| {
            (mode.frequency / (rate / std::f64::consts::TAU) - 1.0).abs() < 1e-4
                && (mode.damping / damping - 1.0).abs() < 1e-3
        };
        let found: Vec<[f64; 2]> = report.modes.iter().map(|mode| [mode.frequency, mode.damping]).collect();
        assert_eq!(
            report.modes.iter().filter(of_bristles).count(),
            2,
            "{about:?}: {found:?}, {rate} {damping}"
        );
        let normal = 1e5_f64.sqrt() / std::f64::consts::TAU;
        assert!(report.modes.iter().any(|mode| (mode.frequency / normal - 1.0).abs() < 1e-4), "{found:?}");
    }
}

/// A part that slides has no stiffness along the plane.
#[test]
fn modes_of_a_sliding_part_have_no_bristles() {
    let report = modes_about(&pressed(0.0, 0.4, 3.0, 0.5), OperatingPoint::Time(0.2));
    let points = report.friction.expect("a contact with friction");
    assert_eq!((points.sticking, points.sliding), (0, 1));
    let bristles = (0.4 * 9.81 / 1e-5_f64).sqrt() / std::f64::consts::TAU;
    for mode in &report.modes {
        let is_oscillation = mode.kind == lissom_core::linearized::ModeKind::Oscillation;
        assert!(!is_oscillation || mode.frequency < 0.6 * bristles, "{} Hz {}", mode.frequency, mode.damping);
    }
    assert!(
        modes_about(&pressed(0.0, 0.4, 0.0, 1.0).replace("friction = 0.4\n", ""), OperatingPoint::Static)
            .friction
            .is_none()
    );
}

/// Static equilibria are still rejected: bristles have no equation there.
#[test]
fn statics_with_friction_are_rejected() {
    let text = pressed(0.0, 0.4, 0.0, 1.0).replace("kind = \"dynamics\"", "kind = \"statics\"\nsteps = 2");
    let error = match Model::from_text("contact.toml", &text).session() {
        Err(error) => error.to_string(),
        Ok(_) => panic!("statics without rates"),
    };
    assert!(error.contains("floor, friction 1"), "{error}");
}

/// Derivatives of an output by whole runs, in the order of `paths`.
fn derivatives(text: &str, of: &str, paths: &[&str]) -> Vec<f64> {
    let paths: Vec<String> = paths.iter().map(|path| (*path).to_owned()).collect();
    let model = Model::from_text("contact.toml", text);
    let found = gradient(&model, &of.parse().expect("a target"), &paths, true)
        .unwrap_or_else(|error| panic!("{of}: {error}"));
    assert!(found.derivatives.iter().all(|of| of.method == Method::Runs));
    found.derivatives.iter().map(|of| of.value).collect()
}

fn slope_of(of: impl Fn(f64) -> f64, at: f64) -> f64 {
    let apart = 1e-5 * at;
    (of(at + apart) - of(at - apart)) / (2.0 * apart)
}

/// Without gravity the velocity after an impact is e v, whatever the stiffness. With gravity and e = 1 the ball is in contact for
/// 2 (π - atan(v ω/g))/ω, ω = √(k/m).
#[test]
fn bounces_are_differentiated() {
    let text = DROP
        .replace("gravity = [0, 0, -9.81]", "[parameters]\nspeed = 2")
        .replace("position = [0, 0, 1.1]", "position = [0, 0, 0.2]\nvelocity = [0, 0, \"-speed\"]")
        .replace("end = 0.46", "end = 0.1\n[outputs.motion]\nkind = \"velocity\"\nof = \"ball\"");
    let paths =
        ["contacts.floor.restitution", "parameters.speed", "contacts.floor.stiffness", "bodies.ball.mass"];
    let found = derivatives(&text, "motion.v3", &paths);
    for (found, wanted) in found.iter().zip([2.0, 0.5, 0.0, 0.0]) {
        let size = if wanted == 0.0 { 1e-5 } else { 1e-4 * wanted };
        assert!((found - wanted).abs() < size, "{found} {wanted}");
    }

    let height_at = |height: f64, mass: f64, stiffness: f64| {
        let (gravity, rate) = (9.81, (stiffness / mass).sqrt());
        let fall = (2.0 * height / gravity).sqrt();
        let speed = gravity * fall;
        let contact = 2.0 * (std::f64::consts::PI - (speed * rate / gravity).atan()) / rate;
        let flight = 0.6 - fall - contact;
        speed * flight - 0.5 * gravity * flight * flight
    };
    let text = DROP
        .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\n[parameters]\nheight = 0.5")
        .replace("position = [0, 0, 1.1]", "position = [0, 0, \"0.1 + height\"]")
        .replace("stiffness = 1e7\nexponent = 1.5\nrestitution = 0.5", "stiffness = 1e4\nrestitution = 1")
        .replace("end = 0.46", "end = 0.6\n[outputs.place]\nkind = \"position\"\nof = \"ball\"");
    let paths = ["parameters.height", "bodies.ball.mass", "contacts.floor.stiffness"];
    let found = derivatives(&text, "place.z", &paths);
    let wanted = [
        slope_of(|height| height_at(height, 1.0, 1e4), 0.5),
        slope_of(|mass| height_at(0.5, mass, 1e4), 1.0),
        slope_of(|stiffness| height_at(0.5, 1.0, stiffness), 1e4),
    ];
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    }
}

/// A rigid ball: height e v τ - g τ²/2 at the time τ after the impact.
#[test]
fn bounces_of_rigid_contacts_are_differentiated() {
    let text = DROP
        .replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9.81]\n[parameters]\nheight = 0.5")
        .replace("position = [0, 0, 1.1]", "position = [0, 0, \"0.1 + height\"]")
        .replace("stiffness = 1e7\nexponent = 1.5\nrestitution = 0.5", "rigid = true\nrestitution = 0.7")
        .replace("end = 0.46", "end = 0.6\n[outputs.place]\nkind = \"position\"\nof = \"ball\"");
    let height_at = |height: f64, restitution: f64| {
        let fall = (2.0 * height / 9.81_f64).sqrt();
        let flight = 0.6 - fall;
        restitution * 9.81 * fall * flight - 0.5 * 9.81 * flight * flight
    };
    let found = derivatives(&text, "place.z", &["parameters.height", "contacts.floor.restitution"]);
    let wanted = [slope_of(|height| height_at(height, 0.7), 0.5), slope_of(|e| height_at(0.5, e), 0.7)];
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    }
}

/// A block that slides: its way is v t - μ g t²/2, and v²/(2 μ g) when it stops.
#[test]
fn friction_of_contacts_is_differentiated() {
    let (speed, coefficient) = (3.0, 0.4);
    let text = pressed(0.0, coefficient, speed, 1.0);
    let found = derivatives(&text, "block.u1@0.5", &["contacts.floor.friction"]);
    let wanted = -0.5 * 9.81 * 0.25;
    assert!((found[0] / wanted - 1.0).abs() < 1e-3, "{} {wanted}", found[0]);
    let found = derivatives(&text, "block.u1", &["contacts.floor.friction"]);
    let wanted = -speed * speed / (2.0 * coefficient * coefficient * 9.81);
    assert!((found[0] / wanted - 1.0).abs() < 2e-3, "{} {wanted}", found[0]);
    // Events of the model are not compared.
    let event = format!("{text}[events.far]\nzero_of = \"block.u1 - 0.1\"\nstop = true\n");
    let model = Model::from_text("contact.toml", &event);
    let refused = gradient(
        &model,
        &"block.u1".parse().expect("a target"),
        &["contacts.floor.friction".to_owned()],
        true,
    );
    assert!(matches!(refused, Err(GradientError::Feedback)), "{refused:?}");
}

const GROOVE: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[ground]
shape = { kind = "outline", length = 1, points = [[-1, 1], [0, 0], [1, 1], [2, 1], [2, -1], [-2, -1], [-2, 1]] }
[bodies.ball]
mass = 1
inertia = { sphere = 0.1 }
position = [0, 0.15, 0]
shape = { sphere = 0.1 }
[joints.guide]
kind = "planar"
base = "ground"
tip = "ball"
axis = "z"
[contacts.groove]
base = "ground"
tip = "ball"
stiffness = 1e5
dissipation = 20
[outputs.groove]
kind = "contact_force"
of = "groove"
[analysis]
kind = "dynamics"
end = 0.1
"#;

/// A ball in a groove of one outline has a force on one side only, which is reported; not so on one side of it, on its ridge, or
/// between two planes.
#[test]
fn balls_in_hollows_are_reported() {
    let planes =
        "shape = [{ kind = \"plane\", normal = [1, 1, 0] }, { kind = \"plane\", normal = [-1, 1, 0] }]";
    let outline = GROOVE.lines().find(|line| line.starts_with("shape = { kind")).expect("an outline");
    let at = |place: &str| GROOVE.replace("[0, 0.15, 0]", place);
    for (text, is_reported) in [
        (GROOVE.to_owned(), true),
        (at("[0.4, 0.54, 0]"), false),
        (at("[1.02, 1.11, 0]"), false),
        (GROOVE.replace(outline, planes), false),
    ] {
        let mut session = Model::from_text("groove.toml", &text).session().expect("valid");
        let record = session.run().unwrap();
        let largest = series(&record, "groove.normal").iter().copied().fold(0.0, f64::max);
        assert!(largest > 1.0, "no contact: {text}");
        let found = session.warnings().filter(|warning| warning.code() == "contact-in-hollow");
        let found: Vec<String> = found.map(ToString::to_string).collect();
        assert_eq!(found.len(), usize::from(is_reported), "{text}: {found:?}");
        assert!(found.iter().all(|text| text.contains("contact `groove`")), "{found:?}");
    }
}
