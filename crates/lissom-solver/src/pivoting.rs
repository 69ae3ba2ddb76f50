//! Sparse LU with partial pivoting: the alternative for matrices that cannot be eliminated without pivoting.
//!
//! Columns are eliminated in an order that is suitable for all choices of pivots (`ordering::column_order`). Each is
//! solved with the earlier columns of L that a depth-first search finds (Gilbert and Peierls 1988, SIAM J. Sci. Stat.
//! Comput. 9, 862); its pivot is its largest entry.

use std::sync::Arc;

use crate::entries::largest_entry;
use crate::ordering::column_order;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport, Monitor};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

pub(crate) const NAME: &str = "pivoting";

/// Backward error of the solve for the report above which the factors are rejected.
const UNUSABLE: f64 = 1e-6;
/// A row without a pivot, or an unknown without a position.
const NONE: u32 = u32::MAX;

/// Sparse LU with partial pivoting.
pub struct Pivoting<S> {
    pattern: Arc<Pattern>,
    /// By step, the column that is eliminated.
    order: Vec<u32>,
    /// By step, the row of its pivot, and by row the step.
    rows: Vec<u32>,
    steps: Vec<u32>,
    /// Columns of L by steps, without its unit diagonal; indices are rows, and steps once all are known.
    lower: Columns<S>,
    /// Columns of U by steps, without the pivots.
    upper: Columns<S>,
    pivots: Vec<S>,
    search: Search,
    /// A column by rows, or a vector by steps, during the computation.
    work: Vec<S>,
    factored: bool,
    probe: Vec<S>,
    solution: Vec<S>,
    product: Vec<S>,
}

/// Sparse columns, concatenated.
struct Columns<S> {
    starts: Vec<usize>,
    indices: Vec<u32>,
    values: Vec<S>,
}

impl<S: Scalar> Columns<S> {
    fn new() -> Self {
        Columns { starts: vec![0], indices: Vec::new(), values: Vec::new() }
    }

    fn clear(&mut self) {
        self.starts.truncate(1);
        self.indices.clear();
        self.values.clear();
    }

    fn push(&mut self, index: u32, value: S) {
        self.indices.push(index);
        self.values.push(value);
    }

    fn end_column(&mut self) {
        self.starts.push(self.indices.len());
    }

    fn column(&self, step: usize) -> impl DoubleEndedIterator<Item = (usize, S)> {
        let range = self.starts[step]..self.starts[step + 1];
        self.indices[range.clone()]
            .iter()
            .map(|&index| index as usize)
            .zip(self.values[range].iter().copied())
    }
}

/// The rows that a column fills, found depth first.
struct Search {
    /// By row, the last step that has reached it.
    reached: Vec<u32>,
    /// Rows on the path, with the number of entries of their columns that have been examined.
    path: Vec<(u32, usize)>,
    /// Steps whose columns of L change the column, the last first; rows without a pivot.
    before: Vec<u32>,
    candidates: Vec<u32>,
}

impl Search {
    fn begin(&mut self) {
        self.before.clear();
        self.candidates.clear();
    }

    /// Reaches a row and all rows that depend on it.
    fn reach<S>(&mut self, row: u32, mark: u32, steps: &[u32], lower: &Columns<S>) {
        let is_new =
            |reached: &mut [u32], row: u32| std::mem::replace(&mut reached[row as usize], mark) != mark;
        if !is_new(&mut self.reached, row) {
            return;
        }
        self.path.push((row, 0));
        while let Some((row, looked_at)) = self.path.last_mut() {
            let step = steps[*row as usize];
            if step == NONE {
                self.candidates.push(*row);
                self.path.pop();
                continue;
            }
            let column = &lower.indices[lower.starts[step as usize]..lower.starts[step as usize + 1]];
            let next = column[*looked_at..].iter().position(|&next| is_new(&mut self.reached, next));
            if let Some(offset) = next {
                let next = column[*looked_at + offset];
                *looked_at += offset + 1;
                self.path.push((next, 0));
            } else {
                self.before.push(step);
                self.path.pop();
            }
        }
    }
}

impl<S: Scalar> Pivoting<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] rejects the structure.
    pub fn new(structure: &Structure) -> Self {
        let pattern = Arc::clone(&structure.pattern);
        let size = pattern.size();
        let order = structure.unknowns_in_order(&column_order(structure));
        // Numbers without a short binary form, of one magnitude, so that every direction is excited.
        let probe = (0..size).map(|unknown| S::from_real((1.0 + unknown as f64).sin() + 2.0)).collect();
        Pivoting {
            order: order.into_iter().map(|unknown| unknown as u32).collect(),
            rows: vec![NONE; size],
            steps: vec![NONE; size],
            lower: Columns::new(),
            upper: Columns::new(),
            pivots: Vec::with_capacity(size),
            search: Search {
                reached: vec![NONE; size],
                path: Vec::new(),
                before: Vec::new(),
                candidates: Vec::new(),
            },
            work: vec![S::zero(); size],
            factored: false,
            probe,
            solution: vec![S::zero(); size],
            product: vec![S::zero(); size],
            pattern,
        }
    }

    /// Factorises column by column; returns the largest magnitude in U.
    fn eliminate(&mut self, values: &[S]) -> Result<f64, FactorError> {
        self.lower.clear();
        self.upper.clear();
        self.pivots.clear();
        self.steps.fill(NONE);
        self.search.reached.fill(NONE);
        self.work.fill(S::zero());
        let mut largest = 0.0_f64;
        for step in 0..self.order.len() {
            let column = self.order[step] as usize;
            self.search.begin();
            let start = self.pattern.column_starts()[column];
            for (offset, &row) in self.pattern.column(column).iter().enumerate() {
                let value = values[start + offset];
                if value != S::zero() {
                    self.work[row] = value;
                    self.search.reach(row as u32, step as u32, &self.steps, &self.lower);
                }
            }
            for &before in self.search.before.iter().rev() {
                let value = std::mem::take(&mut self.work[self.rows[before as usize] as usize]);
                self.upper.push(before, value);
                largest = largest.max(value.magnitude());
                if value == S::zero() {
                    continue;
                }
                for (row, factor) in self.lower.column(before as usize) {
                    self.work[row] -= factor * value;
                }
            }
            self.upper.end_column();
            largest = largest.max(self.take_pivot(step, column)?);
        }
        // From now on L is indexed by steps.
        for row in &mut self.lower.indices {
            *row = self.steps[*row as usize];
        }
        Ok(largest)
    }

    /// Selects the pivot among the remaining rows, and stores the column of L below it. Returns its magnitude.
    fn take_pivot(&mut self, step: usize, column: usize) -> Result<f64, FactorError> {
        let (mut largest, mut chosen) = (0.0, NONE);
        for &row in &self.search.candidates {
            let magnitude = self.work[row as usize].magnitude();
            if !magnitude.is_finite() {
                return Err(FactorError::NotFinite { unknown: column });
            }
            // The lower row among equal candidates is chosen, whatever the order of the search.
            if magnitude > largest || (magnitude == largest && magnitude > 0.0 && row < chosen) {
                (largest, chosen) = (magnitude, row);
            }
        }
        if chosen == NONE {
            return Err(FactorError::ZeroPivot { unknown: column, pivot: 0.0, largest });
        }
        let pivot = std::mem::take(&mut self.work[chosen as usize]);
        for &row in &self.search.candidates {
            let value = std::mem::take(&mut self.work[row as usize]);
            if value != S::zero() {
                self.lower.push(row, value / pivot);
            }
        }
        self.lower.end_column();
        self.pivots.push(pivot);
        self.rows[step] = chosen;
        self.steps[chosen as usize] = step as u32;
        Ok(pivot.magnitude())
    }

    /// Solves once and checks the magnitude of the solution and of the residual.
    fn inspect(&mut self, values: &[S], largest: f64, growth: f64) -> Result<FactorReport, FactorError> {
        let mut solution = std::mem::take(&mut self.solution);
        solution.copy_from_slice(&self.probe);
        self.solve(&mut solution);
        self.pattern.multiply(values, &solution, &mut self.product);
        let (mut size, mut unknown) = (0.0, 0);
        for (index, value) in solution.iter().enumerate() {
            // A value that is not a number counts as the largest.
            if value.magnitude() > size || value.magnitude().is_nan() {
                (size, unknown) = (value.magnitude(), index);
            }
        }
        self.solution = solution;
        let distance = |(&product, &probe): (&S, &S)| (product - probe).magnitude();
        let residual = self.product.iter().zip(&self.probe).map(distance).fold(0.0, f64::max);
        let probe = self.probe.iter().fold(0.0, |largest: f64, value| largest.max(value.magnitude()));
        let backward_error = residual / (largest * size + probe);
        let pivot = probe / size;
        if !size.is_finite() || !backward_error.is_finite() || backward_error > UNUSABLE {
            return Err(FactorError::ZeroPivot { unknown, pivot: 0.0, largest });
        }
        Ok(FactorReport {
            smallest_pivot: pivot,
            smallest_pivot_unknown: unknown,
            largest_diagonal: largest,
            growth,
            worst_cancellation: pivot / largest,
            worst_cancellation_unknown: unknown,
            negative_pivots: None,
        })
    }
}

impl<S: Scalar> LinearSolver<S> for Pivoting<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn exchanges_rows(&self) -> bool {
        true
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        self.factored = false;
        let largest = largest_entry(&self.pattern, values)?;
        if self.pattern.size() == 0 {
            return Ok(Monitor::new().report::<S>(0.0, largest));
        }
        if largest == 0.0 {
            return Err(FactorError::ZeroPivot { unknown: 0, pivot: 0.0, largest });
        }
        let largest_upper = self.eliminate(values)?;
        self.factored = true;
        let report = self.inspect(values, largest, largest_upper / largest);
        self.factored = report.is_ok();
        report
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        assert_eq!(right_hand_side.len(), self.pattern.size(), "one number for each unknown");
        if !self.factored {
            return;
        }
        let x = &mut self.work;
        for (x, &row) in x.iter_mut().zip(&self.rows) {
            *x = right_hand_side[row as usize];
        }
        for step in 0..x.len() {
            let known = x[step];
            for (later, factor) in self.lower.column(step) {
                x[later] -= factor * known;
            }
        }
        for step in (0..x.len()).rev() {
            x[step] = x[step] / self.pivots[step];
            let known = x[step];
            for (earlier, factor) in self.upper.column(step) {
                x[earlier] -= factor * known;
            }
        }
        for (x, &column) in x.iter().zip(&self.order) {
            right_hand_side[column as usize] = *x;
        }
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        assert_eq!(right_hand_side.len(), self.pattern.size(), "one number for each unknown");
        if !self.factored {
            return;
        }
        let x = &mut self.work;
        for (x, &column) in x.iter_mut().zip(&self.order) {
            *x = right_hand_side[column as usize];
        }
        for step in 0..x.len() {
            let sum =
                self.upper.column(step).fold(x[step], |sum, (earlier, factor)| sum - factor * x[earlier]);
            x[step] = sum / self.pivots[step];
        }
        for step in (0..x.len()).rev() {
            x[step] = self.lower.column(step).fold(x[step], |sum, (later, factor)| sum - factor * x[later]);
        }
        for (x, &row) in x.iter().zip(&self.rows) {
            right_hand_side[row as usize] = *x;
        }
    }

    /// Entries of the last factors; before the first factorisation those of the matrix, a lower bound.
    fn factor_entries(&self) -> usize {
        let stored = self.lower.values.len() + self.upper.values.len() + self.pivots.len();
        stored.max(self.pattern.entries())
    }
}
