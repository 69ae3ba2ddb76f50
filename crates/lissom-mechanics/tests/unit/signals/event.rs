//! Tests of `signals::event`, a module of it.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;
use crate::signals::measurement::{Component, Gradient, MAX_COMPONENTS, Measurement};
use crate::signals::{Function, MeasurementId, Signal, SignalFunction};

/// A number, and how often it has been measured.
struct Counted(f64, AtomicUsize);

impl Measurement for Counted {
    fn values(&self, _: &Kinematics) -> [f64; MAX_COMPONENTS] {
        self.1.fetch_add(1, Ordering::Relaxed);
        [self.0; MAX_COMPONENTS]
    }
    fn gradient(&self, _: usize, _: &Kinematics) -> Gradient {
        Gradient::zero()
    }
}

#[derive(Debug)]
struct Doubled;

impl SignalFunction for Doubled {
    fn value(&self, _: f64, arguments: &[f64], _: &[f64]) -> f64 {
        2.0 * arguments[0]
    }
    fn gradient(&self, _: f64, _: &[f64], _: &[f64], out: &mut [f64]) {
        out[0] = 2.0;
    }
}

/// The velocity that an event sets is measured at the event alone, and one root does not require those of other events.
#[test]
fn events_evaluate_the_signals_of_their_roots_alone() {
    let counted: Vec<Arc<Counted>> =
        [1.0, -3.0, 5.0].map(|value| Arc::new(Counted(value, AtomicUsize::new(0)))).to_vec();
    let measured = |k: usize| Argument::Measured(MeasurementId::new(k));
    let signal = |argument: Argument| Signal {
        subject: Subject::nameless("a signal"),
        text: String::new(),
        function: Function::Own(Arc::new(Doubled)),
        arguments: vec![argument],
        sampling: None,
    };
    let arguments = [measured(0), Argument::Signal(SignalId::new(0)), measured(1), measured(2)];
    let event = |root: usize| Event {
        name: String::new(),
        root: SignalId::new(root),
        direction: Direction::Falling,
        stops: false,
        sets: vec![(DiscreteValueId::new(0), SignalId::new(3))],
    };
    let mut graph = Graph {
        signals: arguments.map(signal).to_vec(),
        measurements: counted.iter().map(|of| Component { of: of.clone(), component: 0 }).collect(),
        events: vec![event(1), event(2)],
        ..Graph::default()
    };
    let (held, nodes) = (graph.held_at_start(), Vec::new());
    let (coordinates, multipliers) = (Vec::new(), Vec::new());
    let units = Vec::new();
    let at = Kinematics { time: 0.0, elapsed: 0.0, nodes, coordinates, held, multipliers, units };
    let counts = || counted.iter().map(|own| own.1.load(Ordering::Relaxed)).collect::<Vec<_>>();
    let mut found = Vec::new();
    graph.event_values(&at, |value| found.push(value));
    assert_eq!((found, counts()), (vec![4.0, -6.0], vec![1, 1, 0]));
    let mut found = Vec::new();
    graph.event_values_of(&at, &[false, true, false], |index, value| found.push((index, value)));
    assert_eq!((found, counts()), (vec![(1, -6.0)], vec![1, 2, 0]));
}
