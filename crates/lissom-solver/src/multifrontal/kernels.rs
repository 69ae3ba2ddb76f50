//! Dense kernels on column-major panels: products `A Bᵀ`, triangular solves from the right, a small LU. Written as
//! loops over fixed-size arrays, which the compiler turns into vector instructions of the processor to which the
//! caller has been dispatched. Independent of fronts.
//!
//! A panel is a slice and a stride: column `j` begins at `j * stride`. `FUSED` as in `multiply_add`; `ROWS` is the height
//! of the tiles, a multiple of [`PADDING`].

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use pulp::{Simd, WithSimd};

use super::fronts::PADDING;
use crate::scalar::{Scalar, array, array_mut};

/// Columns of a tile of a product: with two vectors of rows, twelve sums in sixteen or more registers.
const PRODUCT_COLUMNS: usize = 6;
/// Columns of a tile of a triangular solve.
const SOLVE_COLUMNS: usize = 4;
/// Height of the tiles between those of `ROWS` rows and the lowest ones.
const HALF_TILE: usize = 2 * PADDING;
/// Columns eliminated before the rest of a panel is updated. A multiple of [`PADDING`].
pub(super) const BLOCK: usize = 32;

#[inline(always)]
fn strip<S: Scalar, const FUSED: bool, const ADD: bool, const ROWS: usize, const COLUMNS: usize>(
    (c, c_stride): (&mut [S], usize),
    a: (&[S], usize),
    b: (&[S], usize),
    depth: usize,
) {
    let sums = S::tile::<FUSED, ROWS, COLUMNS>(a, b, depth);
    for (j, sums) in sums.iter().enumerate() {
        let column: &mut [S; ROWS] = array_mut(c, j * c_stride);
        for i in 0..ROWS {
            column[i] = if ADD { column[i] - sums[i] } else { -sums[i] };
        }
    }
}

/// As many strips of `COLUMNS` columns as fit from `column` on; returns the first remaining column.
#[inline(always)]
fn strips<S: Scalar, const FUSED: bool, const ADD: bool, const ROWS: usize, const COLUMNS: usize>(
    (c, c_stride): (&mut [S], usize),
    (a, a_stride): (&[S], usize),
    (b, b_stride): (&[S], usize),
    (rows, columns, depth): (usize, usize, usize),
    mut column: usize,
) -> usize {
    while columns - column >= COLUMNS {
        let b = (&b[column..], b_stride);
        let mut row = 0;
        while row + ROWS <= rows {
            let c = (&mut c[row + column * c_stride..], c_stride);
            strip::<S, FUSED, ADD, ROWS, COLUMNS>(c, (&a[row..], a_stride), b, depth);
            row += ROWS;
        }
        while !S::COMPLEX && row + HALF_TILE <= rows {
            let c = (&mut c[row + column * c_stride..], c_stride);
            strip::<S, FUSED, ADD, HALF_TILE, COLUMNS>(c, (&a[row..], a_stride), b, depth);
            row += HALF_TILE;
        }
        while row < rows {
            let c = (&mut c[row + column * c_stride..], c_stride);
            strip::<S, FUSED, ADD, PADDING, COLUMNS>(c, (&a[row..], a_stride), b, depth);
            row += PADDING;
        }
        column += COLUMNS;
    }
    column
}

/// [`subtract_product`], compiled once for all callers.
pub(super) struct Product<'a, S, const FUSED: bool, const ADD: bool, const ROWS: usize> {
    pub(super) c: (&'a mut [S], usize),
    pub(super) a: (&'a [S], usize),
    pub(super) b: (&'a [S], usize),
    pub(super) shape: (usize, usize, usize),
}

impl<S: Scalar, const FUSED: bool, const ADD: bool, const ROWS: usize> WithSimd
    for Product<'_, S, FUSED, ADD, ROWS>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(self, _: V) {
        subtract_product::<S, FUSED, ADD, ROWS>(self.c, self.a, self.b, self.shape);
    }
}

/// `C -= A Bᵀ` with `ADD`, `C = -A Bᵀ` without, if `C` has `rows` (padded) times `columns` entries and `A` and `B`
/// have `depth` columns.
#[inline(always)]
pub(super) fn subtract_product<S: Scalar, const FUSED: bool, const ADD: bool, const ROWS: usize>(
    (c, c_stride): (&mut [S], usize),
    a: (&[S], usize),
    b: (&[S], usize),
    shape: (usize, usize, usize),
) {
    let done = strips::<S, FUSED, ADD, ROWS, PRODUCT_COLUMNS>((&mut *c, c_stride), a, b, shape, 0);
    let done = strips::<S, FUSED, ADD, ROWS, 3>((&mut *c, c_stride), a, b, shape, done);
    strips::<S, FUSED, ADD, ROWS, 1>((c, c_stride), a, b, shape, done);
}

/// Replaces columns `first..first + COLUMNS` of `X` by those of `X R⁻¹`, for one tile of rows, after the columns
/// before, from `begin` on.
#[inline(always)]
fn solve_tile<S: Scalar, const FUSED: bool, const ROWS: usize, const COLUMNS: usize>(
    (x, x_stride): (&mut [S], usize),
    (triangle, t_stride): (&[S], usize),
    reciprocals: Option<&[S]>,
    begin: usize,
    first: usize,
) {
    let done = (&x[begin * x_stride..], x_stride);
    let factors = (&triangle[begin * t_stride + first..], t_stride);
    let sums = S::tile::<FUSED, ROWS, COLUMNS>(done, factors, first - begin);
    let mut block = [[S::zero(); ROWS]; COLUMNS];
    for j in 0..COLUMNS {
        let column: &[S; ROWS] = array(x, (first + j) * x_stride);
        for i in 0..ROWS {
            block[j][i] = column[i] - sums[j][i];
        }
    }
    for j in 0..COLUMNS {
        for q in 0..j {
            let factor = -triangle[first + j + (first + q) * t_stride];
            for i in 0..ROWS {
                block[j][i] = S::multiply_add::<FUSED>(block[q][i], factor, block[j][i]);
            }
        }
        if let Some(reciprocals) = reciprocals {
            let factor = reciprocals[first + j];
            for i in 0..ROWS {
                block[j][i] *= factor;
            }
        }
        *array_mut::<S, ROWS>(x, (first + j) * x_stride) = block[j];
    }
}

#[inline(always)]
fn solve_columns<S: Scalar, const FUSED: bool, const ROWS: usize>(
    (x, x_stride): (&mut [S], usize),
    triangle: (&[S], usize),
    reciprocals: Option<&[S]>,
    (begin, end): (usize, usize),
) {
    let mut first = begin;
    while first + SOLVE_COLUMNS <= end {
        let x = (&mut *x, x_stride);
        solve_tile::<S, FUSED, ROWS, SOLVE_COLUMNS>(x, triangle, reciprocals, begin, first);
        first += SOLVE_COLUMNS;
    }
    while first + 2 <= end {
        solve_tile::<S, FUSED, ROWS, 2>((&mut *x, x_stride), triangle, reciprocals, begin, first);
        first += 2;
    }
    if first < end {
        solve_tile::<S, FUSED, ROWS, 1>((&mut *x, x_stride), triangle, reciprocals, begin, first);
    }
}

/// `X = X R⁻¹` in some columns of a panel of `rows` (padded) rows, with `Rᵀ` the lower triangle of the square
/// `triangle`, its diagonal given by its reciprocals, or one. Compiled once for all callers.
pub(super) struct BlockSolution<'a, S, const FUSED: bool, const ROWS: usize> {
    pub(super) x: (&'a mut [S], usize),
    pub(super) triangle: (&'a [S], usize),
    pub(super) reciprocals: Option<&'a [S]>,
    /// The first column, and the one after the last.
    pub(super) columns: (usize, usize),
    pub(super) rows: usize,
}

impl<S: Scalar, const FUSED: bool, const ROWS: usize> WithSimd for BlockSolution<'_, S, FUSED, ROWS> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: Simd>(self, _: V) {
        solve_block::<S, FUSED, ROWS>(self.x, self.triangle, self.reciprocals, self.columns, self.rows);
    }
}

#[inline(always)]
fn solve_block<S: Scalar, const FUSED: bool, const ROWS: usize>(
    (x, x_stride): (&mut [S], usize),
    triangle: (&[S], usize),
    reciprocals: Option<&[S]>,
    (begin, end): (usize, usize),
    rows: usize,
) {
    let mut row = 0;
    while row + ROWS <= rows {
        let x = (&mut x[row..], x_stride);
        solve_columns::<S, FUSED, ROWS>(x, triangle, reciprocals, (begin, end));
        row += ROWS;
    }
    while !S::COMPLEX && row + HALF_TILE <= rows {
        let x = (&mut x[row..], x_stride);
        solve_columns::<S, FUSED, HALF_TILE>(x, triangle, reciprocals, (begin, end));
        row += HALF_TILE;
    }
    while row < rows {
        let x = (&mut x[row..], x_stride);
        solve_columns::<S, FUSED, PADDING>(x, triangle, reciprocals, (begin, end));
        row += PADDING;
    }
}

/// `X = X R⁻¹` for a whole panel of `columns` columns, block by block.
#[inline(always)]
pub(super) fn solve_panel<S: Scalar, V: Simd, const FUSED: bool, const ROWS: usize>(
    simd: V,
    (x, x_stride): (&mut [S], usize),
    (triangle, t_stride): (&[S], usize),
    reciprocals: Option<&[S]>,
    columns: usize,
    rows: usize,
) {
    if rows == 0 {
        return;
    }
    let mut begin = 0;
    while begin < columns {
        let end = columns.min(begin + BLOCK);
        if begin > 0 {
            let (done, rest) = x.split_at_mut(begin * x_stride);
            simd.vectorize(Product::<S, FUSED, true, ROWS> {
                c: (rest, x_stride),
                a: (done, x_stride),
                b: (&triangle[begin..], t_stride),
                shape: (rows, end - begin, begin),
            });
        }
        simd.vectorize(BlockSolution::<S, FUSED, ROWS> {
            x: (&mut *x, x_stride),
            triangle: (triangle, t_stride),
            reciprocals,
            columns: (begin, end),
            rows,
        });
        begin = end;
    }
}

/// `terms[i] += Σ_j |L[i, j] U[i, j]|` over two panels of the same shape, and the largest `|U[i, j]|`.
#[inline(always)]
pub(super) fn absolute_products<S: Scalar>(
    terms: &mut [f64],
    (lower, upper): (&[S], &[S]),
    stride: usize,
    (rows, columns): (usize, usize),
) -> f64 {
    let mut largest = [0.0_f64; PADDING];
    let mut row = 0;
    while row < rows {
        let mut sums = [0.0_f64; PADDING];
        for column in 0..columns {
            let left: &[S; PADDING] = array(lower, row + column * stride);
            let right: &[S; PADDING] = array(upper, row + column * stride);
            for i in 0..PADDING {
                let size = right[i].magnitude();
                sums[i] += left[i].magnitude() * size;
                largest[i] = if size > largest[i] { size } else { largest[i] };
            }
        }
        for (term, sum) in terms[row..].iter_mut().zip(sums) {
            *term += sum;
        }
        row += PADDING;
    }
    largest.iter().fold(0.0, |largest, &lane| largest.max(lane))
}
