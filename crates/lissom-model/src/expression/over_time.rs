//! A formula in the graph of signals, with the times of its kinks that are known before they are met: those of its parts that
//! depend on time alone.

use lissom_mechanics::kinematics::Switch;
use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::signals::SignalFunction;

use super::breakpoints::{Course, Line};
use super::formula::Formula;

/// A formula, and what is known of it over time.
#[derive(Debug)]
pub(crate) struct OverTime {
    formula: Formula,
    course: Course,
}

impl OverTime {
    /// A formula whose arguments are these straight lines of time, none for what depends on more than time.
    pub(crate) fn new(formula: Formula, arguments: &[Line]) -> Self {
        let course = formula.course(arguments);
        Self { formula, course }
    }

    /// The straight line of time that it is.
    pub(crate) fn line(&self) -> Line {
        self.course.line
    }
}

impl SignalFunction for OverTime {
    fn value(&self, time: f64, arguments: &[f64], sides: &[f64]) -> f64 {
        self.formula.value(time, arguments, sides)
    }

    fn gradient(&self, time: f64, arguments: &[f64], sides: &[f64], out: &mut [f64]) {
        self.formula.gradient(time, arguments, sides, out);
    }

    fn is_polynomial(&self) -> bool {
        self.formula.is_polynomial()
    }

    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval> {
        self.formula.bounds(time, arguments)
    }

    fn enclosure(&self, time: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        self.formula.enclosure(time, arguments)
    }

    fn switch_count(&self) -> usize {
        self.formula.switch_count()
    }

    fn switches(&self, time: f64, arguments: &[f64], sides: &[f64], out: &mut Vec<Switch>) {
        let first = out.len();
        self.formula.switches(time, arguments, sides, out);
        for (value, is_known) in out[first..].iter_mut().zip(&self.course.are_known) {
            if *is_known {
                *value = 0.0.into();
            }
        }
    }

    fn breakpoints(&self) -> &[f64] {
        &self.course.breakpoints
    }
}

#[cfg(test)]
#[path = "../../tests/unit/expression/over_time.rs"]
mod tests;
