//! Numeric factorisation: front after front, children first. Everything goes to places that the symbolic
//! analysis has fixed; nothing is searched for and nothing is allocated.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Child, Front, Run, Symbolic};
use super::kernels::{absolute_products, solve_panel, subtract_product};
use super::square::SquareWork;
use crate::pattern::Pattern;
use crate::report::{FactorError, Monitor};
use crate::scalar::Scalar;

/// Columns of a symmetric contribution that are formed together, from their first row on: a multiple of the padding and
/// of the columns of a tile.
const STRIP: usize = 24;

/// Numbers of the last factorisation, and room to make the next.
pub(super) struct Numeric<S> {
    pub(super) factors: Vec<S>,
    stacks: [Vec<S>; 2],
    square: SquareWork<S>,
    /// D by step, and `L21 D` of the front at hand: of symmetric matrices only.
    pub(super) pivots: Vec<S>,
    scaled: Vec<S>,
    /// By step, the sum of the magnitudes of what the diagonal has been made of so far.
    terms: Vec<f64>,
    front_terms: Vec<f64>,
    diagonal: Vec<u32>,
}

impl<S: Scalar> Numeric<S> {
    pub(super) fn new<const SYMMETRIC: bool>(symbolic: &Symbolic, pattern: &Pattern) -> Self {
        let on_diagonal = |&unknown: &u32| {
            let unknown = unknown as usize;
            pattern.position(unknown, unknown).expect("the diagonal is in the pattern") as u32
        };
        let steps = symbolic.unknowns.len();
        let largest_panel = symbolic.fronts.iter().map(Front::panel_length).max().unwrap_or(0);
        let of_symmetric = |length| vec![S::zero(); if SYMMETRIC { length } else { 0 }];
        Numeric {
            factors: vec![S::zero(); symbolic.factor_length],
            stacks: symbolic.stack_lengths.map(|length| vec![S::zero(); length]),
            square: SquareWork::new(symbolic.largest_pivots),
            pivots: of_symmetric(steps),
            scaled: of_symmetric(largest_panel),
            terms: vec![0.0; steps],
            front_terms: vec![0.0; super::fronts::padded(symbolic.largest_boundary)],
            diagonal: symbolic.unknowns.iter().map(on_diagonal).collect(),
        }
    }

    /// Factors; returns the monitor and the largest magnitude in U.
    #[inline(always)]
    pub(super) fn factor<const FUSED: bool, const ROWS: usize, const SYMMETRIC: bool>(
        &mut self,
        symbolic: &Symbolic,
        values: &[S],
    ) -> Result<(Monitor, f64), FactorError> {
        for (terms, &entry) in self.terms.iter_mut().zip(&self.diagonal) {
            *terms = values[entry as usize].magnitude();
        }
        let mut monitor = Monitor::new();
        let mut largest = 0.0_f64;
        for front in &symbolic.fronts {
            self.assemble::<SYMMETRIC>(symbolic, front, values);
            largest = largest.max(self.eliminate::<FUSED, ROWS, SYMMETRIC>(symbolic, front, &mut monitor)?);
        }
        Ok((monitor, largest))
    }

    /// Entries of the matrix and the children's contributions to the pivots. The square of a symmetric matrix is
    /// completed from its lower triangle.
    #[inline(always)]
    fn assemble<const SYMMETRIC: bool>(&mut self, symbolic: &Symbolic, front: &Front, values: &[S]) {
        let pieces = &mut self.factors[front.factor_range()];
        pieces.fill(S::zero());
        let sources = &symbolic.sources[front.entries.clone()];
        for (&source, &target) in sources.iter().zip(&symbolic.targets[front.entries.clone()]) {
            pieces[target as usize] = values[source as usize];
        }
        let (square, panels) = pieces.split_at_mut(front.square_length());
        let (lower, upper) = panels.split_at_mut(front.panel_length());
        let stride = front.square_stride();
        let stack = &self.stacks[1 - front.stack];
        for child in &symbolic.children[front.children.clone()] {
            let contribution = &stack[child.contribution.clone()];
            let pivot_runs = &symbolic.runs[child.to_pivots.clone()];
            let boundary_runs = &symbolic.runs[child.to_boundary.clone()];
            add_columns(lower, front.panel_stride(), contribution, child, boundary_runs, pivot_runs);
            if SYMMETRIC {
                add_lower(square, stride, contribution, child, pivot_runs);
            } else {
                add_columns(square, stride, contribution, child, pivot_runs, pivot_runs);
                add_transposed(upper, front.panel_stride(), contribution, child, pivot_runs, boundary_runs);
            }
        }
        for column in if SYMMETRIC { 1..front.pivots } else { 0..0 } {
            for row in 0..column {
                square[column * stride + row] = square[row * stride + column];
            }
        }
    }

    /// Elimination of the pivots, then the contribution to the parent, children's included: of symmetric matrices
    /// its lower triangle.
    #[inline(always)]
    fn eliminate<const FUSED: bool, const ROWS: usize, const SYMMETRIC: bool>(
        &mut self,
        symbolic: &Symbolic,
        front: &Front,
        monitor: &mut Monitor,
    ) -> Result<f64, FactorError> {
        let (pivots, boundary) = (front.pivots, front.boundary);
        let steps = front.first..front.first + pivots;
        let pieces = &mut self.factors[front.factor_range()];
        let (square, panels) = pieces.split_at_mut(front.square_length());
        let (lower, upper) = panels.split_at_mut(front.panel_length());
        self.square.terms[..pivots].copy_from_slice(&self.terms[steps.clone()]);
        let unknowns = &symbolic.unknowns[steps.clone()];
        let mut largest = self.square.factor::<FUSED, ROWS>(square, unknowns, monitor)?;
        if SYMMETRIC {
            for (pivot, &reciprocal) in self.pivots[steps.clone()].iter_mut().zip(&self.square.reciprocals) {
                *pivot = S::one() / reciprocal;
            }
        }
        if boundary == 0 {
            return Ok(largest);
        }

        let (stride, square_stride) = (front.panel_stride(), front.square_stride());
        let reciprocals = Some(&self.square.reciprocals[..pivots]);
        let transposed = (&self.square.transposed[..], square_stride);
        solve_panel::<S, FUSED, ROWS>((lower, stride), transposed, reciprocals, pivots, stride);
        let upper: &[S] = if SYMMETRIC {
            let scaled = &mut self.scaled[..front.panel_length()];
            scale_columns(scaled, lower, stride, &self.pivots[steps]);
            scaled
        } else {
            solve_panel::<S, FUSED, ROWS>((upper, stride), (square, square_stride), None, pivots, stride);
            upper
        };
        let terms = &mut self.front_terms[..stride];
        terms.fill(0.0);
        largest = largest.max(absolute_products(terms, (lower, upper), stride, (stride, pivots)));
        for (&step, &term) in symbolic.boundaries[front.rows.clone()].iter().zip(&*terms) {
            self.terms[step as usize] += term;
        }

        let (first, second) = self.stacks.split_at_mut(1);
        let (own, others) =
            if front.stack == 0 { (&mut first[0], &second[0]) } else { (&mut second[0], &first[0]) };
        let contribution = &mut own[front.contribution_range()];
        let strip = if SYMMETRIC { STRIP } else { boundary };
        for begin in (0..boundary).step_by(strip) {
            subtract_product::<S, FUSED, false, ROWS>(
                (&mut contribution[begin * stride + begin..], stride),
                (&lower[begin..], stride),
                (&upper[begin..], stride),
                (stride - begin, strip.min(boundary - begin), pivots),
            );
        }
        for child in &symbolic.children[front.children.clone()] {
            let runs = &symbolic.runs[child.to_boundary.clone()];
            let of_child = &others[child.contribution.clone()];
            if SYMMETRIC {
                add_lower(contribution, stride, of_child, child, runs);
            } else {
                add_columns(contribution, stride, of_child, child, runs, runs);
            }
        }
        Ok(largest)
    }
}

/// Columns times a number each.
#[inline(always)]
fn scale_columns<S: Scalar>(to: &mut [S], from: &[S], stride: usize, factors: &[S]) {
    for ((to, from), &factor) in to.chunks_exact_mut(stride).zip(from.chunks_exact(stride)).zip(factors) {
        for (to, &from) in to.iter_mut().zip(from) {
            *to = from * factor;
        }
    }
}

/// Adds the lower triangle of the part of a contribution in the given runs. Runs ascend in child and parent alike, so
/// that the lower triangle goes to the lower triangle.
#[inline(always)]
fn add_lower<S: Scalar>(target: &mut [S], stride: usize, contribution: &[S], child: &Child, runs: &[Run]) {
    for (index, columns) in runs.iter().enumerate() {
        for column in 0..columns.length as usize {
            let to = &mut target[(columns.to as usize + column) * stride..][..stride];
            let from = &contribution[(columns.from as usize + column) * child.stride..][..child.stride];
            for (further, rows) in runs[index..].iter().enumerate() {
                // Of the run that holds the column only what lies below the diagonal.
                let skip = if further == 0 { column } else { 0 };
                let length = rows.length as usize - skip;
                let to = &mut to[rows.to as usize + skip..][..length];
                let from = &from[rows.from as usize + skip..][..length];
                for (to, &from) in to.iter_mut().zip(from) {
                    *to += from;
                }
            }
        }
    }
}

/// Adds the part of a contribution in the given runs of rows and columns.
#[inline(always)]
fn add_columns<S: Scalar>(
    target: &mut [S],
    stride: usize,
    contribution: &[S],
    child: &Child,
    row_runs: &[Run],
    column_runs: &[Run],
) {
    for columns in column_runs {
        for column in 0..columns.length as usize {
            let to = &mut target[(columns.to as usize + column) * stride..][..stride];
            let from = &contribution[(columns.from as usize + column) * child.stride..][..child.stride];
            for rows in row_runs {
                let length = rows.length as usize;
                let to = &mut to[rows.to as usize..][..length];
                let from = &from[rows.from as usize..][..length];
                for (to, &from) in to.iter_mut().zip(from) {
                    *to += from;
                }
            }
        }
    }
}

/// The same, where rows of the contribution go to columns of the target.
#[inline(always)]
fn add_transposed<S: Scalar>(
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
