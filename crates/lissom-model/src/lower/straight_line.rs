//! A signal that is a straight line over its only argument.

use lissom_mechanics::signals::SignalFunction;

/// A straight line over its argument.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) at_zero: f64,
    pub(super) slope: f64,
}

impl SignalFunction for Line {
    fn value(&self, _: f64, arguments: &[f64], _: &[f64]) -> f64 {
        self.at_zero + self.slope * arguments[0]
    }

    fn gradient(&self, _: f64, _: &[f64], _: &[f64], out: &mut [f64]) {
        out[0] = self.slope;
    }

    fn is_polynomial(&self) -> bool {
        true
    }
}
