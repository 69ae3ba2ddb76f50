//! Velocities, accelerations and forces of mechanisms that drives prescribe, against closed forms of their positions: they must not
//! depend on the steps, for positions have no error there that would make steps shorter.

use lissom::Record;

use crate::support::runs::session;
use crate::support::series::series;

/// A crank that turns at a constant rate drives a piston through a rod without mass of its own to speak of.
const PISTON: &str = r#"
lissom = 1

[parameters]
rate = 20
radius = 0.1
length = 0.3

[bodies.crank]
mass = 1
inertia = [1e-3, 1e-3, 1e-3]

[bodies.rod]
mass = 1e-9
inertia = [1e-12, 1e-12, 1e-12]
position = ["radius + length/2", 0, 0]

[bodies.piston]
mass = 3
inertia = [0.01, 0.01, 0.01]
position = ["radius + length", 0, 0]

[joints.main]
kind = "revolute"
base = "ground"
tip = "crank"
axis = [0, 0, 1]

[joints.pin]
kind = "revolute"
base = "crank"
tip = "rod"
at = ["radius", 0, 0]
axis = [0, 0, 1]

[joints.wrist]
kind = "inline"
base = "rod"
tip = "piston"
axis = [0, 0, 1]

[joints.cylinder]
kind = "prismatic"
base = "ground"
tip = "piston"
axis = [1, 0, 0]

[joints.drive]
kind = "prescribed_rotation"
joint = "main"
rotation = "rate*t"

[outputs.crank]
kind = "relative"
of = "main"
[outputs.velocity]
kind = "velocity"
of = "piston"
[outputs.acceleration]
kind = "acceleration"
of = "piston"
[outputs.slide]
kind = "relative_acceleration"
of = "cylinder"
[outputs.drive]
kind = "reaction"
of = "drive"
[outputs.force]
kind = "expression"
value = "3*acceleration.a1"

[analysis]
kind = "dynamics"
end = 1
"#;

const RATE: f64 = 20.0;
const RADIUS: f64 = 0.1;
const LENGTH: f64 = 0.3;

/// Velocity and acceleration of the piston, and the moment that drives the crank.
fn closed_form(angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    // x = r cos φ + s, s² = l² - r² sin² φ
    let s = (LENGTH * LENGTH - (RADIUS * sine).powi(2)).sqrt();
    let by_angle = -RADIUS * RADIUS * sine * cosine / s;
    let twice = (-RADIUS * RADIUS * (cosine * cosine - sine * sine) - by_angle * by_angle) / s;
    let velocity = (-RADIUS * sine + by_angle) * RATE;
    let acceleration = (-RADIUS * cosine + twice) * RATE * RATE;
    [velocity, acceleration, 3.0 * acceleration * velocity / RATE]
}

fn record(text: &str, settings: &[(&str, &str)]) -> Record {
    let mut session = session(text, settings);
    session.run().unwrap().into_record()
}

/// Largest error of a column against a function of the crank's angle, over the largest value of the function.
fn error(record: &Record, name: &str, wanted: impl Fn(f64) -> f64) -> f64 {
    let (angles, found) = (series(record, "crank.angle"), series(record, name));
    let wanted: Vec<f64> = angles.iter().map(|angle| wanted(*angle)).collect();
    let largest = wanted.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let errors = found.iter().zip(&wanted).map(|(found, wanted)| (found - wanted).abs());
    errors.fold(0.0, f64::max) / largest
}

/// With the steps chosen by default the moment of the drive erred by half of itself, and the acceleration by a fifth.
#[test]
fn rates_and_forces_of_a_driven_mechanism_follow_from_its_places() {
    let plans: [&[(&str, &str)]; 4] = [
        &[],
        &[("analysis.scheme", "radau-iia"), ("analysis.step", "5e-3")],
        &[("analysis.scheme", "generalized-alpha"), ("analysis.relative_tolerance", "1e-5")],
        &[("analysis.scheme", "energy-decaying"), ("analysis.relative_tolerance", "1e-5")],
    ];
    for plan in plans {
        let record = record(PISTON, plan);
        for (name, which) in [("velocity.v1", 0), ("acceleration.a1", 1), ("slide.a", 1), ("drive.moment", 2)]
        {
            let error = error(&record, name, |angle| closed_form(angle)[which]);
            assert!(error < 1e-5, "{plan:?} {name}: {error:.1e}");
        }
        let error = error(&record, "force.value", |angle| 3.0 * closed_form(angle)[1]);
        assert!(error < 1e-5, "{plan:?} expression: {error:.1e}");
    }
}

/// A relation that names the time drives as a drive does, also where its rate passes through zero.
#[test]
fn a_relation_that_names_the_time_drives() {
    let text = PISTON
        .replace(
            "kind = \"prescribed_rotation\"\njoint = \"main\"\nrotation = \"rate*t\"",
            "kind = \"equation\"\nequation = \"main.angle - 2*(1 - cos(5*t))\"",
        )
        .replace(
            "[outputs.force]",
            "[outputs.swing]\nkind = \"relative_acceleration\"\nof = \"main\"\n[outputs.force]",
        );
    let record = record(&text, &[]);
    for (time, found) in record.times.iter().zip(series(&record, "swing.a")) {
        let wanted = 50.0 * (5.0 * time).cos();
        assert!((found - wanted).abs() < 50.0 * 1e-6, "{time}: {found} {wanted}");
    }
}

/// What a program reads between two steps is what a run records there.
#[test]
fn a_session_reports_what_a_run_records() {
    let settings = [("analysis.scheme", "radau-iia"), ("analysis.step", "5e-3")];
    let record = record(PISTON, &settings);
    let mut session = session(PISTON, &settings);
    session.step_to(0.35).unwrap();
    for name in ["velocity.v1", "acceleration.a1", "drive.moment", "force.value"] {
        let found = session.value(name).unwrap();
        assert_eq!(found.to_bits(), series(&record, name)[70].to_bits(), "{name}");
    }
}
