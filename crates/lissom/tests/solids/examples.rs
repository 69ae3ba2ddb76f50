//! The examples with solids have the values that their headers derive.

use lissom::Record;

use crate::support::runs::{column, last, run};

fn example(name: &str) -> Record {
    let path = format!("{}/../../examples/solids/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    run(&std::fs::read_to_string(path).expect("an example"), &[])
}

fn is_near(value: f64, wanted: f64, share: f64) {
    assert!((value / wanted - 1.0).abs() < share, "{value}, {wanted}");
}

/// Against the curved bar of Winkler and Bach.
#[test]
fn a_hook_has_the_stresses_of_a_curved_bar() {
    let record = example("crane-hook");
    is_near(last(&record, "inside", "principal"), 224.5e6, 0.03);
    is_near(last(&record, "outside", "s33"), -137.7e6, 0.03);
    is_near(last(&record, "shank", "f3"), 10e3, 1e-6);
}

/// Against the stiffness of a bonded ring, a strip along its circumference [Gent and Lindley 1959].
#[test]
fn a_mount_isolates_a_machine() {
    let record = example("rubber-mount");
    let motion = column(&record, "compressor", "u3");
    let late = &motion[2 * motion.len() / 3..];
    let half =
        0.5 * (late.iter().copied().fold(f64::MIN, f64::max) - late.iter().copied().fold(f64::MAX, f64::min));
    is_near(half, 78.7e-6, 0.02);
}
