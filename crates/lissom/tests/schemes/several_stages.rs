//! What schemes of several stages reach, against one another.

use crate::support::{example, runs};

/// The last position, and the norm of the reaction, of the pendulum after a second.
fn pendulum(scheme: &str, steps: u32) -> [f64; 2] {
    let step = (1.0 / f64::from(steps)).to_string();
    let overrides = [("analysis.scheme", scheme), ("analysis.step", &step), ("analysis.tolerance", "1e-12")];
    let text = std::fs::read_to_string(example("pendulum")).expect("an example");
    let record = runs::run(&text, &overrides);
    let forces = ["f1", "f2"].map(|component| runs::last(&record, "force", component));
    [runs::last(&record, "bob", "x"), forces[0].hypot(forces[1])]
}

/// Errors of two and three stages as the chapter on schemes has them. Reactions are recovered from the positions.
#[test]
fn three_stages_are_of_fifth_order_for_positions_and_reactions() {
    let reference = pendulum("radau-iia-5", 1600);
    let errors = |scheme: &str, steps: u32| {
        let found = pendulum(scheme, steps);
        [0, 1].map(|k| (found[k] - reference[k]).abs())
    };
    let [two, three] = ["radau-iia", "radau-iia-5"].map(|scheme| [25, 50].map(|steps| errors(scheme, steps)));
    println!("two stages {two:?}, three stages {three:?}");
    assert!(two[0][0] > 1e-6 && three[0][0] < 1e-9, "positions: {two:?} {three:?}");
    assert!(three[1][0] < three[0][0] / 20.0, "fifth order of positions: {three:?}");
    for (errors, least) in [(two, 2.7), (three, 4.7)] {
        let order = (errors[0][1] / errors[1][1]).log2();
        assert!(order > least, "order of reactions: {order}");
    }
}
