//! Ropes over sheaves and drums with a radius against formulas: pulleys, hoists, cranes, belts.

use lissom::Model;

use crate::support::on_one_line::refused_on_one_line;
use crate::support::runs::{SCHEMES, column, last, run, run_without_warnings};

/// Masses of 3 kg and 2 kg at the ends of a rope over a sheave of 0.5 m, which does not turn.
const PULLEY: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[point_masses.heavy]
mass = 3
position = [-0.5, 0, 0]
[point_masses.light]
mass = 2
position = [0.5, 0, 0]
[springs.rope]
kind = "rope"
along = [
    { on = "heavy" },
    { on = "ground", at = [0, 0, 4], radius = 0.5, axis = [0, 1, 0] },
    { on = "light" },
]
stiffness = 1e5
length = "8 + 0.5*pi - 24/1e5"
[outputs.heavy]
kind = "position"
of = "heavy"
[outputs.light]
kind = "position"
of = "light"
[outputs.rope]
kind = "spring"
of = "rope"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

/// a = g (m1 - m2)/(m1 + m2) at the tension 24 N.
#[test]
fn a_pulley_without_friction_accelerates_as_atwood_says() {
    for scheme in SCHEMES {
        let record = run_without_warnings(PULLEY, &[("analysis.scheme", scheme)]);
        let (heavy, light) = (column(&record, "heavy", "z"), column(&record, "light", "z"));
        for (row, time) in record.times.iter().enumerate() {
            let fallen = time * time;
            assert!(
                (heavy[row] + fallen).abs() < 1e-8 && (light[row] - fallen).abs() < 1e-8,
                "{scheme} {time}"
            );
        }
        assert!((last(&record, "rope", "force") - 24.0).abs() < 1e-3, "{scheme}");
    }
}

/// A pulley of 4 kg and 0.5 kg m² that the rope turns is the end of two ropes: a = g (m1 - m2)/(m1 + m2 + I/r²) = 10/7, and its bearing
/// carries both tensions, 180/7 N and 160/7 N, and its weight.
#[test]
fn a_pulley_that_turns_delays_both_masses() {
    let (text, end) = (
        PULLEY.to_owned(),
        "{ on = \"pulley\", radius = 0.5, axis = [0, 1, 0], sense = \"positive\", joint = \"axle\" }",
    );
    let start = text.find("[springs.rope]").unwrap();
    let stop = text.find("[outputs.heavy]").unwrap();
    let ropes = format!(
        "[bodies.pulley]\nmass = 4\ninertia = [0.5, 0.5, 0.5]\nposition = [0, 0, 4]\n\
         [joints.axle]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"pulley\"\naxis = [0, 1, 0]\n\
         [springs.rope]\nkind = \"rope\"\nalong = [{{ on = \"heavy\" }}, {end}]\nstiffness = 1e6\nlength = \"4 - 180/7e6\"\n\
         [springs.other]\nkind = \"rope\"\nalong = [{end}, {{ on = \"light\" }}]\nstiffness = 1e6\nlength = \"4 - 160/7e6\"\n\
         [outputs.axle]\nkind = \"reaction\"\nof = \"axle\"\n[outputs.angle]\nkind = \"relative\"\nof = \"axle\"\n"
    );
    let text = format!("{}{ropes}{}", &text[..start], &text[stop..]);
    for scheme in SCHEMES {
        let record = run_without_warnings(&text, &[("analysis.scheme", scheme), ("analysis.end", "2")]);
        let fallen = 0.5 * (10.0 / 7.0) * 4.0;
        let (heavy, angle) = (last(&record, "heavy", "z"), last(&record, "angle", "angle"));
        assert!((heavy + fallen).abs() < 1e-6, "{scheme}: {heavy}");
        assert!((0.5 * angle + fallen).abs() < 1e-6, "{scheme}: {angle}");
        let force = [1, 2, 3].map(|k| last(&record, "axle", &format!("f{k}")));
        assert!((force[2].abs() - (40.0 + 340.0 / 7.0)).abs() < 0.01, "{scheme}: {force:?}");
        assert!(force[0].abs() + force[1].abs() < 0.01, "{scheme}: {force:?}");
    }
}

/// A mass of 10 kg hangs on a drum of 0.9 kg m² and 0.3 m.
const DRUM: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[point_masses.load]
mass = 10
position = [0.3, 0, 0]
[bodies.drum]
mass = 4
inertia = [0.9, 0.9, 0.9]
position = [0, 0, 5]
[joints.axle]
kind = "revolute"
base = "ground"
tip = "drum"
axis = [0, 1, 0]
angle = 0.7
[springs.rope]
kind = "rope"
along = [
    { on = "drum", radius = 0.3, axis = [0, 1, 0], sense = "positive", joint = "axle" },
    { on = "load" },
]
stiffness = 1e6
length = 4.99995
[outputs.load]
kind = "position"
of = "load"
[outputs.axle]
kind = "relative"
of = "axle"
[outputs.bearing]
kind = "reaction"
of = "axle"
[outputs.rope]
kind = "spring"
of = "rope"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
end = 3
step = 5e-3
"#;

/// a = g/(1 + I/(m r²)) = 5 m/s² over twelve turns of the drum, whose bearing carries the tension of 50 N and the weight of the drum.
#[test]
fn the_bearing_of_a_drum_carries_the_tension_over_many_turns() {
    let reversed = DRUM.replace(
        "radius = 0.3, axis = [0, 1, 0], sense = \"positive\"",
        "radius = 0.3, axis = [0, -2, 0], sense = \"negative\"",
    );
    let last_end = DRUM.replace(
        "    { on = \"drum\", radius = 0.3, axis = [0, 1, 0], sense = \"positive\", joint = \"axle\" },\n    { on = \"load\" },\n",
        "    { on = \"load\" },\n    { on = \"drum\", radius = 0.3, axis = [0, 1, 0], sense = \"negative\", joint = \"axle.angle\" },\n",
    );
    let of_base = DRUM.replace(
        "base = \"ground\"\ntip = \"drum\"\naxis = [0, 1, 0]",
        "base = \"drum\"\ntip = \"ground\"\naxis = [0, -1, 0]",
    );
    for text in [DRUM, &reversed, &last_end, &of_base] {
        for scheme in SCHEMES {
            let record = run_without_warnings(text, &[("analysis.scheme", scheme)]);
            for (row, time) in record.times.iter().enumerate() {
                let fallen = 2.5 * time * time;
                let of = |output, component| column(&record, output, component)[row];
                assert!((of("load", "z") + fallen).abs() < 1e-5, "{scheme} {time}: {}", of("load", "z"));
                let turned = of("axle", "angle") - 0.7;
                assert!((0.3 * turned - fallen).abs() < 1e-5, "{scheme} {time}: {turned}");
                assert!((of("rope", "force") - 50.0).abs() < 0.05, "{scheme} {time}");
                assert!(
                    (of("bearing", "f3").abs() - 90.0).abs() < 0.05,
                    "{scheme} {time}: {}",
                    of("bearing", "f3")
                );
                assert!(of("bearing", "f1").abs() < 0.05, "{scheme} {time}");
            }
            let energy = column(&record, "energy", "total");
            assert!((energy[energy.len() - 1] - energy[0]).abs() < 1e-3, "{scheme}");
        }
    }
}

/// A brake holds the drum: in statics its bearing carries the weight of both, and its brake 0.3 m times the weight of the load.
#[test]
fn a_drum_at_rest_holds_its_load() {
    let text = DRUM.replace("kind = \"dynamics\"\nend = 3\nstep = 5e-3", "kind = \"statics\"").replace(
        "[springs.rope]",
        "[joints.brake]\nkind = \"prescribed_rotation\"\njoint = \"axle\"\nrotation = \"0.7\"\n[outputs.brake]\nkind = \"reaction\"\nof = \"brake\"\n\
         [joints.rail]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"weight\"\naxis = [0, 0, 1]\n[springs.rope]",
    );
    let text = text
        .replace("[point_masses.load]\nmass = 10", "[bodies.weight]\nmass = 10\ninertia = [1, 1, 1]")
        .replace("on = \"load\"", "on = \"weight\"")
        .replace("of = \"load\"", "of = \"weight\"");
    let record = run(&text, &[]);
    assert!(
        (last(&record, "bearing", "f3").abs() - 140.0).abs() < 1e-6,
        "{}",
        last(&record, "bearing", "f3")
    );
    assert!(
        (last(&record, "brake", "moment").abs() - 30.0).abs() < 1e-6,
        "{}",
        last(&record, "brake", "moment")
    );
    assert!(
        (last(&record, "load", "z") + 100.0 / 1e6 - 0.00005).abs() < 1e-9,
        "{}",
        last(&record, "load", "z")
    );
}

/// Rope from the jib's root over a trolley's sheave, around that of the hook, over the other one of the trolley to the jib's end.
const CRANE: &str = r#"
lissom = 1
gravity = [0, 0, -10]
[bodies.trolley]
mass = 100
inertia = [1, 1, 1]
position = [3, 0, 10]
velocity = [1, 0, 0]
[bodies.hook]
mass = 500
inertia = [1, 1, 1]
position = [3, 0, 4]
velocity = [1, 0, 0]
[joints.jib]
kind = "prismatic"
base = "ground"
tip = "trolley"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_displacement"
joint = "jib"
displacement = "t"
[joints.guide]
kind = "prismatic"
base = "trolley"
tip = "hook"
axis = [0, 0, 1]
[springs.rope]
kind = "rope"
along = [
    { on = "ground", at = [-1, 0, 10.3] },
    { on = "trolley", at = [2.4, 0, 10], radius = 0.3, axis = [0, 1, 0] },
    { on = "hook", radius = 0.3, axis = [0, 1, 0] },
    { on = "trolley", at = [3.6, 0, 10], radius = 0.3, axis = [0, 1, 0] },
    { on = "ground", at = [20, 0, 10.3] },
]
stiffness = 1e6
length = "31.8 + 0.6*pi - 2500/1e6"
[outputs.hook]
kind = "position"
of = "hook"
[outputs.rope]
kind = "spring"
of = "rope"
[outputs.drive]
kind = "reaction"
of = "drive"
[analysis]
kind = "dynamics"
end = 5
step = 1e-2
"#;

/// The hook keeps its height while the trolley travels, under half of the weight, and the trolley needs no drive.
#[test]
fn a_trolley_travels_with_its_hook_at_one_height() {
    let record = run_without_warnings(CRANE, &[("analysis.scheme", "radau-iia-5")]);
    for row in 0..record.times.len() {
        let of = |output, component| column(&record, output, component)[row];
        assert!((of("hook", "z") - 4.0).abs() < 1e-8, "{}", of("hook", "z"));
        assert!((of("rope", "force") - 2500.0).abs() < 1e-2, "{}", of("rope", "force"));
        assert!(of("drive", "force").abs() < 1e-2, "{}", of("drive", "force"));
    }
    // By default it has no tension at the start.
    let slack =
        run(&CRANE.replace("length = \"31.8 + 0.6*pi - 2500/1e6\"\n", ""), &[("analysis.end", "0.01")]);
    assert!(column(&slack, "rope", "elongation")[0].abs() < 1e-12);
}

/// Two wheels of 0.5 m and 0.2 m, 1.3 m apart, with an open or a crossed belt of two spans under 100 N each: the second wheel turns by
/// 2.5 times as much, in the same or the opposite sense, and its bearing carries 2 T cos β with sin β = (r1 ∓ r2)/d.
#[test]
fn belts_turn_wheels_in_both_senses() {
    for (is_crossed, sum) in [(false, 0.3), (true, 0.7_f64)] {
        let sign = if is_crossed { -1.0 } else { 1.0 };
        let cosine = (1.0 - (sum / 1.3_f64).powi(2)).sqrt();
        let wheel = |name: &str, x: f64, rate: f64| {
            format!(
                "[bodies.{name}]\nmass = 2\ninertia = [0.1, 0.1, 0.1]\nposition = [{x}, 0, 0]\nangular_velocity = [0, {rate}, 0]\n\
                 [joints.{name}]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = [0, 1, 0]\n\
                 [outputs.{name}]\nkind = \"relative\"\nof = \"{name}\"\n[outputs.{name}_bearing]\nkind = \"reaction\"\nof = \"{name}\"\n"
            )
        };
        let end = |name: &str, radius: f64, is_positive: bool| {
            let sense = if is_positive { "positive" } else { "negative" };
            format!(
                "{{ on = \"{name}\", radius = {radius}, axis = [0, 1, 0], sense = \"{sense}\", joint = \"{name}\" }}"
            )
        };
        let span = |name: &str, is_positive: bool| {
            format!(
                "[springs.{name}]\nkind = \"rope\"\nalong = [{}, {}]\nstiffness = 1e5\nlength = \"{} - 1e-3\"\n",
                end("big", 0.5, is_positive),
                end("small", 0.2, is_positive != is_crossed),
                1.3 * cosine
            )
        };
        let text = format!(
            "lissom = 1\n{}{}[joints.motor]\nkind = \"prescribed_rotation\"\njoint = \"big\"\nrotation = \"3*t\"\n{}{}\
             [analysis]\nkind = \"dynamics\"\nend = 6\nstep = 1e-2\n",
            wheel("big", 0.0, 3.0),
            wheel("small", 1.3, sign * 7.5),
            span("upper", true),
            span("lower", false),
        );
        let record = run_without_warnings(&text, &[("analysis.scheme", "radau-iia-5")]);
        let angle = last(&record, "small", "angle");
        assert!((angle - sign * 45.0).abs() < 1e-7, "{is_crossed}: {angle}");
        let force = last(&record, "small_bearing", "f1");
        assert!((force.abs() - 200.0 * cosine).abs() < 1e-5, "{is_crossed}: {force}");
    }
}

/// A body that flies with a sheave, and two bodies on the rope over it: momentum, angular momentum and energy are conserved, although
/// the rope leaves the plane of the sheave.
const FLYING: &str = r#"
lissom = 1
[bodies.block]
mass = 4
inertia = [0.3, 0.2, 0.25]
angular_velocity = [0.3, 0.4, -0.2]
[bodies.one]
mass = 3
inertia = [0.02, 0.03, 0.04]
position = [-1.5, 0.1, -1.5]
velocity = [-1, 0.6, -1]
[bodies.other]
mass = 4
inertia = [0.05, 0.03, 0.04]
position = [1.5, -0.2, -1.2]
velocity = [1, -0.5, -1]
[springs.rope]
kind = "rope"
along = [
    { on = "one", at = [-1.4, 0.1, -1.4] },
    { on = "block", at = [0.1, 0, 0.2], radius = 0.3, axis = [0, 1, 0] },
    { on = "other" },
]
stiffness = 20
length = 3
[outputs.momentum]
kind = "momentum"
[outputs.energy]
kind = "energy"
[outputs.rope]
kind = "spring"
of = "rope"
[analysis]
kind = "dynamics"
end = 0.3
step = 0.01
"#;

#[test]
fn a_flying_sheave_conserves_momentum_and_energy() {
    let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, own| most.max((own - values[0]).abs()));
    let momenta = ["p1", "p2", "p3", "l1", "l2", "l3"];
    for (scheme, step, limit) in [
        ("radau-iia-9", "0.005", 1e-8),
        ("radau-iia-5", "0.01", 1e-6),
        ("radau-iia", "0.01", 5e-3),
        ("generalized-alpha", "0.005", 0.03),
        ("hht", "0.005", 0.03),
    ] {
        let record = run(FLYING, &[("analysis.scheme", scheme), ("analysis.step", step)]);
        assert!(column(&record, "rope", "force").iter().all(|force| *force > 5.0), "{scheme}: it stays taut");
        let energy = most(column(&record, "energy", "total"));
        assert!(energy < limit, "{scheme}: {energy:e}");
        for component in momenta {
            let momentum = most(column(&record, "momentum", component));
            assert!(momentum < limit, "{scheme} {component}: {momentum:e}");
        }
    }
    for step in ["0.1", "0.02"] {
        let scheme = [("analysis.scheme", "energy-decaying"), ("analysis.spectral_radius", "1")];
        let record = run(FLYING, &[scheme[0], scheme[1], ("analysis.step", step)]);
        let energy = most(column(&record, "energy", "total"));
        assert!(energy < 1e-8, "step {step}: {energy:e}");
    }
}

/// A load that is lifted above a sheave takes the rope off it.
#[test]
fn a_rope_that_leaves_its_sheave_is_an_error() {
    let text = r#"
lissom = 1
[bodies.load]
mass = 1
inertia = [1, 1, 1]
position = [2, 0, -1]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "load"
axis = [0, 0, 1]
[joints.drive]
kind = "prescribed_displacement"
joint = "rail"
displacement = "2*smoothstep(t)"
[springs.rope]
kind = "rope"
along = [
    { on = "ground", at = [-2, 0, 0] },
    { on = "ground", radius = 0.3, axis = [0, 1, 0] },
    { on = "load" },
]
stiffness = 100
length = 3
[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#;
    let mut session = Model::from_text("model.toml", text).session().unwrap();
    let error = session.run().expect_err("the rope leaves the sheave").to_string();
    assert!(error.contains("no longer lies on the sheave") && error.contains("its point 2"), "{error}");
}

#[test]
fn sheaves_that_cannot_be_are_refused() {
    let sheave = "{ on = \"ground\", at = [0, 0, 4], radius = 0.5, axis = [0, 1, 0] }";
    for (with, wanted) in [
        ("{ on = \"ground\", at = [0, 0, 4], radius = 0.5 }", "has a `radius`, but no `axis`"),
        ("{ on = \"ground\", at = [0, 0, 4], axis = [0, 1, 0] }", "has `axis`, but no `radius`"),
        ("{ on = \"ground\", at = [0, 0, 4], radius = -0.5, axis = [0, 1, 0] }", "greater than zero"),
        ("{ on = \"ground\", at = [0, 0, 4], radius = 0.5, axis = [1, 0, 0] }", "in line with it"),
        (
            "{ on = \"ground\", at = [0, 0, 4], radius = 0.5, axis = [0, 1, 2] }",
            "whose plane the rope leaves at 6",
        ),
        (
            "{ on = \"ground\", at = [0, 0, 0], radius = 0.6, axis = [0, 1, 0], sense = \"positive\" }",
            "overlaps a neighbour",
        ),
        (
            "{ on = \"ground\", at = [0, 0, 4], radius = 0.5, axis = [0, 1, 0], sense = \"left\" }",
            "cannot be `left`",
        ),
    ] {
        let found = refused_on_one_line(&PULLEY.replacen(sheave, with, 1));
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
    for (from, to, wanted) in [
        (", sense = \"positive\"", "", "specify `sense`"),
        ("tip = \"drum\"", "tip = \"other\"", "that joint `axle` does not turn"),
        (
            "radius = 0.3, axis = [0, 1, 0]",
            "radius = 0.3, axis = [0, 1, 1]",
            "is not that of its joint `axle`",
        ),
        ("joint = \"axle\" },", "joint = \"axe\" },", "axe"),
        ("kind = \"revolute\"", "kind = \"cylindrical\"", "has 2 coordinates"),
        (
            "{ on = \"load\" },",
            "{ on = \"load\", radius = 0.1, axis = [0, 1, 0], sense = \"positive\" },",
            "has no rotation",
        ),
    ] {
        let text = DRUM.replace("angle = 0.7\n", "").replacen(
            "[joints.axle]",
            "[bodies.other]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 5]\n[joints.axle]",
            1,
        );
        let found = refused_on_one_line(&text.replacen(from, to, 1));
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
}
