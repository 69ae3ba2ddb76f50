//! Functions of time as they are written in a model file: a number, an expression of `t`, or a table.

use std::sync::Arc;

use lissom_core::registry::Function;

use crate::context::Context;
use crate::expression::Formula;
use crate::functions::{Interpolation, Table, TableError, of_expression};
use crate::keys::{Key, Shape, choice, optional, required};
use crate::reader::Reader;
use crate::text::{Node, Value};

/// Keys of a function given by a table.
pub(crate) fn table_keys() -> Vec<Key> {
    vec![
        required("table", Shape::Rows, "", "rows [t, value] in order of time"),
        optional("interpolation", choice(&["linear", "spline"]), "", "between the rows, default linear"),
    ]
}

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

    /// The same of a text alone, where mistakes were told before.
    pub(crate) fn size_untold(&self, node: &Node) -> Option<Size> {
        let Value::Text(text) = &node.value else { return None };
        let formula = Formula::parse(text, &self.parameters.borrow()).ok()?;
        (!formula.arguments().is_empty()).then_some(Size::Signal(formula))
    }

    /// A number, an expression of `t`, or a table of rows.
    pub(crate) fn function(&self, node: &Node, what: &str) -> Option<Function> {
        let function = match node.value {
            Value::Table(_) => self.table_function(node, what)?,
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

    fn table_function(&self, node: &Node, what: &str) -> Option<Function> {
        let reader = Reader::open(self, node, (what.to_owned(), node.span), table_keys())?;
        let interpolation = match reader.choice("interpolation") {
            Some(word) if word.value == "spline" => Interpolation::Spline,
            _ => Interpolation::Linear,
        };
        let table = reader.node("table")?;
        let Value::List(rows) = &table.value else {
            return self.wrong_type(table, what, "a list of rows [t, value]");
        };
        let row = |row: &Node| self.numbers::<2>(row, &format!("each row of {what}")).map(|[t, v]| (t, v));
        let read: Vec<Option<(f64, f64)>> = rows.iter().map(row).collect();
        let read: Vec<(f64, f64)> = read.into_iter().collect::<Option<_>>()?;
        match Table::new(&read, interpolation) {
            Ok(table) => Some(Arc::new(table)),
            Err(error) => {
                let place = match error {
                    TableError::NotAscending(row) => rows.get(row + 1).map_or(table.span, |row| row.span),
                    TableError::TooShort => table.span,
                };
                let message = format!("{what} is no function: {error}");
                self.fail(place, message, "give rows [t, value] in order of time")
            }
        }
    }
}
