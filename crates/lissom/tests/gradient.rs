//! Derivatives along the steps against central differences of whole runs.

use cantilever::CANTILEVER;
use lissom::analyses::gradient::{Confirmation, GradientError, Method, Target, gradient};
use lissom::analyses::{AnalysisError, Origin};
use lissom::{Model, Override};

use crate::support::cantilever;
use crate::support::rail;
use crate::support::runs::overrides;

/// The measure's value of a whole run with a number changed.
fn measured(model: &Model, column: (&str, &str), over: &str, set: &[Override]) -> f64 {
    let mut session = model.with_overrides(set).session().unwrap();
    let record = session.run().unwrap();
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
    let found = gradient(&model.with_overrides(set), &target, &paths, true)
        .unwrap_or_else(|error| panic!("{of}: {error}"));
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
    for scheme in ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] {
        let set = overrides(&[("analysis.scheme", scheme)]);
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
        gradient(&model.with_overrides(set), &of.parse().unwrap(), &[path.to_owned()], true).unwrap_err()
    };
    assert!(matches!(refuse("lower.q", "bodies.lower.mass", &[]), GradientError::Column { .. }));
    assert!(matches!(refuse("lower.z@7", "bodies.lower.mass", &[]), GradientError::Time { .. }));
    assert!(matches!(refuse("lower.z", "bodies.lower.mas", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "bodies.lower.inertia", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "analysis.step", &[]), GradientError::Number(_)));
    assert!(matches!(refuse("lower.z", "springs.elbow", &[]), GradientError::Number(_)));
    let still = overrides(&[("springs.elbow.damping", "0")]);
    assert!(matches!(refuse("lower.z", "springs.elbow.damping", &still), GradientError::Number(_)));
    assert!("lower.z@often".parse::<Target>().is_err());
}

/// Compares derivatives with differences of whole runs over three distances, extrapolated to sixth order. The distance is
/// what round-off of the runs leaves best, relative to the number.
fn agrees_closely(
    model: &Model,
    of: &str,
    column: (&str, &str),
    numbers: &[(&str, f64, f64)],
    set: &[Override],
    tolerance: f64,
) {
    let target: Target = of.parse().unwrap();
    let paths: Vec<String> = numbers.iter().map(|(path, ..)| (*path).to_owned()).collect();
    let found = gradient(&model.with_overrides(set), &target, &paths, true)
        .unwrap_or_else(|error| panic!("{of}: {error}"));
    assert!(found.derivatives.iter().all(|derivative| derivative.method == Method::Direct), "{of}");
    assert!(matches!(found.confirmation, Some(Confirmation::Confirmed { .. })), "{of}: {found:?}");
    let over = of.split_once('@').map_or("end", |(_, measure)| measure);
    for (derivative, &(path, number, distance)) in found.derivatives.iter().zip(numbers) {
        let at = |side: f64| {
            let mut set = set.to_vec();
            set.push(("analysis.tolerance".to_owned(), "1e-13".to_owned()));
            set.push((path.to_owned(), format!("{:?}", number * (1.0 + side * distance))));
            measured(model, column, over, &set)
        };
        let [first, second, third] =
            [1.0, 2.0, 4.0].map(|side| (at(side) - at(-side)) / (2.0 * side * distance * number));
        let (near, far) = ((4.0 * first - second) / 3.0, (4.0 * second - third) / 3.0);
        let difference = (16.0 * near - far) / 15.0;
        assert!(
            (derivative.value - difference).abs() <= tolerance * difference.abs(),
            "{of} by {path}: {:e}, whole runs {difference:e}, {:e}",
            derivative.value,
            derivative.value / difference - 1.0
        );
    }
}

/// Schemes along whose steps derivatives are carried.
const CARRIED: [&str; 5] = ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"];

#[test]
fn derivatives_that_are_carried_have_seven_digits() {
    let model = Model::from_text("model.toml", SWING);
    for scheme in CARRIED {
        // Integrated strains are far from linear in what moves little.
        let distance = if scheme == "energy-decaying" { 5e-4 } else { 5e-3 };
        let numbers = NUMBERS.map(|(path, number)| (path, number, distance));
        let set = overrides(&[("analysis.scheme", scheme)]);
        for (of, column) in [
            ("lower.z", ("lower", "z")),
            ("pivot.f3", ("pivot", "f3")),
            ("pivot.f3@max", ("pivot", "f3")),
            ("lower.x@rms", ("lower", "x")),
        ] {
            agrees_closely(&model, of, column, &numbers[..3], &set, 1e-7);
            // A length moves all positions at the start, which are rounded.
            agrees_closely(&model, of, column, &numbers[3..], &set, 1e-6);
        }
    }
}

#[test]
fn a_tip_crank_is_differentiated_with_every_scheme() {
    let model = Model::from_text("model.toml", include_str!("../../../examples/tip-crank.toml"));
    let numbers = [("materials.aluminium.E", 73e9, 4e-3), ("sections.strip.width", 0.0025, 4e-3)];
    for scheme in CARRIED {
        let set = overrides(&[("analysis.end", "0.02"), ("analysis.scheme", scheme)]);
        // Three stages multiply rounding of the whole runs' reactions by larger weights.
        let tolerance = if scheme == "radau-iia-5" { 3e-7 } else { 1e-7 };
        agrees_closely(&model, "root.f3", ("root", "f3"), &numbers, &set, tolerance);
    }
}

#[test]
fn a_turbine_is_differentiated_with_every_scheme() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/turbine-rotor.toml");
    let model = Model::read(&path).unwrap();
    let numbers = [("parameters.speed", 4.0, 1e-2), ("parts.blade.parameters.pitch", 0.05, 1e-2)];
    for scheme in CARRIED {
        // Blades that hardly bend: what rounding leaves of integrated strains is a part of them.
        let tolerance = if scheme == "energy-decaying" { 1e-6 } else { 1e-7 };
        let set =
            overrides(&[("parameters.speed", "4.0"), ("analysis.end", "0.1"), ("analysis.scheme", scheme)]);
        agrees_closely(&model, "blade1.tip.u1", ("blade1.tip", "u1"), &numbers, &set, tolerance);
    }
}

#[test]
fn a_four_bar_is_differentiated_over_time() {
    let text = include_str!("../../../examples/four-bar.toml")
        .replace("[points]", "[parameters]\nEI = 70.6560\nreach = 0.24\n[points]")
        .replace("70.6560, 70.6560]", "70.6560, \"EI\"]")
        .replace("C = [0.24, 0, 0.12]", "C = [\"reach\", 0, 0.12]")
        .replace("D = [0.24, 0, 0]", "D = [\"reach\", 0, 0]");
    let model = Model::from_text("model.toml", &text);
    for scheme in CARRIED {
        let set = overrides(&[("analysis.end", "0.3"), ("analysis.scheme", scheme)]);
        let drive = ("drive", "moment");
        let mass = [("sections.stiff.mass.per_length", 1.9968, 1e-2)];
        // Forces that are recovered are differenced over some thousandths of a number; with three stages, whose recovery differences
        // forces over half the time, round-off is up to 3e-7.
        let tolerance = if scheme == "radau-iia-5" { 6e-7 } else { 2e-7 };
        agrees_closely(&model, "drive.moment", drive, &mass, &set, tolerance);
        // The moment hardly depends on these: a millionth of it is round-off of the runs.
        let little = [("parameters.EI", 70.656, 1e-2), ("parameters.reach", 0.24, 1e-3)];
        let tolerance = if scheme == "radau-iia-5" { 2e-5 } else { 1e-5 };
        agrees_closely(&model, "drive.moment", drive, &little, &set, tolerance);
    }
}

/// A mass on a rail under a force of time: position and velocity in closed form, and their derivatives by mass, size and instant.
fn pushed(force: &str, analysis: &str) -> Model {
    let tables = rail::force(force);
    let text = rail::rail(1.0, 0.0, &tables, analysis)
        .replace("mass = 1\n", "mass = 2\n")
        .replace("lissom = 1\n", "lissom = 1\n[parameters]\nsize = 3\nfrom = 0.5035\non_a_step = 0.5\n");
    Model::from_text("model.toml", &text)
}

/// Planned steps are divided there, along which nothing is differentiated; chosen ones end there.
#[test]
fn kinks_and_jumps_over_time_are_differentiated_across_or_refused() {
    let target: Target = "rail.displacement".parse().unwrap();
    let mut across = 0;
    for scheme in CARRIED {
        for (size, force) in [
            ((1.0_f64 - 0.5035).powi(3) / 6.0, "size*max(t - 0.5035, 0)"),
            ((1.0_f64 - 0.5035).powi(2) / 2.0, "size*step(t - 0.5035)"),
        ] {
            for analysis in ["step = 1e-2", "step = 3e-3", "relative_tolerance = 1e-6"] {
                let model = pushed(force, &format!("{analysis}\nscheme = \"{scheme}\""));
                let paths = ["bodies.ball.mass", "parameters.size"].map(str::to_owned);
                match gradient(&model, &target, &paths, true) {
                    Ok(found) => {
                        let wanted = [-size * 3.0 / 4.0, size / 2.0];
                        for (derivative, wanted) in found.derivatives.iter().zip(wanted) {
                            let missed = (derivative.value / wanted - 1.0).abs();
                            assert!(missed < 1e-6, "{scheme}, {force}, {analysis}: {derivative:?}, {wanted}");
                        }
                        across += 1;
                    }
                    Err(error) => {
                        assert!(matches!(error, GradientError::InParts(_)), "{scheme}, {force}: {error}");
                        assert!(error.to_string().contains("kink or jump"), "{error}");
                    }
                }
            }
        }
    }
    assert!(across >= 4, "{across}");
}

/// Steps do not see that it moves: derivatives were wrong by 2 %, or a hundredfold.
#[test]
fn numbers_that_move_kinks_are_refused() {
    let target: Target = "rail.displacement".parse().unwrap();
    for scheme in CARRIED {
        for force in ["size*max(t - PATH, 0)", "size*step(t - PATH)"] {
            for analysis in ["step = 1e-2", "relative_tolerance = 1e-6"] {
                for path in ["from", "on_a_step"] {
                    let model =
                        pushed(&force.replace("PATH", path), &format!("{analysis}\nscheme = \"{scheme}\""));
                    let paths = [format!("parameters.{path}")];
                    let error = gradient(&model, &target, &paths, true).map(|_| ()).unwrap_err();
                    assert!(matches!(error, GradientError::KinkMoves { .. }), "{force}, {analysis}: {error}");
                    assert!(
                        matches!(error.origin(), Origin::Request)
                            && error.to_string().contains("smooth the function over"),
                        "{error}"
                    );
                }
            }
        }
    }
}

/// Neighbouring models that take the steps of a model at rest never find what is to be found.
#[test]
fn a_beam_that_starts_from_rest_is_differentiated() {
    let text = CANTILEVER
        .replace(
            "stiffness = [1e6, 4e5, 4e5, 100, 200, 200]",
            "stiffness = [1e6, 4e5, 4e5, 100, \"EI\", 200]",
        )
        .replace("lissom = 1\n", "lissom = 1\n[parameters]\nEI = 200\n")
        .replace("scale = \"3*t\"", "scale = \"30*(1-cos(20*t))\"")
        .replace("kind = \"statics\"\nsteps = 4", "kind = \"dynamics\"\nend = 0.05\nstep = 1e-3");
    let model = Model::from_text("model.toml", &text);
    let numbers = [("parameters.EI", 200.0, 4e-3), ("sections.bar.mass.per_length", 1.0, 4e-3)];
    for scheme in CARRIED {
        let set = overrides(&[("analysis.scheme", scheme)]);
        agrees_closely(&model, "tip.u3", ("tip", "u3"), &numbers, &set, 1e-8);
        agrees_closely(&model, "root.m2@max", ("root", "m2"), &numbers, &set, 1e-7);
    }
}

#[test]
fn a_flexible_mechanism_is_differentiated() {
    let text = include_str!("../../../examples/tip-crank.toml");
    let set = overrides(&[("analysis.end", "0.02"), ("analysis.output_every", "1")]);
    let numbers = [("materials.aluminium.E", 73e9), ("materials.aluminium.density", 2700.0)];
    agrees(text, "root.f3", ("root", "f3"), &numbers, &set, 1e-5);
}

/// Derivatives of steps of the implicit Euler method are not available: whole runs replace them. A fall of n steps is h² n (n + 1)/2 deep.
#[test]
fn gradients_of_the_implicit_euler_method_are_those_of_whole_runs() {
    let text = "lissom = 1\ngravity = [0, 0, \"-g\"]\n[parameters]\ng = 9.81\n[bodies.b]\nmass = 2\ninertia = [1, 1, 1]\n\
                [outputs.b]\nkind = \"position\"\nof = \"b\"\n[analysis]\nkind = \"dynamics\"\nscheme = \"backward-euler\"\nstep = 0.01\nend = 0.5\n";
    let model = Model::from_text("model.toml", text);
    let found =
        gradient(&model, &"b.z".parse::<Target>().unwrap(), &["parameters.g".to_owned()], true).unwrap();
    let wanted = -1e-4 * 50.0 * 51.0 / 2.0;
    assert!((found.derivatives[0].value - wanted).abs() < 1e-7, "{}", found.derivatives[0].value);
}
