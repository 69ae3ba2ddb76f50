//! Errors of expressions.

use std::ops::Range;

/// An expression that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// One sentence.
    pub message: String,
    /// A remedy.
    pub help: Option<String>,
    /// The offending bytes of the expression.
    pub range: Range<usize>,
}
