//! The number of threads changes times, not results.

use std::fmt::Write;

use lissom::core::system::WORTH_WHILE;
use lissom::start::lower;
use lissom::{Model, Session};

/// A chain of bodies on spherical joints, one more than the number at which a second thread is used.
fn chain() -> String {
    let mut text = String::from(
        "lissom = 1\ngravity = [0, 0, -9.81]\n[analysis]\nkind = \"dynamics\"\nscheme = \"generalized-alpha\"\nend = 0.003\nstep = 1e-3\n",
    );
    for k in 0..=WORTH_WHILE {
        let x = 0.1 * k as f64;
        let base = if k == 0 { "ground".to_owned() } else { format!("b{}", k - 1) };
        writeln!(
            text,
            "[bodies.b{k}]\nmass = 0.2\ninertia = [1e-5, 2e-4, 2e-4]\nposition = [{}, 0, 0]\n\
             [joints.j{k}]\nkind = \"spherical\"\nbase = \"{base}\"\ntip = \"b{k}\"\nat = [{x}, 0, 0]",
            x + 0.05
        )
        .unwrap();
    }
    text
}

#[test]
fn results_are_the_same_to_the_last_bit() {
    let model = Model::from_text("chain", &chain());
    let document = model.document().unwrap_or_else(|report| panic!("{}", report.render(false)));
    let places = [1, 2, 3].map(|threads| {
        let mut lowered = lower(&document).unwrap();
        lowered.settings.threads = threads;
        let mut session = Session::start(lowered).unwrap();
        while !session.is_finished() {
            session.advance().unwrap();
        }
        let state = session.simulation().state();
        let positions: Vec<_> = state.kinematics.nodes.iter().map(|node| node.frame.position).collect();
        (positions, state.multipliers.clone())
    });
    assert!(places[0].0[1].z < -1e-6);
    assert!(places[0] == places[1] && places[0] == places[2]);
}
