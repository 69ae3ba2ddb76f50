//! Velocities at the start: those that are not given follow those that are.

use crate::support::runs::{column, last, run, run_without_warnings, session};

/// A crank, a rod and a piston without forces.
const ENGINE: &str = r#"
lissom = 1
[bodies.crank]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.05, 0, 0]
[bodies.rod]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.25, 0, 0]
[bodies.piston]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.4, 0, 0]
[joints.shaft]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0, 0, 0]
axis = "z"
[joints.pin]
kind = "revolute"
base = "crank"
tip = "rod"
at = [0.1, 0, 0]
axis = "z"
[joints.wrist]
kind = "revolute"
base = "rod"
tip = "piston"
at = [0.4, 0, 0]
axis = "z"
[joints.bore]
kind = "prismatic"
base = "ground"
tip = "piston"
axis = "x"
[outputs.shaft]
kind = "relative"
of = "shaft"
[outputs.rod]
kind = "angular_velocity"
of = "rod"
[analysis]
kind = "dynamics"
end = 0.1
"#;

/// The crank at 20 rad/s turns the rod by -20·0.1/0.3 rad/s, whichever way its speed is given.
#[test]
fn a_free_engine_starts_with_the_speed_of_its_crank() {
    let of_joint =
        ENGINE.replace("axis = \"z\"\n[joints.pin]", "axis = \"z\"\nangle = 0.7\nrate = 20\n[joints.pin]");
    let of_body = ENGINE.replace(
        "position = [0.05, 0, 0]",
        "position = [0.05, 0, 0]\nvelocity = [0, 1, 0]\nangular_velocity = [0, 0, 20]",
    );
    for text in [of_joint, of_body] {
        let record = run_without_warnings(&text, &[]);
        let rate = column(&record, "shaft", "rate")[0];
        assert!((rate - 20.0).abs() < 1e-9, "{rate}");
        let rod = column(&record, "rod", "w3")[0];
        assert!((rod + 20.0 * 0.1 / 0.3).abs() < 1e-9, "{rod}");
    }
}

/// Velocities that exclude each other are still changed as little as possible, with a warning.
#[test]
fn velocities_that_exclude_each_other_are_corrected() {
    let both = ENGINE
        .replace("axis = \"z\"\n[joints.pin]", "axis = \"z\"\nrate = 20\n[joints.pin]")
        .replace("position = [0.25, 0, 0]", "position = [0.25, 0, 0]\nangular_velocity = [0, 0, 3]");
    let session = session(&both, &[]);
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(!warnings.is_empty());
}

/// A load that hangs in a latch is in equilibrium, and falls when it is released.
#[test]
fn a_load_in_a_latch_starts_from_equilibrium() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[inputs]
hold = 1
[bodies.carriage]
mass = 3
inertia = [1, 1, 1]
[bodies.load]
mass = 2
inertia = [1, 1, 1]
position = [0, 0, -1]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "carriage"
axis = "z"
[springs.hook]
kind = "axial_latch"
joint = "rail"
engaged = "hold"
[springs.rope]
kind = "bushing"
base = "carriage"
tip = "load"
at_base = [0, 0, -1]
stiffness = [4e3, 4e3, 4e3, 1e3, 1e3, 1e3]
[outputs.carriage]
kind = "position"
of = "carriage"
[outputs.load]
kind = "position"
of = "load"
[outputs.hook]
kind = "spring"
of = "hook"
[events.drop]
zero_of = "t - 0.2"
set = { hold = 0 }
[initial]
equilibrium = true
[analysis]
kind = "dynamics"
end = 0.5
"#;
    let record = run(text, &[]);
    let sag = -1.0 - 2.0 * 9.81 / 4e3;
    for (k, time) in record.times.iter().enumerate().filter(|(_, time)| **time < 0.2) {
        let (carriage, load) = (column(&record, "carriage", "z")[k], column(&record, "load", "z")[k]);
        assert!(carriage.abs() < 1e-12 && (load - sag).abs() < 1e-9, "t = {time}: {carriage} {load}");
        let force = column(&record, "hook", "force")[k];
        assert!((force.abs() - 5.0 * 9.81).abs() < 1e-6, "t = {time}: {force}");
    }
    let mean = (3.0 * last(&record, "carriage", "z") + 2.0 * last(&record, "load", "z")) / 5.0;
    let fallen = 0.4 * sag - 0.5 * 9.81 * 0.09;
    assert!((mean - fallen).abs() < 1e-6, "{mean} for {fallen}");
    // Load steps keep the latch too.
    let statics = text
        .replace("kind = \"dynamics\"\nend = 0.5", "kind = \"statics\"")
        .replace("[initial]\nequilibrium = true\n", "")
        .replace("[events.drop]\nzero_of = \"t - 0.2\"\nset = { hold = 0 }\n", "");
    let record = run(&statics, &[]);
    assert!((last(&record, "load", "z") - sag).abs() < 1e-9);
}
