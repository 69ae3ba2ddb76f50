//! Solves with the factors of [`super::small`]: products of a few columns, all of whose sums remain in registers.
//! Independent of the factorisation.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Front, PADDING, Part, Symbolic};
use super::supernodes::MAX_SMALL;
use super::triangular::{gather, subtract_dot};
use crate::scalar::{Scalar, array, array_mut};

/// Calls a function with the number of stored rows, as its last constant.
macro_rules! with_rows {
    ($rows:expr, $function:ident::<$($generic:ident),+>($($argument:expr),*)) => {
        match $rows {
            0 => {}
            4 => $function::<$($generic),+, 4>($($argument),*),
            8 => $function::<$($generic),+, 8>($($argument),*),
            12 => $function::<$($generic),+, 12>($($argument),*),
            16 => $function::<$($generic),+, 16>($($argument),*),
            20 => $function::<$($generic),+, 20>($($argument),*),
            _ => $function::<$($generic),+, 24>($($argument),*),
        }
    };
}
pub(super) use with_rows;

/// The stored data of a small front: the inverse of its square, the lower and the upper panel, each with all that
/// follows.
#[inline(always)]
pub(super) fn pieces<'a, S>(front: &Front, factors: &'a [S]) -> (&'a [S], &'a [S], &'a [S]) {
    let square = &factors[front.factors..];
    let lower = &square[front.square_length()..];
    (square, lower, &lower[front.panel_length()..])
}

/// `P x`, with undefined numbers beyond the rows of the panel. Even and odd columns are summed separately, which halves
/// the chains of dependent sums.
#[inline(always)]
fn product<S: Scalar, const FUSED: bool, const ROWS: usize>(
    (panel, stride): (&[S], usize),
    x: &[S],
) -> [S; ROWS] {
    let (mut even, mut odd) = ([S::zero(); ROWS], [S::zero(); ROWS]);
    let (pairs, last) = x.as_chunks::<2>();
    let mut begin = 0;
    for x in pairs {
        let column: &[S; ROWS] = array(panel, begin);
        for i in 0..ROWS {
            even[i] = S::multiply_add::<FUSED>(x[0], column[i], even[i]);
        }
        let column: &[S; ROWS] = array(panel, begin + stride);
        for i in 0..ROWS {
            odd[i] = S::multiply_add::<FUSED>(x[1], column[i], odd[i]);
        }
        begin += 2 * stride;
    }
    if let [x] = last {
        let column: &[S; ROWS] = array(panel, begin);
        for i in 0..ROWS {
            even[i] = S::multiply_add::<FUSED>(*x, column[i], even[i]);
        }
    }
    for i in 0..ROWS {
        even[i] += odd[i];
    }
    even
}

/// `x_b -= A21 A11⁻¹ x_p`.
#[inline(always)]
pub(super) fn forward<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    lower: &[S],
    x: &mut [S],
) {
    with_rows!(front.panel_stride(), forward_rows::<S, FUSED>((symbolic, part), front, lower, x));
}

#[inline(always)]
fn forward_rows<S: Scalar, const FUSED: bool, const ROWS: usize>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    lower: &[S],
    x: &mut [S],
) {
    let sums: [S; ROWS] = product::<S, FUSED, ROWS>((lower, front.boundary), &x[part.steps_of(front)]);
    if let Some(first) = front.span {
        let places: &mut [S; ROWS] = array_mut(x, first);
        for i in 0..ROWS {
            places[i] -= if i < front.boundary { sums[i] } else { S::zero() };
        }
    } else {
        for (&place, &sum) in symbolic.places[front.rows.clone()].iter().zip(&sums) {
            x[place as usize] -= sum;
        }
    }
}

/// `x_p = A11⁻¹ x_p - A11⁻¹ A12 x_b`. For a symmetric matrix the panel is `A21 A11⁻¹`, which is `(A11⁻¹ A12)ᵀ`.
#[inline(always)]
pub(super) fn backward<S: Scalar, const FUSED: bool, const SYMMETRIC: bool>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    (square, panel): (&[S], &[S]),
    x: &mut [S],
    boundary: &mut [S],
) {
    with_rows!(
        front.square_stride(),
        backward_rows::<S, FUSED, SYMMETRIC>((symbolic, part), front, (square, panel), x, boundary)
    );
}

#[inline(always)]
fn backward_rows<S: Scalar, const FUSED: bool, const SYMMETRIC: bool, const ROWS: usize>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    (square, panel): (&[S], &[S]),
    x: &mut [S],
    boundary: &mut [S],
) {
    let steps = part.steps_of(front);
    let first = steps.start;
    let mut own: [S; ROWS] = product::<S, FUSED, ROWS>((square, front.pivots), &x[steps]);
    let known = known(symbolic, front, x, boundary);
    if SYMMETRIC {
        for (own, column) in own[..front.pivots].iter_mut().zip(panel.chunks_exact(known.len().max(1))) {
            *own = subtract_dot_in_fours::<S, FUSED>(*own, column, known);
        }
    } else {
        let of_boundary: [S; ROWS] = product::<S, FUSED, ROWS>((panel, front.pivots), known);
        for i in 0..ROWS {
            own[i] -= of_boundary[i];
        }
    }
    *array_mut(x, first) = own;
}

/// The numbers of the boundary: in place, or gathered.
#[inline(always)]
fn known<'a, S: Scalar>(symbolic: &Symbolic, front: &Front, x: &'a [S], boundary: &'a mut [S]) -> &'a [S] {
    if let Some(first) = front.span {
        return &x[first..first + front.boundary];
    }
    gather(symbolic, front, x, boundary);
    &boundary[..front.boundary]
}

/// A scalar product, four sums side by side.
#[inline(always)]
fn subtract_dot_in_fours<S: Scalar, const FUSED: bool>(from: S, left: &[S], right: &[S]) -> S {
    let (left_fours, left_ones) = left.as_chunks::<PADDING>();
    let (right_fours, right_ones) = right.as_chunks::<PADDING>();
    let mut sums = [S::zero(); PADDING];
    for (left, right) in left_fours.iter().zip(right_fours) {
        for i in 0..PADDING {
            sums[i] = S::multiply_add::<FUSED>(left[i], right[i], sums[i]);
        }
    }
    subtract_dot::<S, FUSED>(from, left_ones, right_ones) - ((sums[0] + sums[1]) + (sums[2] + sums[3]))
}

/// `x_b -= (A11⁻¹ A12)ᵀ x_p`.
#[inline(always)]
pub(super) fn forward_transposed<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    upper: &[S],
    x: &mut [S],
) {
    let steps = part.steps_of(front);
    let places = &symbolic.places[front.rows.clone()];
    for (&place, column) in places.iter().zip(upper.chunks_exact(front.pivots.max(1))) {
        x[place as usize] = subtract_dot::<S, FUSED>(x[place as usize], column, &x[steps.clone()]);
    }
}

/// `x_p = A11⁻ᵀ x_p - (A21 A11⁻¹)ᵀ x_b`.
#[inline(always)]
pub(super) fn backward_transposed<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    front: &Front,
    (square, lower): (&[S], &[S]),
    x: &mut [S],
    boundary: &mut [S],
) {
    let mut own = [S::zero(); MAX_SMALL];
    let own = &mut own[..front.pivots];
    let steps = part.steps_of(front);
    for (value, column) in own.iter_mut().zip(square.chunks_exact(front.pivots.max(1))) {
        *value = -subtract_dot::<S, FUSED>(S::zero(), column, &x[steps.clone()]);
    }
    let known = known(symbolic, front, x, boundary);
    for (own, column) in own.iter_mut().zip(lower.chunks_exact(known.len().max(1))) {
        *own = subtract_dot::<S, FUSED>(*own, column, known);
    }
    x[steps].copy_from_slice(own);
}
