//! Studies in memory: the published exponents on the pendulum, the pivots of the tip crank, orders of schemes,
//! round-off at tiny steps.

use std::ops::ControlFlow;
use std::path::Path;

use lissom::analyses::study::{StudyError, conditioning, convergence, factorization, roundoff};
use lissom::core::scaling::ScaleBy;
use lissom::core::simulation::ConditionMethod;
use lissom::{Model, Override};

/// Powers of ten between two published values.
const FLAT: f64 = 1.2;

fn example(name: &str) -> Model {
    let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::read(Path::new(&path)).unwrap()
}

fn texts(words: &[&str]) -> Vec<String> {
    words.iter().map(|&word| word.to_owned()).collect()
}

fn measured(request: &conditioning::Request, set: &[Override]) -> Vec<(f64, [f64; 4])> {
    let table = conditioning::study(&example("pendulum").with_overrides(set), request, &|_, _| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let row = |row: &conditioning::Row| {
        let measured = row.outcome.as_ref().unwrap();
        assert_eq!(measured.method, ConditionMethod::SingularValues);
        assert_eq!(measured.unknowns, 5);
        assert!((measured.end - 1.0).abs() < 1e-9 && !measured.is_shortened);
        let x = row.varied.as_ref().map_or(row.step_size, |value| value.parse().unwrap());
        (x, measured.conditions)
    };
    table.rows.iter().map(row).collect()
}

fn assert_exponent(points: &[(f64, f64)], wanted: f64) {
    for pair in points.windows(2) {
        let exponent = (pair[1].1 / pair[0].1).ln() / (pair[1].0 / pair[0].0).ln();
        assert!((exponent - wanted).abs() < 0.1, "{exponent} from {:?} to {:?}", pair[0], pair[1]);
    }
}

fn assert_flat(points: &[(f64, f64)]) {
    let least = points.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
    let most = points.iter().map(|point| point.1).fold(0.0, f64::max);
    assert!(least > 1.0 && most < FLAT * least, "{points:?}");
}

fn column(rows: &[(f64, [f64; 4])], name: &str) -> Vec<(f64, f64)> {
    let index = conditioning::SCALINGS.iter().position(|known| known.name == name).unwrap();
    rows.iter().map(|(x, conditions)| (*x, conditions[index])).collect()
}

#[test]
fn condition_numbers_over_the_step_size() {
    let steps = texts(&["1e-1", "5e-2", "1e-2", "5e-3", "1e-3", "5e-4", "1e-4", "5e-5", "1e-5"]);
    let rows = measured(&conditioning::Request { steps, vary: None }, &[]);
    assert_eq!(rows.len(), 9);
    assert_exponent(&column(&rows, "none"), -4.0);
    // Far beyond what double precision sees.
    assert!(rows[8].1[0] > 1e20);
    assert_flat(&column(&rows, "unit"));
    assert_flat(&column(&rows, "physical"));
}

/// Smallest and largest of the figures in `docs/measured.md`.
#[test]
fn condition_numbers_are_those_of_the_readme() {
    let steps = texts(&["1e-1", "1e-2", "1e-3", "1e-4", "1e-5"]);
    let rows = measured(&conditioning::Request { steps, vary: None }, &[]);
    let bounds = |name: &str| {
        let values: Vec<f64> = column(&rows, name).into_iter().map(|(_, value)| value).collect();
        [f64::INFINITY, 0.0].map(|start: f64| {
            values
                .iter()
                .fold(start, |best, &value| if start > 0.0 { best.min(value) } else { best.max(value) })
        })
    };
    let ([least, most], [_, by_scale], [small, large]) =
        (bounds("equilibrated"), bounds("physical"), bounds("none"));
    let figure = format!(
        "{least:.1} to {most:.1} for every h from 0.1 s to 10 µs, {by_scale:.0} by `s` alone; unscaled {small:.1e} to {large:.1e}"
    );
    let page = include_str!("../../../docs/measured.md");
    assert!(page.contains(&figure), "docs/measured.md does not say: {figure}");
}

#[test]
fn condition_numbers_over_the_mass() {
    let values = texts(&["1e-2", "1e-1", "1", "1e1", "1e2", "1e3", "1e4"]);
    let request = conditioning::Request {
        steps: texts(&["0.01"]),
        vary: Some(("point_masses.bob.mass".to_owned(), values)),
    };
    let rows = measured(&request, &[]);
    assert_exponent(&column(&rows, "none"), 2.0);
    assert_exponent(&column(&rows, "unit")[3..], 2.0);
    assert_flat(&column(&rows, "physical"));
}

/// The scheme behind the published tables is not known. A spectral radius of 0 and a penalty of 1/2 come close,
/// with the masses of the second table ten times their label.
#[test]
fn published_numbers_are_met_within_their_digits() {
    let overrides = [("analysis.spectral_radius", "0"), ("analysis.penalty", "0.5")]
        .map(|(a, b)| (a.to_owned(), b.to_owned()));
    let steps = texts(&["1e-1", "1e-2", "1e-4"]);
    let rows = measured(&conditioning::Request { steps, vary: None }, &overrides);
    let published = [[4e4, 10.0, 12.0], [3e8, 9.2, 14.0], [3e16, 9.2, 14.0]];
    for ((_, ours), published) in rows.iter().zip(published) {
        for (ours, published) in ours.iter().zip(published) {
            assert!((ours / published).ln().abs() < 1.5_f64.ln(), "{ours:e} for {published:e}");
        }
    }
    let request = conditioning::Request {
        steps: texts(&["0.01"]),
        vary: Some(("point_masses.bob.mass".to_owned(), texts(&["1e-1", "1", "1e1", "1e5"]))),
    };
    let published = [[3e6, 2e1, 13.0], [3e8, 9.0, 14.0], [3e10, 4e2, 14.0], [3e18, 3e10, 14.0]];
    for ((_, ours), published) in measured(&request, &overrides).iter().zip(published) {
        for (ours, published) in ours.iter().zip(published) {
            assert!((ours / published).ln().abs() < 1.5_f64.ln(), "{ours:e} for {published:e}");
        }
    }
}

#[test]
fn large_models_are_estimated_and_tables_say_so() {
    let model = example("tip-crank").with("analysis.end", 1e-3);
    let steps = texts(&["5e-4", "1e-4"]);
    let request = conditioning::Request { steps, vary: None };
    let table = conditioning::study(&model, &request, &|_, _| ControlFlow::Continue(())).unwrap();
    let csv = table.csv();
    assert!(csv.starts_with("step_size,none,unit,physical,equilibrated,method,end\n5e-4,"), "{csv}");
    assert_eq!(csv.lines().filter(|line| line.contains("1-norm estimate")).count(), 2);
    for row in &table.rows {
        let [none, _, physical, equilibrated] = row.outcome.as_ref().unwrap().conditions;
        assert!(none > 1e8 * physical && physical < 1e13, "{none:e} {physical:e}");
        // What no scaling of rows and columns removes: at large steps the tangent is the stiffness of a thin strip.
        let bound = if row.step_size < 2e-4 { 1e6 } else { 1e7 };
        assert!(equilibrated < bound, "{equilibrated:e}");
    }
    assert!(table.figure("").draw().is_ok());
}

#[test]
fn what_cannot_be_studied_is_refused() {
    let request = conditioning::Request { steps: texts(&["0.01"]), ..Default::default() };
    let go_on = |_: usize, _: usize| ControlFlow::Continue(());
    let pendulum = example("pendulum");
    let wrong = conditioning::Request { steps: texts(&["-1"]), ..request.clone() };
    assert!(matches!(conditioning::study(&pendulum, &wrong, &go_on), Err(StudyError::Model(_))));
    let stopped = conditioning::study(&pendulum, &request, &|_, _| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(StudyError::Interrupted)));
    // A run without solution leaves its reason, and the others go on.
    let vary = Some(("analysis.max_iterations".to_owned(), texts(&["1", "25"])));
    let table = conditioning::study(&pendulum, &conditioning::Request { vary, ..request }, &go_on).unwrap();
    assert!(matches!(table.rows[0].outcome, Err(StudyError::Step(_))));
    assert!(table.rows[1].outcome.is_ok());
    assert!(table.csv().contains("\n0.01,1,NaN,NaN,NaN,NaN,failed,NaN\n"), "{}", table.csv());
}

#[test]
fn without_the_augmented_term_elimination_stops_at_the_massless_rotation() {
    // With the penalty of the source's order, for which pivots do not grow.
    let table = factorization::study(&example("tip-crank").with("analysis.penalty", 1)).unwrap();
    assert_eq!(table.cases.len(), 24);
    for case in &table.cases {
        match (&case.outcome, case.augmented || case.solver == "pivoting") {
            (Err(stopped), false) => {
                let known = ["coordinate `L.angle`", "multiplier of joint `G` (rotation 3)"];
                assert!(known.contains(&stopped.unknown.as_str()), "{}", stopped.unknown);
            }
            (Ok(factored), true) => {
                let newton = &factored.newton;
                assert_eq!((newton.iterations, &newton.stopped_at), (15, &None));
                assert!(
                    newton.update < 1e-7 && newton.residual < 1e-4 && newton.violation < 1e-15,
                    "{case:?}"
                );
                assert!(factored.errors_known);
                let pivots = factored.report.relative_pivot();
                if case.scaling == ScaleBy::None {
                    assert!(pivots < 1e-15, "{case:?}");
                } else {
                    assert!(pivots > 1e-10, "{case:?}");
                    assert!(
                        factored.coordinate_error < 1e-7 && factored.multiplier_error < 1e-12,
                        "{case:?}"
                    );
                }
                if case.solver != "pivoting" {
                    assert!(factored.report.growth < 10.0, "{case:?}");
                }
            }
            other => panic!("{:?}, {case:?}", other.1),
        }
    }
    let csv = table.csv();
    assert!(csv.contains("none,false,skyline,false,coordinate `L.angle`,,"), "{csv}");
    assert!(csv.lines().all(|line| line.split(',').count() == 16));
}

#[test]
fn schemes_converge_with_their_orders() {
    let request = convergence::Request {
        schemes: texts(&["generalized-alpha(0.8)", "hht(-0.3)", "radau-iia"]),
        steps: texts(&["2e-2", "1e-2", "5e-3"]),
        reference: ("radau-iia".to_owned(), "5e-4".to_owned()),
        output: "bob".to_owned(),
    };
    let table =
        convergence::study(&example("pendulum"), &request, &|_, _| ControlFlow::Continue(())).unwrap();
    assert_eq!((table.rows.len(), table.instants), (9, 50));
    assert!(!table.is_far_from_reference());
    for (rows, wanted) in table.rows.chunks(3).zip([2.0, 2.0, 3.0]) {
        assert_eq!(rows[0].order, None);
        for row in &rows[1..] {
            assert!((row.order.unwrap() - wanted).abs() < 0.1, "{row:?}");
        }
    }
    // The curves are drawn to the right: finer steps have larger abscissas.
    let figure = table.figure("");
    assert_eq!(figure.curves.len(), 3);
    assert!((figure.curves[0].1[2].0 - 200.0).abs() < 1e-9);
    assert!(figure.draw().is_ok());
}

#[test]
fn a_single_component_can_be_compared() {
    let study = |output: &str| {
        let request = convergence::Request {
            schemes: texts(&["hht(-0.3)"]),
            steps: texts(&["2e-2", "1e-2"]),
            reference: ("radau-iia".to_owned(), "1e-3".to_owned()),
            output: output.to_owned(),
        };
        convergence::study(&example("pendulum"), &request, &|_, _| ControlFlow::Continue(()))
    };
    let [whole, x, y] = ["bob", "bob.x", "bob.y"]
        .map(|output| study(output).unwrap().rows[1].outcome.as_ref().map_or(f64::NAN, |&error| error));
    assert!(x != y && whole > 0.0 && whole <= x.max(y), "{whole:e} {x:e} {y:e}");
    assert!(matches!(study("bob.w"), Err(StudyError::Output { .. })));
}

#[test]
fn errors_are_relative_to_the_reference() {
    // From 0.3 s to 0.35 s, the last instant that whole steps of 0.05 s meet before 0.39 s: the error of one
    // instant, by hand.
    let overrides = [("analysis.start", "0.3"), ("analysis.end", "0.39")]
        .map(|(path, value)| (path.to_owned(), value.to_owned()));
    let request = convergence::Request {
        schemes: texts(&["generalized-alpha(0.8)"]),
        steps: texts(&["0.05"]),
        reference: ("radau-iia".to_owned(), "0.025".to_owned()),
        output: "bob".to_owned(),
    };
    let go_on = |_: usize, _: usize| ControlFlow::Continue(());
    let table =
        convergence::study(&example("pendulum").with_overrides(&overrides), &request, &go_on).unwrap();
    assert_eq!(table.instants, 1);
    assert!((table.end - 0.35).abs() < 1e-12);
    let place = |text: &str, step: &str| {
        let set = [("analysis.end", "0.05"), ("analysis.step", step), ("analysis.tolerance", "1e-10")];
        let set = set.map(|(path, value)| (path.to_owned(), value.to_owned()));
        let record =
            Model::from_text("pendulum", text).with_overrides(&set).session().unwrap().run().unwrap();
        ["x", "y"].map(|axis| *record.column("bob", axis).unwrap().last().unwrap())
    };
    let path = format!("{}/../../examples/pendulum.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let radau = text.replace("spectral_radius = 0.8\n", "").replace("generalized-alpha", "radau-iia");
    let (run, reference) = (place(&text, "0.05"), place(&radau, "0.025"));
    let by_hand = (run[0] - reference[0]).hypot(run[1] - reference[1]) / reference[0].hypot(reference[1]);
    let error = *table.rows[0].outcome.as_ref().unwrap();
    assert!(error > 1e-6 && (error / by_hand - 1.0).abs() < 1e-6, "{error:e} {by_hand:e}");
}

#[test]
fn tiny_steps_leave_reactions_smooth() {
    let request = roundoff::Request { steps: texts(&["1e-3", "1e-5", "1e-7"]), output: "force".to_owned() };
    let go_on = |_: usize, _: usize| ControlFlow::Continue(());
    let table = roundoff::study(&example("pendulum"), &request, &go_on).unwrap();
    let measured: Vec<_> = table.rows.iter().map(|row| *row.outcome.as_ref().unwrap()).collect();
    // At 1 ms the output bends: omega^2 h^2 of about 10 rad^2/s^2.
    assert!(measured[0].noise > 1e-6 && measured[0].noise < 1e-3, "{measured:?}");
    assert!(measured[0].error > 1e-7 && !measured[0].is_doubtful(), "{measured:?}");
    assert!(measured[2].noise < 1e-6 && measured[2].error < 1e-6, "{measured:?}");
    assert_eq!(table.csv().lines().next(), Some("step_size,error,noise"));
    let stopped = roundoff::study(&example("pendulum"), &request, &|_, _| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(StudyError::Interrupted)));
}

/// The largest error of `output` after fifty steps.
fn largest_round_off(model: &str, scheme: &str, output: &str, steps: &[&str]) -> f64 {
    let model = example(model).with("analysis.scheme", scheme);
    let request = roundoff::Request { steps: texts(steps), output: output.to_owned() };
    let table = roundoff::study(&model, &request, &|_, _| ControlFlow::Continue(())).unwrap();
    table.rows.iter().map(|row| row.outcome.as_ref().unwrap().error).fold(0.0, f64::max)
}

#[test]
fn reactions_keep_their_digits_however_small_the_step() {
    let steps = ["1e-5", "1e-6", "1e-7", "1e-8"];
    assert!(largest_round_off("pendulum", "generalized-alpha", "force", &steps) < 1e-8);
    // Two rigid bodies and a beam in space. At 1e-5 s the error is the scheme's.
    assert!(largest_round_off("energy", "radau-iia", "shoulder", &steps[..1]) < 2e-6);
    assert!(largest_round_off("energy", "radau-iia", "shoulder", &steps[1..]) < 1e-8);
}

#[test]
fn one_step_of_any_size_is_solved_to_round_off() {
    // Bounds are a few roundings of the largest forces: a weight, a top's gyroscopic moment, a strip's EA.
    for (model, bound) in [("pendulum", 1e-14), ("top", 2e-11), ("tip-crank", 3e-5)] {
        for step in ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"] {
            let set = [("analysis.step".to_owned(), step.to_owned())];
            let table = factorization::study(&example(model).with_overrides(&set)).unwrap();
            let case = table
                .cases
                .iter()
                .find(|case| case.equilibrated && case.augmented && case.solver == "sparse");
            let newton = &case.unwrap().outcome.as_ref().unwrap().newton;
            assert!(newton.residual < bound && newton.violation < 1e-15, "{model} {step:?} {newton:?}");
        }
    }
}

#[test]
fn one_step_of_a_tenth_of_a_second_is_solved() {
    for model in ["pendulum", "top", "tip-crank"] {
        let step = |path: &str| (path.to_owned(), "0.1".to_owned());
        let mut overrides = vec![step("analysis.step"), step("analysis.end")];
        overrides.push(("analysis.tolerance".to_owned(), "1e-13".to_owned()));
        let mut session = example(model).with_overrides(&overrides).session().unwrap();
        let (_, report) = session.run().unwrap().into_parts();
        // The crank's beam buckles in that time: such a step is divided, down to an eighth. The top turns by 15 rad, and no
        // step may turn by more than a quarter of a turn: it is divided into 16, and longer ones are tried in between.
        let totals = &report.totals;
        let divisions = match model {
            "pendulum" => 0..=0,
            "top" => 4..=8,
            _ => 1..=4,
        };
        assert!(divisions.contains(&totals.rejected_steps), "{model}: {totals:?}");
        assert!(totals.steps <= 1 + 3 * totals.rejected_steps, "{model}: {totals:?}");
        assert!(report.violation < 1e-14, "{model}: {:e}", report.violation);
    }
}

#[test]
fn slopes_are_drawn_within_the_range_of_the_curves() {
    let model = lissom::Model::read(std::path::Path::new(&crate::support::example("pendulum"))).unwrap();
    let texts = |list: &[&str]| list.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
    let request = lissom::analyses::study::convergence::Request {
        schemes: texts(&["radau-iia", "hht(-0.3)"]),
        steps: texts(&["2e-2", "1e-2", "5e-3"]),
        reference: ("radau-iia".to_owned(), "1e-3".to_owned()),
        output: "bob".to_owned(),
    };
    let table =
        lissom::analyses::study::convergence::study(&model.with("analysis.end", 0.2), &request, &|_, _| {
            std::ops::ControlFlow::Continue(())
        });
    let figure = table.unwrap().figure("Pendulum");
    let names: Vec<&str> = figure.guides.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["order 2", "order 3"]);
    for ((_, points), order) in figure.guides.iter().zip([2.0, 3.0]) {
        let slope = (points[1].1 / points[0].1).ln() / (points[1].0 / points[0].0).ln();
        assert!((slope + order).abs() < 1e-9 && points[1].0 <= 200.0 * (1.0 + 1e-9), "{points:?}");
    }
}
