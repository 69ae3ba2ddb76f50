//! Responses to harmonic inputs and matrices of the linear model, against closed forms and against steps in time.

use std::f64::consts::TAU;

use lissom::Model;
use lissom::analyses::linearize::{LinearizeReport, LinearizeRequest, linearize};
use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::analyses::response::{FrequencyError, ResponseReport, ResponseRequest, response};
use lissom::analyses::{AnalysisError, Origin};
use nalgebra::{Complex, DMatrix, Matrix4};

type Complex64 = Complex<f64>;

const I: Complex64 = Complex64::new(0.0, 1.0);

fn request(inputs: &[&str], outputs: &[&str], from: f64, to: f64) -> ResponseRequest {
    ResponseRequest {
        about: OperatingPoint::Static,
        inputs: inputs.iter().map(|name| (*name).to_owned()).collect(),
        outputs: outputs.iter().map(|name| (*name).to_owned()).collect(),
        from,
        to,
        points: 60,
    }
}

fn find(text: &str, request: &ResponseRequest) -> ResponseReport {
    response(&Model::from_text("model.toml", text), request).unwrap_or_else(|error| panic!("{error}"))
}

/// Compares every row of `csv` with `exact`, as a reader of the file would.
fn compare(found: &ResponseReport, name: &str, tolerance: f64, exact: impl Fn(f64) -> Complex64) {
    let csv = found.csv();
    let mut lines = csv.lines();
    let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |part: &str| {
        let wanted = format!("{name}.{part}");
        heads.iter().position(|head| *head == wanted).unwrap_or_else(|| panic!("no {wanted} in {heads:?}"))
    };
    let columns = ["real", "imaginary", "magnitude", "phase"].map(column);
    let mut rows = 0;
    for line in lines {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let [re, im, magnitude, phase] = columns.map(|k| numbers[k]);
        let (value, wanted) = (Complex64::new(re, im), exact(numbers[0]));
        assert!(
            (value - wanted).norm() <= tolerance * wanted.norm(),
            "{name} at {} Hz: {value} for {wanted}",
            numbers[0]
        );
        let polar = Complex64::from_polar(magnitude, phase.to_radians());
        assert!((polar - value).norm() <= 1e-12 * value.norm());
        rows += 1;
    }
    assert!(rows >= 60);
}

const OSCILLATOR: &str = r#"
lissom = 1
[bodies.slider]
mass = 2
inertia = [1, 1, 1]
position = [0.5, 0, 0]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "slider"
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "guide"
stiffness = 800
damping = 4
[inputs]
command = 0.25
[loads.push]
kind = "force"
on = "slider"
vector = [3, 4, 0]
scale = "0.1*sin(t)"
[loads.drive]
kind = "force"
on = "slider"
vector = [1, 0, 0]
scale = "50*command^2"
[outputs]
place = { kind = "position", of = "slider" }
speed = { kind = "velocity", of = "slider" }
rush = { kind = "acceleration", of = "slider" }
guide = { kind = "reaction", of = "guide" }
way = { kind = "relative", of = "guide" }
[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#;

#[test]
fn an_oscillator_has_its_closed_form_in_all_its_outputs() {
    let text = OSCILLATOR;
    let outputs = ["place.x", "speed.v1", "rush.a1", "guide.f2", "way"];
    let found = find(text, &request(&["push", "command"], &outputs, 0.3, 30.0));
    let one = |f: f64| {
        let s = I * TAU * f;
        (s * s * 2.0 + s * 4.0 + 800.0).inv()
    };
    let s = |f: f64| I * TAU * f;
    // A load of size one is its vector; the input acts by the derivative of its expression.
    for (input, force) in [("push", 3.0), ("command", 2.0 * 50.0 * 0.25)] {
        compare(&found, &format!("place.x/{input}"), 1e-10, |f| one(f) * force);
        compare(&found, &format!("way.displacement/{input}"), 1e-10, |f| one(f) * force);
        compare(&found, &format!("way.velocity/{input}"), 1e-10, |f| one(f) * force * s(f));
        compare(&found, &format!("speed.v1/{input}"), 1e-10, |f| one(f) * force * s(f));
        compare(&found, &format!("rush.a1/{input}"), 1e-10, |f| one(f) * force * s(f) * s(f));
    }
    // The guide holds what pushes across it, on the base or on the tip.
    let held = find(text, &request(&["push"], &["guide.f2"], 0.3, 30.0));
    for value in &held.transfers[0].amplitudes {
        assert!((value.norm() - 4.0).abs() < 1e-9 && value.im.abs() < 1e-9, "{value}");
    }
}

fn two_masses() -> String {
    r#"
lissom = 1
[bodies.base]
mass = 5
inertia = [1, 1, 1]
[joints.shaker]
kind = "prismatic"
base = "ground"
tip = "base"
axis = [1, 0, 0]
[joints.shake]
kind = "prescribed_displacement"
joint = "shaker"
displacement = "0.01*t^3"
[joints.a]
kind = "prismatic"
base = "ground"
tip = "left"
axis = [1, 0, 0]
[joints.b]
kind = "prismatic"
base = "ground"
tip = "right"
axis = [1, 0, 0]
[bodies.left]
mass = 3
inertia = [1, 1, 1]
position = [0.2, 0, 0]
[bodies.right]
mass = 1
inertia = [1, 1, 1]
position = [0.7, 0, 0]
[springs.s1]
kind = "point"
base = "base"
tip = "left"
stiffness = 500
damping = 2
[springs.s2]
kind = "point"
base = "left"
tip = "right"
stiffness = 200
damping = 1
[outputs]
left = { kind = "displacement", of = "left" }
right = { kind = "displacement", of = "right" }
force = { kind = "reaction", of = "shake" }
[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#
    .to_owned()
}

#[test]
fn two_masses_on_a_shaken_base_have_their_closed_form() {
    let found = find(&two_masses(), &request(&["shake"], &["left.u1", "right.u1", "force.force"], 0.2, 20.0));
    // (3 s² + k₁ + k₂) x₁ - k₂ x₂ = k₁ u, (s² + k₂) x₂ = k₂ x₁, with k complex.
    let solved = |f: f64| {
        let s = I * TAU * f;
        let (k1, k2) = (s * 2.0 + 500.0, s + 200.0);
        let follow = k2 / (s * s + k2);
        let left = k1 / (s * s * 3.0 + k1 + k2 - k2 * follow);
        (left, left * follow, s * s * 5.0 + k1 * (Complex64::from(1.0) - left))
    };
    compare(&found, "left.u1/shake", 1e-10, |f| solved(f).0);
    compare(&found, "right.u1/shake", 1e-10, |f| solved(f).1);
    compare(&found, "force.force/shake", 1e-9, |f| solved(f).2);
}

/// One component of a `prescribed_motion` is an input of its own, though lists of inputs are divided by commas.
#[test]
fn a_shaken_table_passes_its_motion_on() {
    let text = r#"
lissom = 1
[bodies.table]
mass = 1
inertia = [1, 1, 1]
[bodies.mass]
mass = 2
inertia = [1, 1, 1]
position = [0.5, 0, 0]
[joints.shaker]
kind = "prescribed_motion"
base = "ground"
tip = "table"
x = 0
[joints.guide]
kind = "prismatic"
base = "table"
tip = "mass"
axis = [1, 0, 0]
[springs.spring]
kind = "axial"
joint = "guide"
stiffness = 800
damping = 3
[outputs.place]
kind = "position"
of = "mass"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;
    let report = find(text, &request(&["shaker.x"], &["place.x"], 0.5, 10.0));
    compare(&report, "place.x/shaker.x", 1e-9, |f| {
        let rate = Complex::new(800.0, 3.0 * TAU * f);
        rate / (rate - 2.0 * (TAU * f).powi(2))
    });
}

fn cantilever(elements: usize) -> String {
    format!(
        r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e6, 4e4, 4e4, 300, 100, 150]
mass = {{ per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }}
damping = 2e-4
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = {elements}
order = 3
[joints.root]
kind = "clamp"
base = "ground"
tip = "bar.start"
[inputs]
push = 0
[loads.push]
kind = "force"
on = "bar.end"
vector = [0, 0, 1]
scale = "push"
[outputs]
tip = {{ kind = "displacement", of = "bar.end" }}
root = {{ kind = "reaction", of = "root" }}
quarter = {{ kind = "section_moment", of = "bar@0.3" }}
inside = {{ kind = "velocity", of = "bar@0.37" }}
[analysis]
kind = "dynamics"
end = 1
step = 1e-2
"#
    )
}

/// (w, θ, M, Q) at x and at the end of a damped Timoshenko cantilever under a unit force at the end: closed form by the matrix
/// exponential of w' = θ + Q/GA, θ' = M/EI, M' = -Q + s²J θ, Q' = s² w with complex GA and EI.
fn timoshenko(f: f64, x: f64) -> [Complex64; 4] {
    let s = I * TAU * f;
    let factor = Complex64::from(1.0) + s * 2e-4;
    let (shear, bending) = (factor * 4e4, factor * 100.0);
    let (zero, one) = (Complex64::from(0.0), Complex64::from(1.0));
    let square = s * s;
    let rates = Matrix4::new(
        zero,
        one,
        zero,
        one / shear, //
        zero,
        zero,
        one / bending,
        zero, //
        zero,
        square * 1e-3,
        zero,
        -one, //
        square,
        zero,
        zero,
        zero,
    );
    let exponential = |length: f64| {
        let part = rates * Complex64::from(length / 64.0);
        let (mut sum, mut term) = (Matrix4::identity(), Matrix4::identity());
        for k in 1..20 {
            term = term * part / Complex64::from(f64::from(k));
            sum += term;
        }
        (0..6).fold(sum, |power, _| power * power)
    };
    let whole = exponential(1.0);
    // At the root w = θ = 0; at the end M = 0, Q = 1.
    let [a, b, c, d]: [Complex64; 4] = [whole[(2, 2)], whole[(2, 3)], whole[(3, 2)], whole[(3, 3)]];
    let determinant = a * d - b * c;
    let start = nalgebra::Vector4::new(zero, zero, -b / determinant, a / determinant);
    let at = exponential(x) * start;
    [at[0], at[1], at[2], at[3]]
}

#[test]
fn a_damped_cantilever_has_its_transfer_function_through_its_resonances() {
    let found = find(
        &cantilever(12),
        &request(&["inputs.push"], &["tip.u3", "root.m2", "quarter.m2", "inside.v3"], 0.3, 60.0),
    );
    assert!(found.frequencies.len() < 1000, "{}", found.frequencies.len());
    assert!(found.natural.len() >= 2, "{:?}", found.natural);
    compare(&found, "tip.u3/inputs.push", 2e-6, |f| timoshenko(f, 1.0)[0]);
    compare(&found, "inside.v3/inputs.push", 1e-4, |f| timoshenko(f, 0.37)[0] * I * TAU * f);
    let root = |f: f64| timoshenko(f, 0.0)[2].norm();
    for (transfer, x, tolerance) in [(1, 0.0, 2e-6), (2, 0.3, 1e-3)] {
        for (f, value) in found.frequencies.iter().zip(&found.transfers[transfer].amplitudes) {
            let wanted = timoshenko(*f, x)[2].norm();
            assert!((value.norm() - wanted).abs() < tolerance * root(*f), "{f} Hz: {value} for {wanted}");
        }
    }
    // Peaks are resolved: the largest is within a hundredth of the one on a fine scale of the closed form.
    let (frequency, most) = found.peak(&found.transfers[0]);
    let fine = (0..4000).map(|k| timoshenko(frequency * (0.98 + 1e-5 * f64::from(k)), 1.0)[0].norm());
    assert!(most > 0.99 * fine.fold(0.0, f64::max));
}

const CONTROLLED: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.arm]
mass = 2
inertia = [0.1, 0.2, 0.2]
position = [0.3, 0, -0.4]
[joints.pivot]
kind = "revolute"
base = "ground"
tip = "arm"
at = [0, 0, 0]
axis = [0, 1, 0]
[inputs]
command = 0.0
[states.wound]
derivative = "command - pivot.angle"
start = -0.73575
magnitude = 0.1
[signals]
torque = "30*(command - pivot.angle) - 2*pivot.rate + 8*wound"
[loads.motor]
kind = "joint_torque"
joint = "pivot"
torque = "torque"
[outputs]
arm = { kind = "displacement", of = "arm" }
angle = { kind = "relative", of = "pivot" }
torque = { kind = "signal", of = "torque" }
[analysis]
kind = "dynamics"
end = 60
step = 5e-3
tolerance = 1e-10
"#;

#[test]
fn feedback_and_states_respond_as_in_steps_over_time() {
    let frequency = 0.8;
    let request = ResponseRequest {
        points: 2,
        ..request(&["command"], &["angle.angle", "torque", "arm.u1"], frequency, 1.0001 * frequency)
    };
    let found = find(CONTROLLED, &request);
    assert_eq!(found.frequencies[0], frequency);
    let model = Model::from_text("model.toml", CONTROLLED);
    // The same input in steps: small amplitude, held over each of them, from the equilibrium of the integrator.
    let small = 1e-5;
    let driven = CONTROLLED
        .replace("command - pivot.angle", "u - pivot.angle")
        .replace("[signals]", &format!("[signals]\nu = \"{small}*sin({TAU}*{frequency}*t)\""));
    let driven = Model::from_text("driven.toml", &driven);
    let mut session = driven.session().unwrap_or_else(|error| panic!("{error}"));
    let record = session.run().unwrap();
    for (k, (output, component)) in
        [("angle", "angle"), ("torque", "value"), ("arm", "u1")].into_iter().enumerate()
    {
        let values = record.column(output, component).unwrap();
        // Fourier coefficients over the last 8 periods.
        let (mut sum, mut mean, mut count) = (Complex64::from(0.0), 0.0, 0.0);
        let from = 60.0 - 8.0 / frequency;
        for (time, value) in record.times.iter().zip(values).filter(|(time, _)| **time > from + 1e-9) {
            sum += (-I * TAU * frequency * *time).exp() * *value;
            mean += value;
            count += 1.0;
        }
        assert!((count - 8.0 / frequency / 5e-3_f64).abs() < 0.5 && mean.is_finite());
        // sin = Im e^{iωt}.
        let amplitude = sum * 2.0 / count * I / small;
        let wanted = found.transfers[k].amplitudes[0];
        assert!((amplitude - wanted).norm() < 2e-3 * wanted.norm(), "{output}: {amplitude} for {wanted}");
    }
    // Its modes: the characteristic polynomial of the loop.
    let request =
        ModeRequest { count: Some(5), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let report = modes(&model, &request).unwrap_or_else(|error| panic!("{error}"));
    let inertia = 0.2 + 2.0 * 0.25;
    let gravity = gravity_stiffness();
    for mode in &report.modes {
        let s = mode.eigenvalue;
        let value = s * s * s * inertia + s * s * 2.0 + s * (30.0 + gravity) + 8.0;
        assert!(value.norm() < 1e-6 * (s.norm().powi(3) * inertia + 8.0), "{s}: {value}");
    }
    let eigenvalues: usize =
        report.modes.iter().map(|mode| if mode.eigenvalue.im == 0.0 { 1 } else { 2 }).sum();
    assert_eq!(eigenvalues, 3, "{:?}", report.modes.iter().map(|mode| mode.eigenvalue).collect::<Vec<_>>());
}

/// Of the arm held at its position by the integrator, about its pivot.
fn gravity_stiffness() -> f64 {
    2.0 * 9.81 * 0.4
}

fn matrix(found: &LinearizeReport, name: &str) -> DMatrix<f64> {
    let (_, text) =
        found.files.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name}"));
    let mut lines = text.lines().filter(|line| !line.starts_with('%'));
    let sizes: Vec<usize> = lines.next().unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
    if sizes.len() == 2 {
        let values: Vec<f64> = lines.map(|line| line.parse().unwrap()).collect();
        return DMatrix::from_column_slice(sizes[0], sizes[1], &values);
    }
    let mut matrix = DMatrix::zeros(sizes[0], sizes[1]);
    let mut count = 0;
    for line in lines {
        let words: Vec<&str> = line.split(' ').collect();
        let [row, column] = [0, 1].map(|k| words[k].parse::<usize>().unwrap() - 1);
        matrix[(row, column)] = words[2].parse().unwrap();
        count += 1;
    }
    assert_eq!(count, sizes[2]);
    matrix
}

fn complex(matrix: &DMatrix<f64>) -> DMatrix<Complex64> {
    matrix.map(Complex64::from)
}

#[test]
fn matrices_in_the_files_have_the_response() {
    for (text, inputs, outputs, is_prescribed) in [
        (CONTROLLED.to_owned(), ["command"], ["angle", "torque", "arm"], false),
        (cantilever(3), ["inputs.push"], ["tip", "root", "quarter"], false),
        (OSCILLATOR.to_owned(), ["push"], ["rush", "guide", "way"], false),
        (two_masses(), ["shake"], ["left", "right", "force"], true),
    ] {
        let ask = ResponseRequest { points: 5, ..request(&inputs, &outputs, 0.31, 11.0) };
        let found = find(&text, &ask);
        let asked =
            LinearizeRequest { about: OperatingPoint::Static, inputs: ask.inputs, outputs: ask.outputs };
        let linear = linearize(&Model::from_text("model.toml", &text), &asked)
            .unwrap_or_else(|error| panic!("{error}"));
        let [m, d, k, g] = ["M.mtx", "D.mtx", "K.mtx", "G.mtx"].map(|name| complex(&matrix(&linear, name)));
        let right = complex(&matrix(&linear, "inputs.mtx"));
        let parts = ["place", "rate", "acceleration", "multiplier", "input"]
            .map(|part| complex(&matrix(&linear, &format!("outputs-{part}.mtx"))));
        let (n, c) = (m.nrows(), g.nrows());
        for (row, frequency) in found.frequencies.iter().enumerate().step_by(7) {
            let s = I * TAU * *frequency;
            let mut whole = DMatrix::zeros(n + c, n + c);
            whole.view_mut((0, 0), (n, n)).copy_from(&(&m * (s * s) + &d * s + &k));
            whole.view_mut((n, 0), (c, n)).copy_from(&g);
            whole.view_mut((0, n), (n, c)).copy_from(&g.transpose());
            let x = whole.lu().solve(&right).unwrap();
            let places = x.rows(0, n);
            let y = (&parts[0] + &parts[1] * s + &parts[2] * (s * s)) * places
                + &parts[3] * x.rows(n, c)
                + &parts[4];
            let size = y.norm();
            let compare = |y: &DMatrix<Complex64>, tolerance: f64| {
                for (k, transfer) in found.transfers.iter().enumerate() {
                    let value = transfer.amplitudes[row];
                    assert!(
                        (y[k] - value).norm() < tolerance * size,
                        "{}: {} for {value}",
                        transfer.name(),
                        y[k]
                    );
                }
            };
            compare(&y, 1e-7);
            match &linear.state_space {
                Ok(space) => {
                    assert!(!is_prescribed);
                    let [a, b, c, d] = ["A", "B", "C", "D"]
                        .map(|name| complex(&matrix(&linear, &format!("state-space-{name}.mtx"))));
                    let states = a.nrows();
                    assert_eq!(space.states.len(), states);
                    let inner = DMatrix::<Complex64>::identity(states, states) * s - a;
                    compare(&(c * inner.lu().solve(&b).unwrap() + d), 1e-7);
                }
                Err(error) => assert!(is_prescribed, "{error}"),
            }
        }
    }
}

/// A coordinate that no part has: its acceleration answers as its position does, times -ω².
#[test]
fn accelerations_of_generalized_coordinates_answer() {
    let text = r#"
lissom = 1
[joints.x]
kind = "generalized_coordinates"
start = [0]
[springs.matrices]
kind = "coordinate_dynamics"
coordinates = ["x"]
mass = 2
damping = 0.5
stiffness = 50
[loads.push]
kind = "joint_force"
joint = "x"
force = 0
[outputs.acceleration]
kind = "relative_acceleration"
of = "x"
[analysis]
kind = "dynamics"
end = 1
"#;
    let found = find(text, &request(&["push"], &["acceleration"], 0.1, 3.0));
    compare(&found, "acceleration.a/push", 1e-9, |hertz| {
        let rate = TAU * hertz;
        -rate * rate / (50.0 - 2.0 * rate * rate + I * 0.5 * rate)
    });
}

#[test]
fn questions_without_sense_are_refused() {
    let ask = |inputs: &[&str], outputs: &[&str], from: f64, to: f64| {
        response(&Model::from_text("model.toml", OSCILLATOR), &request(inputs, outputs, from, to))
            .expect_err("it has no answer")
    };
    for (error, words) in [
        (ask(&["pusch"], &["place"], 0.1, 1.0), "`inputs.command`, `loads.push`, `loads.drive`"),
        (ask(&["push"], &["plaice"], 0.1, 1.0), "`place.x`"),
        (ask(&["push"], &["place"], 0.0, 1.0), "two frequencies greater than zero"),
        (ask(&["push"], &["place"], 2.0, 1.0), "the smaller one first"),
    ] {
        assert!(matches!(error.origin(), Origin::Request) && error.to_string().contains(words), "{error}");
    }
    let idle = OSCILLATOR.replace("scale = \"50*command^2\"", "");
    let error =
        response(&Model::from_text("model.toml", &idle), &request(&["command"], &["place"], 0.1, 1.0));
    assert!(matches!(error, Err(FrequencyError::Port(_))));
    let work = OSCILLATOR.replace("[outputs]", "[outputs]\nall = { kind = \"work\", of = \"push\" }");
    let error = response(&Model::from_text("model.toml", &work), &request(&["push"], &["all"], 0.1, 1.0));
    assert!(error.expect_err("works are accumulated").to_string().contains("no linear response"));
    let sampled = CONTROLLED.replace(
        "torque = \"30*(command - pivot.angle) - 2*pivot.rate + 8*wound\"",
        "torque = { value = \"-pivot.angle\", sample = 0.1 }",
    );
    let error =
        response(&Model::from_text("model.toml", &sampled), &request(&["motor"], &["angle"], 0.1, 1.0));
    assert!(error.expect_err("it is sampled").to_string().contains("sampled"));
}
