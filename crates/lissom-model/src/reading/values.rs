//! Conversion of TOML values to numbers, vectors, matrices and expressions, with errors that state what was
//! expected. A number may also be a text: an expression of the parameters.

use lissom_motion::{Matrix3, Matrix6, Vector3, Vector6};
use nalgebra::{DMatrix, DVector};

use crate::expression::{Expression, ExpressionError, Formula};
use crate::parts::context::Context;
use crate::text::report::Problem;
use crate::text::{Node, Value};

/// A value's type, in words.
pub(crate) fn type_of(node: &Node) -> &'static str {
    match &node.value {
        Value::Text(_) => "a text",
        Value::Number(_) => "a number",
        Value::Flag(_) => "true or false",
        Value::Date => "a date",
        Value::List(_) => "a list",
        Value::Table(_) => "a table",
    }
}

/// Largest component of a vector: products of three of them are finite.
const MAX_COMPONENT: f64 = 1e100;

impl Context<'_> {
    /// Reports that `what` must be `wanted` but is of another type.
    pub(crate) fn wrong_type<T>(&self, node: &Node, what: &str, wanted: &str) -> Option<T> {
        let found = type_of(node);
        let problem = Problem::error(node.span, format!("{what} must be {wanted}, not {found}"));
        let example = if wanted == "a list of 3 numbers" { ", such as [0, 0, -9.81]" } else { "" };
        self.report(problem.label(format!("this is {found}")).help(format!("write {wanted}{example}")));
        None
    }

    /// A finite number.
    pub(crate) fn number(&self, node: &Node, what: &str) -> Option<f64> {
        let value = match &node.value {
            Value::Number(number) => *number,
            Value::Text(_) => self.expression(node, None, what)?.jet(0.0).value,
            _ => return self.wrong_type(node, what, "a number"),
        };
        if value.is_finite() {
            return Some(value);
        }
        let problem = Problem::error(node.span, format!("{what} must be a finite number"));
        self.report(problem.label("not finite").help("a double-precision number is at most 1.8e308"));
        None
    }

    /// An expression of `variable`, or of the parameters alone.
    pub(crate) fn expression(&self, node: &Node, variable: Option<&str>, what: &str) -> Option<Expression> {
        let Value::Text(text) = &node.value else {
            return self.number(node, what).map(Expression::of_constant);
        };
        match Expression::parse(text, variable, &self.parameters_of(node.scope)) {
            Ok(expression) => Some(expression),
            Err(error) => {
                self.report(self.expression_problem(node, text, &error, what));
                None
            }
        }
    }

    /// An expression of time and of named quantities of the model.
    pub(crate) fn formula(&self, node: &Node, what: &str) -> Option<Formula> {
        self.own_formula(node, what).map(|formula| self.in_whole_model(formula, node.scope))
    }

    /// An expression of time and of quantities whose names are its own.
    pub(crate) fn own_formula(&self, node: &Node, what: &str) -> Option<Formula> {
        let Value::Text(text) = &node.value else {
            return self.number(node, what).map(Formula::of_constant);
        };
        let parsed = Formula::parse(text, &self.parameters_of(node.scope));
        match parsed {
            Ok(formula) => Some(formula),
            Err(error) => {
                self.report(self.expression_problem(node, text, &error, what));
                None
            }
        }
    }

    /// Underlines the offending bytes, where the text is in the file as it is read.
    fn expression_problem(&self, node: &Node, text: &str, error: &ExpressionError, what: &str) -> Problem {
        let place = self.sources.within(node.span, text, &error.range);
        Problem::error(place, format!("{what} cannot be read: {error}"))
            .label("here")
            .help("expressions consist of numbers, + - * / ^ ( ), pi, [parameters] and functions such as sin(x)")
            .maybe_help(error.help.clone())
    }

    /// A list of exactly `length` values, each read by `read`.
    pub(crate) fn list<'n>(&self, node: &'n Node, length: usize, what: &str) -> Option<&'n [Node]> {
        let Value::List(array) = &node.value else {
            return self.wrong_type(node, what, &format!("a list of {length} numbers"));
        };
        if array.len() == length {
            return Some(array);
        }
        let message = format!("{what} must have {length} entries, not {}", array.len());
        self.report(
            Problem::error(node.span, message)
                .label(format!("{} entries", array.len()))
                .help(format!("give exactly {length}")),
        );
        None
    }

    /// Exactly `N` finite numbers; every wrong one is noted.
    pub(crate) fn numbers<const N: usize>(&self, node: &Node, what: &str) -> Option<[f64; N]> {
        let list = self.list(node, N, what)?;
        let read: Vec<Option<f64>> = list.iter().map(|entry| self.number(entry, what)).collect();
        let mut numbers = [0.0; N];
        for (number, read) in numbers.iter_mut().zip(read) {
            *number = read?;
        }
        Some(numbers)
    }

    /// Three numbers.
    pub(crate) fn vector(&self, node: &Node, what: &str) -> Option<Vector3> {
        let vector = Vector3::from(self.numbers::<3>(node, what)?);
        if vector.amax() <= MAX_COMPONENT {
            return Some(vector);
        }
        let message = format!("{what} has the number {:e}", vector.amax());
        self.fail(node.span, message, "write lengths in m; no number of a vector may exceed 1e100")
    }

    /// Three numbers that are not all zero, or the letter of an axis, as they are written.
    pub(crate) fn own_direction(&self, node: &Node, what: &str) -> Option<Vector3> {
        if let Value::Text(word) = &node.value {
            let (sign, letter) = word.strip_prefix('-').map_or((1.0, word.as_str()), |letter| (-1.0, letter));
            if let Some(axis) = ["x", "y", "z"].iter().position(|own| *own == letter) {
                return Some(Vector3::from_fn(|k, _| if k == axis { sign } else { 0.0 }));
            }
            return self.wrong_type(node, what, "a direction, such as [0, 0, 1] or \"z\"");
        }
        let vector = self.vector(node, what)?;
        if vector.norm() > f64::MIN_POSITIVE && vector.norm().is_finite() {
            return Some(vector);
        }
        let message = format!("{what} must point somewhere, but its length is not a positive number");
        self.fail(node.span, message, "only the direction counts: [0, 0, 1] is global z")
    }

    fn is_list_of_lists(node: &Node) -> bool {
        let Value::List(rows) = &node.value else { return false };
        rows.iter().any(|row| matches!(&row.value, Value::List(_)))
    }

    fn matrix<const N: usize>(&self, node: &Node, what: &str) -> Option<[[f64; N]; N]> {
        let rows = self.list(node, N, what)?;
        let read: Vec<_> =
            rows.iter().map(|row| self.numbers::<N>(row, &format!("each row of {what}"))).collect();
        let mut matrix = [[0.0; N]; N];
        for (row, read) in matrix.iter_mut().zip(read) {
            *row = read?;
        }
        let size = matrix.iter().flatten().fold(0.0, |size: f64, entry| size.max(entry.abs()));
        for i in 0..N {
            for j in 0..i {
                if (matrix[i][j] - matrix[j][i]).abs() > 1e-10 * size {
                    let message = format!(
                        "{what} must be symmetric, but entry ({}, {}) is {} and entry ({}, {}) is {}",
                        i + 1,
                        j + 1,
                        matrix[i][j],
                        j + 1,
                        i + 1,
                        matrix[j][i]
                    );
                    return self.fail(node.span, message, "make both entries equal");
                }
            }
        }
        Some(matrix)
    }

    /// One finite number or more.
    pub(crate) fn number_list(&self, node: &Node, what: &str) -> Option<Vec<f64>> {
        let Value::List(list) = &node.value else {
            return self.wrong_type(node, what, "a list of numbers");
        };
        if list.is_empty() {
            return self.fail(node.span, format!("{what} is empty"), "give at least one number");
        }
        let read: Vec<Option<f64>> = list.iter().map(|entry| self.number(entry, what)).collect();
        read.into_iter().collect()
    }

    /// Lists of `length` numbers, or of as many as the first holds.
    pub(crate) fn number_rows(
        &self,
        node: &Node,
        length: Option<usize>,
        what: &str,
    ) -> Option<Vec<Vec<f64>>> {
        let Value::List(rows) = &node.value else {
            return self.wrong_type(node, what, "a list of lists of numbers");
        };
        let what = format!("each entry of {what}");
        let mut read: Vec<Vec<f64>> = Vec::with_capacity(rows.len());
        for row in rows {
            if let Some(length) = length.or(read.first().map(Vec::len)) {
                self.list(row, length, &what)?;
            }
            read.push(self.number_list(row, &what)?);
        }
        Some(read)
    }

    /// A number, a diagonal or a square matrix by rows.
    pub(crate) fn square_matrix(&self, node: &Node, what: &str) -> Option<DMatrix<f64>> {
        let Value::List(rows) = &node.value else {
            return self.number(node, what).map(|number| DMatrix::from_element(1, 1, number));
        };
        if !Self::is_list_of_lists(node) {
            return self.number_list(node, what).map(|own| DMatrix::from_diagonal(&DVector::from_vec(own)));
        }
        let size = rows.len();
        let mut numbers = Vec::with_capacity(size * size);
        for row in rows {
            self.list(row, size, &format!("each row of {what}"))?;
            numbers.extend(self.number_list(row, &format!("each row of {what}"))?);
        }
        Some(DMatrix::from_row_slice(size, size, &numbers))
    }

    /// Three numbers, or a symmetric 3 x 3 matrix; positive definite, or zero if `mass` is.
    pub(crate) fn inertia(&self, node: &Node, what: &str, mass: f64) -> Option<Matrix3> {
        let matrix = if Self::is_list_of_lists(node) {
            let rows = self.matrix::<3>(node, what)?;
            Matrix3::from_fn(|i, j| rows[i][j])
        } else {
            Matrix3::from_diagonal(&self.vector(node, what)?)
        };
        if mass == 0.0 {
            let help = "give both a mass and an inertia, or inertia = [0, 0, 0] for a body without mass";
            let message = format!("{what} is not zero, but the mass is");
            return if matrix == Matrix3::zeros() {
                Some(matrix)
            } else {
                self.fail(node.span, message, help)
            };
        }
        let moments = matrix.symmetric_eigenvalues();
        let [a, b, c] = [moments[0], moments[1], moments[2]];
        if !(a > 0.0 && b > 0.0 && c > 0.0) {
            let help = "for a body without extension use [point_masses.…]";
            return self.fail(node.span, format!("{what} must have positive principal moments"), help);
        }
        if 2.0 * a.max(b).max(c) > (a + b + c) * (1.0 + 1e-6) {
            let message =
                format!("{what} belongs to no body: one principal moment exceeds the sum of the others");
            self.report(
                Problem::warning(node.span, message).help("check the order and the units of the moments"),
            );
        }
        Some(matrix)
    }

    /// Six numbers, or a symmetric 6 x 6 matrix; without negative eigenvalues.
    pub(crate) fn semidefinite_matrix(&self, node: &Node, what: &str) -> Option<Matrix6> {
        let matrix = if Self::is_list_of_lists(node) {
            let rows = self.matrix::<6>(node, what)?;
            Matrix6::from_fn(|i, j| rows[i][j])
        } else {
            Matrix6::from_diagonal(&Vector6::from(self.numbers::<6>(node, what)?))
        };
        // Scaled to a unit diagonal, so that units do not decide.
        let diagonal = matrix.diagonal();
        let scale = diagonal.map(|entry| if entry > 0.0 { 1.0 / entry.sqrt() } else { 1.0 });
        let scaled = Matrix6::from_fn(|i, j| matrix[(i, j)] * scale[i] * scale[j]);
        if scaled.iter().all(|entry| entry.is_finite()) && scaled.symmetric_eigenvalues().min() > -1e-10 {
            return Some(matrix);
        }
        let help = "a negative eigenvalue would make the model unstable";
        self.fail(node.span, format!("{what} must not have negative eigenvalues"), help)
    }

    /// Six numbers, or a symmetric 6 x 6 matrix; positive definite.
    pub(crate) fn definite_matrix(&self, node: &Node, what: &str) -> Option<Matrix6> {
        let matrix = if Self::is_list_of_lists(node) {
            let rows = self.matrix::<6>(node, what)?;
            Matrix6::from_fn(|i, j| rows[i][j])
        } else {
            Matrix6::from_diagonal(&Vector6::from(self.numbers::<6>(node, what)?))
        };
        // Scaled to a unit diagonal, so that units do not decide.
        let scale = matrix.diagonal().map(|entry| 1.0 / entry.sqrt());
        let scaled = Matrix6::from_fn(|i, j| matrix[(i, j)] * scale[i] * scale[j]);
        let definite = matrix.diagonal().min() > 0.0
            && scaled.iter().all(|entry| entry.is_finite())
            && scaled.symmetric_eigenvalues().min() > 1e-13;
        if definite {
            return Some(matrix);
        }
        let help =
            "the stiffness or mass in each direction must be greater than zero; small values are accepted";
        self.fail(node.span, format!("{what} must be positive definite"), help)
    }
}
