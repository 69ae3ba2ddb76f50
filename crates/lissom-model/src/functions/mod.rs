//! Functions of time for the simulator, from expressions; those from tables are in `table`.
//! Independent of their use and of their form in a file.

mod remembered;
pub mod table;
pub mod table_family;

use std::sync::Arc;

use lissom_mechanics::registry::{Constant, Function, TimeFunction};

use crate::expression::{Expression, Jet};
use remembered::Remembered;

impl TimeFunction for Expression {
    fn value(&self, time: f64) -> f64 {
        Self::value(self, time)
    }
    fn first_derivative(&self, time: f64) -> f64 {
        Self::jet(self, time).first
    }
    fn second_derivative(&self, time: f64) -> f64 {
        Self::jet(self, time).second
    }
    fn jet(&self, time: f64) -> [f64; 3] {
        let Jet { value, first, second } = Self::jet(self, time);
        [value, first, second]
    }
    fn breakpoints(&self) -> Vec<f64> {
        Self::breakpoints(self)
    }
    fn first_kink(&self) -> Option<f64> {
        Self::first_kink(self)
    }
    fn bounds(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        Some(Self::bounds(self, from, to))
    }
    fn curvature(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        Some(self.enclosure(from, to).second)
    }
}

/// An expression as a shared function of time; one that does not depend on time becomes a [`Constant`].
pub(crate) fn of_expression(expression: Expression) -> Function {
    match expression.constant() {
        Some(value) => Arc::new(Constant(value)),
        None => Arc::new(Remembered::new(expression)),
    }
}

/// A constant that grows from nothing, in a straight line from the first time to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Value at the end.
    pub value: f64,
    /// From when to when [s].
    pub span: (f64, f64),
}

impl TimeFunction for Ramp {
    fn value(&self, time: f64) -> f64 {
        let (start, end) = self.span;
        self.value * ((time - start) / (end - start))
    }
    fn first_derivative(&self, _: f64) -> f64 {
        let (start, end) = self.span;
        self.value / (end - start)
    }
    fn second_derivative(&self, _: f64) -> f64 {
        0.0
    }
    fn bounds(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        let [one, other] = [from, to].map(|time| self.value(time));
        Some([one.min(other), one.max(other)])
    }
    fn curvature(&self, _: f64, _: f64) -> Option<[f64; 2]> {
        Some([0.0; 2])
    }
}

#[cfg(test)]
#[path = "../../tests/unit/functions/mod.rs"]
mod tests;
