//! Expressions of time and of named quantities, with exact derivatives by each of them.

use std::collections::BTreeMap;
use std::ops::Range;

use lissom_mechanics::kinematics::Switch;
use lissom_mechanics::law::{Enclosure, Interval};
use lissom_mechanics::signals::SignalFunction;

use super::breakpoints::{Course, Line};
use super::compile::{compile, fold};
use super::error::ExpressionError;
use super::jet::{Function, Jet};
use super::program::{Step, run, run_continued};
use super::smoothness::{self, Kink};
use super::{Expression, breakpoints};

/// A name in an expression that is no parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The name, such as `tip.u1`.
    pub text: String,
    /// Where it is first in the expression.
    pub range: Range<usize>,
}

/// A compiled expression of the time `t` and of named quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    steps: Vec<Step>,
    arguments: Vec<Name>,
    text: String,
}

impl Formula {
    /// Reads `text`, in which `parameters` are numbers and all other names are arguments.
    ///
    /// # Errors
    /// If the text is no expression; with the offending bytes.
    pub fn parse(text: &str, parameters: &BTreeMap<String, f64>) -> Result<Self, ExpressionError> {
        let mut arguments = Vec::new();
        let steps = compile(text, Some("t"), parameters, Some(&mut arguments))?;
        Ok(Self { steps, arguments, text: text.to_owned() })
    }

    /// Formula with one value at all times.
    pub(crate) fn of_constant(value: f64) -> Self {
        Self { steps: vec![Step::Constant(value)], arguments: Vec::new(), text: value.to_string() }
    }

    /// Gives names other texts; two that become the same stay two arguments of the same value.
    pub(crate) fn rename(&mut self, change: &dyn Fn(&str) -> String) {
        for name in &mut self.arguments {
            name.text = change(&name.text);
        }
    }

    /// The names it depends on, each once, in the order of the arguments.
    pub fn arguments(&self) -> &[Name] {
        &self.arguments
    }

    /// Whether it names the time.
    pub(crate) fn depends_on_time(&self) -> bool {
        self.steps.contains(&Step::Variable)
    }

    /// The expression of time alone that is left where the arguments are these numbers, one for each.
    pub(crate) fn with_arguments(&self, arguments: &[f64]) -> Expression {
        let number = |step: &Step| match *step {
            Step::Argument(index) => Step::Constant(arguments[index]),
            other => other,
        };
        Expression { steps: fold(self.steps.iter().map(number).collect()) }
    }

    /// Values of an argument at which it is known not to be smooth while other arguments are 0, in ascending order.
    pub(crate) fn breakpoints_of(&self, argument: usize) -> Vec<f64> {
        let alone: Vec<Step> = (self.steps.iter())
            .map(|step| match *step {
                Step::Argument(index) if index == argument => Step::Variable,
                Step::Argument(_) | Step::Variable => Step::Constant(0.0),
                other => other,
            })
            .collect();
        breakpoints::of(&alone, &[]).breakpoints
    }

    /// Whether it neither oscillates nor has kinks elsewhere than at its [`breakpoints_of`](Self::breakpoints_of) an argument.
    pub(crate) fn is_integrable(&self, argument: usize) -> bool {
        let oscillates =
            |step: &Step| matches!(step, Step::Call(Function::Sin | Function::Cos | Function::Tan));
        let mut lines: Vec<Line> = vec![None; self.arguments.len()];
        lines[argument] = Some((0.0, 1.0));
        !self.steps.iter().any(oscillates) && self.course(&lines).are_known.iter().all(|is_known| *is_known)
    }

    /// Where value or gradient jump, if such an instant is found.
    pub(crate) fn first_kink(&self) -> Option<Kink> {
        smoothness::first_kink(&self.steps, self.arguments.len())
    }

    /// What is known of it over time, where arguments are these lines, one for each.
    pub(super) fn course(&self, arguments: &[Line]) -> Course {
        breakpoints::of(&self.steps, arguments)
    }

    /// Passes its switching functions to `visit`, in their order.
    pub(crate) fn visit_switches(
        &self,
        time: f64,
        arguments: &[f64],
        sides: &[f64],
        visit: impl FnMut(Switch),
    ) {
        run_continued(&self.steps, time, |index| arguments[index], sides, visit);
    }

    /// The expression as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

impl Formula {
    /// Value, and first and second derivative along a direction: `time` and `argument` give values and the direction's
    /// components.
    pub fn jet(&self, time: (f64, f64), argument: impl Fn(usize) -> (f64, f64)) -> [f64; 3] {
        let along = |(value, first): (f64, f64)| Jet { value, first, second: 0.0 };
        let Jet { value, first, second } = run(&self.steps, along(time), |index| along(argument(index)));
        [value, first, second]
    }
}

impl SignalFunction for Formula {
    fn value(&self, time: f64, arguments: &[f64], sides: &[f64]) -> f64 {
        if sides.is_empty() {
            return run(&self.steps, time, |index| arguments[index]);
        }
        run_continued(&self.steps, time, |index| arguments[index], sides, |_| ())
    }

    fn gradient(&self, time: f64, arguments: &[f64], sides: &[f64], out: &mut [f64]) {
        for (wanted, derivative) in out.iter_mut().enumerate() {
            let of = |index: usize| {
                let value = arguments[index];
                if index == wanted { Jet::variable(value) } else { Jet::constant(value) }
            };
            *derivative = run_continued(&self.steps, Jet::constant(time), of, sides, |_| ()).first;
        }
    }

    fn is_polynomial(&self) -> bool {
        let is_number = |step: Option<&Step>| matches!(step, Some(Step::Constant(_)));
        self.steps.iter().enumerate().all(|(k, step)| match step {
            Step::Call(_) | Step::Call2(_) | Step::Call3(_) => false,
            Step::Divide => is_number(self.steps.get(k.wrapping_sub(1))),
            Step::Power => self.steps.get(k.wrapping_sub(1)) == Some(&Step::Constant(2.0)),
            _ => true,
        })
    }

    fn bounds(&self, time: Interval, arguments: &[Interval]) -> Option<Interval> {
        Some(run(&self.steps, time, |index| arguments[index]))
    }

    fn enclosure(&self, time: &Enclosure, arguments: &[Enclosure]) -> Option<Enclosure> {
        Some(run(&self.steps, *time, |index| arguments[index]))
    }

    fn switch_count(&self) -> usize {
        let of = |step: &Step| match step {
            Step::Call(function) | Step::Call2(function) | Step::Call3(function) => {
                breakpoints::switch_count(*function)
            }
            _ => 0,
        };
        self.steps.iter().map(of).sum()
    }

    fn switches(&self, time: f64, arguments: &[f64], sides: &[f64], out: &mut Vec<Switch>) {
        self.visit_switches(time, arguments, sides, |value| out.push(value));
    }
}

#[cfg(test)]
#[path = "../../tests/unit/expression/formula.rs"]
mod tests;
