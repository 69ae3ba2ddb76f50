//! Loads that depend on the motion of their own points: derivatives by motion, states and held values.

use std::sync::Arc;

use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::local_load::{LocalArgument, LocalFunction, LocalFunctions, LocalLoad};
use lissom_mechanics::kinematics::{CarriedFrame, Freedoms, Subject};
use lissom_mechanics::registry::Constant;
use lissom_mechanics::signals::SignalFunction;
use lissom_system::Builder;

use crate::derivatives::check;
use crate::derivatives::configuration::{Configuration, Random};

/// Change of the held value for differences.
const STEP: f64 = 1e-5;

/// sin(a·x + b t), with a different a for every argument.
#[derive(Debug)]
struct Wave(f64);

impl Wave {
    fn factor(&self, index: usize) -> f64 {
        0.3 + self.0 * (index as f64 + 1.0)
    }

    fn angle(&self, time: f64, arguments: &[f64]) -> f64 {
        0.7 * time + arguments.iter().enumerate().map(|(k, x)| self.factor(k) * x).sum::<f64>()
    }
}

impl SignalFunction for Wave {
    fn value(&self, time: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.angle(time, arguments).sin()
    }

    fn gradient(&self, time: f64, arguments: &[f64], _: &[f64], out: &mut [f64]) {
        let slope = self.angle(time, arguments).cos();
        out.iter_mut().enumerate().for_each(|(k, out)| *out = slope * self.factor(k));
    }
}

fn function(seed: f64, arguments: Vec<LocalArgument>) -> LocalFunction {
    let subject = Arc::new(Subject::nameless("wave"));
    LocalFunction { subject, function: Arc::new(Wave(seed)), arguments }
}

#[test]
fn loads_have_the_derivatives_of_their_functions() {
    use LocalArgument::{
        AngularVelocity, Constant as Number, Direction, Displacement, Function, Held, Position, RelativeFlow,
        RelativePosition, State, Velocity,
    };
    // The seventh and eighth are relative to their own node.
    for seed in 1..=8 {
        let (is_global, has_flow) = (seed % 2 == 0, seed % 4 < 3);
        let mut random = Random::new(seed);
        let mut builder = Builder::new();
        let node = builder.add_node("body", random.motion(), Freedoms::Full);
        let other = builder.add_node("hub", random.motion(), Freedoms::Full);
        let held = builder.add_held("wind", 0.4);
        let mut contribution = Contribution::to(builder.model());
        let states =
            (0..2).map(|k| contribution.add_state(format!("state {k}"), 0.1, 1.0)).collect::<Vec<_>>();
        let all = vec![
            function(0.11, vec![Position(2), Position(0), Held(held)]),
            function(0.23, vec![Position(1)]),
            function(0.17, vec![Velocity(0), AngularVelocity(1), Displacement(2)]),
            function(0.31, vec![RelativeFlow(0), RelativeFlow(2), Function(2), Number(0.2)]),
            function(0.13, vec![Function(3), State(0), Velocity(1), Held(held)]),
            function(0.19, vec![Function(2), RelativeFlow(1), AngularVelocity(2), State(1)]),
            function(0.29, vec![Function(4), Velocity(2), Position(1), AngularVelocity(0)]),
            function(0.21, vec![RelativePosition(0), RelativePosition(2), Direction(1), State(0)]),
            function(0.37, vec![Function(7), Direction(0), Direction(2), RelativePosition(1), Held(held)]),
        ];
        let functions = LocalFunctions {
            all,
            flow: if has_flow { [Some(0), None, Some(1)] } else { [None; 3] },
            wrench: [Some(4), Some(5), Some(3), Some(6), Some(8), Some(2)],
            rates: vec![6, if seed > 4 { 7 } else { 5 }],
        };
        let frame = CarriedFrame { node, offset: random.motion() };
        let mut load = LocalLoad::new(
            0,
            (frame, random.vector()),
            (random.motion(), is_global),
            functions,
            states,
            (1.3, Arc::new(Constant(0.8))),
        );
        if seed > 4 {
            let about = CarriedFrame { node: if seed > 6 { node } else { other }, offset: random.motion() };
            load = load.about(about, random.vector());
        }
        builder.add(contribution.with(load));
        let (system, state) = builder.build(0.0).unwrap();
        let name = format!("load {seed}");
        check(&name, &system, &state, 0.4, &mut random);
        let mut here = Configuration::random(&system, &state, 0.4, &mut random);
        let exact = system.input_derivative(held, &here.at);
        let given = here.at.held[held.index()];
        let [after, before] = [STEP, -STEP].map(|step| {
            here.at.held[held.index()] = given + step;
            here.residual(&system, 0.0)
        });
        assert!(exact.iter().any(|value| value.abs() > 0.01), "{name}: {exact:?}");
        for (exact, (after, before)) in exact.iter().zip(after.iter().zip(&before)) {
            let found = (after - before) / (2.0 * STEP);
            assert!((exact - found).abs() < 1e-8, "{name}: by held value {exact}, difference {found}");
        }
    }
}
