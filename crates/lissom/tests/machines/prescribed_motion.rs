//! Motions prescribed in space: where the body is, and what it takes.

use lissom_motion::{Rotation, Vector3};

use crate::support::refused::refused;
use crate::support::runs::{SCHEMES, column, goes_on_from_a_snapshot, run};

/// A body that is shaken and turned about its centre, and a pendulum on it that is not in the way.
const PLATFORM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.platform]
mass = 3
inertia = [0.2, 0.3, 0.4]
position = [0.5, 0, 1]
[joints.shaker]
kind = "prescribed_motion"
base = "ground"
tip = "platform"
x = "0.1*sin(3*t)^2"
z = "0.05*t^2"
rx = "0.3*t^2"
ry = { table = [[0, 0], [0.5, 0.1], [1, 0.3], [1.5, 0.2]], interpolation = "spline" }
rz = "0.8*(1 - cos(2*t))"
[outputs.place]
kind = "position"
of = "platform"
[outputs.turn]
kind = "rotation"
of = "platform"
[outputs.shaker]
kind = "reaction"
of = "shaker"
[outputs.drives]
kind = "relative"
of = "shaker"
[outputs.acceleration]
kind = "acceleration"
of = "platform"
[analysis]
kind = "dynamics"
end = 1.0
step = 2e-3
"#;

fn rx(time: f64) -> f64 {
    0.3 * time * time
}

fn rz(time: f64) -> f64 {
    0.8 * (1.0 - (2.0 * time).cos())
}

#[test]
fn a_platform_follows_its_prescribed_motion_and_its_reaction_carries_it() {
    for scheme in SCHEMES {
        let record = run(PLATFORM, &[("analysis.scheme", scheme)]);
        let end = record.times.len() - 1;
        let [x, y, z] = ["x", "y", "z"].map(|name| column(&record, "place", name));
        for (k, &time) in record.times.iter().enumerate() {
            let wanted = [0.5 + 0.1 * (3.0 * time).sin().powi(2), 0.0, 1.0 + 0.05 * time * time];
            for (found, wanted) in [x[k], y[k], z[k]].iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-9, "{scheme} at {time}: {found} {wanted}");
            }
        }
        let turn = Rotation::about_axis(&Vector3::x(), rx(1.0))
            * Rotation::about_axis(&Vector3::y(), 0.3)
            * Rotation::about_axis(&Vector3::z(), rz(1.0));
        let found = ["r1", "r2", "r3"].map(|name| column(&record, "turn", name)[end]);
        assert!((Vector3::from(found) - turn.logarithm()).norm() < 1e-9, "{scheme}: {found:?}");
        // Newton: f = m (a - g), with a from the functions.
        let acceleration = [0.1 * 18.0 * (6.0_f64).cos(), 0.0, 0.1];
        let force = ["f1", "f2", "f3"].map(|name| column(&record, "shaker", name)[end]);
        for (k, (found, a)) in force.iter().zip(acceleration).enumerate() {
            let wanted = 3.0 * (a + if k == 2 { 9.81 } else { 0.0 });
            assert!((found - wanted).abs() < 0.03, "{scheme}: force {k} {found} {wanted}");
        }
    }
}

#[test]
fn steps_of_chosen_size_and_a_restart_in_the_middle() {
    let chosen = PLATFORM.replace("step = 2e-3", "relative_tolerance = 1e-5");
    for scheme in SCHEMES {
        let record = run(&chosen, &[("analysis.scheme", scheme)]);
        let end = record.times.len() - 1;
        let found = column(&record, "place", "x")[end];
        assert!((found - 0.5 - 0.1 * 3.0_f64.sin().powi(2)).abs() < 1e-9, "{scheme}");
    }
    goes_on_from_a_snapshot(PLATFORM, [0.3, 0.6]);
}

/// A mass on a spring on shaking ground, driven at 2/3 of its own rate: x = A (sin Ωt - r sin ωt)/(1 - r²) with r = Ω/ω.
#[test]
fn shaking_ground_drives_an_oscillator() {
    let model = r#"
lissom = 1
[bodies.table]
mass = 10
inertia = [1, 1, 1]
[bodies.mass]
mass = 2
inertia = [0.1, 0.1, 0.1]
position = [0.5, 0, 0]
velocity = [0, 0, 0]
[joints.ground_motion]
kind = "prescribed_motion"
base = "ground"
tip = "table"
x = "0.01*sin(8*t)"
[joints.rail]
kind = "prismatic"
base = "table"
tip = "mass"
at = [0.5, 0, 0]
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "rail"
stiffness = 288
[outputs.mass]
kind = "position"
of = "mass"
[analysis]
kind = "dynamics"
end = 1.0
step = 5e-4
"#;
    for scheme in SCHEMES {
        let record = run(model, &[("analysis.scheme", scheme)]);
        let x = column(&record, "mass", "x");
        let (own, drive) = (12.0_f64, 8.0_f64);
        let ratio = drive / own;
        // At rest at the start, in space.
        let wanted = 0.01 * (drive.sin() - ratio * own.sin()) / (1.0 - ratio * ratio);
        let found = x[x.len() - 1] - 0.5;
        assert!((found - wanted).abs() < 1e-5, "{scheme}: {found} {wanted}");
    }
}

#[test]
fn motions_that_begin_elsewhere_or_name_nothing_are_refused() {
    let said = refused(&PLATFORM.replace("x = \"0.1*sin(3*t)^2\"", "x = \"0.1*cos(3*t)\""));
    assert!(said.contains("starts at 0.1 m"), "{said}");
    let nothing = PLATFORM
        .lines()
        .filter(|line| !["x =", "z =", "rx =", "ry =", "rz ="].iter().any(|key| line.starts_with(key)))
        .collect::<Vec<_>>()
        .join("\n");
    let said = refused(&nothing);
    assert!(said.contains("at least one of x, y, z, rx, ry, rz"), "{said}");
}
