//! LU without pivoting of the square of a front, with the monitor of its pivots. Knows neither the panels below nor
//! the tree.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::PADDING;
use super::kernels::{BLOCK, absolute_products, solve_block, subtract_product};
use crate::report::{FactorError, Monitor};
use crate::scalar::Scalar;

/// Memory for the factorisation of a square of any of the fronts.
pub(super) struct SquareWork<S> {
    /// Transpose of `U11`, columns of the same stride as the square's.
    pub(super) transposed: Vec<S>,
    /// Reciprocals of the pivots.
    pub(super) reciprocals: Vec<S>,
    /// For each row of the front the sum of the magnitudes of what its diagonal has been made of.
    pub(super) terms: Vec<f64>,
    column: [S; BLOCK],
}

impl<S: Scalar> SquareWork<S> {
    pub(super) fn new(pivots: usize) -> Self {
        let stride = pivots.next_multiple_of(PADDING);
        SquareWork {
            transposed: vec![S::zero(); stride * pivots],
            reciprocals: vec![S::zero(); stride],
            terms: vec![0.0; stride],
            column: [S::zero(); BLOCK],
        }
    }

    /// Replaces the square by `L11` and `U11`, leaving the reciprocals of the pivots on its diagonal. Expects the `terms` of the
    /// first `pivots` rows to be loaded. Returns the largest magnitude in `U11`.
    #[inline(always)]
    pub(super) fn factor<const FUSED: bool, const ROWS: usize>(
        &mut self,
        square: &mut [S],
        pivots: usize,
        unknowns: &[u32],
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let stride = pivots.next_multiple_of(PADDING);
        let mut largest = 0.0_f64;
        let mut begin = 0;
        while begin < pivots {
            let end = pivots.min(begin + BLOCK);
            largest =
                largest.max(self.factor_block::<FUSED>(square, stride, (begin, end), unknowns, monitor)?);
            self.transpose(square, stride, (begin, end), pivots);
            if end < pivots {
                largest = largest.max(self.eliminate_block::<FUSED, ROWS>(square, (begin, end), pivots));
            }
            begin = end;
        }
        for begin in (0..pivots).step_by(BLOCK) {
            for column in begin + BLOCK..pivots {
                for row in begin..begin + BLOCK {
                    square[row + column * stride] = self.transposed[column + row * stride];
                }
            }
        }
        Ok(largest)
    }

    /// Elimination within the diagonal block, column after column.
    #[inline(always)]
    fn factor_block<const FUSED: bool>(
        &mut self,
        square: &mut [S],
        stride: usize,
        (begin, end): (usize, usize),
        unknowns: &[u32],
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let mut largest = 0.0_f64;
        let height = (end - begin).next_multiple_of(PADDING);
        for step in begin..end {
            let (done, rest) = square.split_at_mut((step + 1) * stride);
            let column = &mut done[step * stride + begin..step * stride + begin + height];
            let local = step - begin;
            let pivot = column[local];
            monitor.pivot(unknowns[step] as usize, pivot.magnitude(), self.terms[step])?;
            largest = largest.max(pivot.magnitude());
            let reciprocal = S::one() / pivot;
            self.reciprocals[step] = reciprocal;
            column[local] = reciprocal;
            // Rows up to the pivot get a factor of zero, so that whole tiles can be worked on.
            for (row, (factor, value)) in self.column[..height].iter_mut().zip(column).enumerate() {
                *factor = if row > local { *value * reciprocal } else { S::zero() };
                *value = if row > local { *factor } else { *value };
            }
            let from = (local + 1) / PADDING * PADDING;
            for (next, column) in rest.chunks_exact_mut(stride).enumerate().take(end - step - 1) {
                let column = &mut column[begin..begin + height];
                let upper = column[local];
                let row = local + 1 + next;
                let size = upper.magnitude();
                self.terms[begin + row] += self.column[row].magnitude() * size;
                largest = if size > largest { size } else { largest };
                for (values, factors) in
                    column[from..].chunks_exact_mut(PADDING).zip(self.column[from..].chunks_exact(PADDING))
                {
                    for lane in 0..PADDING {
                        values[lane] = S::multiply_add::<FUSED>(factors[lane], -upper, values[lane]);
                    }
                }
            }
        }
        Ok(largest)
    }

    /// Copies rows `begin..end` of U, as far as known, to the transpose; padding becomes zero.
    #[inline(always)]
    fn transpose(&mut self, square: &[S], stride: usize, (begin, end): (usize, usize), pivots: usize) {
        for row in begin..end {
            let line = &mut self.transposed[row * stride..(row + 1) * stride];
            for column in begin..pivots {
                line[column] = square[row + column * stride];
            }
            line[pivots..].fill(S::zero());
        }
    }

    /// Rows of U to the right of the block, columns of L below it, and what they do to the rest.
    #[inline(always)]
    fn eliminate_block<const FUSED: bool, const ROWS: usize>(
        &mut self,
        square: &mut [S],
        (begin, end): (usize, usize),
        pivots: usize,
    ) -> f64 {
        let stride = pivots.next_multiple_of(PADDING);
        let rows = stride - end;
        let (done, rest) = square.split_at_mut(end * stride);
        let block = &mut done[begin * stride..];
        let transposed = &mut self.transposed[begin * stride..end * stride];
        // The triangles are read where the panels are written, in other rows: take a copy.
        let mut triangle = [S::zero(); BLOCK * BLOCK];
        let width = end - begin;
        for column in 0..width {
            for row in column + 1..width {
                triangle[row + column * BLOCK] = transposed[begin + row + column * stride];
            }
        }
        let reciprocals = &self.reciprocals[begin..end];
        let lower = (&mut block[end..], stride);
        solve_block::<S, FUSED, ROWS>(lower, (&triangle, BLOCK), Some(reciprocals), (0, width), rows);
        for column in 0..width {
            for row in column + 1..width {
                triangle[row + column * BLOCK] = block[begin + row + column * stride];
            }
        }
        let upper = (&mut transposed[end..], stride);
        solve_block::<S, FUSED, ROWS>(upper, (&triangle, BLOCK), None, (0, width), rows);
        subtract_product::<S, FUSED, true, ROWS>(
            (&mut rest[end..], stride),
            (&block[end..], stride),
            (&transposed[end..], stride),
            (rows, pivots - end, width),
        );
        let panels = (&block[end..], &transposed[end..]);
        absolute_products(&mut self.terms[end..], panels, stride, (rows, width))
    }
}
