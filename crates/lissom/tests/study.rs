//! Convergence studies in memory: orders of schemes, and errors against a reference.

use std::ops::ControlFlow;
use std::path::Path;

use lissom::Model;
use lissom::analyses::study::{StudyError, convergence};

fn example(name: &str) -> Model {
    let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Model::read(Path::new(&path)).unwrap()
}

fn texts(words: &[&str]) -> Vec<String> {
    words.iter().map(|&word| word.to_owned()).collect()
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
fn what_cannot_be_studied_is_refused() {
    let pendulum = example("pendulum");
    let request = convergence::Request {
        schemes: texts(&["radau-iia"]),
        steps: texts(&["1e-2"]),
        reference: ("radau-iia".to_owned(), "1e-3".to_owned()),
        output: "bob".to_owned(),
    };
    let go_on = |_: usize, _: usize| ControlFlow::Continue(());
    let wrong = convergence::Request { steps: texts(&["-1"]), ..request.clone() };
    assert!(matches!(convergence::study(&pendulum, &wrong, &go_on), Err(StudyError::Model(_))));
    let stopped = convergence::study(&pendulum, &request, &|_, _| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(StudyError::Interrupted)));
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
