//! Expressions of components of other outputs.

use lissom_mechanics::signals::SignalFunction;
use lissom_system::OutputDerivatives;

use super::derivatives::add_scaled;
use super::{Build, Evaluation, OutputQuantity};
use crate::expression::Formula;
use crate::outputs::channels::Channel;
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const EXPRESSION: Declaration = Declaration {
    word: "expression",
    summary: "Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and states.",
    subject: Subject::Expression,
    features: &[Feature::Unit, Feature::Fatigue],
    components: &[("value", "")],
    build: Build::Expression,
};
/// A formula of components of channels.
pub(crate) struct Expression {
    pub(crate) formula: Formula,
    pub(crate) arguments: Vec<(Channel, usize)>,
}

impl Expression {
    fn values(&self, at: &Evaluation<'_>) -> Vec<f64> {
        let mut values = Vec::new();
        let value = |(channel, index): &(Channel, usize)| {
            values.clear();
            channel.evaluate(at.system, at.state, &mut values);
            values.get(*index).copied().unwrap_or(f64::NAN)
        };
        self.arguments.iter().map(value).collect()
    }
}

impl OutputQuantity for Expression {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        out.push(self.formula.value(at.motion().time, &self.values(at), &[]));
    }

    /// By the chain rule.
    fn derivatives(&self, at: &Evaluation<'_>, length: f64) -> Option<Vec<OutputDerivatives>> {
        let values = self.values(at);
        let mut gradient = vec![0.0; values.len()];
        self.formula.gradient(at.motion().time, &values, &[], &mut gradient);
        let mut own = OutputDerivatives::default();
        for ((channel, index), factor) in self.arguments.iter().zip(gradient) {
            let all = channel.derivatives_at(at.system, at.state, length)?;
            add_scaled(&mut own, all.get(*index)?, factor);
        }
        Some(vec![own])
    }

    fn arguments(&self) -> &[(Channel, usize)] {
        &self.arguments
    }
}
