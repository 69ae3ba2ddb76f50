//! Contributions of fronts to their parents, added run by run. Independent of the use of the sums.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Child, PADDING, Run};
use crate::scalar::Scalar;

/// Adds a whole contribution to a front whose runs begin at the given positions.
#[inline(always)]
pub(super) fn add_all<S: Scalar>(
    target: &mut [S],
    stride: usize,
    contribution: &[S],
    child: &Child,
    all_runs: [(&[Run], usize); 2],
) {
    for (column_runs, column) in all_runs {
        for (row_runs, row) in all_runs {
            let target = &mut target[column * stride + row..];
            add_columns(target, stride, contribution, child, row_runs, column_runs);
        }
    }
}

/// Adds numbers in fours, because runs are short.
#[inline(always)]
fn add<S: Scalar>(to: &mut [S], from: &[S]) {
    let (to_fours, to_ones) = to.as_chunks_mut::<PADDING>();
    let (from_fours, from_ones) = from.as_chunks::<PADDING>();
    for (to, from) in to_fours.iter_mut().zip(from_fours) {
        // Copies, because the compiler cannot infer that the two do not overlap.
        let (mut sums, from) = (*to, *from);
        for i in 0..PADDING {
            sums[i] += from[i];
        }
        *to = sums;
    }
    for (to, &from) in to_ones.iter_mut().zip(from_ones) {
        *to += from;
    }
}

/// Adds the lower triangle of the part of a contribution in the given runs. Runs ascend in child and parent alike, so
/// that the lower triangle is added to the lower triangle.
#[inline(always)]
pub(super) fn add_lower<S: Scalar>(
    target: &mut [S],
    stride: usize,
    contribution: &[S],
    child: &Child,
    runs: &[Run],
) {
    for (index, columns) in runs.iter().enumerate() {
        for column in 0..columns.length as usize {
            let to = &mut target[(columns.to as usize + column) * stride..];
            let from = &contribution[(columns.from as usize + column) * child.stride..][..child.stride];
            for (further, rows) in runs[index..].iter().enumerate() {
                // In the run that contains the column, only the part below the diagonal.
                let skip = if further == 0 { column } else { 0 };
                let length = rows.length as usize - skip;
                add(
                    &mut to[rows.to as usize + skip..][..length],
                    &from[rows.from as usize + skip..][..length],
                );
            }
        }
    }
}

/// Adds the part of a contribution in the given runs of rows and columns.
#[inline(always)]
pub(super) fn add_columns<S: Scalar>(
    target: &mut [S],
    stride: usize,
    contribution: &[S],
    child: &Child,
    row_runs: &[Run],
    column_runs: &[Run],
) {
    for columns in column_runs {
        for column in 0..columns.length as usize {
            let to = &mut target[(columns.to as usize + column) * stride..];
            let from = &contribution[(columns.from as usize + column) * child.stride..][..child.stride];
            for rows in row_runs {
                let length = rows.length as usize;
                add(&mut to[rows.to as usize..][..length], &from[rows.from as usize..][..length]);
            }
        }
    }
}

/// Adds rows of the contribution to columns of the target.
#[inline(always)]
pub(super) fn add_transposed<S: Scalar>(
    target: &mut [S],
    stride: usize,
    contribution: &[S],
    child: &Child,
    row_runs: &[Run],
    column_runs: &[Run],
) {
    for rows in row_runs {
        for row in 0..rows.length as usize {
            let to = &mut target[(rows.to as usize + row) * stride..][..stride];
            let from = &contribution[rows.from as usize + row..];
            for columns in column_runs {
                let to = &mut to[columns.to as usize..][..columns.length as usize];
                let begin = columns.from as usize * child.stride;
                for (to, &from) in to.iter_mut().zip(from[begin..].iter().step_by(child.stride)) {
                    *to += from;
                }
            }
        }
    }
}
