//! Solves for several right-hand sides at once, stored side by side: every factor is read once for all of them. Front by
//! front as [`super::triangular`] and [`super::small_solves`] do for one.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::factorisation::Numeric;
use super::fronts::{Front, Part, Symbolic};
use crate::scalar::Scalar;
use crate::solver::SEVERAL;

/// One number of each right-hand side.
type Row<S> = [S; SEVERAL];

/// Rows of a product that are computed at once.
const ROWS: usize = 4;

pub(super) struct Several<'a, S> {
    pub(super) symbolic: &'a Symbolic,
    pub(super) numeric: &'a Numeric<S>,
    pub(super) right_hand_sides: &'a mut [Row<S>],
    /// Storage for all steps, including positions for unknowns outside of parts, and for a front.
    pub(super) vector: &'a mut [Row<S>],
    pub(super) front: &'a mut [Row<S>],
}

impl<S: Scalar> pulp::WithSimd for Several<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<V: pulp::Simd>(self, _: V) {
        if V::F64_LANES >= 4 { self.solve::<true>() } else { self.solve::<false>() }
    }
}

impl<S: Scalar> Several<'_, S> {
    #[inline(always)]
    fn solve<const FUSED: bool>(self) {
        let Several { symbolic, numeric, right_hand_sides, vector, front: room } = self;
        let zero = [S::zero(); SEVERAL];
        let Some((top, subtrees)) = symbolic.parts.split_last() else { return };
        for part in &symbolic.parts {
            let (below, own) = vector.split_at_mut(part.steps.start);
            let own = &mut own[..part.steps.len()];
            own.fill(zero);
            let unknowns = part.steps.start..part.places.start;
            for (value, &unknown) in own.iter_mut().zip(&symbolic.unknowns[unknowns]) {
                *value = right_hand_sides.get(unknown as usize).copied().unwrap_or(zero);
            }
            if part.steps == top.steps {
                for part in subtrees {
                    for (&step, value) in part.outside.iter().zip(&below[part.places.clone()]) {
                        add(&mut own[step as usize - top.steps.start], value);
                    }
                }
            }
            for front in &symbolic.fronts[part.fronts.clone()] {
                forward::<S, FUSED>(symbolic, part, front, &numeric.factors, own, room);
            }
        }
        for part in symbolic.parts.iter().rev() {
            let (below, own) = vector.split_at_mut(part.steps.start);
            let own = &mut own[..part.steps.len()];
            for front in symbolic.fronts[part.fronts.clone()].iter().rev() {
                backward::<S, FUSED>(symbolic, part, front, &numeric.factors, own, room);
            }
            if part.steps == top.steps {
                for part in subtrees {
                    for (&step, value) in part.outside.iter().zip(&mut below[part.places.clone()]) {
                        *value = own[step as usize - top.steps.start];
                    }
                }
            }
        }
        for (value, &step) in right_hand_sides.iter_mut().zip(&symbolic.steps) {
            *value = vector[step as usize];
        }
    }
}

#[inline(always)]
fn forward<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    part: &Part,
    front: &Front,
    factors: &[S],
    x: &mut [Row<S>],
    room: &mut [Row<S>],
) {
    let (square, panels) = factors[front.factor_range()].split_at(front.square_length());
    let lower = &panels[..front.panel_length()];
    let steps = part.steps_of(front);
    let (pivots, boundary) = (front.pivots, front.boundary);
    if !front.is_small() {
        let (own, stride) = (&mut x[steps.clone()], front.square_stride());
        for step in 0..pivots {
            let known = own[step];
            for row in step + 1..pivots {
                subtract::<S, FUSED>(&mut own[row], square[row + step * stride], &known);
            }
        }
    }
    let stride = if front.is_small() { boundary } else { front.panel_stride() };
    products::<S, FUSED>(
        (boundary, pivots),
        |row, column| lower[row + column * stride],
        &x[steps],
        &mut room[..boundary],
    );
    for (&place, sum) in symbolic.places[front.rows.clone()].iter().zip(&*room) {
        let value = &mut x[place as usize];
        for lane in 0..SEVERAL {
            value[lane] -= sum[lane];
        }
    }
}

#[inline(always)]
fn backward<S: Scalar, const FUSED: bool>(
    symbolic: &Symbolic,
    part: &Part,
    front: &Front,
    factors: &[S],
    x: &mut [Row<S>],
    room: &mut [Row<S>],
) {
    let (square, panels) = factors[front.factor_range()].split_at(front.square_length());
    let upper = &panels[panels.len() - front.panel_length()..];
    let steps = part.steps_of(front);
    let (pivots, boundary) = (front.pivots, front.boundary);
    let (known, sums) = room.split_at_mut(boundary);
    let sums = &mut sums[..pivots];
    for (value, &place) in known.iter_mut().zip(&symbolic.places[front.rows.clone()]) {
        *value = x[place as usize];
    }
    let own = &mut x[steps];
    if front.is_small() {
        // The panel is A11⁻¹ A12, by columns of the boundary; the square is A11⁻¹.
        products::<S, FUSED>((pivots, pivots), |row, column| square[row + column * pivots], own, sums);
        own.copy_from_slice(sums);
        products::<S, FUSED>((pivots, boundary), |row, column| upper[row + column * pivots], known, sums);
        subtract_all(own, sums);
        return;
    }
    let stride = front.panel_stride();
    products::<S, FUSED>((pivots, boundary), |row, column| upper[column + row * stride], known, sums);
    subtract_all(own, sums);
    let stride = front.square_stride();
    for step in (0..pivots).rev() {
        let column = &square[step * stride..];
        let own_factor = column[step];
        for value in &mut own[step] {
            *value *= own_factor;
        }
        let known = own[step];
        for row in 0..step {
            subtract::<S, FUSED>(&mut own[row], column[row], &known);
        }
    }
}

/// `P x` for these numbers of rows and columns.
#[inline(always)]
fn products<S: Scalar, const FUSED: bool>(
    (rows, columns): (usize, usize),
    entry: impl Fn(usize, usize) -> S,
    x: &[Row<S>],
    out: &mut [Row<S>],
) {
    let x = &x[..columns];
    let (blocks, rest) = out[..rows].as_chunks_mut::<ROWS>();
    let whole = blocks.len() * ROWS;
    for (block, out) in blocks.iter_mut().enumerate() {
        let mut sums = [[S::zero(); SEVERAL]; ROWS];
        for (column, x) in x.iter().enumerate() {
            for row in 0..ROWS {
                let factor = entry(block * ROWS + row, column);
                for lane in 0..SEVERAL {
                    sums[row][lane] = S::multiply_add::<FUSED>(x[lane], factor, sums[row][lane]);
                }
            }
        }
        *out = sums;
    }
    for (row, out) in rest.iter_mut().enumerate() {
        let mut sums = [S::zero(); SEVERAL];
        for (column, x) in x.iter().enumerate() {
            let factor = entry(whole + row, column);
            for lane in 0..SEVERAL {
                sums[lane] = S::multiply_add::<FUSED>(x[lane], factor, sums[lane]);
            }
        }
        *out = sums;
    }
}

#[inline(always)]
fn subtract<S: Scalar, const FUSED: bool>(value: &mut Row<S>, factor: S, known: &Row<S>) {
    for lane in 0..SEVERAL {
        value[lane] = S::multiply_add::<FUSED>(-known[lane], factor, value[lane]);
    }
}

#[inline(always)]
fn subtract_all<S: Scalar>(values: &mut [Row<S>], sums: &[Row<S>]) {
    for (value, sum) in values.iter_mut().zip(sums) {
        for lane in 0..SEVERAL {
            value[lane] -= sum[lane];
        }
    }
}

#[inline(always)]
fn add<S: Scalar>(value: &mut Row<S>, other: &Row<S>) {
    for lane in 0..SEVERAL {
        value[lane] += other[lane];
    }
}
