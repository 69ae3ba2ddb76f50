//! Rigid contacts against formulas: impacts, rest, opening, friction, several contacts at once, and what is rejected.

use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::{Model, Record};

use crate::support::refused::refused;
use crate::support::runs::session;
use crate::support::series::{last, series};

/// The record, and the events with their times.
fn run(text: &str, set: &[(&str, &str)]) -> (Record, Vec<(String, f64)>) {
    let mut session = session(text, set);
    let record = session.run().unwrap().into_record();
    let warnings: Vec<_> = session.warnings().collect();
    assert!(warnings.is_empty(), "{set:?}: {warnings:?}");
    let events = session.events().map(|(name, time)| (name.to_owned(), time)).collect();
    (record, events)
}

fn of(events: &[(String, f64)], name: &str) -> Vec<f64> {
    events.iter().filter(|(own, _)| own == name).map(|(_, time)| *time).collect()
}

/// Why a run ends before its end.
fn failure(text: &str) -> String {
    let mut session = match Model::from_text("rigid.toml", text).session() {
        Ok(session) => session,
        Err(error) => return error.to_string(),
    };
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    report.error().map(ToString::to_string).expect("the run fails")
}

const BALL: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[ground]
shape = { kind = "plane" }
[bodies.ball]
mass = 2
inertia = { sphere = 0.1 }
shape = { sphere = 0.1 }
position = [0, 0, 0.6]
[contacts.floor]
base = "ground"
tip = "ball"
rigid = true
restitution = 0.5
[outputs.energy]
kind = "energy"
[outputs.floor]
kind = "contact_force"
of = "floor"
[outputs.ball]
kind = "velocity"
of = "ball"
[analysis]
kind = "dynamics"
end = 8
"#;

/// Impacts at t₁ = √(2h/g), t_k+1 = t_k + 2 v_k/g with v_k = e v_k-1, until an impact below the velocity of rest.
#[test]
fn a_ball_bounces_at_its_instants_and_comes_to_rest() {
    let schemes = ["radau-iia", "radau-iia-9", "generalized-alpha", "hht"];
    for (restitution, scheme, step) in [0.5_f64, 0.7, 0.9]
        .into_iter()
        .flat_map(|restitution| schemes.map(|scheme| (restitution, scheme, Some("0.01"))))
        .chain([(0.8, "radau-iia-9", None)])
    {
        let number = restitution.to_string();
        let mut set = vec![("contacts.floor.restitution", number.as_str()), ("analysis.scheme", scheme)];
        set.extend(step.map(|step| ("analysis.step", step)));
        let (record, events) = run(BALL, &set);
        let mut speed = 10.0_f64.sqrt();
        let mut instants = vec![speed / 10.0];
        while restitution * speed >= 0.0 && speed > 1e-3 {
            speed *= restitution;
            instants.push(instants[instants.len() - 1] + 2.0 * speed / 10.0);
        }
        let found = of(&events, "floor, touch");
        assert_eq!(found.len(), instants.len(), "{restitution} {scheme}: {found:?}");
        for (k, (found, wanted)) in found.iter().zip(&instants).enumerate() {
            assert!((found - wanted).abs() < 1e-9, "{restitution} {scheme} {k}: {found} {wanted}");
        }
        assert!(of(&events, "floor, release").is_empty());
        assert!((last(&record, "floor.normal") - 20.0).abs() < 1e-6, "{}", last(&record, "floor.normal"));
        assert!(last(&record, "floor.gap").abs() < 1e-9 && last(&record, "ball.v3").abs() < 1e-9);
        let rest = instants[instants.len() - 1];
        for (time, normal) in record.times.iter().zip(series(&record, "floor.normal")) {
            let wanted = if *time > rest + 1e-6 { 20.0 } else { 0.0 };
            assert!(
                (time - rest).abs() < 1e-5 || (normal - wanted).abs() < 1e-6,
                "{scheme} {time}: {normal}"
            );
        }
    }
}

#[test]
fn a_ball_rests_for_an_hour() {
    let set = [("bodies.ball.position", "[0, 0, 0.1]"), ("analysis.end", "3600")];
    let (record, events) = run(BALL, &set);
    assert!(events.is_empty(), "{events:?}");
    for (gap, normal) in series(&record, "floor.gap").iter().zip(series(&record, "floor.normal")) {
        assert!(gap.abs() < 1e-12 && (normal - 20.0).abs() < 1e-8, "{gap} {normal}");
    }
}

/// An approach at the start is an impact there.
#[test]
fn an_impact_at_the_start_rebounds() {
    let text = BALL.replace("position = [0, 0, 0.6]", "position = [0, 0, 0.1]\nvelocity = [1, 0, -3]");
    let (record, _) = run(&text, &[("analysis.end", "0.1")]);
    assert!((series(&record, "ball.v3")[0] - 1.5).abs() < 1e-12, "{}", series(&record, "ball.v3")[0]);
    assert!((last(&record, "ball.v3") - 0.5).abs() < 1e-9, "{}", last(&record, "ball.v3"));
}

/// A box on a plane with gravity at an angle.
fn slope(friction: f64, angle: f64) -> String {
    format!(
        r#"
lissom = 1
gravity = [{}, 0, {}]
[ground]
shape = {{ kind = "plane" }}
[bodies.block]
mass = 3
inertia = {{ box = [0.5, 0.4, 0.2] }}
shape = {{ box = [0.5, 0.4, 0.2] }}
position = [0, 0, 0.1]
[contacts.floor]
base = "ground"
tip = "block"
rigid = true
friction = {friction}
[outputs.block]
kind = "displacement"
of = "block"
[outputs.floor]
kind = "contact_force"
of = "floor"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 2
"#,
        10.0 * angle.sin(),
        -10.0 * angle.cos()
    )
}

#[test]
fn a_block_sticks_below_the_angle_of_friction_and_slides_above() {
    for angle in [0.1_f64, 0.29, 0.31, 0.5] {
        let friction = 0.3_f64.tan();
        let (record, _) = run(&slope(friction, angle), &[]);
        let excess = (10.0 * (angle.sin() - friction * angle.cos())).max(0.0);
        let found = last(&record, "block.u1");
        assert!((found - 2.0 * excess).abs() < 1e-9, "{angle}: {found} {}", 2.0 * excess);
        let normal = 30.0 * angle.cos();
        assert!((last(&record, "floor.normal") - normal).abs() < 1e-6);
        let wanted = (30.0 * angle.sin()).min(friction * normal);
        assert!((last(&record, "floor.friction") - wanted).abs() < 1e-6, "{angle}");
        assert!((last(&record, "floor.f1") + wanted).abs() < 1e-6, "{angle}");
    }
}

/// A block at rest for an hour.
#[test]
fn a_block_that_sticks_does_not_creep() {
    let (record, events) = run(&slope(0.5, 0.4), &[("analysis.end", "3600")]);
    assert!(events.is_empty(), "{events:?}");
    assert!(last(&record, "block.u1").abs() < 1e-7, "{}", last(&record, "block.u1"));
}

/// A block that stops: s = v²/(2 μ g), and remains there.
#[test]
fn a_block_stops_by_friction() {
    let text =
        slope(0.4, 0.0).replace("position = [0, 0, 0.1]", "position = [0, 0, 0.1]\nvelocity = [1.8, 2.4, 0]");
    for scheme in ["radau-iia-9", "generalized-alpha"] {
        let (record, _) = run(&text, &[("analysis.scheme", scheme)]);
        let path = last(&record, "block.u1").hypot(last(&record, "block.u2"));
        let wanted = 9.0 / (2.0 * 0.4 * 10.0);
        assert!((path - wanted).abs() < 1e-6, "{scheme}: {path} {wanted}");
        assert!(last(&record, "energy.kinetic") < 1e-12, "{scheme}");
        // 30 N m of weight at the centre, 0.1 m above the ground.
        let lost = series(&record, "energy.total")[0] - last(&record, "energy.total");
        assert!((lost - 13.5).abs() < 1e-6, "{scheme}: {lost}");
    }
}

const OSCILLATOR: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[ground]
shape = { kind = "plane" }
[point_masses.block]
mass = 1
position = [0, 0, 0.1]
shape = { sphere = 0.1 }
[springs.spring]
kind = "point"
base = "ground"
tip = "block"
at_base = [-1, 0, 0.1]
stiffness = 100
length = 0.5
[contacts.floor]
base = "ground"
tip = "block"
rigid = true
friction = 0.4
[outputs.block]
kind = "position"
of = "block"
[outputs.velocity]
kind = "velocity"
of = "block"
[outputs.floor]
kind = "contact_force"
of = "floor"
[analysis]
kind = "dynamics"
end = 4
"#;

/// Coulomb's oscillator: its amplitude about the relaxed spring falls by 2 μ m g/k = 0.08 m in every half period π/10 s, from 0.5 m,
/// until the friction holds it at 0.02 m.
#[test]
fn an_oscillator_loses_its_amplitude_and_sticks() {
    for set in [vec![], vec![("analysis.scheme", "generalized-alpha"), ("analysis.step", "1e-3")]] {
        let (record, events) = run(OSCILLATOR, &set);
        let turns = of(&events, "floor, slip");
        assert_eq!(turns.len(), 6, "{turns:?}");
        let allowed = if set.is_empty() { 1e-6 } else { 1e-4 };
        for (k, turn) in turns.iter().enumerate() {
            let wanted = std::f64::consts::PI / 10.0 * (k + 1) as f64;
            assert!((turn - wanted).abs() < allowed, "{k}: {turn} {wanted}");
        }
        // -0.5 + 0.5, -0.42, 0.34, -0.26, 0.18, -0.1, 0.02 about -0.5.
        let found = last(&record, "block.x1");
        assert!((found - (-0.5 + 0.02)).abs() < allowed, "{found}");
        assert!((last(&record, "floor.friction") - 2.0).abs() < 100.0 * allowed);
        assert!(last(&record, "velocity.v1").abs() < 1e-9);
    }
}

/// A block pulled by a spring whose end moves at v sticks until k v t = μ m g, and then moves by v (τ - sin(ω τ)/ω).
#[test]
fn a_block_that_is_pulled_sticks_and_then_slides() {
    let text = OSCILLATOR
        .replace("at_base = [-1, 0, 0.1]", "at_base = [0, 0, 0]")
        .replace("length = 0.5", "length = 1")
        .replace("base = \"ground\"\ntip = \"block\"\nat_base", "base = \"cart\"\ntip = \"block\"\nat_base")
        .replace("end = 4", "end = 0.9")
        + r#"
[bodies.cart]
mass = 1
inertia = [1, 1, 1]
position = [1, 0, 0.1]
[joints.pull]
kind = "prescribed_motion"
base = "ground"
tip = "cart"
x = "0.1*t"
"#;
    let text = text.replace("at_base = [0, 0, 0]\n", "");
    let (record, events) = run(&text, &[]);
    let begin = 4.0 / (100.0 * 0.1);
    let slips = of(&events, "floor, slip");
    assert_eq!(slips.len(), 1, "{slips:?}");
    assert!((slips[0] - begin).abs() < 1e-6, "{}", slips[0]);
    for (time, place) in record.times.iter().zip(series(&record, "block.x1")) {
        let since = (time - begin).max(0.0);
        let wanted = 0.1 * (since - (10.0 * since).sin() / 10.0);
        assert!((place - wanted).abs() < 1e-6, "{time}: {place} {wanted}");
    }
}

/// A ball on a shaking table leaves it where the table falls with g: A ω² sin ω t = g.
#[test]
fn a_ball_leaves_a_shaking_table() {
    let text = BALL
        .replace("[ground]\nshape", "[bodies.table]\nmass = 1\ninertia = [1, 1, 1]\nshape")
        .replace("base = \"ground\"\ntip = \"ball\"", "base = \"table\"\ntip = \"ball\"")
        .replace("position = [0, 0, 0.6]", "position = [0, 0, 0.1]")
        .replace("end = 8", "end = 0.2")
        + r#"
[joints.table]
kind = "prescribed_motion"
base = "ground"
tip = "table"
z = "0.05*sin(20*t) - t"
"#;
    // Both move down at first: without that, the start would be an impact.
    let text = text.replace("[contacts.floor]", "[initial.all]\nparts = [\"ball\"]\n[contacts.floor]");
    let (_, events) = run(&text, &[]);
    let found = of(&events, "floor, release");
    let wanted = (10.0_f64 / (0.05 * 400.0)).asin() / 20.0;
    assert!(!found.is_empty() && (found[0] - wanted).abs() < 1e-6, "{found:?} {wanted}");
}

/// Housner's block: ω⁺/ω⁻ = 1 - 3/2 sin² α at each impact, with tan α = width/height.
#[test]
fn a_block_rocks_as_housner_says() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[parameters]
tilt = 0.05
[ground]
shape = { kind = "plane" }
[bodies.block]
mass = 2
inertia = { box = [0.2, 0.5, 1.0] }
shape = { box = [0.2, 0.5, 1.0] }
position = ["0.1*cos(tilt) + 0.5*sin(tilt)", 0, "0.1*sin(tilt) + 0.5*cos(tilt)"]
rotation = [0, "tilt", 0]
[contacts.floor]
base = "ground"
tip = "block"
rigid = true
friction = 2
[outputs.block]
kind = "angular_velocity"
of = "block"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 3
"#;
    let (record, events) = run(text, &[]);
    let mut impacts: Vec<f64> =
        events.iter().filter(|(name, _)| name.ends_with("touch")).map(|(_, time)| *time).collect();
    impacts.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    assert!(impacts.len() > 8, "{impacts:?}");
    // At an impact the energy is kinetic, m g H/2 above the ground: its ratio is that of ω².
    let squared = 0.04 / (0.04 + 1.0);
    let ratio = (1.0_f64 - 1.5 * squared).powi(2);
    let energy = series(&record, "energy.total");
    let at = |time: f64| {
        let row = record.times.iter().position(|own| *own > time).expect("within the run");
        energy[row] - 2.0 * 9.81 * 0.5
    };
    for three in impacts.windows(3).take(8) {
        let [before, after] = [0, 1].map(|k| 0.5 * (three[k] + three[k + 1]));
        let found = at(after) / at(before);
        assert!((found - ratio).abs() < 1e-6, "{found} {ratio}");
    }
}

const TUMBLING: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[ground]
shape = { kind = "plane" }
[bodies.box]
mass = 1
inertia = { box = [0.3, 0.4, 0.6] }
shape = { box = [0.3, 0.4, 0.6] }
position = [0, 0, 1.5]
rotation = [0.3, 0.5, 0.1]
velocity = [2, 0.3, 0]
angular_velocity = [3, -4, 5]
[contacts.floor]
base = "ground"
tip = "box"
rigid = true
friction = 0.4
restitution = 0.5
[outputs.energy]
kind = "energy"
[outputs.floor]
kind = "contact_force"
of = "floor"
[analysis]
kind = "dynamics"
relative_tolerance = 1e-6
end = 6
"#;

/// A box that tumbles over a plane loses energy only, and rests on a side at the end.
#[test]
fn a_tumbling_box_never_gains_energy_and_comes_to_rest() {
    for turn in ["[0.3, 0.5, 0.1]", "[-1.46, 1.39, 1.06]"] {
        for friction in ["0", "0.15", "0.3", "0.6"] {
            let set = [("bodies.box.rotation", turn), ("contacts.floor.friction", friction)];
            let mut session = session(TUMBLING, &set);
            let record = session.run().unwrap();
            let energy = series(&record, "energy.total");
            for pair in energy.windows(2) {
                assert!(pair[1] - pair[0] < 1e-5 * energy[0], "{set:?}: {pair:?}");
            }
            assert!(series(&record, "floor.gap").iter().all(|gap| *gap > -1e-6), "{set:?}");
            assert!(session.events().count() > 10, "{set:?}");
            if friction != "0" {
                assert!(
                    last(&record, "energy.kinetic") < 1e-9,
                    "{set:?}: {}",
                    last(&record, "energy.kinetic")
                );
                let normal = last(&record, "floor.normal");
                assert!((normal - 9.81).abs() < 1e-5, "{set:?}: {normal}");
            }
        }
    }
}

/// A dumbbell lands on both ends at once, and two balls land at the same instant.
#[test]
fn contacts_that_touch_at_the_same_instant_rebound_together() {
    let dumbbell = BALL.replace(
        "shape = { sphere = 0.1 }",
        "shape = [{ sphere = 0.1, position = [0.5, 0, 0] }, { sphere = 0.1, position = [-0.5, 0, 0] }]",
    );
    let (record, events) = run(&dumbbell, &[("analysis.end", "0.4")]);
    assert_eq!(of(&events, "floor, touch").len(), 1);
    let speed = 0.5 * 10.0_f64.sqrt() - 10.0 * (0.4 - 0.1_f64.sqrt());
    assert!((last(&record, "ball.v3") - speed).abs() < 1e-8, "{} {speed}", last(&record, "ball.v3"));
    let second = r#"
[bodies.second]
mass = 1
inertia = { sphere = 0.1 }
shape = { sphere = 0.1 }
position = [1, 0, 0.6]
[contacts.second]
base = "ground"
tip = "second"
rigid = true
restitution = 0.25
[outputs.second]
kind = "velocity"
of = "second"
"#;
    let (record, _) = run(&format!("{BALL}{second}"), &[("analysis.end", "0.4")]);
    assert!((last(&record, "ball.v3") - speed).abs() < 1e-8);
    let slower = 0.25 * 10.0_f64.sqrt() - 10.0 * (0.4 - 0.1_f64.sqrt());
    assert!((last(&record, "second.v3") - slower).abs() < 1e-8);
}

/// A ball falls on another one that rests: with the same mass and e = 1, the lower one cannot move, and the upper one rebounds by
/// the law of both contacts.
#[test]
fn a_ball_falls_on_one_that_rests() {
    let upper = r#"
[bodies.upper]
mass = 2
inertia = { sphere = 0.1 }
shape = { sphere = 0.1 }
position = [0, 0, 0.8]
[contacts.balls]
base = "ball"
tip = "upper"
rigid = true
[outputs.balls]
kind = "contact_force"
of = "balls"
"#;
    let text = format!("{BALL}{upper}");
    let set = [("bodies.ball.position", "[0, 0, 0.1]"), ("analysis.end", "1")];
    let (record, events) = run(&text, &set);
    assert_eq!(of(&events, "balls, touch").len(), 1);
    // Both rest on each other.
    assert!((last(&record, "balls.normal") - 20.0).abs() < 1e-6, "{}", last(&record, "balls.normal"));
    assert!((last(&record, "floor.normal") - 40.0).abs() < 1e-6, "{}", last(&record, "floor.normal"));
}

/// A ball rolls down a slope: 5/7 g sin, without penetration after many turns.
#[test]
fn a_ball_rolls_down_a_slope() {
    let text = BALL
        .replace("gravity = [0, 0, -10]", "gravity = [1, 0, -10]")
        .replace("restitution = 0.5", "friction = 0.3")
        .replace("position = [0, 0, 0.6]", "position = [0, 0, 0.1]");
    // The direction of the velocity turns by 0.06 rad per step in the axes of the ball.
    for (scheme, allowed, of_forces) in [("radau-iia-9", 1e-8, 1e-6), ("radau-iia", 1e-3, 1e-2)] {
        let (record, _) = run(&text, &[("analysis.scheme", scheme), ("analysis.step", "0.001")]);
        let wanted = 8.0 * 5.0 / 7.0;
        let found = last(&record, "ball.v1");
        assert!((found - wanted).abs() < allowed, "{scheme}: {found} {wanted}");
        let friction = last(&record, "floor.friction");
        assert!((friction - 4.0 / 7.0).abs() < of_forces, "{scheme}: {friction}");
        let deepest = series(&record, "floor.gap").iter().fold(0.0_f64, |most, gap| most.max(gap.abs()));
        assert!(deepest < 0.01 * allowed, "{scheme}: {deepest}");
    }
}

/// A rod that slides on its lower end, half length 1, m = 1, J = 1/3, at 45°: N (1 + 3/2 (1 - μ)) = g - ω² l sin with the lean
/// behind the motion: a paradox from μ = 5/3 on.
fn rod(friction: f64) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -10]
[parameters]
high = "sqrt(0.5)"
[ground]
shape = {{ kind = "plane" }}
[bodies.rod]
mass = 1
inertia = [0.3333333333333333, 0.3333333333333333, 0.3333333333333333]
shape = {{ sphere = 0.001, position = ["-high", 0, "-high"] }}
position = [0, 0, "high + 0.001"]
velocity = [-5, 0, 0]
[contacts.floor]
base = "ground"
tip = "rod"
rigid = true
friction = {friction}
[outputs.floor]
kind = "contact_force"
of = "floor"
[analysis]
kind = "dynamics"
end = 0.01
"#
    )
}

#[test]
fn a_rod_in_a_paradox_is_reported() {
    let (record, _) = run(&rod(0.5), &[]);
    // The arm ends at the surface of the small sphere.
    let (across, up) = (0.5_f64.sqrt(), 0.5_f64.sqrt() + 0.001);
    let wanted = 10.0 / (1.0 + 3.0 * across * (across - 0.5 * up));
    let found = series(&record, "floor.normal")[0];
    assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
    let error = failure(&rod(2.0));
    assert!(error.contains("`floor`") && error.contains("paradox"), "{error}");
}

/// A contact within a step is not missed, however long the run is.
#[test]
fn a_ball_that_flies_past_another_one_hits_it() {
    let text = r#"
lissom = 1
[ground]
shape = { sphere = 0.2 }
[point_masses.ball]
mass = 1
position = [-50, 0.18, 0]
velocity = [10, 0, 0]
shape = { sphere = 0.1 }
[contacts.post]
base = "ground"
tip = "ball"
rigid = true
restitution = 0.5
[outputs.ball]
kind = "velocity"
of = "ball"
[analysis]
kind = "dynamics"
end = 10
"#;
    for end in ["6", "10", "100", "10000"] {
        let (record, events) = run(text, &[("analysis.end", end)]);
        let touched = of(&events, "post, touch");
        assert_eq!(touched.len(), 1, "{end}");
        // n = (-0.8, 0.6) where the distance is 0.3 m.
        assert!((touched[0] - (50.0 - 0.24) / 10.0).abs() < 1e-9, "{end}: {}", touched[0]);
        // u_n = -8 becomes 4: u = 10 (1, 0) + 12 n.
        assert!((last(&record, "ball.v1") - 0.4).abs() < 1e-6, "{end}: {}", last(&record, "ball.v1"));
        assert!((last(&record, "ball.v2") - 7.2).abs() < 1e-6, "{end}: {}", last(&record, "ball.v2"));
    }
    let mut session = session(text, &[("analysis.step", "3"), ("analysis.end", "12")]);
    session.run().unwrap();
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(warnings.iter().any(|warning| warning.contains("post")), "{warnings:?}");
}

#[test]
fn what_is_not_available_is_rejected() {
    let stiff = BALL.replace("rigid = true", "rigid = true\nstiffness = 1e6");
    assert!(refused(&stiff).contains("of kind `rigid`, which has no `stiffness`"), "{}", refused(&stiff));
    let weak =
        BALL.replace("rigid = true", "stiffness = 1e6").replace("restitution = 0.5", "restitution = 0");
    assert!(refused(&weak).contains("is below 0.01"), "{}", refused(&weak));
    let statics = BALL.replace("kind = \"dynamics\"\nend = 8", "kind = \"statics\"\nstep = 1");
    assert!(refused(&statics).contains("statics"), "{}", refused(&statics));
    let deep = BALL.replace("position = [0, 0, 0.6]", "position = [0, 0, 0.05]");
    assert!(refused(&deep).contains("penetrate"), "{}", refused(&deep));
    let request =
        ModeRequest { count: None, about: Some(OperatingPoint::Undeformed), shift: None, no_plots: true };
    let error = modes(&Model::from_text("rigid.toml", BALL), &request).expect_err("it has no modes");
    assert!(error.to_string().contains("floor"), "{error}");
}

/// A sled on the floor, and a carriage on its mast that a latch catches at a height of 0.5 m.
const SLED: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[ground]
shape = { kind = "plane" }
[bodies.sled]
mass = 2
inertia = [1, 1, 1]
shape = { box = [2, 2, 0.2] }
position = [0, 0, 0.1]
[bodies.carriage]
mass = 3
inertia = [1, 1, 1]
position = [0, 0, 0.5]
[contacts.floor]
base = "ground"
tip = "sled"
rigid = true
[joints.mast]
kind = "prismatic"
base = "sled"
tip = "carriage"
axis = [0, 0, 1]
latch = { at = CAUGHT }
[initial.thrown]
parts = ["carriage"]
velocity = [0, 0, SPEED]
[outputs.sled]
kind = "position"
of = "sled"
[outputs.speed]
kind = "velocity"
of = "sled"
[outputs.carriage]
kind = "velocity"
of = "carriage"
[outputs.floor]
kind = "contact_force"
of = "floor"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 0.6
step = 1e-3
"#;

/// Thrown up with 4 m/s and caught at 0.25 m, where √(16 - 5) m/s remain, the carriage lifts the sled: a floor does not hold it.
#[test]
fn a_latch_that_catches_a_rising_part_lifts_what_rests_on_the_floor() {
    let text = SLED.replace("CAUGHT", "0.25").replace("SPEED", "4");
    for scheme in ["radau-iia", "generalized-alpha", "hht", "energy-decaying"] {
        let (record, _) = run(&text, &[("analysis.scheme", scheme)]);
        let common = 3.0 / 5.0 * 11.0_f64.sqrt();
        let highest = series(&record, "sled.z").iter().copied().fold(0.0, f64::max);
        let wanted = 0.1 + common * common / 20.0;
        assert!((highest - wanted).abs() < 1e-5, "{scheme}: {highest} for {wanted}");
        // They fall together, and the impact on the floor is without rebound.
        assert!((last(&record, "sled.z") - 0.1).abs() < 1e-8, "{scheme}");
        assert!((last(&record, "floor.f3") - 50.0).abs() < 1e-5, "{scheme}: {}", last(&record, "floor.f3"));
    }
}

/// Thrown down, the carriage stops at once: the floor takes its momentum, and all kinetic energy is dissipated.
#[test]
fn a_latch_that_catches_a_falling_part_is_held_by_the_floor() {
    let text = SLED.replace("CAUGHT", "-0.25").replace("SPEED", "-2");
    let (record, _) = run(&text, &[]);
    // 4 + 2·10·0.25 = 9 m²/s².
    let fallen = record.times.iter().position(|&time| time > 0.1 + 1e-6).unwrap();
    for (name, wanted) in [("sled.z", 0.1), ("speed.v3", 0.0), ("carriage.v3", 0.0), ("floor.f3", 50.0)] {
        for value in &series(&record, name)[fallen..] {
            assert!((value - wanted).abs() < 1e-7, "{name}: {value}");
        }
    }
    let dissipated = series(&record, "energy.total")[0] - last(&record, "energy.total");
    assert!((dissipated - 0.5 * 3.0 * 9.0).abs() < 1e-9, "{dissipated}");
}

/// Solids that penetrate each other by round-off as drawn are not pressed apart, which would supply energy: they stay as they are.
#[test]
fn what_is_drawn_with_round_off_rests() {
    for shape in ["{ sphere = 0.1 }", "{ cylinder = [0.5, 0.2] }"] {
        for depth in [0.0_f64, 1e-8, 3e-8, -2e-8] {
            let height = (0.1 - depth).to_string();
            let position = format!("[0, 0, {height}]");
            let set =
                [("bodies.ball.position", &*position), ("bodies.ball.shape", shape), ("analysis.end", "1")];
            let (record, _) = run(BALL, &set);
            let gap = series(&record, "floor.gap");
            let moved = gap.iter().map(|own| (own - gap[0]).abs()).fold(0.0, f64::max);
            assert!(moved <= 1e-12 + (-depth).max(0.0), "{shape}, {depth}: {moved}");
            let force = last(&record, "floor.normal");
            assert!((force - 20.0).abs() < 1e-6, "{shape}, {depth}: {force}");
        }
    }
}
