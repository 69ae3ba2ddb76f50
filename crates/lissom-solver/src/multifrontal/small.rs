//! Elimination of small fronts, pivot by pivot from all other rows, those above included (Gauss and Jordan). With
//! `A11` the pivots' square, `A12`, `A21` and `A22` the rest, a front becomes
//!
//! ```text
//! [A11⁻¹, A11⁻¹ A12; A21 A11⁻¹, A22 - A21 A11⁻¹ A12]
//! ```
//!
//! so that solves need products only, in which no number depends on another of the same front. Pivots, multipliers, the
//! contribution to the parent and the monitor are those of LU: only the stored factors differ. Numbers of rows are
//! compile-time constants, so that columns are a few registers each. Independent of the tree.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::Front;
use super::small_solves::with_rows;
use super::supernodes::MAX_SMALL;
use crate::report::{FactorError, Monitor};
use crate::scalar::{Scalar, array, array_mut};

/// Whether small fronts are eliminated here. Complex ones on x86 processors without AVX2 are eliminated like large ones: such
/// processors are rare, and the kernels take long to compile.
pub(super) const fn is_for<S: Scalar>(fused: bool) -> bool {
    fused || !S::COMPLEX || !cfg!(target_arch = "x86_64")
}

/// Number of the remaining pivots that are eliminated together: three, because most groups have a multiple of three unknowns,
/// or four if one would remain.
fn together(left: usize) -> usize {
    match left {
        1 | 2 | 5 => 1,
        4 | 8 => 4,
        _ => 3,
    }
}

/// Columns of the identity: a column begins at twice [`MAX_SMALL`] minus its index.
static UNIT: [f64; 4 * MAX_SMALL] = {
    let mut unit = [0.0; 4 * MAX_SMALL];
    unit[2 * MAX_SMALL] = 1.0;
    unit
};

/// Aligned to a cache line of the processor, so that each vector is within one line.
#[repr(align(64))]
pub(super) struct Aligned<T>(pub(super) T);

/// A front during elimination, with consecutive columns, each padded.
pub(super) struct SmallFront<S> {
    pub(super) matrix: Box<Aligned<[S; 2 * MAX_SMALL * (2 * MAX_SMALL + 1)]>>,
    /// By pivots, the columns of L and the rows of U, both in the order of the front's rows.
    lower: Box<Aligned<[S; 2 * MAX_SMALL * MAX_SMALL]>>,
    upper: Box<Aligned<[S; 2 * MAX_SMALL * MAX_SMALL]>>,
    reciprocals: [S; MAX_SMALL],
    /// Sum of the magnitudes of the terms of the diagonal, by row.
    pub(super) terms: [f64; 2 * MAX_SMALL],
    largest: f64,
}

impl<S: Scalar> SmallFront<S> {
    pub(super) fn new() -> Self {
        SmallFront {
            matrix: Box::new(Aligned([S::zero(); 2 * MAX_SMALL * (2 * MAX_SMALL + 1)])),
            lower: Box::new(Aligned([S::zero(); 2 * MAX_SMALL * MAX_SMALL])),
            upper: Box::new(Aligned([S::zero(); 2 * MAX_SMALL * MAX_SMALL])),
            reciprocals: [S::zero(); MAX_SMALL],
            terms: [0.0; 2 * MAX_SMALL],
            largest: 0.0,
        }
    }

    /// Completes a symmetric front from its lower triangle.
    #[inline(always)]
    pub(super) fn complete(&mut self, front: &Front) {
        let (pivots, stride) = (front.pivots, front.small_stride());
        for column in 1..pivots + front.boundary {
            for before in 0..column {
                self.matrix.0[column * stride + before] = self.matrix.0[before * stride + column];
            }
        }
    }

    /// Eliminates the pivots, and writes the factors for solves and the contribution to the parent. Returns the largest
    /// magnitude in U.
    #[inline(always)]
    pub(super) fn eliminate<V: pulp::Simd>(
        &mut self,
        simd: V,
        (front, unknowns): (&Front, &[u32]),
        (pieces, contribution): (&mut [S], &mut [S]),
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let stride = front.small_stride();
        match stride {
            16 => simd.vectorize(Elimination::<S, 16> { work: self, front }),
            24 => simd.vectorize(Elimination::<S, 24> { work: self, front }),
            32 => simd.vectorize(Elimination::<S, 32> { work: self, front }),
            _ => simd.vectorize(Elimination::<S, { 2 * MAX_SMALL }> { work: self, front }),
        }
        simd.vectorize(Storage { work: self, front, pieces, contribution });
        let mut largest = self.largest;
        for (step, &unknown) in unknowns.iter().enumerate() {
            let pivot = self.upper.0[step * stride + step];
            let pivot = monitor.pivot(unknown as usize, pivot, self.terms[step])?;
            largest = if pivot > largest { pivot } else { largest };
        }
        Ok(largest)
    }

    /// Rows of pivots remain as in U, and are divided by their pivots when they are stored.
    #[inline(always)]
    fn eliminate_rows<const FUSED: bool, const ROWS: usize>(&mut self, front: &Front) {
        let mut step = 0;
        while step < front.pivots {
            let count = together(front.pivots - step);
            match count {
                1 => self.eliminate_together::<FUSED, ROWS, 1>(front, step),
                3 => self.eliminate_together::<FUSED, ROWS, 3>(front, step),
                _ => self.eliminate_together::<FUSED, ROWS, 4>(front, step),
            }
            step += count;
        }
    }

    /// Eliminates `COUNT` pivots from `first` on.
    #[inline(always)]
    fn eliminate_together<const FUSED: bool, const ROWS: usize, const COUNT: usize>(
        &mut self,
        front: &Front,
        first: usize,
    ) {
        let (columns, _) = self.matrix.0.as_chunks_mut::<ROWS>();
        let columns = &mut columns[..front.pivots + front.boundary];
        let uppers: &mut [[S; ROWS]; COUNT] = array_mut(self.upper.0.as_chunks_mut::<ROWS>().0, first);
        let lowers: &mut [[S; ROWS]; COUNT] = array_mut(self.lower.0.as_chunks_mut::<ROWS>().0, first);
        let (corner, reciprocals) = factor_corner::<S, FUSED, COUNT>(&std::array::from_fn(|column| {
            *array::<S, COUNT>(&columns[first + column], first)
        }));
        *array_mut(&mut self.reciprocals, first) = reciprocals;
        let mut factors = [[S::zero(); ROWS]; COUNT];
        for q in 0..COUNT {
            let mut column = columns[first + q];
            for before in 0..q {
                subtract::<S, FUSED, ROWS>(&mut column, &factors[before], corner[q][before]);
            }
            let unit: &[f64; ROWS] = array(&UNIT, 2 * MAX_SMALL - first - q);
            for i in 0..ROWS {
                factors[q][i] = column[i] * (reciprocals[q] * S::from_real(1.0 - unit[i]));
            }
            lowers[q] = factors[q];
        }
        for (j, column) in columns.iter_mut().enumerate() {
            let mut rows = [S::zero(); COUNT];
            for q in 0..COUNT {
                rows[q] = column[first + q];
                for before in 0..q {
                    rows[q] = S::multiply_add::<FUSED>(-rows[before], corner[before][q], rows[q]);
                }
                uppers[q][j] = rows[q];
            }
            let mut sums = *column;
            for q in 0..COUNT {
                subtract::<S, FUSED, ROWS>(&mut sums, &factors[q], rows[q]);
            }
            *column = sums;
        }
        // The transformed columns of the identity.
        for q in 0..COUNT {
            let unit: &[f64; ROWS] = array(&UNIT, 2 * MAX_SMALL - first - q);
            let mut column = [S::zero(); ROWS];
            for i in 0..ROWS {
                column[i] = S::from_real(unit[i]) - factors[q][i];
            }
            let mut rows = [S::zero(); COUNT];
            for later in q + 1..COUNT {
                rows[later] = -corner[q][later];
                for between in q + 1..later {
                    rows[later] =
                        S::multiply_add::<FUSED>(-rows[between], corner[between][later], rows[later]);
                }
                subtract::<S, FUSED, ROWS>(&mut column, &factors[later], rows[later]);
            }
            columns[first + q] = column;
        }
    }

    /// Adds to the terms what the pivots have subtracted from every diagonal; records the largest magnitude in U and the
    /// pivots.
    #[inline(always)]
    fn sum_up<const ROWS: usize>(&mut self, front: &Front) {
        let size_of_front = front.pivots + front.boundary;
        let mut terms: [f64; ROWS] = *array(&self.terms, 0);
        let mut largest = [0.0_f64; ROWS];
        let uppers = self.upper.0.as_chunks::<ROWS>().0.iter();
        for (step, (upper, lower)) in
            uppers.zip(self.lower.0.as_chunks::<ROWS>().0).enumerate().take(front.pivots)
        {
            for i in 0..ROWS {
                // Data beyond the front belong to earlier fronts.
                let counts = i > step && i < size_of_front;
                let size = if counts { upper[i].magnitude() } else { 0.0 };
                terms[i] += if counts { lower[i].magnitude() * size } else { 0.0 };
                largest[i] = if size > largest[i] { size } else { largest[i] };
            }
        }
        *array_mut(&mut self.terms, 0) = terms;
        self.largest = largest.iter().fold(0.0, |largest, &size| if size > largest { size } else { largest });
    }

    /// Writes the factors for solves, and the contribution to the parent.
    #[inline(always)]
    fn store(&self, front: &Front, pieces: &mut [S], contribution: &mut [S]) {
        let (pivots, boundary, rows) = (front.pivots, front.boundary, front.small_stride());
        let (of_pivots, of_boundary) = self.matrix.0.split_at(pivots * rows);
        let (below_pivots, left) = (&self.matrix.0[pivots..], &of_boundary[pivots..]);
        let factors = &self.reciprocals;
        let (lower, upper) = (front.square_length(), front.square_length() + front.panel_length());
        let scaled = front.square_stride();
        // Last rows extend into the data written next.
        with_rows!(scaled, copy_scaled::<S>(&mut pieces[..], (pivots, pivots), (of_pivots, rows), factors));
        with_rows!(
            front.panel_stride(),
            copy_negative::<S>(&mut pieces[lower..], (boundary, pivots), (below_pivots, rows))
        );
        if front.panels == 2 {
            let to = &mut pieces[upper..];
            with_rows!(scaled, copy_scaled::<S>(to, (pivots, boundary), (of_boundary, rows), factors));
        }
        with_rows!(front.panel_stride(), copy::<S>(contribution, left, rows));
    }
}

/// A small front with columns of `ROWS` numbers. Compiled once for LU and LDLᵀ.
struct Elimination<'a, S, const ROWS: usize> {
    work: &'a mut SmallFront<S>,
    front: &'a Front,
}

impl<S: Scalar, const ROWS: usize> pulp::WithSimd for Elimination<'_, S, ROWS> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        let Elimination { work, front } = self;
        if V::F64_LANES >= 4 {
            work.eliminate_rows::<true, ROWS>(front);
        } else {
            work.eliminate_rows::<false, ROWS>(front);
        }
        work.sum_up::<ROWS>(front);
    }
}

/// Storage of a small front. Compiled once for columns of all lengths.
struct Storage<'a, S> {
    work: &'a SmallFront<S>,
    front: &'a Front,
    pieces: &'a mut [S],
    contribution: &'a mut [S],
}

impl<S: Scalar> pulp::WithSimd for Storage<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        self.work.store(self.front, self.pieces, self.contribution);
    }
}

/// LU of a few columns; the reciprocals of its pivots.
#[inline(always)]
fn factor_corner<S: Scalar, const FUSED: bool, const COUNT: usize>(
    columns: &[[S; COUNT]; COUNT],
) -> ([[S; COUNT]; COUNT], [S; COUNT]) {
    let mut columns = *columns;
    let mut reciprocals = [S::zero(); COUNT];
    for step in 0..COUNT {
        reciprocals[step] = S::one() / columns[step][step];
        for row in step + 1..COUNT {
            columns[step][row] *= reciprocals[step];
            for column in step + 1..COUNT {
                columns[column][row] = S::multiply_add::<FUSED>(
                    -columns[step][row],
                    columns[column][step],
                    columns[column][row],
                );
            }
        }
    }
    (columns, reciprocals)
}

/// Subtracts a multiple of a column from another.
#[inline(always)]
fn subtract<S: Scalar, const FUSED: bool, const ROWS: usize>(
    column: &mut [S; ROWS],
    other: &[S; ROWS],
    factor: S,
) {
    for i in 0..ROWS {
        column[i] = S::multiply_add::<FUSED>(other[i], -factor, column[i]);
    }
}

/// Copies the first rows of columns, each multiplied by a number of its own, to columns `stride` apart.
#[inline(always)]
fn copy_scaled<S: Scalar, const ROWS: usize>(
    to: &mut [S],
    (stride, columns): (usize, usize),
    (from, from_stride): (&[S], usize),
    factors: &[S; MAX_SMALL],
) {
    let factors: [S; ROWS] = *array(factors, 0);
    for column in 0..columns {
        let from: &[S; ROWS] = array(from, column * from_stride);
        let to: &mut [S; ROWS] = array_mut(to, column * stride);
        for i in 0..ROWS {
            to[i] = from[i] * factors[i];
        }
    }
}

/// Copies the first rows of columns with the opposite sign.
#[inline(always)]
fn copy_negative<S: Scalar, const ROWS: usize>(
    to: &mut [S],
    (stride, columns): (usize, usize),
    (from, from_stride): (&[S], usize),
) {
    for column in 0..columns {
        let from: &[S; ROWS] = array(from, column * from_stride);
        *array_mut(to, column * stride) = from.map(|value| -value);
    }
}

/// Copies the first rows of columns.
#[inline(always)]
fn copy<S: Scalar, const ROWS: usize>(to: &mut [S], from: &[S], stride: usize) {
    for (column, to) in to.as_chunks_mut::<ROWS>().0.iter_mut().enumerate() {
        *to = *array(from, column * stride);
    }
}
