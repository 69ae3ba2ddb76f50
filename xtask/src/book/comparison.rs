//! The schemes beside each other, as in the third chapter of [Epple 2008]: what they do to an oscillator, their orders, the energy of
//! flexible models, and models that are hard for all of them.

use lissom::analyses::study::convergence::{Request, Row, study};
use lissom::{Model, Override};
use lissom_model::output::{LogFigure, Record};
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::fragment::{Fragment, overrides, texts};
use super::numbers::two;
use super::{BookError, Studio};

const SCHEMES: [&str; 9] = [
    "backward-euler",
    "generalized-alpha",
    "hht(-0.3)",
    "radau-iia",
    "radau-iia-5",
    "radau-iia-9",
    "radau-iia-13",
    "energy-decaying",
    "energy-decaying(0.5)",
];

/// A unit mass on a unit spring, released from the displacement 1.
const OSCILLATOR: &str = r#"
lissom = 1
[bodies.mass]
mass = 1
inertia = [1, 1, 1]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "mass"
axis = [1, 0, 0]
[springs.spring]
kind = "coordinate_dynamics"
coordinates = ["guide.displacement"]
stiffness = 1
rest = [-1]
[outputs.guide]
kind = "relative"
of = "guide"
[analysis]
kind = "dynamics"
end = 1
step = 1
energy_check = false
tolerance = 1e-13
"#;

/// A bob on a rod of 1 m: no coordinate is a function of another.
const PENDULUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.bob]
mass = 1
inertia = [0.1, 0.2, 0.3]
position = [1, 0, 0]
[joints.pivot]
kind = "spherical"
base = "ground"
tip = "bob"
at = [0, 0, 0]
[outputs.position]
kind = "position"
of = "bob"
[outputs.velocity]
kind = "velocity"
of = "bob"
[outputs.pivot]
kind = "reaction"
of = "pivot"
[analysis]
kind = "dynamics"
end = 0.5
step = 1e-2
"#;

/// Step sizes in units of the oscillator's frequency.
const FREQUENCIES: [f64; 7] = [0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0];
/// Errors below this are round-off.
const ROUND_OFF: f64 = 1e-12;
/// Displacements above this have digits from which a recurrence can be found.
const SEEN: f64 = 1e-7;
/// Steps of the oscillator.
const STEPS: usize = 8;

/// The table of a linear oscillator, and the figure of the amplification.
pub(super) fn oscillator(studio: &Studio) -> Result<Fragment, BookError> {
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    for (done, scheme) in SCHEMES.iter().enumerate() {
        studio.show(done, SCHEMES.len());
        let mut curve = Vec::new();
        let mut row = vec![(*scheme).to_owned()];
        let (mut period, mut fastest) = (String::new(), String::new());
        for frequency in FREQUENCIES {
            let (positions, velocities) = released(scheme, frequency)?;
            let roots = amplification(&positions);
            let radius = roots.iter().map(|root| root.norm()).fold(0.0, f64::max);
            curve.push((frequency, radius));
            if [0.3, 1.0, 10.0, 100.0].contains(&frequency) {
                row.push(format!("{radius:.3}"));
            }
            // Not the real root of schemes with three of them.
            let turns = roots.iter().filter(|root| root.im.abs() > 1e-9 * root.norm());
            let angle =
                turns.max_by(|a, b| a.norm().total_cmp(&b.norm())).map_or(f64::NAN, |root| root.arg().abs());
            if frequency == 0.3 {
                period = format!("{:.1e}", frequency / angle - 1.0);
            }
            if frequency == 10.0 {
                fastest = two(velocities.iter().fold(0.0, |most: f64, velocity| most.max(velocity.abs())));
            }
        }
        row.extend([period, fastest]);
        rows.push(row);
        curves.push(((*scheme).to_owned(), curve));
    }
    let mut fragment = Fragment::default();
    let radii = ["0.3", "1", "10", "100"].map(|frequency| format!("radius, hω = {frequency}"));
    let mut heading = vec!["scheme"];
    heading.extend(radii.iter().map(String::as_str));
    heading.extend(["period error, hω = 0.3", "largest velocity, hω = 10"]);
    fragment.table(&heading, &rows);
    let figure = LogFigure {
        name: "amplification".to_owned(),
        title: "Amplification of a step, undamped oscillator".to_owned(),
        x_label: "hω [-]".to_owned(),
        y_label: "spectral radius [-]".to_owned(),
        guides: Vec::new(),
        curves,
    };
    fragment.figure("comparison-oscillator", "Spectral radius over hω", &figure)?;
    Ok(fragment)
}

/// Displacements and velocities of the oscillator at the ends of its steps.
fn released(scheme: &str, step: f64) -> Result<(Vec<f64>, Vec<f64>), BookError> {
    let set =
        [("analysis.step", format!("{step:e}")), ("analysis.end", format!("{:e}", STEPS as f64 * step))];
    let record = run("oscillator", &Model::from_text("oscillator", OSCILLATOR), scheme, &set)?;
    let column = |component: &str| {
        let column = record.column("guide", component).unwrap_or_default();
        let ends = record.times.iter().zip(column).filter(|(time, _)| {
            let steps = *time / step;
            (steps - steps.round()).abs() < 1e-6
        });
        ends.map(|(_, value)| *value).collect::<Vec<f64>>()
    };
    let positions = column("displacement").iter().map(|displacement| displacement + 1.0).collect();
    Ok((positions, column("velocity")))
}

/// Eigenvalues of a step, from a recurrence of two or three terms that the displacements satisfy. The first step may differ from
/// the others.
fn amplification(positions: &[f64]) -> Vec<Complex64> {
    let mut roots = Vec::new();
    for terms in [2, 3] {
        let size =
            |window: &[f64]| window.iter().fold(f64::MIN_POSITIVE, |most: f64, value| most.max(value.abs()));
        // The displacement is measured from that of the start, with the round-off of a number of order one.
        let windows = positions[1..].windows(terms + 1).filter(|window| size(window) > SEEN);
        let windows: Vec<&[f64]> = windows.collect();
        let matrix =
            DMatrix::from_fn(windows.len(), terms, |i, j| windows[i][terms - 1 - j] / size(windows[i]));
        let right = DVector::from_fn(windows.len(), |i, _| windows[i][terms] / size(windows[i]));
        let Ok(factors) = matrix.clone().svd(true, true).solve(&right, 1e-9) else { continue };
        let misfit = (&matrix * &factors - &right).amax();
        let mut companion = DMatrix::zeros(terms, terms);
        for k in 0..terms {
            companion[(0, k)] = factors[k];
            if k > 0 {
                companion[(k, k - 1)] = 1.0;
            }
        }
        roots = companion.complex_eigenvalues().iter().copied().collect();
        if misfit < 1e-7 {
            break;
        }
    }
    roots
}

/// Orders of positions, velocities and multipliers.
pub(super) fn orders(studio: &Studio) -> Result<Fragment, BookError> {
    let model = Model::from_text("pendulum", PENDULUM);
    let steps = ["1e-1", "5e-2", "2.5e-2"];
    let (mut rows, outputs) = (Vec::new(), ["position.x", "velocity.v1", "pivot.f1"]);
    let mut tables = Vec::new();
    for output in outputs {
        let request = Request {
            schemes: texts(&SCHEMES),
            steps: texts(&steps),
            reference: ("radau-iia-13".to_owned(), "1e-3".to_owned()),
            output: output.to_owned(),
        };
        let set = overrides(&[("analysis.tolerance", "1e-13")]);
        tables.push(study(&model.with_overrides(&set), &request, &studio.watch())?);
    }
    for scheme in SCHEMES {
        let mut row = vec![scheme.to_owned()];
        for table in &tables {
            let last = table.rows.iter().rfind(|row| row.scheme == scheme);
            let error =
                last.and_then(|row| row.outcome.as_ref().ok()).map_or_else(String::new, |error| two(*error));
            let is_seen = |row: &&Row| row.outcome.as_ref().is_ok_and(|error| *error > ROUND_OFF);
            let order = last.filter(is_seen).and_then(|row| row.order);
            let order = order.map_or_else(|| "round-off".to_owned(), |order| format!("{order:.1}"));
            row.extend([error, order]);
        }
        rows.push(row);
    }
    let mut fragment = Fragment::default();
    let heading =
        ["scheme", "position: error", "order", "velocity: error", "order", "reaction: error", "order"];
    fragment.table(&heading, &rows);
    Ok(fragment)
}

/// Models in which every scheme meets a difficulty: name, what it is, path below the project's folder.
const HARD: [(&str, &str); 3] = [
    ("redundant loop", "verification/bricard/model.toml"),
    ("singular position", "verification/four-bar-n2/model.toml"),
    ("jump of the drive's acceleration", "examples/tip-crank.toml"),
];

/// Energy of flexible models that nothing drives, and models with redundant constraints, singular positions and jumps.
pub(super) fn energy(studio: &Studio) -> Result<Fragment, BookError> {
    let model = studio.example("energy")?;
    let mut rows = Vec::new();
    for (done, scheme) in SCHEMES.iter().enumerate() {
        studio.show(done, SCHEMES.len());
        let mut row = vec![(*scheme).to_owned()];
        for step in ["1e-2", "1e-3"] {
            let set = [
                ("analysis.step", step.to_owned()),
                ("analysis.end", "1".to_owned()),
                ("analysis.energy_check", "false".to_owned()),
            ];
            row.push(match run("energy", &model, scheme, &set) {
                Ok(record) => {
                    let energy = record.column("energy", "total").unwrap_or_default();
                    let first = energy.first().copied().unwrap_or(f64::NAN);
                    let most = energy.iter().fold(f64::NEG_INFINITY, |most, energy| most.max(energy - first));
                    let last = energy.last().map_or(f64::NAN, |energy| energy - first);
                    format!("{last:+.1e} (at most {most:+.0e})")
                }
                Err(error) => first_words(&error.to_string()),
            });
        }
        for (_, path) in HARD {
            let model = Model::read(&studio.root.join(path))?;
            let set = [("analysis.step", "1e-3".to_owned()), ("analysis.end", "0.2".to_owned())];
            row.push(match run("hard", &model, scheme, &set) {
                Ok(_) => "runs".to_owned(),
                Err(error) => first_words(&error.to_string()),
            });
        }
        rows.push(row);
    }
    let mut fragment = Fragment::default();
    let mut heading = vec!["scheme", "energy change [J], h = 10 ms", "h = 1 ms"];
    heading.extend(HARD.iter().map(|(name, _)| *name));
    fragment.table(&heading, &rows);
    Ok(fragment)
}

fn first_words(message: &str) -> String {
    message.split([';', ',']).next().unwrap_or_default().replace('|', "/")
}

/// The record of a run, or why it ended early.
fn run(
    name: &'static str,
    model: &Model,
    scheme: &str,
    settings: &[(&str, String)],
) -> Result<Record, BookError> {
    let mut set: Vec<Override> =
        settings.iter().map(|(path, value)| ((*path).to_owned(), value.clone())).collect();
    // As in studies: the parameter in parentheses.
    let (word, parameter) = scheme.split_once('(').unwrap_or((scheme, ""));
    set.push(("analysis.scheme".to_owned(), word.to_owned()));
    if let Some(value) = parameter.strip_suffix(')') {
        let key = if word == "hht" { "analysis.alpha" } else { "analysis.spectral_radius" };
        set.push((key.to_owned(), value.to_owned()));
    }
    let mut session = model.with_overrides(&set).session().map_err(BookError::run(name))?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    report
        .error()
        .map_or(Ok(record), |error| Err(BookError::Run { example: name, reason: error.to_string() }))
}
