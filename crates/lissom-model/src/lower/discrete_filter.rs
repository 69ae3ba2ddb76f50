//! Discrete filters: sampled signals that are a transfer function in z.
//!
//! Past values are sampled signals as well, each the previous sample of the next newer one. They are held values, which
//! snapshots contain.

use std::sync::Arc;

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::ParameterError;
use lissom_mechanics::signals::{Argument, DiscreteValueId, Function, Sampling, Signal, SignalFunction};
use lissom_system::Builder;

use crate::document::DiscreteFilter;

/// A sum of the arguments with constant weights.
#[derive(Debug)]
struct WeightedSum(Vec<f64>);

impl SignalFunction for WeightedSum {
    fn value(&self, _: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.0.iter().zip(arguments).map(|(weight, argument)| weight * argument).sum()
    }

    fn gradient(&self, _: f64, _: &[f64], _: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&self.0);
    }

    fn is_polynomial(&self) -> bool {
        true
    }
}

/// A signal sampled by `sampling` that filters `input`, whose past values are 0 at the start; its own are `start`.
pub(super) fn filtered(
    builder: &mut Builder,
    filter: &DiscreteFilter,
    input: Signal,
    (sampling, start): (Sampling, f64),
) -> Result<Signal, ParameterError> {
    let (subject, text) = (input.subject.clone(), format!("a filter of {}", input.text));
    let mut line = DelayLine { builder, of: Subject::new("signal", &*subject.name), sampling };
    let part = line.of.clone().component("the input");
    let held = line.builder.add_held(&part.to_string(), 0.0);
    let newest = Signal { subject: part, sampling: Some(Sampling { held, ..sampling }), ..input };
    let mut arguments = vec![Argument::Signal(line.builder.add_signal(newest)?)];
    line.push_past(&mut arguments, held, (filter.numerator.len() - 1, 0.0))?;
    line.push_past(&mut arguments, sampling.held, (filter.denominator.len(), start))?;
    let own = filter.denominator.iter().map(|coefficient| -coefficient);
    let weights = filter.numerator.iter().copied().chain(own).collect();
    let function = Function::Own(Arc::new(WeightedSum(weights)));
    Ok(Signal { subject, text, function, arguments, sampling: Some(sampling) })
}

/// Past values of a signal.
struct DelayLine<'b> {
    builder: &'b mut Builder,
    /// Subject of messages.
    of: Subject,
    sampling: Sampling,
}

impl DelayLine<'_> {
    /// Appends the last `count` samples of the held value `newest`, the latest first; `start` before there are so many.
    fn push_past(
        &mut self,
        arguments: &mut Vec<Argument>,
        newest: DiscreteValueId,
        (count, start): (usize, f64),
    ) -> Result<(), ParameterError> {
        let mut held = newest;
        for age in 1..=count {
            arguments.push(Argument::Held(held));
            if age == count {
                break;
            }
            let subject = self.of.clone().component(&format!("past value {age}"));
            let older = self.builder.add_held(&subject.to_string(), start);
            self.builder.add_signal(Signal {
                text: "a previous sample".to_owned(),
                subject,
                function: Function::Own(Arc::new(WeightedSum(vec![1.0]))),
                arguments: vec![Argument::Held(held)],
                sampling: Some(Sampling { held: older, ..self.sampling }),
            })?;
            held = older;
        }
        Ok(())
    }
}
