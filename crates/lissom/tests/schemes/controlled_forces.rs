//! `control = "forces"`: steps resolve the vibrations of which forces consist.

use lissom::{Model, Override, Record, SessionError};

use crate::support::runs::run;

/// A carriage on a soft spring, and a mass on it on a stiff one, which is loaded suddenly: the force of the stiff spring
/// vibrates, with displacements of hundredths of a millimetre beside a motion of decimetres.
const CARRIAGE: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]

[bodies.carriage]
mass = 2
inertia = [1, 1, 1]

[bodies.load]
mass = 0.5
inertia = [1, 1, 1]

[joints.guide]
kind = "prismatic"
base = "ground"
tip = "carriage"
axis = [0, 0, 1]

[joints.slide]
kind = "prismatic"
base = "carriage"
tip = "load"
axis = [0, 0, 1]

[springs.soft]
kind = "axial"
joint = "guide"
stiffness = 20

[springs.stiff]
kind = "axial"
joint = "slide"
stiffness = 2e6

[loads.weight]
kind = "force"
on = "load"
vector = [0, 0, -20]

[outputs.force]
kind = "spring"
of = "stiff"

[outputs.load]
kind = "acceleration"
of = "load"

[analysis]
kind = "dynamics"
end = 0.2
output_step = 0.002
"#;

fn record(settings: &[(&str, &str)]) -> Record {
    run(CARRIAGE, settings)
}

/// Largest error of the force of the stiff spring relative to the largest force, from the two modes of the linear model.
fn error(record: &Record) -> f64 {
    let [m, n, k, s, g, sudden] = [2.0, 0.5, 20.0, 2e6, 9.81, 20.0];
    // Positions relative to equilibrium are sums of two modes: ω² roots of m n ω⁴ - (m s + n (k + s)) ω² + k s = 0.
    let sum: f64 = (m * s + n * (k + s)) / (m * n);
    let product = k * s / (m * n);
    let fast = 0.5 * (sum + (sum * sum - 4.0 * product).sqrt());
    let slow = product / fast;
    let carriage = ((m + n) * g + sudden) / k;
    let load = carriage + (n * g + sudden) / s;
    // Shape (1, a) with a = s/(s - n ω²); the start is at rest at the displacements carriage and load.
    let shape = |square: f64| s / (s - n * square);
    let [a, b] = [shape(slow), shape(fast)];
    let of_fast = (load - a * carriage) / (b - a);
    let of_slow = carriage - of_fast;
    let force = |time: f64| {
        let [p, q] = [of_slow * (slow.sqrt() * time).cos(), of_fast * (fast.sqrt() * time).cos()];
        s * ((a - 1.0) * p + (b - 1.0) * q - (load - carriage))
    };
    let values = record.column("force", "force").unwrap();
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    for (time, value) in record.times.iter().zip(values) {
        error = error.max((value - force(*time)).abs());
        size = size.max(force(*time).abs());
    }
    error / size
}

#[test]
fn forces_that_vibrate_are_accurate_where_they_are_controlled() {
    let forces = ("analysis.control", "\"forces\"");
    let third = ("analysis.scheme", "\"radau-iia\"");
    let usual = ("analysis.relative_tolerance", "1e-5");
    let finer = ("analysis.relative_tolerance", "1e-7");
    let fifth = ("analysis.scheme", "\"radau-iia-5\"");
    let [usual, controlled, finer, fifth] =
        [&[third, usual][..], &[forces, third, usual], &[forces, third, finer], &[forces, fifth, usual]]
            .map(|settings| error(&record(settings)));
    println!("{usual:.1e} {controlled:.1e} {finer:.1e} {fifth:.1e}");
    assert!(controlled < 0.015 && controlled < 0.4 * usual, "{controlled:.1e}, usual {usual:.1e}");
    assert!(finer < 0.15 * controlled, "{finer:.1e} after {controlled:.1e}");
    assert!(fifth < 0.15 * controlled, "{fifth:.1e} after {controlled:.1e}");
}

#[test]
fn steps_of_one_size_have_no_errors_to_control() {
    let settings: [Override; 2] = [("analysis.step", "1e-3"), ("analysis.control", "\"forces\"")]
        .map(|(path, value)| (path.into(), value.into()));
    let text = CARRIAGE.replace("output_step = 0.002\n", "");
    let problem = match Model::from_text("carriage.toml", &text).with_overrides(&settings).session() {
        Err(SessionError::Model(report)) => report.render(false),
        _ => panic!("accepted"),
    };
    assert!(problem.contains("adaptive steps") && problem.contains("relative_tolerance"), "{problem}");
}
