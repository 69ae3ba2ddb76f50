//! Expressions of one variable, with exact first and second derivatives.
//!
//! The usual precedence holds: `-t^2` is `-(t^2)` and `2^3^2` is `2^(3^2)`. A compiled expression is a flat list
//! of steps on a small stack, run on second-order jets: no allocation in a call. Knows no files.

mod bounds;
mod breakpoints;
mod compile;
mod enclosure;
mod error;
mod formula;
mod jet;
pub(crate) mod noise;
mod number;
mod over_time;
mod program;
mod smoothness;
mod token;

use std::collections::BTreeMap;

use lissom_mechanics::law::{EVERYTHING, Enclosure};

pub(crate) use breakpoints::Line;
pub use error::ExpressionError;
pub use formula::{Formula, Name};
pub(crate) use jet::NAMES as FUNCTION_NAMES;
pub use jet::{Function, Jet};
pub(crate) use over_time::OverTime;
use program::{Step, run};
pub(crate) use smoothness::Kink;

/// A compiled expression of one variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    steps: Vec<Step>,
}

impl Expression {
    /// Reads `text`, in which `variable` (if any) is free and the `parameters` are numbers.
    ///
    /// # Errors
    /// If the text is no expression; with the offending bytes.
    pub fn parse(
        text: &str,
        variable: Option<&str>,
        parameters: &BTreeMap<String, f64>,
    ) -> Result<Self, ExpressionError> {
        compile::compile(text, variable, parameters, None).map(|steps| Self { steps })
    }

    /// Expression with one value everywhere.
    pub(crate) fn of_constant(value: f64) -> Self {
        Self { steps: vec![Step::Constant(value)] }
    }

    /// The value, if it does not depend on the variable.
    pub fn constant(&self) -> Option<f64> {
        match self.steps.as_slice() {
            [Step::Constant(value)] => Some(*value),
            _ => None,
        }
    }

    /// Values of the variable at which the expression is not smooth, as far as they can be determined: where a function that is
    /// not smooth takes an argument that is a straight line of the variable. In ascending order.
    pub fn breakpoints(&self) -> Vec<f64> {
        breakpoints::of(&self.steps, &[]).breakpoints
    }

    /// A value of the variable at which value or slope jump, if one is found; NaN for functions with steps, such as `floor`.
    pub fn first_kink(&self) -> Option<f64> {
        smoothness::first_kink(&self.steps, 0).map(|kink| kink.variable)
    }

    /// Bounds of the value where the variable is between `from` and `to`.
    pub fn bounds(&self, from: f64, to: f64) -> [f64; 2] {
        run(&self.steps, [from, to], |_| EVERYTHING)
    }

    /// Bounds of the value and of both derivatives where the variable is between `from` and `to`.
    pub(crate) fn enclosure(&self, from: f64, to: f64) -> Enclosure {
        run(&self.steps, Enclosure::of_line([from, to], 1.0), |_| Enclosure::of_constant(EVERYTHING))
    }

    /// Value at `x`, without derivatives.
    pub fn value(&self, x: f64) -> f64 {
        run(&self.steps, x, |_| 0.0)
    }

    /// Value and derivatives at `x`.
    pub fn jet(&self, x: f64) -> Jet {
        run(&self.steps, Jet::variable(x), |_| Jet::constant(0.0))
    }
}

/// Words that no parameter may be called.
pub(crate) fn is_reserved(word: &str) -> bool {
    matches!(word, "t" | "s" | "pi") || Function::named(word).is_some()
}

#[cfg(test)]
#[path = "../../tests/unit/expression/mod.rs"]
mod tests;
