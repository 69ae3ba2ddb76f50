//! Solves with the factors, front by front, on a vector in the order of elimination. Independent of the
//! factorisation.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Front, PADDING, Part, Symbolic, padded};
use super::{small, small_solves};
use crate::scalar::{Scalar, array, array_mut};

/// Columns of a panel that are read side by side.
const COLUMNS: usize = 4;

/// Factors of fewer bytes than this remain in the processor's own cache.
const NEAR: usize = 1 << 20;
/// Distance, in fronts, between the present front and the one whose factors are prefetched.
const AHEAD: usize = 3;

/// Reads one number of every cache line, so that the lines are in the cache when they are needed: nothing depends on
/// these reads, whereas the numbers of a front depend on each other.
#[inline(always)]
fn fetch<S: Scalar>(factors: &[S]) {
    for line in factors.chunks(64 / size_of::<S>()) {
        std::hint::black_box(line[0]);
    }
}

/// Storage for the pivots and for the boundary of any one front of a part, padded.
pub(super) struct FrontVectors<S> {
    pub(super) pivots: Vec<S>,
    pub(super) boundary: Vec<S>,
}

impl<S: Scalar> FrontVectors<S> {
    pub(super) fn new(part: &Part) -> Self {
        FrontVectors {
            pivots: vec![S::zero(); padded(part.largest_pivots)],
            boundary: vec![S::zero(); padded(part.largest_boundary)],
        }
    }
}

/// `x = L⁻¹ x` in a part, with `x` in its steps.
#[inline(always)]
pub(super) fn forward<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    factors: &[S],
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    let far = size_of_val(factors) > NEAR;
    let fronts = &symbolic.fronts[part.fronts.clone()];
    for (index, front) in fronts.iter().enumerate() {
        if far && let Some(next) = fronts.get(index + AHEAD) {
            let (square, lower, _) = pieces(next, factors);
            fetch(if next.is_small() { &[] } else { square });
            fetch(lower);
        }
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (_, lower, _) = small_solves::pieces(front, factors);
            small_solves::forward::<S, FUSED>((symbolic, part), front, lower, x);
            continue;
        }
        let (square, lower, _) = pieces(front, factors);
        let pivots = &mut vectors.pivots[..front.square_stride()];
        let place = &mut x[part.steps_of(front)];
        pivots[..front.pivots].copy_from_slice(place);
        solve_lower::<S, FUSED>(pivots, square, front.pivots);
        place.copy_from_slice(&pivots[..front.pivots]);
        let sums = &mut vectors.boundary[..front.panel_stride()];
        sums.fill(S::zero());
        add_columns::<S, FUSED>(sums, lower, place);
        for (&row, &sum) in symbolic.places[front.rows.clone()].iter().zip(&*sums) {
            x[row as usize] -= sum;
        }
    }
}

/// `x = U⁻¹ x` in a part.
#[inline(always)]
pub(super) fn backward<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    factors: &[S],
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    let far = size_of_val(factors) > NEAR;
    let fronts = &symbolic.fronts[part.fronts.clone()];
    for (index, front) in fronts.iter().enumerate().rev() {
        if far && let Some(next) = index.checked_sub(AHEAD) {
            let (square, _, upper) = pieces(&fronts[next], factors);
            fetch(square);
            fetch(upper);
        }
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (square, _, upper) = small_solves::pieces(front, factors);
            small_solves::backward::<S, FUSED, false>(
                (symbolic, part),
                front,
                (square, upper),
                x,
                &mut vectors.boundary,
            );
            continue;
        }
        let (square, _, upper) = pieces(front, factors);
        gather(symbolic, front, x, &mut vectors.boundary);
        let pivots = &mut vectors.pivots[..front.square_stride()];
        let place = &mut x[part.steps_of(front)];
        pivots[..front.pivots].copy_from_slice(place);
        subtract_dots::<S, FUSED>(
            &mut pivots[..front.pivots],
            upper,
            &vectors.boundary[..front.panel_stride()],
        );
        solve_upper::<S, FUSED>(pivots, square, front.pivots);
        place.copy_from_slice(&pivots[..front.pivots]);
    }
}

/// `x = L11⁻¹ x` for a padded vector, four columns at a time.
#[inline(always)]
fn solve_lower<S: Scalar, const FUSED: bool>(x: &mut [S], square: &[S], pivots: usize) {
    let stride = x.len();
    let whole = pivots / COLUMNS * COLUMNS;
    for first in (0..whole).step_by(COLUMNS) {
        let columns = &square[first * stride..(first + COLUMNS) * stride];
        let known: &mut [S; COLUMNS] = array_mut(x, first);
        for column in 0..COLUMNS {
            let factors: &[S; COLUMNS] = array(columns, column * stride + first);
            for row in column + 1..COLUMNS {
                known[row] = S::multiply_add::<FUSED>(-known[column], factors[row], known[row]);
            }
        }
        let known = known.map(|value| -value);
        let rest = &mut x[first + COLUMNS..];
        add_four::<S, FUSED>(rest, columns, stride, first + COLUMNS, &known);
    }
    for step in whole..pivots {
        let known = -x[step];
        for row in step + 1..pivots {
            x[row] = S::multiply_add::<FUSED>(known, square[row + step * stride], x[row]);
        }
    }
}

/// `x = U11⁻¹ x` for a padded vector, four columns at a time. The diagonal contains reciprocals.
#[inline(always)]
pub(super) fn solve_upper<S: Scalar, const FUSED: bool>(x: &mut [S], square: &[S], pivots: usize) {
    let stride = x.len();
    let whole = pivots / COLUMNS * COLUMNS;
    for step in (whole..pivots).rev() {
        let column = &square[step * stride..(step + 1) * stride];
        x[step] *= column[step];
        let known = -x[step];
        for (x, &factor) in x[..step].iter_mut().zip(column) {
            *x = S::multiply_add::<FUSED>(known, factor, *x);
        }
    }
    for first in (0..whole).step_by(COLUMNS).rev() {
        let columns = &square[first * stride..(first + COLUMNS) * stride];
        let known: &mut [S; COLUMNS] = array_mut(x, first);
        for column in (0..COLUMNS).rev() {
            let factors: &[S; COLUMNS] = array(columns, column * stride + first);
            known[column] *= factors[column];
            for row in 0..column {
                known[row] = S::multiply_add::<FUSED>(-known[column], factors[row], known[row]);
            }
        }
        let known = known.map(|value| -value);
        add_four::<S, FUSED>(&mut x[..first], columns, stride, 0, &known);
    }
}

/// `x = U⁻ᵀ x` in a part.
#[inline(always)]
pub(super) fn forward_transposed<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    factors: &[S],
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in &symbolic.fronts[part.fronts.clone()] {
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (_, _, upper) = small_solves::pieces(front, factors);
            small_solves::forward_transposed::<S, FUSED>((symbolic, part), front, upper, x);
            continue;
        }
        let (square, _, upper) = pieces(front, factors);
        let pivots = &mut x[part.steps_of(front)];
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate() {
            let (known, rest) = pivots.split_at_mut(step);
            rest[0] = subtract_dot::<S, FUSED>(rest[0], column, known) * column[step];
        }
        let sums = &mut vectors.boundary[..front.panel_stride()];
        sums.fill(S::zero());
        add_columns::<S, FUSED>(sums, upper, pivots);
        for (&row, &sum) in symbolic.places[front.rows.clone()].iter().zip(&*sums) {
            x[row as usize] -= sum;
        }
    }
}

/// `x = L⁻ᵀ x` in a part.
#[inline(always)]
pub(super) fn backward_transposed<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    factors: &[S],
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in symbolic.fronts[part.fronts.clone()].iter().rev() {
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (square, lower, _) = small_solves::pieces(front, factors);
            small_solves::backward_transposed::<S, FUSED>(
                (symbolic, part),
                front,
                (square, lower),
                x,
                &mut vectors.boundary,
            );
            continue;
        }
        let (square, lower, _) = pieces(front, factors);
        gather(symbolic, front, x, &mut vectors.boundary);
        let pivots = &mut x[part.steps_of(front)];
        subtract_dots::<S, FUSED>(pivots, lower, &vectors.boundary[..front.panel_stride()]);
        let stride = front.square_stride();
        for (step, column) in square.chunks_exact(stride.max(1)).enumerate().rev() {
            let (own, known) = pivots[step..].split_at_mut(1);
            own[0] = subtract_dot::<S, FUSED>(own[0], &column[step + 1..], known);
        }
    }
}

/// `x = (D Lᵀ)⁻¹ x` in a part.
#[inline(always)]
pub(super) fn backward_symmetric<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    (factors, pivots): (&[S], &[S]),
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in symbolic.fronts[part.fronts.clone()].iter().rev() {
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (square, lower, _) = small_solves::pieces(front, factors);
            small_solves::backward::<S, FUSED, true>(
                (symbolic, part),
                front,
                (square, lower),
                x,
                &mut vectors.boundary,
            );
            continue;
        }
        let (square, lower) = factors[front.factor_range()].split_at(front.square_length());
        gather(symbolic, front, x, &mut vectors.boundary);
        let steps = part.steps_of(front);
        let of_front = &pivots[front.first..front.first + front.pivots];
        let pivots = &mut vectors.pivots[..front.square_stride()];
        pivots.fill(S::zero());
        let known = &vectors.boundary[..front.panel_stride()];
        subtract_dots::<S, FUSED>(&mut pivots[..front.pivots], lower, known);
        for ((value, &right), &pivot) in pivots.iter_mut().zip(&x[steps.clone()]).zip(of_front) {
            *value = S::multiply_add::<FUSED>(*value, pivot, right);
        }
        solve_upper::<S, FUSED>(pivots, square, front.pivots);
        x[steps].copy_from_slice(&pivots[..front.pivots]);
    }
}

#[inline(always)]
fn pieces<'a, S>(front: &Front, factors: &'a [S]) -> (&'a [S], &'a [S], &'a [S]) {
    let (square, panels) = factors[front.factor_range()].split_at(front.square_length());
    let (lower, upper) = panels.split_at(front.panel_length());
    (square, lower, upper)
}

#[inline(always)]
pub(super) fn gather<S: Scalar>(symbolic: &Symbolic, front: &Front, x: &[S], front_vector: &mut [S]) {
    let rows = &symbolic.places[front.rows.clone()];
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
        add_four::<S, FUSED>(sums, columns, stride, 0, x);
    }
    for (&x, column) in ones.iter().zip(panel_ones.chunks_exact(stride)) {
        for (sums, column) in tiles_mut(sums).iter_mut().zip(tiles(column)) {
            for i in 0..PADDING {
                sums[i] = S::multiply_add::<FUSED>(x, column[i], sums[i]);
            }
        }
    }
}

/// `sums += P x` for four columns, from a row on.
#[inline(always)]
fn add_four<S: Scalar, const FUSED: bool>(
    sums: &mut [S],
    columns: &[S],
    stride: usize,
    row: usize,
    x: &[S; COLUMNS],
) {
    let column = |index: usize| tiles(&columns[index * stride + row..(index + 1) * stride]);
    let panels = column(0).iter().zip(column(1)).zip(column(2)).zip(column(3));
    for (sums, (((a, b), c), d)) in tiles_mut(sums).iter_mut().zip(panels) {
        for i in 0..PADDING {
            let first = S::multiply_add::<FUSED>(x[0], a[i], sums[i]);
            let second = S::multiply_add::<FUSED>(x[1], b[i], first);
            let third = S::multiply_add::<FUSED>(x[2], c[i], second);
            sums[i] = S::multiply_add::<FUSED>(x[3], d[i], third);
        }
    }
}

/// `x -= Pᵀ v`, with the columns of the panel in fours.
#[inline(always)]
pub(super) fn subtract_dots<S: Scalar, const FUSED: bool>(x: &mut [S], panel: &[S], vector: &[S]) {
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
pub(super) fn subtract_dot<S: Scalar, const FUSED: bool>(from: S, left: &[S], right: &[S]) -> S {
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
