//! Loads whose size is a signal, and states: tangents are derivatives through the whole graph of signals.

use std::sync::Arc;

use lissom_mechanics::elements::{Attached, LOADS, SPRINGS};
use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, NodeId, Quantity, SignalId, Subject};
use lissom_mechanics::registry::{Constant, ParameterType, Value};
use lissom_mechanics::signals::coordinate::{self, Coordinate};
use lissom_mechanics::signals::frame_quantity::{FrameQuantity, Of};
use lissom_mechanics::signals::measurement::Component;
use lissom_mechanics::signals::{Argument, Function, Sampling, Signal, SignalFunction};
use lissom_motion::{Motion, Rotation};
use lissom_system::Builder;

use super::configuration::{Configuration, Random, sample_parameters};
use super::ports::{attached, coordinate};
use super::{check, two_bodies};

/// Σ sin(k + argument k), times the cosine of time.
#[derive(Debug)]
struct Waves;

impl SignalFunction for Waves {
    fn value(&self, time: f64, arguments: &[f64], _: &[f64]) -> f64 {
        let sum: f64 = arguments.iter().enumerate().map(|(k, value)| (k as f64 + value).sin()).sum();
        (1.5 + sum) * time.cos()
    }

    fn gradient(&self, time: f64, arguments: &[f64], _: &[f64], out: &mut [f64]) {
        for (k, (out, value)) in out.iter_mut().zip(arguments).enumerate() {
            *out = (k as f64 + value).cos() * time.cos();
        }
    }
}

fn signal(arguments: Vec<Argument>, sampling: Option<Sampling>) -> Signal {
    Signal {
        subject: Subject::new("signal", "waves").called("waves"),
        text: "waves".to_owned(),
        function: Function::Own(Arc::new(Waves)),
        arguments,
        sampling,
    }
}

/// Quantities of frames that signals depend on.
const MEASURED: [Of; 5] = [Of::Position, Of::Velocity, Of::Rotation, Of::AngularVelocity, Of::Distance];

/// Signals of everything that can be measured, one upon the other; the last one.
fn graph(builder: &mut Builder, nodes: [NodeId; 2], own: CoordinateId, random: &mut Random) -> SignalId {
    let held = builder.add_held("input", 0.3);
    let sample = builder.add_held("sample", -0.2);
    let state = builder.add_state("state", 0.4, 1.0);
    let mut frame = |node| CarriedFrame {
        node,
        offset: Motion::new(Rotation::exponential(&random.vector()), random.vector()),
    };
    let observers = [None, Some(frame(nodes[1]))];
    let axes = [None, Some(frame(nodes[0]))];
    let [one, other] = [frame(nodes[0]), frame(nodes[1])];
    let start = Motion::exponential(&random.screw());
    let mut measured = vec![
        builder.add_measurement(Coordinate::new(own, coordinate::Of::Value)),
        builder.add_measurement(Coordinate::new(own, coordinate::Of::Rate)),
        builder.add_measurement(Coordinate::new(state, coordinate::Of::Value)),
    ];
    for (index, &of) in MEASURED.iter().enumerate() {
        let observer = observers[index % 2];
        let own = if index % 3 == 0 { other } else { one };
        let of = Arc::new(FrameQuantity::new(of, own, observer, axes[index / 2 % 2], start));
        measured.push(builder.add_component(Component { of, component: index % 3 }));
    }
    let measured: Vec<Argument> = measured.into_iter().map(Argument::Measured).collect();
    let mut add = |arguments, sampling| builder.add_signal(signal(arguments, sampling)).expect("valid");
    let sampled = add(vec![measured[3]], Some(Sampling { held: sample, period: 0.1 }));
    let first = add(vec![measured[0], measured[4], Argument::Held(held)], None);
    let second = add([&[Argument::Signal(first), Argument::Signal(sampled)], &measured[..]].concat(), None);
    let last = add(vec![Argument::Signal(second), Argument::Signal(first), measured[5]], None);
    builder.drive_state(state, last);
    last
}

#[test]
fn sizes_that_are_signals() {
    for (seed, kind) in SPRINGS.iter().chain(LOADS).enumerate() {
        let Some(size) = kind.parameters.iter().find(|own| own.holds == ParameterType::Size) else {
            continue;
        };
        for flag in [false, true] {
            let mut random = Random::new(seed as u64 + 70);
            let (mut builder, nodes) = two_bodies(&mut random);
            let wanted = kind.ports.quantity();
            let own = coordinate(&mut builder, nodes, wanted.unwrap_or(Quantity::Angle), &mut random);
            let attached = match wanted {
                Some(_) => Attached::to_coordinates([own]),
                None => attached(&mut builder, kind, nodes, &mut random),
            };
            let last = graph(&mut builder, nodes, own, &mut random);
            let parameters = sample_parameters(kind.parameters, flag, &mut random)
                .with(size.name, Value::Function(Arc::new(Constant(1.0))));
            let load = kind.contribution(builder.model(), attached, &parameters).expect("valid");
            builder.add_driven(last, load);
            let (system, state) = builder.build(0.0).expect("valid");
            check(kind.name, &system, &state, 0.4, &mut random);
        }
    }
}

/// What a signal multiplies must be in proportion to the size: a load of size 2 is twice that of size 1.
#[test]
fn loads_are_in_proportion_to_their_size() {
    for (seed, kind) in SPRINGS.iter().chain(LOADS).enumerate() {
        let Some(size) = kind.parameters.iter().find(|own| own.holds == ParameterType::Size) else {
            continue;
        };
        let forces = |factor: f64| {
            let mut random = Random::new(seed as u64 + 90);
            let (mut builder, nodes) = two_bodies(&mut random);
            let attached = attached(&mut builder, kind, nodes, &mut random);
            let parameters =
                sample_parameters(kind.parameters, false, &mut random).with(size.name, Value::Number(factor));
            builder.add_of_kind(kind, attached, &parameters).expect("valid");
            let (system, state) = builder.build(0.0).expect("valid");
            let mut here = Configuration::random(&system, &state, 0.4, &mut random);
            here.multipliers.fill(0.0);
            here.residual(&system, 0.0)
        };
        let count = 12;
        let [none, once, twice] = [0.0, 1.0, 2.0].map(forces);
        for row in 0..count {
            let (one, two) = (once[row] - none[row], twice[row] - none[row]);
            assert!((two - 2.0 * one).abs() < 1e-13 * (1.0 + two.abs()), "{}: {one} {two}", kind.name);
            assert!(none[row].abs() < 1e-14, "{}: without size there is no force", kind.name);
        }
    }
}
