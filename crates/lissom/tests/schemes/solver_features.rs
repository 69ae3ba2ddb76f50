//! Optional features of the nonlinear solver change what it costs, not what is found.

use lissom::core::solver_features::WORDS;
use lissom::{Model, SessionError};

/// A driven double pendulum with a soft beam at its end: stiff and nonlinear enough for every feature to act.
const MODEL: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[bodies.arm]
mass = 1
inertia = [0.01, 0.1, 0.1]
position = [0.5, 0, 0]
[joints.shoulder]
kind = "revolute"
base = "ground"
tip = "arm"
at = [0, 0, 0]
axis = [0, 0, 1]
[materials.rubber]
E = 5e6
nu = 0.5
density = 1100
[sections.rod]
shape = "circle"
material = "rubber"
radius = 0.01
[beams.rod]
section = "rod"
from = [1, 0, 0]
to = [1.5, 0, 0]
elements = 4
[joints.wrist]
kind = "spherical"
base = "arm"
tip = "rod.start"
at = [1, 0, 0]
[outputs.end]
kind = "position"
of = "rod.end"
[analysis]
kind = "dynamics"
scheme = "generalized-alpha"
end = 0.5
step = 2e-3
"#;

/// Where the end is at last, and how many iterations that took.
fn end(without: &str) -> ([f64; 3], usize) {
    let overrides = [("analysis.without".to_owned(), without.to_owned())];
    let overrides = if without.is_empty() { &[][..] } else { &overrides[..] };
    let mut session = Model::from_text("model", MODEL)
        .with_overrides(overrides)
        .session()
        .unwrap_or_else(|e| panic!("{e}"));
    let (_, report) = session.run().unwrap().into_parts();
    (
        ["x", "y", "z"].map(|axis| session.value(&format!("end.{axis}")).unwrap()),
        report.totals.newton_iterations,
    )
}

#[test]
fn results_do_not_depend_on_them() {
    let (with_all, fewest) = end("");
    assert!(with_all[1] < -0.5, "{with_all:?}");
    for word in WORDS {
        let (places, iterations) = end(&format!("[\"{word}\"]"));
        for (one, other) in places.iter().zip(with_all) {
            assert!((one - other).abs() < 1e-6, "without {word}: {places:?}, {with_all:?}");
        }
        assert!(iterations >= fewest, "without {word}: {iterations}, {fewest} with all");
        if ["prediction", "secants"].contains(&word) {
            assert!(iterations > fewest, "without {word} nothing has changed");
        }
    }
}

#[test]
fn words_that_mean_nothing_are_refused() {
    let overrides = [("analysis.without".to_owned(), "[\"predicton\"]".to_owned())];
    let Err(SessionError::Model(report)) =
        Model::from_text("model", MODEL).with_overrides(&overrides).session()
    else {
        panic!("there is no such mechanism")
    };
    assert!(report.render(false).contains("prediction"), "{}", report.render(false));
}
