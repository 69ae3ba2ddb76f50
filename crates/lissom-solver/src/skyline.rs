//! LU without pivoting in profile storage: the readable reference. Values are unsymmetric, the profile is symmetric.
//! The order of elimination is used only as a permutation.
//!
//! Legend: `A = L U` in the order of elimination, `L` with unit diagonal. Row `i` of `L` and column `i` of `U` are both
//! stored from the first coupled unknown to the diagonal, so that every number is a dot product of two contiguous
//! pieces (Crout's scheme):
//!
//! ```text
//! u_ji = a_ji - Σ_k l_jk u_ki        l_ij = (a_ij - Σ_k l_ik u_kj) / u_jj        k < j < i
//! ```

use std::sync::Arc;

use crate::entries::largest_entry;
use crate::ordering::profile_order;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport, Monitor};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

pub(crate) const NAME: &str = "skyline";

/// Profile solver without pivoting.
pub struct Skyline<S> {
    pattern: Arc<Pattern>,
    /// Unknown eliminated at each step.
    unknowns: Vec<usize>,
    /// First step coupled with each step.
    first: Vec<usize>,
    /// Offset of the piece of each step in `lower` and `upper`, which do not contain the diagonal.
    starts: Vec<usize>,
    /// For each entry of the pattern its position in the storage `lower ‖ upper ‖ diagonal`.
    places: Vec<usize>,
    lower: Vec<S>,
    upper: Vec<S>,
    diagonal: Vec<S>,
    work: Vec<S>,
}

impl<S: Scalar> Skyline<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] rejects the structure.
    pub fn new(structure: &Structure) -> Self {
        let pattern = Arc::clone(&structure.pattern);
        let size = pattern.size();
        let unknowns = structure.unknowns_in_order(&profile_order(structure));
        let mut steps = vec![0; size];
        for (step, &unknown) in unknowns.iter().enumerate() {
            steps[unknown] = step;
        }
        let first: Vec<usize> = (0..size)
            .map(|step| {
                let rows = pattern.column(unknowns[step]).iter();
                rows.map(|&row| steps[row]).fold(step, usize::min)
            })
            .collect();
        let mut starts = vec![0];
        for step in 0..size {
            starts.push(starts[step] + step - first[step]);
        }
        let profile = starts[size];
        let mut places = Vec::with_capacity(pattern.entries());
        for column in 0..size {
            let column_step = steps[column];
            for &row in pattern.column(column) {
                let row_step = steps[row];
                places.push(match row_step.cmp(&column_step) {
                    std::cmp::Ordering::Greater => starts[row_step] + column_step - first[row_step],
                    std::cmp::Ordering::Less => profile + starts[column_step] + row_step - first[column_step],
                    std::cmp::Ordering::Equal => 2 * profile + row_step,
                });
            }
        }
        Skyline {
            pattern,
            unknowns,
            first,
            starts,
            places,
            lower: vec![S::zero(); profile],
            upper: vec![S::zero(); profile],
            diagonal: vec![S::zero(); size],
            work: vec![S::zero(); size],
        }
    }

    fn load(&mut self, values: &[S]) {
        self.lower.fill(S::zero());
        self.upper.fill(S::zero());
        let profile = self.lower.len();
        for (&place, &value) in self.places.iter().zip(values) {
            if place < profile {
                self.lower[place] = value;
            } else if place < 2 * profile {
                self.upper[place - profile] = value;
            } else {
                self.diagonal[place - 2 * profile] = value;
            }
        }
    }

    /// Replaces row `step` of A by that of L, and column `step` of A by that of U.
    fn eliminate(&mut self, step: usize) {
        let begin = self.first[step];
        let (lower_done, lower_row) = self.lower.split_at_mut(self.starts[step]);
        let (upper_done, upper_column) = self.upper.split_at_mut(self.starts[step]);
        for earlier in begin..step {
            let from = begin.max(self.first[earlier]);
            let known = self.starts[earlier] + from - self.first[earlier]..self.starts[earlier + 1];
            let own = from - begin..earlier - begin;
            let (row, column) = (&lower_done[known.clone()], &upper_done[known]);
            upper_column[earlier - begin] -= dot(row, &upper_column[own.clone()]);
            lower_row[earlier - begin] =
                (lower_row[earlier - begin] - dot(&lower_row[own], column)) / self.diagonal[earlier];
        }
    }
}

impl<S: Scalar> LinearSolver<S> for Skyline<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        let largest = largest_entry(&self.pattern, values)?;
        self.load(values);
        let mut monitor = Monitor::new();
        let mut largest_upper = 0.0_f64;
        for step in 0..self.unknowns.len() {
            self.eliminate(step);
            let piece = self.starts[step]..self.starts[step + 1];
            let mut pivot = self.diagonal[step];
            let mut terms = pivot.magnitude();
            for (&lower, &upper) in self.lower[piece.clone()].iter().zip(&self.upper[piece.clone()]) {
                pivot -= lower * upper;
                terms += (lower * upper).magnitude();
            }
            monitor.pivot(self.unknowns[step], pivot, terms)?;
            self.diagonal[step] = pivot;
            largest_upper = self.upper[piece]
                .iter()
                .fold(largest_upper.max(pivot.magnitude()), |largest, value| largest.max(value.magnitude()));
        }
        Ok(monitor.report::<S>(largest_upper, largest))
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        let size = self.unknowns.len();
        assert_eq!(right_hand_side.len(), size, "one number for each unknown");
        let work = &mut self.work;
        for step in 0..size {
            let known = &work[self.first[step]..step];
            let row = &self.lower[self.starts[step]..self.starts[step + 1]];
            work[step] = right_hand_side[self.unknowns[step]] - dot(row, known);
        }
        for step in (0..size).rev() {
            let known = work[step] / self.diagonal[step];
            right_hand_side[self.unknowns[step]] = known;
            let column = &self.upper[self.starts[step]..self.starts[step + 1]];
            for (value, &upper) in work[self.first[step]..step].iter_mut().zip(column) {
                *value -= upper * known;
            }
        }
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        let size = self.unknowns.len();
        assert_eq!(right_hand_side.len(), size, "one number for each unknown");
        let work = &mut self.work;
        for step in 0..size {
            let known = &work[self.first[step]..step];
            let column = &self.upper[self.starts[step]..self.starts[step + 1]];
            work[step] = (right_hand_side[self.unknowns[step]] - dot(column, known)) / self.diagonal[step];
        }
        for step in (0..size).rev() {
            let known = work[step];
            right_hand_side[self.unknowns[step]] = known;
            let row = &self.lower[self.starts[step]..self.starts[step + 1]];
            for (value, &lower) in work[self.first[step]..step].iter_mut().zip(row) {
                *value -= lower * known;
            }
        }
    }

    fn factor_entries(&self) -> usize {
        self.lower.len() + self.upper.len() + self.diagonal.len()
    }
}

/// Sum of products, in several partial sums that can be computed in parallel.
#[inline]
fn dot<S: Scalar>(left: &[S], right: &[S]) -> S {
    const LANES: usize = 8;
    let mut sums = [S::zero(); LANES];
    let (left_chunks, right_chunks) = (left.chunks_exact(LANES), right.chunks_exact(LANES));
    let rest = left_chunks.remainder().iter().zip(right_chunks.remainder());
    for (left, right) in left_chunks.zip(right_chunks) {
        for lane in 0..LANES {
            sums[lane] += left[lane] * right[lane];
        }
    }
    let mut sum = rest.fold(S::zero(), |sum, (&left, &right)| sum + left * right);
    for lane in sums {
        sum += lane;
    }
    sum
}
