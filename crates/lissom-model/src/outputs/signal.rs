//! Values of signals, inputs and states.

use std::sync::Arc;

use lissom_mechanics::kinematics::Kinematics;
use lissom_mechanics::signals::Argument;
use lissom_system::OutputDerivatives;
use lissom_system::System;

use super::derivatives::add_argument;
use super::frames::name_of;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const SIGNAL: Declaration = Declaration {
    word: "signal",
    summary: "Value of a signal, an input or a state.",
    subject: Subject::Signal,
    features: &[Feature::Unit, Feature::Fatigue],
    components: &[("value", "")],
    build: Build::Motion(quantity),
};
/// The value of an argument of signals.
pub(crate) struct SignalValue(pub(crate) Argument);

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let unknown = || Problem::error(name.span, format!("there is no signal called `{}`", name.value));
    let argument = *subjects.names.signals.get(&name.value).ok_or_else(unknown)?;
    Ok(Arc::new(SignalValue(argument)))
}

/// Value of a signal, an input or a state.
pub fn signal_value(system: &System, at: &Kinematics, argument: Argument) -> f64 {
    match argument {
        Argument::Held(held) => at.held[held.index()],
        Argument::Signal(signal) => system.signals().value(signal, at),
        Argument::Measured(measurement) => system.signals().measured(measurement, at),
    }
}

impl OutputQuantity for SignalValue {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(signal_value(at.system, at.motion(), self.0));
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let mut own = OutputDerivatives::default();
        add_argument(&mut own, 1.0, self.0, at.system, at.motion());
        Some(vec![own])
    }
}
