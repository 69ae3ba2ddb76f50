//! Machines of many parts that touch, in `examples/contacts`, by what is known of them. Runs are shorter than those of the files.

use lissom::Record;

use crate::support::runs::run;
use crate::support::series::{last, series};

fn machine(name: &str, set: &[(&str, &str)]) -> Record {
    let path = format!("{}/../../examples/contacts/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    run(&std::fs::read_to_string(path).expect("an example"), set)
}

/// Mean of the second half of a column.
fn mean(record: &Record, name: &str) -> f64 {
    let values = series(record, name);
    let half = &values[values.len() / 2..];
    half.iter().sum::<f64>() / half.len() as f64
}

/// Change of a column over the second half of a run.
fn gained(record: &Record, name: &str) -> f64 {
    let values = series(record, name);
    values[values.len() - 1] - values[values.len() / 2]
}

/// The wheel turns by the ratio of the teeth, and the flanks push with the torque over the radius of the base circle.
#[test]
fn spur_gears_have_the_ratio_of_their_teeth() {
    let record = machine("spur-gears", &[("analysis.end", "0.1")]);
    let ratio = -gained(&record, "wheel.angle") / gained(&record, "pinion.angle");
    assert!((ratio - 20.0 / 30.0).abs() < 2e-3, "{ratio}");
    let mut forces = series(&record, "mesh.normal").to_vec();
    forces.sort_by(f64::total_cmp);
    let wanted = 100.0 / (0.075 * 20.0_f64.to_radians().cos());
    let median = forces[forces.len() / 2];
    assert!((median / wanted - 1.0).abs() < 0.01, "{median} {wanted}");
}

/// Balls roll on both rings: the cage turns at ω/2 (1 - d/D).
#[test]
fn the_cage_of_a_bearing_turns_with_its_balls() {
    let record = machine("ball-bearing", &[("analysis.end", "0.1")]);
    let ratio = gained(&record, "cage_angle.angle") / gained(&record, "inner.angle");
    assert!((ratio - 0.5 * (1.0 - 0.010 / 0.046)).abs() < 5e-3, "{ratio}");
}

/// The sprockets turn by the ratio of their teeth.
#[test]
fn a_roller_chain_drives_by_the_ratio_of_the_teeth() {
    let record = machine("roller-chain", &[("analysis.end", "0.3")]);
    let ratio = gained(&record, "driven.angle") / gained(&record, "driver.angle");
    assert!((ratio - 17.0 / 23.0).abs() < 5e-3, "{ratio}");
}

/// A walking robot does not fall, and its feet carry its weight on average.
#[test]
fn a_quadruped_walks_on_uneven_ground() {
    let record = machine("quadruped", &[("analysis.end", "2")]);
    assert!(
        (mean(&record, "carried.value") / 160.9 - 1.0).abs() < 0.05,
        "{}",
        mean(&record, "carried.value")
    );
    assert!(last(&record, "trunk.z") > 0.2, "{}", last(&record, "trunk.z"));
}

/// A vehicle on two tracks moves by their links.
#[test]
fn a_vehicle_moves_by_the_links_of_its_tracks() {
    let record = machine("tracked-undercarriage", &[("analysis.end", "0.8")]);
    let wanted = 12.0 * 0.06 * 4.0 / std::f64::consts::TAU;
    assert!((mean(&record, "velocity.v1") / wanted - 1.0).abs() < 0.02, "{}", mean(&record, "velocity.v1"));
}

/// A scale below a box with a pile of spheres shows their weight when they rest.
#[test]
fn a_scale_shows_the_weight_of_a_pile() {
    let record = machine("pile-of-spheres", &[("analysis.end", "1.2")]);
    assert!((last(&record, "scale.f3").abs() / 340.651 - 1.0).abs() < 0.01, "{}", last(&record, "scale.f3"));
}

/// Blows that no step resolves drive the pile by s/(1 - e² g/a), with the ram that stops at each of them.
#[test]
fn a_pile_driver_drives_by_a_geometric_series() {
    let gravity = 9.81;
    let deceleration = 6000.0 / 200.0 - gravity;
    let blow = 0.4 * 0.4 * gravity / deceleration;
    for step in ["5e-4", "1e-4"] {
        let record = machine("pile-driver", &[("analysis.step", step)]);
        let depth = -last(&record, "pile.displacement");
        assert!((depth / (blow / (1.0 - blow)) - 1.0).abs() < 0.01, "{step}: {depth}");
    }
}

/// The break of a rack of balls keeps the momentum, and no step gains energy.
#[test]
fn a_break_keeps_its_momentum() {
    let record = machine("break", &[("analysis.end", "0.4")]);
    let at = record.times.iter().position(|time| *time > 0.066).expect("it lasts longer");
    let momentum = series(&record, "momentum.p1");
    assert!((momentum[at] / momentum[0] - 1.0).abs() < 0.03, "{}", momentum[at]);
    let energy = series(&record, "energy.total");
    assert!(energy[at] < 0.8 * energy[0], "the rack is broken");
    let rise = energy.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max);
    assert!(rise < 1e-5, "{rise:e}");
}
