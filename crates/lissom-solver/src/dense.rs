//! LU of a dense matrix with partial pivoting: the reference for the other solvers. Ignores groups.

use std::sync::Arc;

use crate::entries::largest_entry;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport, TINY_PIVOT};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

pub(crate) const NAME: &str = "dense";

/// Dense LU with row exchanges; cubic time, quadratic memory.
pub struct Dense<S> {
    pattern: Arc<Pattern>,
    /// Column-major; L below the diagonal, its unit diagonal omitted, and U above.
    factors: Vec<S>,
    /// Row exchanged with row `k` at step `k`.
    exchanges: Vec<usize>,
}

impl<S: Scalar> Dense<S> {
    /// A solver for matrices of this pattern.
    pub fn new(structure: &Structure) -> Self {
        let size = structure.pattern.size();
        Dense {
            pattern: Arc::clone(&structure.pattern),
            factors: vec![S::zero(); size * size],
            exchanges: vec![0; size],
        }
    }

    fn load(&mut self, values: &[S]) {
        let size = self.pattern.size();
        self.factors.fill(S::zero());
        for column in 0..size {
            let start = self.pattern.column_starts()[column];
            for (offset, &row) in self.pattern.column(column).iter().enumerate() {
                self.factors[row + column * size] = values[start + offset];
            }
        }
    }

    fn exchange_rows(&mut self, first: usize, second: usize) {
        if first != second {
            for column in self.factors.chunks_exact_mut(self.exchanges.len()) {
                column.swap(first, second);
            }
        }
    }

    fn eliminate(&mut self, step: usize) {
        let size = self.pattern.size();
        let (left, right) = self.factors.split_at_mut((step + 1) * size);
        let pivot_column = &mut left[step * size..];
        let pivot = pivot_column[step];
        for value in &mut pivot_column[step + 1..] {
            *value = *value / pivot;
        }
        for column in right.chunks_exact_mut(size) {
            let factor = column[step];
            if factor != S::zero() {
                for (value, &lower) in column[step + 1..].iter_mut().zip(&pivot_column[step + 1..]) {
                    *value -= lower * factor;
                }
            }
        }
    }
}

impl<S: Scalar> LinearSolver<S> for Dense<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn exchanges_rows(&self) -> bool {
        true
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        let size = self.pattern.size();
        let largest = largest_entry(&self.pattern, values)?;
        self.load(values);
        let mut smallest = (f64::INFINITY, 0);
        let (mut largest_diagonal, mut largest_upper) = (0.0_f64, 0.0_f64);
        for step in 0..size {
            let column = &self.factors[step * size..(step + 1) * size];
            let scale = column.iter().fold(0.0, |scale: f64, value| scale.max(value.magnitude()));
            let mut row = step;
            for candidate in step + 1..size {
                if column[candidate].magnitude() > column[row].magnitude() {
                    row = candidate;
                }
            }
            let pivot = column[row].magnitude();
            if !pivot.is_finite() {
                return Err(FactorError::NotFinite { unknown: step });
            }
            if pivot <= TINY_PIVOT * scale {
                return Err(FactorError::ZeroPivot { unknown: step, pivot, largest: scale });
            }
            self.exchanges[step] = row;
            self.exchange_rows(step, row);
            self.eliminate(step);
            if pivot < smallest.0 {
                smallest = (pivot, step);
            }
            largest_diagonal = largest_diagonal.max(pivot);
            let upper = &self.factors[step * size..=step * size + step];
            largest_upper = upper.iter().fold(largest_upper, |largest, value| largest.max(value.magnitude()));
        }
        Ok(FactorReport {
            smallest_pivot: smallest.0,
            smallest_pivot_unknown: smallest.1,
            largest_diagonal,
            growth: if largest > 0.0 { largest_upper / largest } else { 0.0 },
            worst_cancellation: smallest.0 / largest_diagonal,
            worst_cancellation_unknown: smallest.1,
            negative_pivots: None,
        })
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        let size = self.pattern.size();
        assert_eq!(right_hand_side.len(), size, "one number for each unknown");
        for (step, &row) in self.exchanges.iter().enumerate() {
            right_hand_side.swap(step, row);
        }
        for (step, column) in self.factors.chunks_exact(size.max(1)).enumerate() {
            let known = right_hand_side[step];
            for (value, &lower) in right_hand_side[step + 1..].iter_mut().zip(&column[step + 1..]) {
                *value -= lower * known;
            }
        }
        for (step, column) in self.factors.chunks_exact(size.max(1)).enumerate().rev() {
            let known = right_hand_side[step] / column[step];
            right_hand_side[step] = known;
            for (value, &upper) in right_hand_side[..step].iter_mut().zip(column) {
                *value -= upper * known;
            }
        }
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        let size = self.pattern.size();
        assert_eq!(right_hand_side.len(), size, "one number for each unknown");
        for (step, column) in self.factors.chunks_exact(size.max(1)).enumerate() {
            let mut sum = right_hand_side[step];
            for (&known, &upper) in right_hand_side[..step].iter().zip(column) {
                sum -= upper * known;
            }
            right_hand_side[step] = sum / column[step];
        }
        for (step, column) in self.factors.chunks_exact(size.max(1)).enumerate().rev() {
            let mut sum = right_hand_side[step];
            for (&known, &lower) in right_hand_side[step + 1..].iter().zip(&column[step + 1..]) {
                sum -= lower * known;
            }
            right_hand_side[step] = sum;
        }
        for (step, &row) in self.exchanges.iter().enumerate().rev() {
            right_hand_side.swap(step, row);
        }
    }

    fn factor_entries(&self) -> usize {
        self.factors.len()
    }
}
