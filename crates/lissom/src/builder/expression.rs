//! Expressions of time, inputs, signals, states, and of quantities of joints and outputs, written with the operators of
//! Rust.

use std::ops::{Add, Div, Mul, Neg, Sub};

use lissom_model::output::number_text;

use super::written::{Fields, Written};
use crate::ids::{AnyId, InputId, JointId, OutputId, SignalId, StateId};

/// An expression of time, inputs, signals, states, coordinates of joints and components of outputs.
///
/// ```
/// use lissom::builder::{Expression, Input, ModelBuilder};
///
/// let mut model = ModelBuilder::new();
/// let command = model.add(Input::starting_at(0.0));
/// let t = Expression::time();
/// let size = 2.0 * (t.clone() * 3.0).sin() + command / 4.0 - 1.0;
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expression(Form);

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Number(f64),
    Pieces(Vec<Piece>),
}

/// A part of an expression's text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    Text(String),
    Name(AnyId),
    /// The name of the entry that contains the expression.
    Own,
}

impl Expression {
    /// The time `t` [s].
    pub fn time() -> Self {
        Self::text("t")
    }

    /// An expression in the syntax of model files, such as `"sin(3*t)"`, or the name of a variable, such as `"elongation"` in the
    /// force of a spring.
    pub fn text(text: &str) -> Self {
        Self(Form::Pieces(vec![Piece::Text(text.to_owned())]))
    }

    /// The state whose derivative this is; in a sampled signal, its last sample.
    pub fn itself() -> Self {
        Self(Form::Pieces(vec![Piece::Own]))
    }

    fn named(id: AnyId, component: &str) -> Self {
        let mut pieces = vec![Piece::Name(id)];
        if !component.is_empty() {
            pieces.push(Piece::Text(format!(".{component}")));
        }
        Self(Form::Pieces(pieces))
    }

    /// Text of the expression in pieces, or its number.
    pub(crate) fn pieces(&self) -> Result<&[Piece], f64> {
        match &self.0 {
            Form::Number(number) => Err(*number),
            Form::Pieces(pieces) => Ok(pieces),
        }
    }

    fn into_pieces(self) -> Vec<Piece> {
        match self.0 {
            Form::Number(number) => vec![Piece::Text(number_text(number))],
            Form::Pieces(pieces) => pieces,
        }
    }

    /// `before` this `between` other `after`.
    fn joined(self, before: &str, between: &str, other: Option<Self>, after: &str) -> Self {
        let mut pieces = vec![Piece::Text(before.to_owned())];
        pieces.extend(self.into_pieces());
        pieces.push(Piece::Text(between.to_owned()));
        pieces.extend(other.into_iter().flat_map(Self::into_pieces));
        pieces.push(Piece::Text(after.to_owned()));
        Self(Form::Pieces(pieces))
    }

    /// This to the power of `exponent`.
    #[must_use]
    pub fn power(self, exponent: impl Into<Self>) -> Self {
        self.joined("((", ")^(", Some(exponent.into()), "))")
    }

    /// The larger of this and `other`.
    #[must_use]
    pub fn max(self, other: impl Into<Self>) -> Self {
        self.joined("max(", ", ", Some(other.into()), ")")
    }

    /// The smaller of this and `other`.
    #[must_use]
    pub fn min(self, other: impl Into<Self>) -> Self {
        self.joined("min(", ", ", Some(other.into()), ")")
    }

    /// A named function of this, such as `"smoothstep"`.
    #[must_use]
    pub fn function(self, name: &str) -> Self {
        self.joined(&format!("{name}("), "", None, ")")
    }

    /// Sine of the expression.
    #[must_use]
    pub fn sin(self) -> Self {
        self.function("sin")
    }

    /// Cosine of the expression.
    #[must_use]
    pub fn cos(self) -> Self {
        self.function("cos")
    }

    /// Exponential of the expression.
    #[must_use]
    pub fn exp(self) -> Self {
        self.function("exp")
    }

    /// Square root of the expression.
    #[must_use]
    pub fn sqrt(self) -> Self {
        self.function("sqrt")
    }

    /// Absolute value of the expression.
    #[must_use]
    pub fn abs(self) -> Self {
        self.function("abs")
    }
}

impl From<f64> for Expression {
    fn from(number: f64) -> Self {
        Self(Form::Number(number))
    }
}

impl Neg for Expression {
    type Output = Self;

    fn neg(self) -> Self {
        self.joined("(-(", "))", None, "")
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $sign:literal;)*) => {
        $(
            operators!(@on $operator, $method, $sign, Expression InputId SignalId StateId f64);

            impl<R: Into<Expression>> $operator<R> for Expression {
                type Output = Expression;

                fn $method(self, other: R) -> Expression {
                    self.joined("((", $sign, Some(other.into()), "))")
                }
            }
        )*
    };
    (@on $operator:ident, $method:ident, $sign:literal, Expression $($id:ident)*) => {
        $(operators!(@of $operator, $method, $sign, $id);)*
    };
    (@of $operator:ident, $method:ident, $sign:literal, f64) => {
        impl $operator<Expression> for f64 {
            type Output = Expression;

            fn $method(self, other: Expression) -> Expression {
                Expression::from(self).$method(other)
            }
        }
        operators!(@number $operator, $method, InputId SignalId StateId);
    };
    (@of $operator:ident, $method:ident, $sign:literal, $id:ident) => {
        impl<R: Into<Expression>> $operator<R> for $id {
            type Output = Expression;

            fn $method(self, other: R) -> Expression {
                Expression::from(self).$method(other)
            }
        }
    };
    (@number $operator:ident, $method:ident, $($id:ident)*) => {
        $(impl $operator<$id> for f64 {
            type Output = Expression;

            fn $method(self, other: $id) -> Expression {
                Expression::from(self).$method(other)
            }
        })*
    };
}

operators! {
    Add, add, ") + (";
    Sub, sub, ") - (";
    Mul, mul, ")*(";
    Div, div, ")/(";
}

macro_rules! named {
    ($($id:ident)*) => {
        $(impl From<$id> for Expression {
            fn from(id: $id) -> Self {
                Self::named(id.0, "")
            }
        }

        impl From<$id> for Function {
            fn from(id: $id) -> Self {
                Self::from(Expression::from(id))
            }
        })*
    };
}

named! { InputId SignalId StateId }

impl SignalId {
    /// Previous sample of the signal, in the expression of a sampled signal.
    pub fn last(self) -> Expression {
        Expression::named(self.0, "last")
    }
}

impl JointId {
    /// Relative rotation of the joint [rad].
    pub fn angle(self) -> Expression {
        self.coordinate("angle")
    }

    /// The rate of its relative rotation [rad/s].
    pub fn rate(self) -> Expression {
        self.coordinate("rate")
    }

    /// Relative displacement of the joint [m].
    pub fn displacement(self) -> Expression {
        self.coordinate("displacement")
    }

    /// The rate of its relative displacement [m/s].
    pub fn velocity(self) -> Expression {
        self.coordinate("velocity")
    }

    /// One of its coordinates or rates by its name in model files, such as `"angle2"` if it has two.
    pub fn coordinate(self, word: &str) -> Expression {
        Expression::named(self.0, word)
    }
}

impl OutputId {
    /// One of its components by its name in tables of results, such as `"x"`.
    pub fn component(self, word: &str) -> Expression {
        Expression::named(self.0, word)
    }
}

/// A function of time or of another variable: a number, an expression or a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Function(Written);

impl From<f64> for Function {
    fn from(number: f64) -> Self {
        Self(Written::Number(number))
    }
}

impl From<Expression> for Function {
    fn from(expression: Expression) -> Self {
        Self(Written::Expression(expression))
    }
}

impl From<TabulatedFunction> for Function {
    fn from(table: TabulatedFunction) -> Self {
        Self(Written::Fields(table.0))
    }
}

impl From<Function> for Written {
    fn from(function: Function) -> Self {
        function.0
    }
}

impl From<Expression> for Written {
    fn from(expression: Expression) -> Self {
        Self::Expression(expression)
    }
}

/// A function given by rows of argument and value, arguments ascending; linear between the rows by default.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct TabulatedFunction(pub(crate) Fields);

impl TabulatedFunction {
    /// A function through `rows` of argument and value.
    pub fn of_rows(rows: impl Into<Vec<[f64; 2]>>) -> Self {
        let mut fields = Fields::default();
        fields.set("table", rows.into());
        Self(fields)
    }

    /// A spline with continuous second derivative between the rows.
    pub fn spline(self) -> Self {
        self.with("interpolation", "spline")
    }

    /// A smooth function between the rows that does not overshoot.
    pub fn monotone(self) -> Self {
        self.with("interpolation", "monotone")
    }

    /// The values of the ends beyond the rows.
    pub fn constant_beyond(self) -> Self {
        self.with("extrapolation", "constant")
    }

    /// Straight lines beyond the rows.
    pub fn linear_beyond(self) -> Self {
        self.with("extrapolation", "linear")
    }

    fn with(mut self, key: &'static str, word: &str) -> Self {
        self.0.set(key, word.to_owned());
        self
    }
}
