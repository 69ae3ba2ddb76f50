//! Ropes over pulleys against formulas: tackles, hoists, drums, and ropes that go slack.

use lissom::Model;

use crate::support::on_one_line::refused_on_one_line;
use crate::support::runs::{column, run};

/// A hook of 12 kg on a rail, hung from the ground by four falls of one rope.
const TACKLE: &str = r#"
lissom = 1
gravity = [0, 0, -10]

[bodies.hook]
mass = 12
inertia = [1, 1, 1]

[joints.rail]
kind = "prismatic"
base = "ground"
tip = "hook"
axis = [0, 0, 1]

[springs.hoist]
kind = "rope"
along = [
    { on = "ground", at = [0, 0, 5] },
    { on = "hook" },
    { on = "ground", at = [0, 0, 5] },
    { on = "hook" },
    { on = "ground", at = [0, 0, 5] },
]
stiffness = 1000

[outputs.hoist]
kind = "spring"
of = "hoist"
[outputs.rail]
kind = "relative"
of = "rail"
[outputs.energy]
kind = "energy"
[outputs.work]
kind = "work"
of = "hoist"
[outputs.support]
kind = "reaction"
of = "rail"

[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 2e-3
"#;

#[test]
fn a_tackle_divides_the_weight_among_its_falls() {
    let statics =
        TACKLE.split("[analysis]").next().unwrap().to_owned() + "[analysis]\nkind = \"statics\"\nsteps = 4\n";
    // Taut from the start: a slack rope holds nothing, and has no equilibrium.
    let record = run(&statics, &[("springs.hoist.length", "19.99")]);
    let tension = column(&record, "hoist", "force").last().unwrap();
    assert!((tension - 12.0 * 10.0 / 4.0).abs() < 1e-9, "{tension}");
    // four falls, 30 N / (1000 N/m) longer than 19.99 m
    let sunk = column(&record, "rail", "displacement").last().unwrap();
    assert!((sunk + (30.0 / 1000.0 - 0.01) / 4.0).abs() < 1e-10, "{sunk}");
}

/// m z'' = 4 k (4 (5 - z) - L) - m g with L = L0 - 0.2 t² from equilibrium: z = z0 + 0.05 t² - 0.1 m/(16 k) (1 - cos ω t).
#[test]
fn a_winch_hoists_by_a_quarter_of_what_it_takes_in() {
    let slack = 12.0 * 10.0 / (4.0 * 1000.0);
    let length = format!("{} - 0.2*t^2", 20.0 - slack);
    let set = [("springs.hoist.length", length.as_str())];
    let omega = (16.0 * 1000.0 / 12.0_f64).sqrt();
    let errors = ["4e-3", "2e-3"].map(|step| {
        let record = run(TACKLE, &[set[0], ("analysis.step", step)]);
        let (times, places) = (&record.times, column(&record, "rail", "displacement"));
        let error = times.iter().zip(places).map(|(time, place)| {
            let exact = 0.05 * time * time - 0.1 * 12.0 / 16000.0 * (1.0 - (omega * time).cos());
            (place - exact).abs()
        });
        // The work of the winch is what the hook has got; weight is not among the works.
        let lifted = column(&record, "energy", "total");
        let work = column(&record, "work", "work").last().unwrap();
        assert!((work - (lifted.last().unwrap() - lifted[0])).abs() < 2e-4, "{work} {lifted:?}");
        error.fold(0.0, f64::max)
    });
    assert!(errors[1] < 1e-6 && errors[0] / errors[1] > 6.0, "{errors:?}");
}

#[test]
fn a_slack_rope_lets_fall_and_throws_back() {
    // 0.2 m of free fall, then a bounce without loss.
    let text = TACKLE.replace("step = 2e-3", "relative_tolerance = 1e-7");
    let record = run(&text, &[("springs.hoist.length", "20.8")]);
    let (places, tension) = (column(&record, "rail", "displacement"), column(&record, "hoist", "force"));
    for (row, time) in record.times.iter().enumerate().filter(|(_, time)| **time < 0.2) {
        assert!((places[row] + 5.0 * time * time).abs() < 1e-9 && tension[row] == 0.0, "{time}");
    }
    assert!(tension.iter().all(|&tension| tension >= 0.0) && tension.iter().any(|&tension| tension > 100.0));
    // m g (0.2 + x) = ½ 16 k x²
    let deepest = places.iter().copied().fold(0.0, f64::min);
    let sag = (120.0 + (120.0_f64.powi(2) + 2.0 * 16000.0 * 24.0).sqrt()) / 16000.0;
    assert!((deepest + 0.2 + sag).abs() < 1e-3, "{deepest} {sag}");
    let energy = column(&record, "energy", "total");
    assert!(energy.iter().all(|now| (now - energy[0]).abs() < 1e-3 * 24.0), "{energy:?}");
}

/// Two buckets over a pulley on the ground: (m1 - m2) g/(m1 + m2), whatever the rope does inside of itself.
#[test]
fn two_buckets_over_a_pulley_accelerate_as_atwood_says() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[point_masses.heavy]
mass = 3
position = [-1, 0, 0]
[point_masses.light]
mass = 2
position = [1, 0, 0]
[springs.rope]
kind = "rope"
along = [
    { on = "heavy" },
    { on = "ground", at = [-1, 0, 4] },
    { on = "ground", at = [1, 0, 4] },
    { on = "light" },
]
stiffness = 1e5
length = 9.99976
[outputs.heavy]
kind = "position"
of = "heavy"
[outputs.light]
kind = "position"
of = "light"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1
step = 1e-3
"#;
    let record = run(text, &[]);
    let (heavy, light) = (column(&record, "heavy", "z"), column(&record, "light", "z"));
    // At the tension 2 m1 m2 g/(m1 + m2) = 24 N, without oscillation from the start.
    for (row, time) in record.times.iter().enumerate() {
        let fallen = 0.5 * 2.0 * time * time;
        assert!((heavy[row] + fallen).abs() < 1e-9 && (light[row] - fallen).abs() < 1e-9, "t = {time}");
    }
}

/// A mass of 10 kg hangs on a rope of 1e6 N/m that a drum of 0.9 kg m² and 0.3 m pays out.
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
along = [{ on = "ground", at = [0.3, 0, 5] }, { on = "load" }]
drums = ["axle"]
drum_radii = [0.3]
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
end = 1
step = 2e-3
"#;

/// a = g/(1 + I/(m r²)) = 5 m/s² at the tension m (g - a) = 50 N, without oscillation from the start.
#[test]
fn a_mass_on_a_drum_falls_slowly() {
    for scheme in ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"] {
        for steps in [("analysis.step", "2e-3"), ("analysis.relative_tolerance", "1e-6")] {
            let record = run(DRUM, &[("analysis.scheme", scheme), steps]);
            let last = record.times.len() - 1;
            let of = |output, component| column(&record, output, component);
            for (row, time) in record.times.iter().enumerate() {
                let fallen = 2.5 * time * time;
                let (z, turned) = (of("load", "z")[row], of("axle", "angle")[row] - 0.7);
                assert!((z + fallen).abs() < 1e-6, "{scheme} {steps:?} t = {time}: {z}");
                assert!((0.3 * turned - fallen).abs() < 1e-6, "{scheme} {steps:?} t = {time}: {turned}");
                let tension = of("rope", "force")[row];
                assert!((tension - 50.0).abs() < 0.02, "{scheme} {steps:?} t = {time}: {tension}");
            }
            let total = of("energy", "total");
            assert!(
                (total[last] - total[0]).abs() < 1e-4,
                "{scheme} {steps:?}: {} {}",
                total[0],
                total[last]
            );
        }
    }
}

/// The drum's carrier is free: what the rope pulls on it and on the drum leaves momentum and angular momentum what they were.
#[test]
fn a_drum_on_a_part_that_flies_takes_no_momentum() {
    let text = DRUM
        .replace("gravity = [0, 0, -10]", "gravity = [0, 0, 0]")
        .replace("base = \"ground\"", "base = \"carrier\"")
        .replace("{ on = \"ground\", at", "{ on = \"carrier\", at")
        .replace("length = 4.99995", "length = 4.99")
        .replace(
            "[joints.axle]",
            "[bodies.carrier]\nmass = 20\ninertia = [3, 2, 1]\nposition = [0, 0.2, 5.5]\n[outputs.momentum]\n\
             kind = \"momentum\"\n[joints.axle]",
        )
        .replace("stiffness = 1e6", "stiffness = 2e3");
    for scheme in ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"] {
        let record = run(&text, &[("analysis.scheme", scheme)]);
        for component in ["p1", "p2", "p3", "l1", "l2", "l3"] {
            let values = column(&record, "momentum", component);
            let most = values.iter().fold(0.0_f64, |most, own| most.max((own - values[0]).abs()));
            assert!(most < 2e-4, "{scheme} {component}: {most}");
        }
        // The spring has given all of its energy.
        let total = column(&record, "energy", "total");
        assert!(column(&record, "energy", "kinetic")[total.len() - 1] > 0.05, "{scheme}");
        assert!((total[total.len() - 1] / total[0] - 1.0).abs() < 5e-3, "{scheme}: {total:?}");
    }
}

/// Two drums hold a tackle of two falls: one of 0.3 m takes up 2 rad/s, one of 0.2 m pays out 1 rad/s, so that the hook rises by
/// (0.6 - 0.2)/2 m/s under twice the tension, and each drive holds its radius times that.
#[test]
fn a_hook_rises_by_half_of_what_two_drums_take_up() {
    let drum = |name: &str, rate: f64| {
        format!(
            "[bodies.{name}]\nmass = 4\ninertia = [1, 1, 1]\nangular_velocity = [0, {rate}, 0]\n[joints.{name}]\n\
             kind = \"revolute\"\nbase = \"ground\"\ntip = \"{name}\"\naxis = [0, 1, 0]\n[joints.{name}_drive]\n\
             kind = \"prescribed_rotation\"\njoint = \"{name}\"\nrotation = \"{rate}*t\"\n[outputs.{name}_drive]\n\
             kind = \"reaction\"\nof = \"{name}_drive\"\n"
        )
    };
    let text = format!(
        "lissom = 1\ngravity = [0, 0, -10]\n{}{}[point_masses.hook]\nmass = 12\nvelocity = [0, 0, 0.2]\n[springs.rope]\n\
         kind = \"rope\"\nalong = [{{ on = \"ground\", at = [0, 0, 5] }}, {{ on = \"hook\" }}, {{ on = \"ground\", at = [0, 0, 5] }}]\n\
         drums = [\"big.angle\", \"small\"]\ndrum_radii = [-0.3, 0.2]\nstiffness = 6e4\nlength = 9.999\n\
         [outputs.hook]\nkind = \"position\"\nof = \"hook\"\n[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-2\n",
        drum("big", 2.0),
        drum("small", 1.0)
    );
    let record = run(&text, &[("analysis.scheme", "radau-iia")]);
    let last = record.times.len() - 1;
    assert!((column(&record, "hook", "z")[last] - 0.2).abs() < 1e-7);
    let [big, small] = ["big_drive", "small_drive"].map(|own| column(&record, own, "moment")[last]);
    assert!(
        (big.abs() - 0.3 * 60.0).abs() < 1e-3 && (small.abs() - 0.2 * 60.0).abs() < 1e-3,
        "{big} {small}"
    );
    assert!(big * small < 0.0, "one lifts, one lets down: {big} {small}");
}

/// A winch whose speed is a signal: a coordinate of its own that a large damping holds at the speed asked for. Its length is
/// led by the hook's height, h' = 2 (1 - h).
#[test]
fn a_winch_follows_a_signal() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[bodies.hook]
mass = 2
inertia = [1, 1, 1]
velocity = [0, 0, 2]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "hook"
axis = [0, 0, 1]
[joints.winch]
kind = "generalized_coordinates"
start = [0]
rate = [-2]
[springs.winch]
kind = "coordinate_dynamics"
coordinates = ["winch"]
mass = 1
damping = 1e9
[loads.winch]
kind = "joint_force"
joint = "winch"
force = "1e9*2*(rail.displacement - 1)"
[springs.rope]
kind = "rope"
along = [{ on = "ground", at = [0, 0, 5] }, { on = "hook" }]
drums = ["winch"]
drum_radii = [1]
stiffness = 1e7
damping = 1e4
length = 4.999998
[outputs.rail]
kind = "relative"
of = "rail"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 2
step = 1e-2
"#;
    let record = run(text, &[]);
    for (row, time) in record.times.iter().enumerate() {
        let height = column(&record, "rail", "displacement")[row];
        assert!((height - (1.0 - (-2.0 * time).exp())).abs() < 1e-4, "t = {time}: {height}");
    }
}

/// A weight on a rope over an eye, which swings and bounces, and its counterweight on a rail: steps that turn the rope by a third of a
/// radian change nothing of the energy of the scheme that keeps it.
#[test]
fn a_rope_over_an_eye_keeps_its_energy_in_long_steps() {
    let text = r#"
lissom = 1
gravity = [0, 0, -10]
[bodies.weight]
mass = 2
inertia = [0.1, 0.2, 0.3]
position = [0.8, 0, 1]
velocity = [0, 3, 0]
angular_velocity = [0.5, 1, 0]
[bodies.counter]
mass = 3
inertia = [1, 1, 1]
position = [-1, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "counter"
axis = [0, 0, 1]
[springs.rope]
kind = "rope"
along = [{ on = "weight", at = [0.7, 0.1, 1.1] }, { on = "ground", at = [0, 0, 2] }, { on = "counter" }]
stiffness = 60
length = 2
[outputs.energy]
kind = "energy"
[outputs.rope]
kind = "spring"
of = "rope"
[analysis]
kind = "dynamics"
scheme = "energy-decaying"
spectral_radius = 1
end = 2
step = 0.1
"#;
    for step in ["0.1", "0.02"] {
        let record = run(text, &[("analysis.step", step)]);
        assert!(column(&record, "rope", "force").iter().all(|force| *force > 1.0), "it stays taut");
        let energy = column(&record, "energy", "total");
        let change = energy.iter().map(|own| (own - energy[0]).abs()).fold(0.0, f64::max);
        assert!(change < 1e-9, "step {step}: {change:e}");
    }
}

#[test]
fn ropes_that_cannot_be_are_refused() {
    for (from, to, wanted) in [
        ("stiffness = 1000", "stiffness = 1000\ndrums = [\"rail\"]", "as many as `drums`: 0 for 1"),
        ("stiffness = 1000", "stiffness = 1000\ndrum_radii = [0.2]", "as many as `drums`: 1 for 0"),
        ("stiffness = 1000", "stiffness = 1000\ndrums = [\"rail\"]\ndrum_radii = [0]", "pays out no rope"),
        (
            "stiffness = 1000",
            "stiffness = 1000\ndrums = [\"rail.angle\"]\ndrum_radii = [1]",
            "has no coordinate",
        ),
        ("stiffness = 1000", "stiffness = 1000\ndrums = [\"reel\"]\ndrum_radii = [1]", "reel"),
        (
            "{ on = \"hook\" },\n    { on = \"ground\"",
            "{ on = \"ground\", at = [0, 0, 5] },\n    { on = \"ground\"",
            "at one position",
        ),
        ("{ on = \"hook\" }", "{ on = \"hock\" }", "hock"),
        ("{ on = \"hook\" }", "{ at = [0, 0, 1] }", "lacks `on`"),
        ("{ on = \"hook\" }", "\"hook\"", "must be a table"),
    ] {
        let found = refused_on_one_line(&TACKLE.replacen(from, to, 1));
        assert!(found.contains(wanted), "{wanted}: {found}");
    }
}

/// A winch lifts a load by a stiff rope with long steps: its force is recovered with the acceleration that the winch requires.
#[test]
fn the_force_of_a_rope_follows_from_the_motion_of_its_winch() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[point_masses.load]
mass = 2000
position = [0, 0, -15]
[springs.rope]
kind = "rope"
along = [{ on = "ground", at = [0, 0, 0] }, { on = "load" }]
stiffness = 2e6
damping = 2e4
length = "15 - 2000*9.81/2e6 - 3*smoothstep((t - 2)/8)"
[outputs.rope]
kind = "spring"
of = "rope"
[outputs.load]
kind = "acceleration"
of = "load"
[analysis]
kind = "dynamics"
end = 12
output_step = 0.25
"#;
    for scheme in ["radau-iia-9", "radau-iia-5", "radau-iia"] {
        let record = run(text, &[("analysis.scheme", &format!("\"{scheme}\""))]);
        for (k, time) in record.times.iter().enumerate() {
            let x = ((time - 2.0) / 8.0).clamp(0.0, 1.0);
            let lifted = 3.0 / 64.0 * (120.0 * x.powi(3) - 180.0 * x * x + 60.0 * x);
            let (found, force) = (column(&record, "load", "a3")[k], column(&record, "rope", "force")[k]);
            // The rope stretches by less than a thousandth of the motion.
            assert!((found - lifted).abs() < 4e-3, "{scheme}, t = {time}: {found} for {lifted}");
            assert!((force - 2000.0 * (9.81 + found)).abs() < 20.0, "{scheme}, t = {time}: {force}");
        }
    }
}

/// A mass on three ropes without tension as drawn, taut or slack: nothing resists the first part of its weight, which is ramped.
#[test]
fn a_mass_hangs_on_ropes_without_tension_as_drawn() {
    let (mass, stiffness) = (2.0, 2e4);
    for length in [2.0_f64.sqrt(), 1.5] {
        let rope = |k: u8| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(k) / 3.0).sin_cos();
            format!(
                "[springs.rope{k}]\nkind = \"rope\"\nstiffness = {stiffness}\nlength = {length}\n\
                 along = [{{ on = \"ground\", at = [{cosine}, {sine}, 0] }}, {{ on = \"load\" }}]\n"
            )
        };
        let ropes = [0, 1, 2].map(rope).concat();
        let text = format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[point_masses.load]\nmass = {mass}\nposition = [0, 0, -1]\n{ropes}\
             [outputs.load]\nkind = \"position\"\nof = \"load\"\n[outputs.rope]\nkind = \"spring\"\nof = \"rope1\"\n\
             [analysis]\nkind = \"statics\"\n"
        );
        let record = run(&text, &[]);
        // Balance along z, by bisection of the depth.
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..100 {
            let depth: f64 = 0.5 * (low + high);
            let now = depth.hypot(1.0);
            let held = 3.0 * stiffness * (now - length).max(0.0) * depth / now;
            if held < mass * 9.81 { low = depth } else { high = depth }
        }
        let found = column(&record, "load", "z").last().unwrap() + low;
        assert!(found.abs() < 1e-8, "{length}: {found} beside {low}");
        let tension =
            column(&record, "rope", "force").last().unwrap() - mass * 9.81 * low.hypot(1.0) / (3.0 * low);
        assert!(tension.abs() < 1e-5, "{length}: {tension}");
    }
}

/// A heavy line whose end is drawn in while its weight grows has no equilibrium nearby: the remedy, to draw it in after the weight, finds
/// the one of the elastic catenary, H = 33,810.65 N with a sag of 26.5504 m.
#[test]
fn a_line_that_is_drawn_in_hangs_first() {
    let line = |x: &str| {
        format!(
            "lissom = 1\ngravity = [0, 0, -9.81]\n[sections.c]\nshape = \"general\"\nstiffness = [5e8, 1.6667e8, 1.6667e8, 10, 10, 10]\n\
             mass = [101.9367991845056, 101.9367991845056, 101.9367991845056, 1, 0.5, 0.5]\n\
             [beams.c]\nsection = \"c\"\nfrom = [0, 0, 0]\nto = [100, 0, 0]\nelements = 24\n\
             [joints.a]\nkind = \"spherical\"\nbase = \"ground\"\ntip = \"c.start\"\n\
             [joints.b]\nkind = \"prescribed_motion\"\nbase = \"ground\"\ntip = \"c.end\"\nx = \"{x}\"\nfree = [\"ry\", \"rz\"]\n\
             [outputs.a]\nkind = \"reaction\"\nof = \"a\"\n[outputs.middle]\nkind = \"position\"\nof = \"c@0.5\"\n\
             [analysis]\nkind = \"statics\"\n"
        )
    };
    let mut session = Model::from_text("line.toml", &line("-20*t")).session().unwrap();
    let error = session.run().expect_err("no equilibrium").to_string();
    assert!(error.contains("max(0, t - 0.1)"), "{error}");
    let record = run(&line("-20*max(0, t - 0.1)/0.9"), &[]);
    let force = column(&record, "a", "f1").last().unwrap();
    assert!((force + 33_810.65).abs() < 0.1, "{force}");
    let sag = column(&record, "middle", "z").last().unwrap();
    assert!((sag + 26.5504).abs() < 1e-3, "{sag}");
}
