//! The examples with solids have the values that their headers derive.

use lissom::Record;

use crate::support::runs::{column, last, run};

fn text(name: &str) -> String {
    let path = format!("{}/../../examples/solids/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("an example")
}

fn example(name: &str) -> Record {
    run(&text(name), &[])
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

/// In calm water it heaves with √(g/d) for its draught d.
#[test]
fn a_raft_heaves() {
    let lowered = text("raft").replace("-0.75, -0.15]", "-0.75, -0.17]").replace("0, -0.15]", "0, -0.17]");
    let record = run(&lowered, &[("parameters.height", "0"), ("analysis.end", "3")]);
    let (times, heights) = (&record.times, column(&record, "bow", "z"));
    let up: Vec<f64> = (1..times.len())
        .filter(|&k| heights[k - 1] < -0.15 && heights[k] >= -0.15)
        .map(|k| {
            let [before, after] = [heights[k - 1], heights[k]].map(|height| height + 0.15);
            times[k - 1] - before * (times[k] - times[k - 1]) / (after - before)
        })
        .collect();
    let period = (up[up.len() - 1] - up[0]) / (up.len() - 1) as f64;
    is_near(period, std::f64::consts::TAU / (9.81_f64 / 0.15).sqrt(), 5e-3);
}
