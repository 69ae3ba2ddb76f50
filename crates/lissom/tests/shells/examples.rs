//! The examples with shells have the values that their headers derive.

use lissom::Record;

use crate::support::runs::{column, last, run};

fn example(name: &str) -> Record {
    let path = format!("{}/../../examples/shells/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    run(&std::fs::read_to_string(path).expect("an example"), &[])
}

fn is_near(value: f64, wanted: f64, share: f64) {
    assert!((value.abs() / wanted - 1.0).abs() < share, "{value}, {wanted}");
}

/// Against beams that touch at their ends.
#[test]
fn leaves_of_a_spring_share_the_load() {
    let record = example("leaf-spring");
    is_near(last(&record, "eye", "u3"), 0.1382, 0.02);
    is_near(last(&record, "second_end", "f3"), 3322.0, 0.03);
    is_near(last(&record, "third_end", "f3"), 4508.0, 0.03);
}

/// Half the pressure on the foil reaches the seams, a quarter of that each.
#[test]
fn seams_of_a_cushion_carry_its_pressure() {
    let record = example("cushion");
    is_near(last(&record, "top", "u3"), 0.0349, 0.02);
    is_near(last(&record, "top_east", "f3"), 100.0, 0.02);
}

#[test]
fn a_laminate_with_coupling_is_twisted_by_its_centrifugal_force() {
    let record = example("rotor-blade");
    is_near(last(&record, "force", "n11"), 480.0, 0.01);
    is_near(last(&record, "twist", "r1"), 5.72e-3, 0.1);
}

/// Momentum stays zero, and the centre of mass where it is.
#[test]
fn a_satellite_moves_by_the_motion_of_its_panels() {
    let record = example("solar-panels");
    is_near(last(&record, "hub", "u3"), 0.043_863, 2e-3);
    let momentum = last(&record, "momentum", "p3");
    assert!(momentum.abs() < 1e-3, "{momentum:e}");
}

/// It bends the sheet as a slow force does, and rolls out of the hollow as fast as it rolled into it.
#[test]
fn a_ball_that_rolls_over_a_sheet_bends_it() {
    let record = example("ball-on-sheet");
    let lowest = column(&record, "middle", "u3").iter().copied().fold(0.0, f64::min);
    is_near(lowest, 7.03e-4, 0.03);
    is_near(last(&record, "speed", "v1"), 0.5, 1e-3);
    let normal = column(&record, "touch", "normal");
    let mean = normal.iter().sum::<f64>() / normal.len() as f64;
    is_near(mean, 20.64, 0.01);
    assert!(column(&record, "touch", "points")[100..].iter().all(|points| *points == 1.0));
}
