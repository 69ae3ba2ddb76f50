//! Functions of time as they are written in a model file: a number, an expression of `t`, or a table.

use std::sync::Arc;

use lissom_mechanics::registry::Function;

use crate::expression::Formula;
use crate::functions::of_expression;
use crate::functions::table::Extrapolation;
use crate::parts::context::Context;
use crate::text::{Node, Value};

/// The size of a load.
pub(crate) enum Size {
    /// A function of time.
    OfTime(Function),
    /// An expression that names more than the time.
    Signal(Formula),
}

impl Context<'_> {
    /// A number, an expression of time, inputs, signals, states and outputs, or a table of rows.
    pub(crate) fn size(&self, node: &Node, what: &str) -> Option<Size> {
        if let Value::Text(_) = node.value {
            let formula = self.formula(node, what)?;
            if !formula.arguments().is_empty() {
                return Some(Size::Signal(formula));
            }
        }
        self.function(node, what).map(Size::OfTime)
    }

    /// A size from a text alone, where mistakes were reported before.
    pub(crate) fn size_unreported(&self, node: &Node) -> Option<Size> {
        let Value::Text(text) = &node.value else { return None };
        let formula = Formula::parse(text, &self.parameters_of(node.scope)).ok()?;
        let formula = self.in_whole_model(formula, node.scope);
        (!formula.arguments().is_empty()).then_some(Size::Signal(formula))
    }

    /// A number, an expression of `t`, or a table of rows.
    pub(crate) fn function(&self, node: &Node, what: &str) -> Option<Function> {
        let function = match node.value {
            Value::Table(_) => Arc::new(self.read_table(node, what, Extrapolation::Constant)?),
            Value::List(_) | Value::Flag(_) | Value::Date => {
                return self.wrong_type(
                    node,
                    what,
                    "a number, an expression of t, or { table = [[t, value], …] }",
                );
            }
            Value::Number(_) | Value::Text(_) => of_expression(self.expression(node, Some("t"), what)?),
        };
        self.functions.borrow_mut().push((Arc::clone(&function), node.span, what.to_owned()));
        Some(function)
    }

    /// A number, an expression of `variable`, or a table of rows.
    pub(crate) fn function_of(&self, node: &Node, variable: &'static str, what: &str) -> Option<Function> {
        if self.parameters_of(node.scope).contains_key(variable) {
            let message =
                format!("{what} is a function of `{variable}`, which is the name of a parameter too");
            return self.fail(node.span, message, "give the parameter another name");
        }
        match &node.value {
            Value::Table(own) => {
                let table = self.read_table(node, what, Extrapolation::Linear)?;
                Some(Arc::new(if own.contains_key("extrapolation") { table } else { table.bounded() }))
            }
            Value::List(_) | Value::Flag(_) | Value::Date => {
                let wanted = format!(
                    "a number, an expression of {variable}, or {{ table = [[{variable}, value], …] }}"
                );
                self.wrong_type(node, what, &wanted)
            }
            Value::Number(_) | Value::Text(_) => {
                Some(of_expression(self.expression(node, Some(variable), what)?))
            }
        }
    }
}
