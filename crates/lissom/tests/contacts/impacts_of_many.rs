//! Impacts, and friction at impacts, where all touches of a step are solved at once: closed forms at every step size and mass ratio.

use lissom::Model;
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};

use crate::support::runs::{record, run, session};
use crate::support::series::{last, series};

/// Gravity [m/s²].
const G: f64 = 9.81;

fn scene(gravity: f64, bodies: &str, contact: &str, [step, end]: [f64; 2]) -> String {
    format!(
        "lissom = 1\ngravity = [0, 0, -{gravity}]\nground.shape = {{ kind = \"plane\" }}\n{bodies}\n[contacts.all]\nstiffness = 1e6\n{contact}\n\
         [outputs.all]\nkind = \"contact_force\"\nof = \"all\"\n[outputs.energy]\nkind = \"energy\"\n\
         [analysis]\nkind = \"dynamics\"\nscheme = \"backward-euler\"\nstep = {step}\nend = {end}\n"
    )
}

fn ball(name: &str, (radius, mass): (f64, f64), place: [f64; 3], more: &str) -> String {
    format!(
        "[bodies.{name}]\nmass = {mass}\ninertia = {{ sphere = {radius} }}\nshape = {{ sphere = {radius} }}\nposition = {place:?}\n{more}\n\
         [outputs.v_{name}]\nkind = \"velocity\"\nof = \"{name}\"\n[outputs.w_{name}]\nkind = \"angular_velocity\"\nof = \"{name}\"\n\
         [outputs.p_{name}]\nkind = \"position\"\nof = \"{name}\"\n"
    )
}

/// A tip that is joined to a heavier or lighter body rebounds with the restitution, whatever the joint, the masses and the step are.
#[test]
fn jointed_tips_rebound_with_the_restitution() {
    for (joint, more) in [("clamp", ""), ("spherical", ""), ("revolute", "axis = \"y\"\n")] {
        for mass in [0.01, 1.0, 20.0] {
            for step in [5e-3, 1e-3, 1e-4] {
                let bodies = format!(
                    "[bodies.a]\nmass = 7\ninertia = [1, 1, 1]\nposition = [0, 0, 0.7]\nvelocity = [0, 0, -1.5]\n\
                     [outputs.v]\nkind = \"velocity\"\nof = \"a\"\n{}[joints.j]\nkind = \"{joint}\"\nbase = \"a\"\ntip = \"b\"\n{more}",
                    ball("b", (0.05, mass), [0.0, 0.0, 0.11], "velocity = [0, 0, -1.5]")
                );
                let contact = "base = \"ground\"\ntip = \"b\"\nrestitution = 0.55";
                let record = run(&scene(0.0, &bodies, contact, [step, 0.1]), &[]);
                let found = last(&record, "v.v3");
                assert!((found - 0.55 * 1.5).abs() < 2e-3, "{joint} {mass} {step}: {found}");
            }
        }
    }
}

/// The friction of an impact that sticks: the ball leaves rolling, at 5/7 of its velocity; of one that slides it is μ (1 + e) v.
#[test]
fn impacts_have_their_friction() {
    for mass in [0.2, 5.0] {
        for step in [1e-2_f64, 1e-3, 1e-4, 1e-5] {
            let end = (20.0 * step).max(0.03);
            let scene = |velocity: [f64; 3]| {
                let above = 0.1 + 0.3 * end * 2.0;
                let body = ball("b", (0.1, mass), [0.0, 0.0, above], &format!("velocity = {velocity:?}"));
                let contact = "base = \"ground\"\ntip = \"b\"\nrestitution = 0.6\nfriction = 0.3";
                run(&scene(0.0, &body, contact, [step, end]), &[])
            };
            let sticks = scene([1.2, 0.0, -2.0]);
            let found = last(&sticks, "v_b.v1");
            // Steps that resolve the impact see the ball flatten: by 4 % of its radius if it is heavy.
            let allowed = if step < 1e-4 { 0.02 } else { 5e-3 };
            assert!((found - 1.2 * 5.0 / 7.0).abs() < allowed, "{mass} {step}: {found}");
            assert!((last(&sticks, "w_b.w2") - found / 0.1).abs() < 50.0 * allowed, "{mass} {step}");
            let slides = scene([4.0, 0.0, -2.0]);
            let found = last(&slides, "v_b.v1");
            assert!((found - (4.0 - 0.3 * 1.6 * 2.0)).abs() < allowed, "{mass} {step}: {found}");
        }
    }
}

/// A ball rebounds from a head at the end of a beam: the relative velocity has the restitution, whose error is of first order in the step.
#[test]
fn a_ball_rebounds_from_the_end_of_a_beam() {
    let beam = "[materials.steel]\nE = 2.1e11\nnu = 0.3\ndensity = 7800\n[sections.s]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.01\n\
                material = \"steel\"\n[beams.beam]\nfrom = [0, 0, 0.5]\nto = [1, 0, 0.5]\nelements = 6\nsection = \"s\"\n[joints.wall]\n\
                kind = \"clamp\"\nbase = \"ground\"\ntip = \"beam.start\"\n[joints.head]\nkind = \"clamp\"\nbase = \"beam.end\"\ntip = \"head\"\n";
    let bodies = ball("head", (0.05, 0.3), [1.0, 0.0, 0.45], "")
        + &ball("ball", (0.05, 0.2), [1.0, 0.0, 0.57], "velocity = [0, 0, -1.2]")
        + beam;
    let contact = "base = \"head\"\ntip = \"ball\"\nrestitution = 0.7";
    for (step, allowed) in [(1e-3, 0.1), (1e-4, 0.01)] {
        let record = run(&scene(0.0, &bodies, contact, [step, 0.03]), &[]);
        let relative: Vec<f64> = series(&record, "v_ball.v3")
            .iter()
            .zip(series(&record, "v_head.v3"))
            .map(|(ball, head)| ball - head)
            .collect();
        let impact = relative.windows(2).find(|pair| pair[0] < -0.5 && pair[1] > 0.0).expect("they collide");
        let found = impact[1] / -impact[0];
        assert!((found / 0.7 - 1.0).abs() < allowed, "{step}: {found}");
    }
}

/// A body that stands on light feet sinks to N/k and stays there, and one that is dropped on them rests there in the end.
#[test]
fn light_feet_carry_a_heavy_body() {
    for (mass, height, step) in [(0.02, 0.0, 1e-3), (0.02, 0.0, 1e-2), (0.5, 0.03, 1e-3)] {
        let mut bodies = format!(
            "[bodies.a]\nmass = 30\ninertia = [1, 1, 1]\nposition = [0, 0, {}]\nshape = []\n[outputs.a]\nkind = \"position\"\nof = \"a\"\n",
            0.4 + height
        );
        for (k, (x, y)) in [(0.3, 0.2), (0.3, -0.2), (-0.3, 0.2), (-0.3, -0.2)].into_iter().enumerate() {
            bodies += &ball(&format!("f{k}"), (0.03, mass), [x, y, 0.03 + height], "");
            let joint = format!("[joints.j{k}]\nkind = \"clamp\"\nbase = \"a\"\ntip = \"f{k}\"\n");
            bodies += &joint;
        }
        let contact = "base = \"ground\"\ntip = \"f0\"\nothers = [\"f1\", \"f2\", \"f3\"]\nrestitution = 0.4\nfriction = 0.5";
        let record = run(&scene(G, &bodies, contact, [step, 3.0]), &[]);
        let depth = (30.0 + 4.0 * mass) * G / 4e6;
        let found = 0.4 - last(&record, "a.z");
        assert!((found / depth - 1.0).abs() < 0.02, "{mass} {height} {step}: {found} of {depth}");
    }
}

/// Four corners that meet the ground at once rebound with the restitution.
#[test]
fn a_box_rebounds_flat() {
    for restitution in [0.1, 0.5, 1.0] {
        let body = "[bodies.b]\nmass = 2\ninertia = { box = [0.2, 0.2, 0.1] }\nshape = { box = [0.2, 0.2, 0.1] }\nposition = [0, 0, 0.07]\n\
                    velocity = [0, 0, -1]\n[outputs.v]\nkind = \"velocity\"\nof = \"b\"\n";
        let contact = format!("base = \"ground\"\ntip = \"b\"\nrestitution = {restitution}\nfriction = 0.3");
        for step in [3e-3, 1e-3, 1e-4] {
            let record = run(&scene(0.0, body, &contact, [step, 0.05]), &[]);
            let found = last(&record, "v.v3");
            assert!((found - restitution).abs() < 1e-3, "{restitution} {step}: {found}");
        }
    }
}

/// Balls in a row that touch, struck without loss: impacts at one instant keep energy and momentum.
#[test]
fn balls_in_a_row_keep_their_energy() {
    let mut bodies = String::new();
    for k in 0..3 {
        let more = if k == 0 { "velocity = [1, 0, 0]" } else { "" };
        bodies += &ball(
            &format!("b{k}"),
            (0.05, 1.0),
            [0.1 * f64::from(k) - if k == 0 { 1e-3 } else { 0.0 }, 0.0, 1.0],
            more,
        );
    }
    let contact = "base = \"b0\"\ntip = \"b1\"\nothers = [\"b2\"]\nrestitution = 1";
    for step in [1e-3, 1e-4] {
        let record = run(&scene(0.0, &bodies, contact, [step, 0.02]), &[]);
        let velocities: Vec<f64> = (0..3).map(|k| last(&record, &format!("v_b{k}.v1"))).collect();
        let (momentum, energy) = velocities.iter().fold((0.0, 0.0), |(p, e), own| (p + own, e + own * own));
        assert!((momentum - 1.0_f64).abs() < 1e-6, "{step}: {velocities:?}");
        assert!(energy < 1.0 + 1e-6 && energy > 0.97, "{step}: {velocities:?}");
    }
}

/// A ball that passes above an edge is not touched, and one that strikes another at speed leaves it along the line of centres.
#[test]
fn fast_balls_touch_only_what_they_meet() {
    for (speed, step) in [(20.0, 1e-3), (60.0, 1e-3), (8.0, 1e-2)] {
        let bodies = ball("b", (0.05, 1.0), [-0.21, 0.0, 0.0521], &format!("velocity = [{speed}, 0, 0]"))
            + "[bodies.c]\nmass = 1\ninertia = [1, 1, 1]\nshape = { sphere = 0.05 }\nposition = [0, 0, -0.05]\n";
        let contact = "base = \"c\"\ntip = \"b\"\nrestitution = 0.5";
        let record = run(&scene(0.0, &bodies, contact, [step, 0.4 / speed]), &[]);
        assert!((last(&record, "v_b.v1") - speed).abs() < 1e-9, "{speed}: {}", last(&record, "v_b.v1"));
        assert!(last(&record, "v_b.v3").abs() < 1e-9, "{speed}: {}", last(&record, "v_b.v3"));
    }
    for (speed, step) in [(10.0, 1e-3), (3.0, 1e-2)] {
        let aside: f64 = 0.05;
        let bodies = ball("b", (0.05, 1.0), [-0.313, aside, 0.0], &format!("velocity = [{speed}, 0, 0]"))
            + &ball("c", (0.05, 1.0), [0.0, 0.0, 0.0], "");
        let contact = "base = \"c\"\ntip = \"b\"\nrestitution = 1";
        let record = run(&scene(0.0, &bodies, contact, [step, 0.6 / speed]), &[]);
        let angle = (last(&record, "v_c.v2") / last(&record, "v_c.v1")).atan();
        assert!((angle + (aside / 0.1).asin()).abs() < 5e-3, "{speed}: {angle}");
    }
}

/// A capsule that two pads press keeps still.
#[test]
fn a_pinched_capsule_does_not_rock() {
    let pad = |name: &str, x: f64, push: f64| {
        format!(
            "[bodies.{name}]\nmass = 0.2\ninertia = [1e-4, 1e-4, 1e-4]\nposition = [{x}, 0, 1]\nshape = {{ box = [0.02, 0.05, 0.05] }}\n\
             [joints.{name}]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = \"x\"\n[springs.{name}]\nkind = \"axial\"\n\
             joint = \"{name}\"\ndamping = 20\n[loads.{name}]\nkind = \"joint_force\"\njoint = \"{name}\"\nforce = \"{push}\"\n"
        )
    };
    let bodies = pad("left", -0.015, 15.0)
        + &pad("right", 0.015, -15.0)
        + "[bodies.c]\nmass = 0.06\ninertia = [5e-6, 5e-6, 5e-7]\nposition = [0, 0, 1]\n\
           shape = { kind = \"capsule\", radius = 0.005, length = 0.03, axis = \"y\" }\n[outputs.c]\nkind = \"position\"\nof = \"c\"\n\
           [outputs.w]\nkind = \"angular_velocity\"\nof = \"c\"\n";
    let contact = "base = \"left\"\ntip = \"c\"\nothers = [\"right\"]\nfriction = 0.6";
    for step in [1e-3, 5e-3] {
        let record = run(&scene(G, &bodies, contact, [step, 3.0]), &[]);
        let spin = ["w.w1", "w.w2", "w.w3"].map(|name| last(&record, name).abs());
        assert!(spin.iter().all(|own| *own < 1e-6), "{step}: {spin:?}");
        assert!((last(&record, "c.z") - 1.0).abs() < 1e-4, "{step}: {}", last(&record, "c.z"));
    }
}

/// Modes about an instant are those about the state of the model's own run.
#[test]
fn modes_about_an_instant_start_from_the_own_run() {
    let bodies = ball("b", (0.1, 2.0), [0.0, 0.0, 0.1], "");
    let contact = "base = \"ground\"\ntip = \"b\"\ndissipation = 0.2";
    let text = scene(G, &bodies, contact, [1e-3, 1.0]);
    for deflection in ["", "friction = 0.3\ndeflection = 1e-3"] {
        let text = text.replace("dissipation = 0.2", &format!("dissipation = 0.2\n{deflection}"));
        let request = ModeRequest { about: Some(OperatingPoint::Time(1.0)), ..ModeRequest::default() };
        let found = modes(&Model::from_text("model.toml", &text), &request).unwrap();
        let wanted = (1e6_f64 / 2.0).sqrt() / std::f64::consts::TAU;
        let is_found = found.modes.iter().any(|mode| (mode.frequency / wanted - 1.0).abs() < 1e-3);
        assert!(is_found, "{deflection}: {wanted}");
    }
}

/// Piles with restitution gain no energy in a step, and give no warning that means nothing.
#[test]
fn piles_with_restitution_gain_no_energy() {
    for restitution in [0.3, 0.8] {
        let mut bodies = String::new();
        let mut names = Vec::new();
        for k in 0..12 {
            let share = |factor: f64| 0.004 * ((f64::from(k) * factor).fract() - 0.5);
            let place = [
                f64::from(k % 2) * 0.106 + share(0.71),
                f64::from(k / 2 % 2) * 0.106 + share(0.37),
                0.06 + 0.12 * f64::from(k / 4),
            ];
            bodies += &ball(&format!("b{k}"), (0.05, 1.0), place, "");
            names.push(format!("\"b{k}\""));
        }
        let contact = format!(
            "base = \"ground\"\ntip = \"b0\"\nothers = [{}]\nrestitution = {restitution}\nfriction = 0.3",
            names[1..].join(", ")
        );
        for step in [1e-3, 5e-3] {
            let mut session = session(&scene(G, &bodies, &contact, [step, 1.0]), &[]);
            let record = record(&mut session);
            let energy = series(&record, "energy.total");
            let rise = energy.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max);
            assert!(rise < 1e-6 * energy[0], "{restitution} {step}: {rise:e}");
            // Bounces shorter than ten steps lose in flight.
            let is_quiet = step > 1e-3 || session.warnings().count() == 0;
            assert!(is_quiet, "{restitution} {step}: {:?}", session.warnings().next());
        }
    }
}
