//! Solves with the factors, front after front, on a vector in the order of elimination. Knows where factors
//! lie, not how they were made.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Front, PADDING, Symbolic};
use crate::scalar::Scalar;

/// Columns of a panel that are read side by side.
const COLUMNS: usize = 4;

/// `x = U⁻¹ L⁻¹ x`; `front_vector` has room for the largest padded boundary.
#[inline(always)]
pub(super) fn solve<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    factors: &[S],
    x: &mut [S],
    front_vector: &mut [S],
) {
    for front in &symbolic.fronts {
        let (square, lower, _) = pieces(front, factors);
        let rows = &symbolic.boundaries[front.rows.clone()];
        let pivots = &mut x[front.first..front.first + front.pivots];
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate() {
            let known = pivots[step];
            for (value, &factor) in pivots[step + 1..].iter_mut().zip(&column[step + 1..]) {
                *value = S::multiply_add::<FUSED>(-known, factor, *value);
            }
        }
        let sums = &mut front_vector[..front.panel_stride()];
        sums.fill(S::zero());
        add_columns::<S, FUSED>(sums, lower, pivots);
        for (&row, &sum) in rows.iter().zip(&*sums) {
            x[row as usize] -= sum;
        }
    }
    for front in symbolic.fronts.iter().rev() {
        let (square, _, upper) = pieces(front, factors);
        gather(symbolic, front, x, front_vector);
        let pivots = &mut x[front.first..front.first + front.pivots];
        subtract_dots::<S, FUSED>(pivots, upper, &front_vector[..front.panel_stride()]);
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate().rev() {
            let known = pivots[step] * column[step];
            pivots[step] = known;
            for (value, &factor) in pivots[..step].iter_mut().zip(column) {
                *value = S::multiply_add::<FUSED>(-known, factor, *value);
            }
        }
    }
}

/// `x = L⁻ᵀ U⁻ᵀ x`.
#[inline(always)]
pub(super) fn solve_transposed<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    factors: &[S],
    x: &mut [S],
    front_vector: &mut [S],
) {
    for front in &symbolic.fronts {
        let (square, _, upper) = pieces(front, factors);
        let rows = &symbolic.boundaries[front.rows.clone()];
        let pivots = &mut x[front.first..front.first + front.pivots];
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate() {
            let (known, rest) = pivots.split_at_mut(step);
            rest[0] = subtract_dot::<S, FUSED>(rest[0], column, known) * column[step];
        }
        let sums = &mut front_vector[..front.panel_stride()];
        sums.fill(S::zero());
        add_columns::<S, FUSED>(sums, upper, pivots);
        for (&row, &sum) in rows.iter().zip(&*sums) {
            x[row as usize] -= sum;
        }
    }
    for front in symbolic.fronts.iter().rev() {
        let (square, lower, _) = pieces(front, factors);
        gather(symbolic, front, x, front_vector);
        let pivots = &mut x[front.first..front.first + front.pivots];
        subtract_dots::<S, FUSED>(pivots, lower, &front_vector[..front.panel_stride()]);
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate().rev() {
            let (own, known) = pivots[step..].split_at_mut(1);
            own[0] = subtract_dot::<S, FUSED>(own[0], &column[step + 1..], known);
        }
    }
}

#[inline(always)]
fn pieces<'a, S>(front: &Front, factors: &'a [S]) -> (&'a [S], &'a [S], &'a [S]) {
    let (square, panels) = factors[front.factor_range()].split_at(front.square_length());
    let (lower, upper) = panels.split_at(front.panel_length());
    (square, lower, upper)
}

#[inline(always)]
fn gather<S: Scalar>(symbolic: &Symbolic, front: &Front, x: &[S], front_vector: &mut [S]) {
    let rows = &symbolic.boundaries[front.rows.clone()];
    let (known, padding) = front_vector[..front.panel_stride()].split_at_mut(rows.len());
    for (value, &row) in known.iter_mut().zip(rows) {
        *value = x[row as usize];
    }
    padding.fill(S::zero());
}

/// `sums += P x`, with the columns of the panel in fours.
#[inline(always)]
fn add_columns<S: Scalar, const FUSED: bool>(sums: &mut [S], panel: &[S], x: &[S]) {
    let stride = sums.len();
    if stride == 0 {
        return;
    }
    let (fours, ones) = x.as_chunks::<COLUMNS>();
    let (panel_fours, panel_ones) = panel.split_at(fours.len() * COLUMNS * stride);
    for (x, columns) in fours.iter().zip(panel_fours.chunks_exact(COLUMNS * stride)) {
        let (a, rest) = columns.split_at(stride);
        let (b, rest) = rest.split_at(stride);
        let (c, d) = rest.split_at(stride);
        let panels = tiles(a).iter().zip(tiles(b)).zip(tiles(c)).zip(tiles(d));
        for (sums, (((a, b), c), d)) in tiles_mut(sums).iter_mut().zip(panels) {
            for i in 0..PADDING {
                let first = S::multiply_add::<FUSED>(x[0], a[i], sums[i]);
                let second = S::multiply_add::<FUSED>(x[1], b[i], first);
                let third = S::multiply_add::<FUSED>(x[2], c[i], second);
                sums[i] = S::multiply_add::<FUSED>(x[3], d[i], third);
            }
        }
    }
    for (&x, column) in ones.iter().zip(panel_ones.chunks_exact(stride)) {
        for (sums, column) in tiles_mut(sums).iter_mut().zip(tiles(column)) {
            for i in 0..PADDING {
                sums[i] = S::multiply_add::<FUSED>(x, column[i], sums[i]);
            }
        }
    }
}

/// `x -= Pᵀ v`, with the columns of the panel in fours.
#[inline(always)]
fn subtract_dots<S: Scalar, const FUSED: bool>(x: &mut [S], panel: &[S], vector: &[S]) {
    let stride = vector.len();
    if stride == 0 {
        return;
    }
    let (fours, ones) = x.as_chunks_mut::<COLUMNS>();
    let (panel_fours, panel_ones) = panel.split_at(fours.len() * COLUMNS * stride);
    for (x, columns) in fours.iter_mut().zip(panel_fours.chunks_exact(COLUMNS * stride)) {
        let (a, rest) = columns.split_at(stride);
        let (b, rest) = rest.split_at(stride);
        let (c, d) = rest.split_at(stride);
        let mut sums = [[S::zero(); PADDING]; COLUMNS];
        let panels = tiles(a).iter().zip(tiles(b)).zip(tiles(c)).zip(tiles(d));
        for (v, (((a, b), c), d)) in tiles(vector).iter().zip(panels) {
            for i in 0..PADDING {
                sums[0][i] = S::multiply_add::<FUSED>(v[i], a[i], sums[0][i]);
                sums[1][i] = S::multiply_add::<FUSED>(v[i], b[i], sums[1][i]);
                sums[2][i] = S::multiply_add::<FUSED>(v[i], c[i], sums[2][i]);
                sums[3][i] = S::multiply_add::<FUSED>(v[i], d[i], sums[3][i]);
            }
        }
        for (x, sums) in x.iter_mut().zip(sums) {
            *x -= (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }
    }
    for (x, column) in ones.iter_mut().zip(panel_ones.chunks_exact(stride)) {
        let mut sums = [S::zero(); PADDING];
        for (v, column) in tiles(vector).iter().zip(tiles(column)) {
            for i in 0..PADDING {
                sums[i] = S::multiply_add::<FUSED>(v[i], column[i], sums[i]);
            }
        }
        *x -= (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }
}

#[inline(always)]
fn subtract_dot<S: Scalar, const FUSED: bool>(from: S, left: &[S], right: &[S]) -> S {
    left.iter().zip(right).fold(from, |sum, (&left, &right)| S::multiply_add::<FUSED>(-left, right, sum))
}

#[inline(always)]
fn tiles<S>(slice: &[S]) -> &[[S; PADDING]] {
    slice.as_chunks::<PADDING>().0
}

#[inline(always)]
fn tiles_mut<S>(slice: &mut [S]) -> &mut [[S; PADDING]] {
    slice.as_chunks_mut::<PADDING>().0
}
