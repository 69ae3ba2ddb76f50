//! Derivatives along the steps against central differences of whole runs.

#[path = "support/cantilever.rs"]
mod cantilever;

use cantilever::CANTILEVER;
use lissom::gradient::{GradientError, Target, gradient};
use lissom::{Model, Override};

/// The measure's value of a whole run with a number changed.
fn measured(model: &Model, column: (&str, &str), over: &str, set: &[Override]) -> f64 {
    let mut session = model.session(set).unwrap();
    let (record, report) = session.record();
    assert!(report.is_complete());
    let values = record.column(column.0, column.1).unwrap();
    match over {
        "max" => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        "rms" => {
            let last = values.len() - 1;
            let sum: f64 = (0..last)
                .map(|k| {
                    0.5 * (record.times[k + 1] - record.times[k])
                        * (values[k].powi(2) + values[k + 1].powi(2))
                })
                .sum();
            (sum / (record.times[last] - record.times[0])).sqrt()
        }
        _ => values[values.len() - 1],
    }
}

/// Compares derivatives with central differences of fourth order of whole runs.
fn agrees(
    text: &str,
    of: &str,
    column: (&str, &str),
    numbers: &[(&str, f64)],
    set: &[Override],
    tolerance: f64,
) {
    let model = Model::from_text("model.toml", text);
    let target: Target = of.parse().unwrap();
    let paths: Vec<String> = numbers.iter().map(|(path, _)| (*path).to_owned()).collect();
    let found = gradient(&model, set, &target, &paths).unwrap_or_else(|error| panic!("{of}: {error}"));
    let over = of.split_once('@').map_or("end", |(_, measure)| measure);
    for (derivative, &(path, number)) in found.derivatives.iter().zip(numbers) {
        assert_eq!((derivative.path.as_str(), derivative.number), (path, number));
        let at = |side: f64| {
            let mut set = set.to_vec();
            set.push(("analysis.tolerance".to_owned(), "1e-13".to_owned()));
            if over.parse::<f64>().is_ok() {
                set.push(("analysis.end".to_owned(), over.to_owned()));
            }
            set.push((path.to_owned(), format!("{:?}", number * (1.0 + side * 1e-3))));
            measured(&model, column, over, &set)
        };
        let difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * 1e-3 * number);
        assert!(
            (derivative.value - difference).abs() <= tolerance * difference.abs(),
            "{of} by {path}: {:e}, whole runs {difference:e}, {:e}",
            derivative.value,
            derivative.value / difference - 1.0
        );
    }
}

fn set(overrides: &[(&str, &str)]) -> Vec<Override> {
    overrides.iter().map(|&(path, value)| (path.to_owned(), value.to_owned())).collect()
}

/// Two rods swing under gravity, the lower one on a spring.
const SWING: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[parameters]
length = 0.7
[bodies.upper]
mass = 2.0
inertia = [0.1, 0.1, 0.03]
position = ["length", 0, 0]
[bodies.lower]
mass = 1.0
inertia = [0.05, 0.05, 0.01]
position = ["2*length", 0, 0]
[joints.pivot]
kind = "revolute"
base = "ground"
tip = "upper"
at = [0, 0, 0]
axis = [0, 1, 0]
[joints.elbow]
kind = "revolute"
base = "upper"
tip = "lower"
at = ["length", 0, 0]
axis = [0, 1, 0]
[springs.elbow]
kind = "torsional"
joint = "elbow"
stiffness = 30.0
damping = 0.4
[outputs.lower]
kind = "position"
of = "lower"
[outputs.pivot]
kind = "reaction"
of = "pivot"
[analysis]
kind = "dynamics"
end = 0.6
step = 5e-3
scheme = "generalized-alpha"
"#;

const NUMBERS: [(&str, f64); 4] = [
    ("bodies.lower.mass", 1.0),
    ("springs.elbow.stiffness", 30.0),
    ("springs.elbow.damping", 0.4),
    ("parameters.length", 0.7),
];

#[test]
fn a_mechanism_is_differentiated_with_every_scheme() {
    for scheme in ["generalized-alpha", "hht", "radau-iia", "energy-decaying"] {
        let set = set(&[("analysis.scheme", scheme)]);
        agrees(SWING, "lower.z", ("lower", "z"), &NUMBERS, &set, 1e-6);
    }
}

#[test]
fn reactions_times_maxima_and_means_are_differentiated() {
    agrees(SWING, "pivot.f3@0.35", ("pivot", "f3"), &NUMBERS[..2], &[], 1e-6);
    agrees(SWING, "pivot.f3@max", ("pivot", "f3"), &NUMBERS[..2], &[], 1e-6);
    agrees(SWING, "lower.x@rms", ("lower", "x"), &NUMBERS, &[], 1e-6);
}

#[test]
fn a_bent_beam_is_differentiated() {
    let text = CANTILEVER
        .replace(
            "stiffness = [1e6, 4e5, 4e5, 100, 200, 200]",
            "stiffness = [1e6, 4e5, 4e5, 100, \"EI\", 200]",
        )
        .replace("lissom = 1\n", "lissom = 1\n[parameters]\nEI = 200\nforce = 300\n")
        .replace("3*t", "force*t");
    let numbers = [("parameters.EI", 200.0), ("parameters.force", 300.0)];
    agrees(&text, "tip.u3", ("tip", "u3"), &numbers, &[], 1e-7);
    agrees(&text, "root.m2@0.5", ("root", "m2"), &numbers, &[], 1e-7);
}

#[test]
fn questions_without_sense_are_refused() {
    let refuse = |of: &str, path: &str, set: &[Override]| {
        let model = Model::from_text("model.toml", SWING);
        gradient(&model, set, &of.parse().unwrap(), &[path.to_owned()]).unwrap_err()
    };
    assert!(matches!(refuse("lower.q", "bodies.lower.mass", &[]), GradientError::Column { .. }));
    assert!(matches!(refuse("lower.z@7", "bodies.lower.mass", &[]), GradientError::Time { .. }));
    assert!(matches!(refuse("lower.z", "bodies.lower.mas", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "bodies.lower.inertia", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "analysis.step", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "springs.elbow", &[]), GradientError::Number(_)));
    let still = set(&[("springs.elbow.damping", "0")]);
    assert!(matches!(refuse("lower.z", "springs.elbow.damping", &still), GradientError::Number(_)));
    assert!("lower.z@often".parse::<Target>().is_err());
}

#[test]
fn a_flexible_mechanism_is_differentiated() {
    let text = include_str!("../../../examples/tip-crank.toml");
    let set = set(&[("analysis.end", "0.02"), ("analysis.output_every", "1")]);
    let numbers = [("materials.aluminium.E", 73e9), ("materials.aluminium.density", 2700.0)];
    agrees(text, "root.f3", ("root", "f3"), &numbers, &set, 1e-5);
}
