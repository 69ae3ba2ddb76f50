//! Laws, contacts and friction whose state at the start is rest, or steady sliding.

use crate::defects::results::{Results, near};

/// x'' = 1/(1 + x)² from x = 1: the energy of the law is negative.
#[test]
fn springs_with_negative_energy() {
    for more in [&[][..], &["--set", "analysis.relative_tolerance=1e-8"]] {
        let results = Results::clean("repelling-magnets.toml", more);
        results.assert_last("rail", &["displacement"], &[1.464_541_1], 2e-6);
    }
}

/// v t - v²/(2 μ g), whichever contact is first by name.
#[test]
fn work_of_a_belt_beside_other_contacts() {
    let way = 0.5 - 0.25 / (2.0 * 0.2 * 9.81);
    let results = Results::clean("parcels-on-a-belt.toml", &[]);
    near("a", results.last("a.x"), way, 5e-5);
    near("b", results.last("b.x"), way + 0.05, 5e-5);
}

fn steps(results: &Results) -> usize {
    let summary = std::fs::read_to_string(results.path("summary.json")).unwrap();
    let steps = summary.split("\"steps\": ").nth(1).unwrap();
    steps.split(|c: char| !c.is_ascii_digit()).next().unwrap().parse().unwrap()
}

/// Values of laws at rest are the round-off of their arguments, which steps need not resolve.
#[test]
fn laws_at_rest() {
    let pipe = Results::clean("pipe-from-rest.toml", &[]);
    near("p", pipe.last("p.value"), 424_789.63, 1.0);
    assert!(steps(&pipe) < 1000, "{}", steps(&pipe));
    let valve = Results::clean("valve-between-equal-pressures.toml", &[]);
    assert!(steps(&valve) < 100, "{}", steps(&valve));
    for place in ["[0.5, 0, 0]", "[0.5e-3, 0, 0]", "[2e3, 0, 0]"] {
        let place = format!("point_masses.m.position={place}");
        let law = ["--set", &place];
        let number = ["--set", &place, "--unset", "springs.s.force", "--set", "springs.s.stiffness=4000"];
        let [law, number] =
            [&law[..], &number[..]].map(|options| Results::clean("spring-at-its-free-length.toml", options));
        near(&place, law.last("t.z"), number.last("t.z"), 1e-5 * number.last("t.z").abs());
        assert!(steps(&law) < 2 * steps(&number) + 20, "{} for {}", steps(&law), steps(&number));
    }
}

/// A disc of 88 kg sinks by N/k = 0.087 mm at most.
#[test]
fn cylinders_stand_on_their_ends() {
    let flat = ["--set", "bodies.c.rotation=[0, 0, 0]", "--set", "bodies.c.angular_velocity=[0, 0, 5]"];
    let upside_down = ["--set", "bodies.c.rotation=[2.99, 0, 0]"];
    for step in ["0.005", "0.001"] {
        let step = format!("analysis.step={step}");
        for more in [&[][..], &flat, &upside_down] {
            let results = Results::clean("tilted-disc.toml", &[more, &["--set", &step][..]].concat());
            near("z", results.last("c.z"), 0.25, 3e-4);
        }
    }
}

/// Without friction nothing changes the speed.
#[test]
fn parts_slide_over_seams() {
    let cylinder = "bodies.c.shape={ kind = \"cylinder\", radius = 0.1, length = 0.1 }";
    for more in [&[][..], &["--set", cylinder], &["--set", "bodies.c.velocity=[2.4, 0, 0]"]] {
        let results = Results::clean("seam-of-plates.toml", more);
        near("v", results.last("v.v1"), results.first("v.v1"), 1e-3);
        near("z", results.last("c.z"), 0.05, 1e-4);
    }
    // A ledge of 5 mm stops it.
    let ledge = "ground.shape=[{ kind = \"box\", sides = [1, 2, 0.02], position = [0.5, 0, -0.01] }, \
                 { kind = \"box\", sides = [1, 2, 0.02], position = [1.5, 0, -0.005] }]";
    let results = Results::of("run", "seam-of-plates.toml", &["--set", ledge, "--no-plots"]);
    results.assert_done();
    assert!(results.last("v.v1") < 0.5, "{}", results.last("v.v1"));
}

/// The energy of the rotor, I ω²/2, and its angle I ω²/(2 M), although a bristle deflects within a thousandth of the first step.
#[test]
fn work_of_joint_friction_at_planned_steps() {
    for scheme in ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] {
        let scheme = format!("analysis.scheme={scheme}");
        for step in ["1e-2", "1e-3"] {
            let step = format!("analysis.step={step}");
            let options = ["--set", &scheme, "--set", &step, "--set", "analysis.end=5"];
            let results = Results::clean("braked-rotor.toml", &options);
            near(&scheme, results.last("heat.work"), -0.005 * (300.0_f64.powi(2) - 50.0_f64.powi(2)), 0.02);
            near(&scheme, results.last("q.angle"), 300.0 * 5.0 - 25.0 * 25.0, 0.05);
        }
    }
}

/// Normal forces at the start depend on the friction of the gear.
#[test]
fn gears_with_friction_start_in_motion() {
    let results = Results::clean("gear-in-motion.toml", &[]);
    near("angle", results.last("q.angle"), 6.372_29, 1e-3);
}
