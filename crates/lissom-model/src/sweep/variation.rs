//! The values of a varied path: a list, a range, a normal distribution.

use serde::Serialize;

use super::sampling::normal_quantile;
use crate::text::number::number_text;

/// A value put into a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum SweepValue {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Any other value, as TOML.
    Toml(String),
}

impl SweepValue {
    /// The value as TOML; numbers with the fewest digits that give them back exactly.
    pub fn to_toml(&self) -> String {
        match self {
            Self::Number(number) => number_text(*number),
            Self::Text(text) => toml::Value::String(text.clone()).to_string(),
            Self::Toml(toml) => toml.clone(),
        }
    }

    /// The value as a cell of a table: a text without its quotes.
    pub fn to_cell(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            other => other.to_toml(),
        }
    }
}

/// The values of a varied path.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Variation {
    /// These.
    Listed(Vec<SweepValue>),
    /// From one number to another, evenly or with even ratios.
    Range {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many, for samplings that do not choose the values themselves.
        count: Option<usize>,
        /// Whether ratios are even; then both are greater than zero.
        logarithmic: bool,
    },
    /// Normally distributed numbers.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, greater than zero.
        standard_deviation: f64,
    },
}

impl Variation {
    /// Number of values, where they can be counted.
    pub(super) fn count(&self) -> Option<usize> {
        match self {
            Self::Listed(values) => Some(values.len()),
            Self::Range { count, .. } => *count,
            Self::Normal { .. } => None,
        }
    }

    /// The sample at the fraction `u`, between 0 and 1: a number, or the index of a listed value.
    pub(super) fn at_fraction(&self, u: f64) -> f64 {
        match self {
            Self::Listed(values) => (u * values.len() as f64).floor().min((values.len() - 1) as f64),
            Self::Range { from, to, logarithmic, .. } => {
                if *logarithmic {
                    (from.ln() + u * (to.ln() - from.ln())).exp().clamp(from.min(*to), from.max(*to))
                } else {
                    from * (1.0 - u) + to * u
                }
            }
            Self::Normal { mean, standard_deviation } => mean + standard_deviation * normal_quantile(u),
        }
    }

    /// The sample number `index` of those that can be counted; first and last are met exactly.
    pub(super) fn at_index(&self, index: usize) -> f64 {
        match self {
            Self::Listed(_) => index as f64,
            Self::Range { from, to, .. } => {
                let last = self.count().unwrap_or(1).max(2) - 1;
                match index {
                    0 => *from,
                    _ if index >= last => *to,
                    _ => self.at_fraction(index as f64 / last as f64),
                }
            }
            Self::Normal { mean, .. } => *mean,
        }
    }
}

#[cfg(test)]
#[path = "../../tests/unit/sweep/variation.rs"]
mod tests;
