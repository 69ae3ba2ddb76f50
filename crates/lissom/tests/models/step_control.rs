//! Steps of changing size: chosen by their error, or given. References are runs with far smaller steps of one size.

use lissom::start::{Lowered, lower};
use lissom_core::simulation::Simulation;
use lissom_core::system::State;
use lissom_model::Document;
use lissom_model::lower::registry::registry;

const PENDULUM: &str = r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.arm]
mass = 1.3
inertia = [0.02, 0.05, 0.04]
position = [0.4, 0.1, 0]
[bodies.tip]
mass = 0.4
inertia = [0.001, 0.002, 0.003]
position = [0.9, 0.1, 0.1]
[joints.base]
kind = "spherical"
base = "ground"
tip = "arm"
at = [0, 0, 0]
[joints.elbow]
kind = "revolute"
base = "arm"
tip = "tip"
at = [0.8, 0.1, 0]
axis = [0, 1, 0]
[analysis]
kind = "dynamics"
"#;

fn simulation(analysis: &str) -> Simulation {
    simulation_of(&format!("{PENDULUM}{analysis}"))
}

fn simulation_of(text: &str) -> Simulation {
    let document = Document::parse(text, "model.toml", &registry()).expect("it is right");
    let Lowered { system, state, settings, .. } = lower(&document).expect("it is right");
    Simulation::new(system, state, settings).expect("it starts")
}

fn run_to(simulation: &mut Simulation, end: f64) {
    while simulation.state().kinematics.time < end {
        simulation.step_watched(end, &mut lissom_core::settings::Unwatched).expect("it has a solution");
    }
}

fn distance(a: &State, b: &State) -> f64 {
    let nodes = a.kinematics.nodes.iter().zip(&b.kinematics.nodes);
    nodes.map(|(a, b)| (a.frame.position - b.frame.position).norm()).fold(0.0, f64::max)
}

fn reference() -> State {
    let mut fine = simulation("scheme = \"radau-iia\"\nend = 1\nstep = 2e-4\ntolerance = 1e-12\n");
    for _ in 0..5000 {
        fine.step().expect("it has a solution");
    }
    fine.state().clone()
}

#[test]
fn errors_follow_the_tolerance_with_every_scheme() {
    let exact = reference();
    for scheme in ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "energy-decaying"] {
        let mut errors = Vec::new();
        for tolerance in [1e-4, 1e-5, 1e-6] {
            let mut controlled = simulation(&format!(
                "scheme = \"{scheme}\"\nend = 1\nstep = 1e-3\nrelative_tolerance = {tolerance:e}\n"
            ));
            run_to(&mut controlled, 1.0);
            assert_eq!(controlled.state().kinematics.time, 1.0, "{scheme}");
            let error = distance(controlled.state(), &exact);
            println!(
                "{scheme} {tolerance:.0e}: {error:.1e} in {} steps, {} rejected",
                controlled.totals().steps,
                controlled.totals().rejected_steps
            );
            assert!(error < 30.0 * tolerance, "{scheme} {tolerance}: {error}");
            errors.push(error);
        }
        assert!(errors[2] < 0.2 * errors[0], "{scheme}: {errors:?}");
    }
}

/// A model, the time between two looks at its multipliers [s], how often they are looked at after a first time that does not
/// count, and the longer of two step sizes [s].
struct Changing {
    name: &'static str,
    model: String,
    between: f64,
    looks: [usize; 2],
    step: f64,
    /// Steps of the reference between two looks.
    fine: usize,
}

impl Changing {
    fn of_file(name: &'static str, between: f64, looks: [usize; 2], step: f64, fine: usize) -> Self {
        let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect("the example is there");
        let (model, _) = text.split_once("[analysis]").expect("it has an analysis");
        let model = format!("{model}[analysis]\nkind = \"dynamics\"\n");
        Self { name, model, between, looks, step, fine }
    }

    fn run(&self, scheme: &str, step: f64, tolerance: f64) -> Simulation {
        let analysis = format!("{scheme}end = 1\nstep = {step:e}\ntolerance = {tolerance:e}\n");
        simulation_of(&format!("{}{analysis}", self.model))
    }

    fn exact(&self) -> Vec<(f64, Vec<f64>)> {
        let step = self.between / self.fine as f64;
        let mut fine = self.run("scheme = \"generalized-alpha\"\n", step, 1e-12);
        let mut exact = Vec::new();
        for look in 1..=self.looks[1] {
            (0..self.fine).for_each(|_| fine.step().map(|_| ()).expect("it has a solution"));
            exact.push((look as f64 * self.between, fine.state().multipliers.clone()));
        }
        exact.split_off(self.looks[0])
    }

    /// Largest error of the multipliers, with steps that are 1.2 times as long every other time.
    fn error(&self, scheme: &str, step: f64, exact: &[(f64, Vec<f64>)]) -> f64 {
        let mut run = self.run(scheme, step, 1e-11);
        let mut worst = 0.0_f64;
        for (time, multipliers) in exact {
            while run.state().kinematics.time < time - 1e-9 {
                for ratio in [1.0, 1.2] {
                    run.set_step_size(ratio * step);
                    run.step().expect("it has a solution");
                }
            }
            assert!((run.state().kinematics.time - time).abs() < 1e-9);
            let pairs = run.state().multipliers.iter().zip(multipliers);
            worst = pairs.map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
        }
        worst
    }
}

#[test]
fn multipliers_keep_second_order_when_steps_change() {
    let pendulum = Changing {
        name: "pendulum",
        model: PENDULUM.to_owned(),
        between: 0.022,
        looks: [9, 20],
        step: 5e-4,
        fine: 880,
    };
    let top = Changing::of_file("top", 0.0022, [9, 20], 1e-4, 440);
    let crank = Changing::of_file("tip-crank", 0.0011, [2, 6], 5e-6, 1760);
    for model in [pendulum, top, crank] {
        let exact = model.exact();
        for scheme in ["scheme = \"generalized-alpha\"\n", "scheme = \"hht\"\nalpha = -0.3\n"] {
            let errors = [1.0, 0.5].map(|part| model.error(scheme, part * model.step, &exact));
            let order = (errors[0] / errors[1]).log2();
            println!("{}, {scheme}: {errors:?}, order {order:.2}", model.name);
            assert!((1.8..2.2).contains(&order), "{}, {scheme}: {errors:?}, order {order}", model.name);
        }
    }
}

#[test]
fn values_within_a_step_are_of_the_scheme_s_order() {
    let mut fine = simulation("scheme = \"radau-iia\"\nend = 1\nstep = 1e-3\n");
    for _ in 0..87 {
        fine.step().expect("it has a solution");
    }
    let error = |step: f64| {
        let mut coarse = simulation(&format!("scheme = \"radau-iia\"\nend = 1\nstep = {step}\n"));
        while coarse.state().kinematics.time < 0.087 {
            coarse.step().expect("it has a solution");
        }
        let mut between = coarse.state().clone();
        coarse.interpolate(coarse.state().kinematics.time, &mut between);
        assert!(distance(&between, coarse.state()) < 1e-14);
        coarse.interpolate(0.087, &mut between);
        assert_eq!(between.kinematics.time, 0.087);
        distance(&between, fine.state())
    };
    // 0.087 s lies in the middle of a step of either size.
    let order = (error(0.058) / error(0.029 * 2.0 / 3.0)).ln() / 3.0_f64.ln();
    assert!(order > 2.7, "{order}");
}

#[test]
fn steps_end_where_loads_have_kinks() {
    // A mass under a force that sets in at 0.3333 s and is doubled, by a table, at 0.7 s.
    let text = r#"
        lissom = 1
        [point_masses.m]
        mass = 2
        [loads.on]
        kind = "force"
        on = "m"
        vector = [1, 0, 0]
        scale = "step(t - 0.3333)"
        [loads.more]
        kind = "force"
        on = "m"
        vector = [1, 0, 0]
        scale = { table = [[0, 0], [0.7, 0], [1, 0.3]] }
        [analysis]
        kind = "dynamics"
        scheme = "radau-iia"
        end = 1
        relative_tolerance = 1e-3
        max_step = 0.3
    "#;
    let document = Document::parse(text, "kinks.toml", &registry()).expect("it is right");
    let Lowered { system, state, settings, .. } = lower(&document).expect("it is right");
    let mut simulation = Simulation::new(system, state, settings).expect("it starts");
    let mut times = Vec::new();
    while simulation.state().kinematics.time < 1.0 {
        simulation.step_watched(1.0, &mut lissom_core::settings::Unwatched).expect("it has a solution");
        times.push(simulation.state().kinematics.time);
    }
    // Behind the jump, and before the kink.
    assert!(times.contains(&0.3333) && times.contains(&0.7_f64.next_down()), "{times:?}");
    // The motion between kinks is a polynomial that the scheme has exactly.
    let place = simulation.state().kinematics.nodes[1].frame.position.x;
    let impulse = [(1.0_f64 - 0.3333).powi(2) / 2.0, 0.3_f64.powi(3) / 6.0];
    let exact = impulse.iter().sum::<f64>() / 2.0;
    assert!((place - exact).abs() < 1e-9, "{place} {exact} {times:?}");
}
