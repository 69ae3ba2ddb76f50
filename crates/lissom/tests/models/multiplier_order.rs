//! Multipliers keep second order with steps that change by 1.2 every time, in fast rotation.

use lissom::start::{Lowered, lower};
use lissom_core::simulation::Simulation;
use lissom_model::Document;
use lissom_model::lower::registry::registry;

/// The heavy top of Brüls, Cardona and Arnold [2012].
const TOP: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.top]
mass = 15
inertia = [0.234375, 0.46875, 0.234375]
position = [0, 1, 0]
velocity = [4.61538, 0, 0]
angular_velocity = [0, 150, -4.61538]
[joints.pivot]
kind = "spherical"
base = "ground"
tip = "top"
at = [0, 0, 0]
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;

const SCHEMES: [&[(&str, &str)]; 2] = [
    &[("analysis.scheme", "generalized-alpha"), ("analysis.spectral_radius", "0.8")],
    &[("analysis.scheme", "hht"), ("analysis.alpha", "-0.3")],
];

/// A model with steps of a size that the caller chooses.
fn simulation(text: &str, overrides: &[&[(&str, &str)]]) -> Simulation {
    let own = |&(path, value): &(&str, &str)| (path.to_owned(), value.to_owned());
    let mut all: Vec<(String, String)> = overrides.iter().flat_map(|list| list.iter().map(own)).collect();
    all.push(("analysis.tolerance".to_owned(), "1e-11".to_owned()));
    let document = Document::parse_with(text, "model.toml", &registry(), &all).expect("it is right");
    let Lowered { system, state, settings, .. } = lower(&document).expect("it is right");
    Simulation::new(system, state, settings).expect("it starts")
}

/// Takes pairs of steps, the second 1.2 times as long as the first, and gives the multipliers after every `every`-th pair of
/// the second half.
fn multipliers(mut run: Simulation, size: f64, pairs: usize, every: usize) -> Vec<Vec<f64>> {
    let mut found = Vec::new();
    for pair in 1..=pairs {
        for ratio in [1.0, 1.2] {
            run.set_step_size(ratio * size);
            run.step().expect("it has a solution");
        }
        if 2 * pair >= pairs && pair % every == 0 {
            found.push(run.state().multipliers.clone());
        }
    }
    found
}

fn distance(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Finds the order of the multipliers from pairs of steps of 2.2 `size` [s] and half of that, with one reference of steps an
/// eighth as long.
fn check(name: &str, text: &str, overrides: &[(&str, &str)], size: f64, pairs: usize) {
    for scheme in SCHEMES {
        let run = |parts: usize| {
            let small = size / parts as f64;
            multipliers(simulation(text, &[overrides, scheme]), small, pairs * parts, 4 * parts)
        };
        let [coarse, middle, fine] = [1, 2, 16].map(run);
        let errors = [distance(&coarse, &fine), distance(&middle, &fine)];
        let order = (errors[0] / errors[1]).log2();
        println!("{name}, {}: {errors:?}, order {order:.2}", scheme[0].1);
        assert!((1.8..2.2).contains(&order), "{name}, {}: {errors:?}, order {order}", scheme[0].1);
    }
}

#[test]
fn of_the_heavy_top() {
    check("top", TOP, &[], 5e-5, 400);
}
