//! Brings the rows and columns of a tangent to one size, by powers of two: what is left of its condition is
//! the model's own, not that of units or of parts that are light beside others. Powers of two are exact and
//! elimination without pivoting does not see them, so that no result changes by a bit. Knows no mechanics.
//!
//! ```text
//! Ĵ = F J F,   F_i = |J_ii|^(-1/2) for coordinates,   F_k = |J_k· F|₂⁻¹ for multipliers
//! ```
//!
//! With the first, the blocks of coordinates have a unit diagonal, which is within a factor of the best
//! diagonal scaling of a definite matrix [van der Sluis 1969]; with the second, so has their Schur complement
//! where they are nearly diagonal.

use lissom_solver::{Pattern, Scalar};

use crate::round_off;

/// The factors of rows and columns.
#[derive(Clone, Debug)]
pub(crate) struct Equilibration {
    factors: Vec<f64>,
    /// Rows before this one belong to coordinates, the others to multipliers.
    coordinate_count: usize,
}

impl Equilibration {
    /// No change yet, for `size` unknowns of which the first `coordinate_count` are coordinates.
    pub(crate) fn new(size: usize, coordinate_count: usize) -> Self {
        Self { factors: vec![1.0; size], coordinate_count }
    }

    /// Factor of each row and column.
    pub(crate) fn factors(&self) -> &[f64] {
        &self.factors
    }

    /// Takes over factors that were found before.
    pub(crate) fn set_factors(&mut self, factors: &[f64]) {
        self.factors.copy_from_slice(factors);
    }

    /// Finds the factors of the tangent with `values` on `pattern` and applies them to it.
    pub(crate) fn apply<S: Scalar>(&mut self, pattern: &Pattern, values: &mut [S]) {
        self.find(pattern, values);
        self.scale_matrix(pattern, values);
    }

    /// Finds the factors of the tangent with `values` on `pattern`.
    pub(crate) fn find<S: Scalar>(&mut self, pattern: &Pattern, values: &[S]) {
        let (starts, rows) = (pattern.column_starts(), pattern.row_indices());
        let count = self.coordinate_count;
        for column in 0..pattern.size() {
            let entries = (starts[column]..starts[column + 1]).map(|k| (rows[k], values[k].magnitude()));
            let square = if column < count {
                let (mut diagonal, mut largest) = (0.0, 0.0_f64);
                for (row, value) in entries {
                    largest = if value > largest { value } else { largest };
                    if row == column {
                        diagonal = value;
                    }
                }
                // A coordinate that only constraints see has no diagonal without the augmented term.
                if diagonal > round_off::PIVOT * largest { diagonal } else { largest }
            } else {
                let own = entries.filter(|&(row, _)| row < count);
                own.map(|(row, value)| (value * self.factors[row]).powi(2)).sum()
            };
            self.factors[column] = power_of_two(square);
        }
    }

    /// Multiplies rows and columns of a tangent by the factors.
    pub(crate) fn scale_matrix<S: Scalar>(&self, pattern: &Pattern, values: &mut [S]) {
        let (starts, rows) = (pattern.column_starts(), pattern.row_indices());
        for column in 0..pattern.size() {
            let own = self.factors[column];
            for k in starts[column]..starts[column + 1] {
                values[k] *= S::from_parts(own * self.factors[rows[k]], 0.0);
            }
        }
    }

    /// Right-hand side of the equilibrated tangent, or from its solution to the tangent's own.
    pub(crate) fn scale(&self, vector: &mut [f64]) {
        for (value, factor) in vector.iter_mut().zip(&self.factors) {
            *value *= factor;
        }
    }
}

/// The power of two next to the inverse root of `square`; 1 if `square` is zero.
fn power_of_two(square: f64) -> f64 {
    let (bias, fraction) = (i64::from(f64::MAX_EXP) - 1, f64::MANTISSA_DIGITS - 1);
    if !(square.is_normal() && square > 0.0) {
        return 1.0;
    }
    // The inverse root of 2^e m with 1 <= m < 2 is between 2^(-e/2) and 2^(-(e + 1)/2).
    let exponent = (square.to_bits() >> fraction).cast_signed() - bias;
    f64::from_bits((bias - (exponent + 1).div_euclid(2)).cast_unsigned() << fraction)
}

#[cfg(test)]
#[path = "../../tests/unit/saddle_point/equilibration.rs"]
mod tests;
