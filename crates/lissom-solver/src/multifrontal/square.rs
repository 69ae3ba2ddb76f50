//! LU without pivoting of the square of a front, with the monitor of its pivots. Independent of the panels below and
//! of the tree.
//!
//! Blocks of four columns are eliminated within blocks of [`BLOCK`], both in the same way: factorise the diagonal
//! block, solve for the rows of L below it and for the columns of U to its right, subtract their product from the
//! rest. `Uᵀ` is stored beside the square, so that both solves and the product access columns.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use pulp::Simd;

use super::fronts::PADDING;
use super::kernels::{BLOCK, BlockSolution, Product, absolute_products, subtract_product};
use crate::report::{FactorError, Monitor};
use crate::scalar::{Scalar, array, array_mut};

/// Columns of the inner blocks.
const WIDTH: usize = PADDING;

/// Memory for the factorisation of any front's square.
pub(super) struct SquareWork<S> {
    /// `U11ᵀ` without its diagonal, columns of the same stride as those of the square; zero above the diagonal.
    pub(super) transposed: Vec<S>,
    /// Reciprocals of the pivots.
    pub(super) reciprocals: Vec<S>,
    /// Sum of the magnitudes of the terms of the diagonal, by row of the front.
    pub(super) terms: Vec<f64>,
}

impl<S: Scalar> SquareWork<S> {
    pub(super) fn new(pivots: usize) -> Self {
        let stride = pivots.next_multiple_of(PADDING);
        SquareWork {
            transposed: vec![S::zero(); stride * stride],
            reciprocals: vec![S::zero(); stride],
            terms: vec![0.0; stride],
        }
    }

    /// Replaces the square by `L11` and `U11`, with the reciprocals of the pivots on its diagonal. Expects the
    /// `terms` of the rows. Returns the largest magnitude in `U11`.
    #[inline(always)]
    pub(super) fn factor<V: Simd, const FUSED: bool, const ROWS: usize>(
        &mut self,
        simd: V,
        square: &mut [S],
        unknowns: &[u32],
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let pivots = unknowns.len();
        let stride = pivots.next_multiple_of(PADDING);
        let mut largest = 0.0_f64;
        let mut begin = 0;
        while begin < pivots {
            let end = pivots.min(begin + BLOCK);
            self.factor_block::<FUSED>(square, stride, (begin, end));
            if end < pivots {
                self.eliminate_block::<V, FUSED, ROWS>(simd, square, (begin, end), pivots);
            }
            let from = begin * stride + begin;
            let panels = (&square[from..], &self.transposed[from..]);
            let shape = (stride - begin, end - begin);
            largest = largest.max(absolute_products(&mut self.terms[begin..], panels, stride, shape));
            begin = end;
        }
        self.copy_upper(square, stride, pivots);
        // Only now, so that the elimination is not delayed: later operations do not change earlier pivots.
        for (step, &unknown) in unknowns.iter().enumerate() {
            let diagonal = &mut square[step * stride + step];
            let pivot = monitor.pivot(unknown as usize, *diagonal, self.terms[step])?;
            largest = if pivot > largest { pivot } else { largest };
            *diagonal = self.reciprocals[step];
        }
        Ok(largest)
    }

    /// Elimination within a diagonal block, four columns at a time.
    #[inline(always)]
    fn factor_block<const FUSED: bool>(
        &mut self,
        square: &mut [S],
        stride: usize,
        (begin, end): (usize, usize),
    ) {
        let bottom = end.next_multiple_of(PADDING);
        let mut first = begin;
        while first < end {
            let width = WIDTH.min(end - first);
            let block = self.factor_corner::<FUSED>(square, stride, first, width);
            let next = first + WIDTH;
            if next < end {
                let reciprocals: [S; WIDTH] = *array(&self.reciprocals, first);
                for row in (next..bottom).step_by(PADDING) {
                    solve_lower::<S, FUSED>(square, stride, (row, first), &block, &reciprocals);
                    self.solve_upper::<FUSED>(square, stride, (first, row), &block, end);
                }
                let (done, rest) = square.split_at_mut(next * stride);
                subtract_product::<S, FUSED, true, PADDING>(
                    (&mut rest[next..], stride),
                    (&done[first * stride + next..], stride),
                    (&self.transposed[first * stride + next..], stride),
                    (bottom - next, end - next, WIDTH),
                );
            }
            first = next;
        }
    }

    /// LU of the four columns and rows from `first` on; missing columns are those of the identity.
    #[inline(always)]
    fn factor_corner<const FUSED: bool>(
        &mut self,
        square: &mut [S],
        stride: usize,
        first: usize,
        width: usize,
    ) -> [[S; WIDTH]; WIDTH] {
        let mut block = [[S::zero(); WIDTH]; WIDTH];
        for column in 0..WIDTH {
            block[column][column] = S::one();
            if column < width {
                block[column] = *array(square, (first + column) * stride + first);
            }
        }
        let mut reciprocals = [S::zero(); WIDTH];
        for step in 0..WIDTH {
            let reciprocal = S::one() / block[step][step];
            reciprocals[step] = reciprocal;
            for row in step + 1..WIDTH {
                block[step][row] *= reciprocal;
            }
            for column in step + 1..WIDTH {
                let upper = -block[column][step];
                for row in step + 1..WIDTH {
                    block[column][row] =
                        S::multiply_add::<FUSED>(block[step][row], upper, block[column][row]);
                }
            }
        }
        for column in 0..width {
            let step = first + column;
            self.reciprocals[step] = reciprocals[column];
            *array_mut(square, step * stride + first) = block[column];
            let line = &mut self.transposed[step * stride..(step + 1) * stride];
            line[..first].fill(S::zero());
            let line: &mut [S; WIDTH] = array_mut(line, first);
            for row in 0..WIDTH {
                line[row] = if row > column { block[row][column] } else { S::zero() };
            }
        }
        block
    }

    /// Four columns of U, from `column` on, in the rows of a block.
    #[inline(always)]
    fn solve_upper<const FUSED: bool>(
        &mut self,
        square: &[S],
        stride: usize,
        (first, column): (usize, usize),
        block: &[[S; WIDTH]; WIDTH],
        end: usize,
    ) {
        let mut panel = [[S::zero(); PADDING]; WIDTH];
        for lane in 0..PADDING.min(end - column) {
            let rows: &[S; WIDTH] = array(square, (column + lane) * stride + first);
            for row in 0..WIDTH {
                panel[row][lane] = rows[row];
            }
        }
        for row in 0..WIDTH {
            for before in 0..row {
                let factor = -block[before][row];
                for lane in 0..PADDING {
                    panel[row][lane] =
                        S::multiply_add::<FUSED>(panel[before][lane], factor, panel[row][lane]);
                }
            }
            *array_mut::<S, PADDING>(&mut self.transposed, (first + row) * stride + column) = panel[row];
        }
    }

    /// Computes the rows of U right of the block and the columns of L below it, and updates the rest.
    #[inline(always)]
    fn eliminate_block<V: Simd, const FUSED: bool, const ROWS: usize>(
        &mut self,
        simd: V,
        square: &mut [S],
        (begin, end): (usize, usize),
        pivots: usize,
    ) {
        let stride = pivots.next_multiple_of(PADDING);
        let rows = stride - end;
        for row in begin..end {
            let line = &mut self.transposed[row * stride..(row + 1) * stride];
            for column in end..pivots {
                line[column] = square[row + column * stride];
            }
            line[pivots..].fill(S::zero());
        }
        let (done, rest) = square.split_at_mut(end * stride);
        let block = &mut done[begin * stride..];
        let transposed = &mut self.transposed[begin * stride..end * stride];
        // The triangles are read from the array to which the panels are written, in other rows: a copy is needed.
        let mut triangle = [S::zero(); BLOCK * BLOCK];
        let width = end - begin;
        for (column, copy) in triangle.chunks_exact_mut(BLOCK).enumerate().take(width) {
            copy[..width].copy_from_slice(&transposed[column * stride + begin..][..width]);
        }
        let reciprocals = &self.reciprocals[begin..end];
        simd.vectorize(BlockSolution::<S, FUSED, ROWS> {
            x: (&mut block[end..], stride),
            triangle: (&triangle, BLOCK),
            reciprocals: Some(reciprocals),
            columns: (0, width),
            rows,
        });
        for (column, copy) in triangle.chunks_exact_mut(BLOCK).enumerate().take(width) {
            copy[..width].copy_from_slice(&block[column * stride + begin..][..width]);
        }
        simd.vectorize(BlockSolution::<S, FUSED, ROWS> {
            x: (&mut transposed[end..], stride),
            triangle: (&triangle, BLOCK),
            reciprocals: None,
            columns: (0, width),
            rows,
        });
        simd.vectorize(Product::<S, FUSED, true, ROWS> {
            c: (&mut rest[end..], stride),
            a: (&block[end..], stride),
            b: (&transposed[end..], stride),
            shape: (rows, pivots - end, width),
        });
    }

    /// Writes U right of the inner diagonal blocks back to the square.
    #[inline(always)]
    fn copy_upper(&self, square: &mut [S], stride: usize, pivots: usize) {
        for first in (0..pivots).step_by(WIDTH) {
            for column in first + WIDTH..pivots {
                let rows: &mut [S; WIDTH] = array_mut(square, column * stride + first);
                for row in 0..WIDTH {
                    rows[row] = self.transposed[(first + row) * stride + column];
                }
            }
        }
    }
}

/// Four rows of L, from `row` on, in the columns of a block.
#[inline(always)]
fn solve_lower<S: Scalar, const FUSED: bool>(
    square: &mut [S],
    stride: usize,
    (row, first): (usize, usize),
    block: &[[S; WIDTH]; WIDTH],
    reciprocals: &[S; WIDTH],
) {
    let mut panel = [[S::zero(); PADDING]; WIDTH];
    for column in 0..WIDTH {
        let place: &mut [S; PADDING] = array_mut(square, (first + column) * stride + row);
        panel[column] = *place;
        for before in 0..column {
            let factor = -block[column][before];
            for lane in 0..PADDING {
                panel[column][lane] =
                    S::multiply_add::<FUSED>(panel[before][lane], factor, panel[column][lane]);
            }
        }
        for lane in 0..PADDING {
            panel[column][lane] *= reciprocals[column];
        }
        *place = panel[column];
    }
}
