//! Gears with friction between their teeth, against formulas.

use crate::support::refused::refused;
use crate::support::runs::{last, run};

/// A shaft that drives another one with four times its inertia by half its rate.
const GEAR: &str = r#"
lissom = 1
[bodies.a]
mass = 1
inertia = [0.1, 0.1, 0.1]
[bodies.b]
mass = 1
inertia = [0.4, 0.4, 0.4]
position = [1, 0, 0]
[joints.in]
kind = "revolute"
base = "ground"
tip = "a"
axis = [0, 0, 1]
[joints.out]
kind = "revolute"
base = "ground"
tip = "b"
axis = [0, 0, 1]
[joints.mesh]
kind = "gear"
joint = "in"
other = "out"
ratio = -0.5
efficiency = 0.8
deflection = 1e-6
damping = 0.5
[inputs]
drive = 0
load = 0
[loads.drive]
kind = "joint_torque"
joint = "in"
torque = "drive"
[loads.load]
kind = "joint_torque"
joint = "out"
torque = "load"
[outputs.in]
kind = "relative"
of = "in"
[outputs.mesh]
kind = "reaction"
of = "mesh"
[analysis]
kind = "dynamics"
end = 1
"#;

/// With J and J' the inertias, i the ratio and f = 1/η - 1, the teeth exert m on the first shaft and m/i on the second:
/// J ω̇ = M - (1 + f) m, J' i ω̇ = m/i if it drives; J ω̇ = (1 - f) m, J' i ω̇ = M' - m/i if the second does.
#[test]
fn the_efficiency_of_a_gear_acts_in_both_directions() {
    let loss = 1.0 / 0.8 - 1.0;
    for scheme in ["radau-iia", "generalized-alpha", "energy-decaying", "adaptive"] {
        let mut set = vec![("analysis.scheme", scheme), ("analysis.step", "0.002")];
        if scheme == "adaptive" {
            set.clear();
        }
        set.push(("inputs.drive", "10"));
        let record = run(GEAR, &set);
        let acceleration = 10.0 / (0.1 + (1.0 + loss) * 0.4 * 0.25);
        let found = last(&record, "in", "rate");
        assert!((found - acceleration).abs() < 2e-3 * acceleration, "{scheme}: {found} for {acceleration}");
        let moment = last(&record, "mesh", "moment1");
        assert!((moment + 0.1 * acceleration).abs() < 1e-6 * acceleration, "{scheme}: {moment}");
        set.pop();
        set.push(("inputs.load", "10"));
        let record = run(GEAR, &set);
        let acceleration = 5.0 / (0.1 + 0.1 / (1.0 - loss));
        let found = -last(&record, "in", "rate");
        assert!((found - acceleration).abs() < 2e-3 * acceleration, "{scheme}: {found} for {acceleration}");
    }
}

/// A worm that would need more than all the power of its load holds it, and is turned back by its own shaft.
#[test]
fn a_worm_locks() {
    let set = [("joints.mesh.efficiency", "0.4"), ("inputs.load", "10"), ("analysis.end", "2")];
    let record = run(GEAR, &set);
    assert!(last(&record, "in", "rate").abs() < 1e-6 && last(&record, "in", "angle").abs() < 1e-4);
    // The teeth carry the whole load.
    assert!((last(&record, "mesh", "moment1") + 5.0).abs() < 1e-3);
    let turned = [set[0], set[1], ("inputs.drive", "-8")];
    let record = run(GEAR, &turned);
    assert!(last(&record, "in", "rate") < -1.0, "{}", last(&record, "in", "rate"));
    assert!(refused(&GEAR.replace("0.8", "1.2")).contains("efficiency"));
}
