//! Iterative refinement of solutions whose factors have the compliance of redundant constraints in them.

use crate::round_off;
use crate::tuning::MAX_ITERATIONS;
use lissom_solver::{Pattern, Scalar};

/// Iterative refinement with the matrix as it was before the compliance entered it. The
/// right-hand sides of the constraints are consistent, so that the solution without the compliance exists.
pub(crate) struct Refinement<S> {
    values: Vec<S>,
    right: Vec<S>,
    residual: Vec<S>,
    solution: Vec<S>,
}

impl<S: Scalar> Refinement<S> {
    /// Without a compliance.
    pub(crate) fn new() -> Self {
        let empty = Vec::new;
        Self { values: empty(), right: empty(), residual: empty(), solution: empty() }
    }

    /// Stores the matrix before the compliance enters it.
    pub(crate) fn start(&mut self, values: &[S]) {
        self.values.clear();
        self.values.extend_from_slice(values);
    }

    /// Solves in place with `solve`, which uses the factors.
    pub(crate) fn solve(&mut self, pattern: &Pattern, right: &mut [S], mut solve: impl FnMut(&mut [S])) {
        self.right.clear();
        self.right.extend_from_slice(right);
        self.residual.clear();
        self.residual.extend_from_slice(right);
        self.solution.clear();
        self.solution.resize(right.len(), S::zero());
        let size = |values: &[S]| values.iter().fold(0.0_f64, |most, value| most.max(value.magnitude()));
        let mut last = size(right);
        let enough = round_off::SOLUTION * last;
        for _ in 0..MAX_ITERATIONS {
            solve(&mut self.residual);
            for (value, &change) in self.solution.iter_mut().zip(&self.residual) {
                *value += change;
            }
            self.residual.copy_from_slice(&self.right);
            for (column, &factor) in self.solution.iter().enumerate() {
                let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
                for (&row, &value) in pattern.row_indices()[range.clone()].iter().zip(&self.values[range]) {
                    self.residual[row] += S::zero() - factor * value;
                }
            }
            let rest = size(&self.residual);
            // A residual that is not halved is round-off; also left where the residual is not a number.
            if !(rest > enough && rest <= 0.5 * last) {
                break;
            }
            last = rest;
        }
        right.copy_from_slice(&self.solution);
    }
}
