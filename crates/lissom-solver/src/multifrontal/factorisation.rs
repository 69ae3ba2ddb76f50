//! Numeric factorisation: front after front, children first. Everything goes to places that the symbolic
//! analysis has fixed; nothing is searched for and nothing is allocated.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::fronts::{Child, Front, Run, Symbolic};
use super::kernels::{absolute_products, solve_panel, subtract_product};
use super::square::SquareWork;
use crate::report::{FactorError, Monitor};
use crate::scalar::Scalar;

/// Numbers of the last factorisation, and room to make the next.
pub(super) struct Numeric<S> {
    pub(super) factors: Vec<S>,
    stacks: [Vec<S>; 2],
    square: SquareWork<S>,
    /// By step, the sum of the magnitudes of what the diagonal has been made of so far.
    terms: Vec<f64>,
    front_terms: Vec<f64>,
    diagonal: Vec<u32>,
}

impl<S: Scalar> Numeric<S> {
    pub(super) fn new(symbolic: &Symbolic, diagonal: Vec<u32>) -> Self {
        Numeric {
            factors: vec![S::zero(); symbolic.factor_length],
            stacks: symbolic.stack_lengths.map(|length| vec![S::zero(); length]),
            square: SquareWork::new(symbolic.largest_pivots),
            terms: vec![0.0; symbolic.unknowns.len()],
            front_terms: vec![0.0; super::fronts::padded(symbolic.largest_boundary)],
            diagonal,
        }
    }

    /// Factors; returns the monitor and the largest magnitude in U.
    #[inline(always)]
    pub(super) fn factor<const FUSED: bool, const ROWS: usize>(
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
            self.assemble(symbolic, front, values);
            largest = largest.max(self.eliminate::<FUSED, ROWS>(symbolic, front, &mut monitor)?);
        }
        Ok((monitor, largest))
    }

    /// Entries of the matrix and the children's contributions to the pivots.
    #[inline(always)]
    fn assemble(&mut self, symbolic: &Symbolic, front: &Front, values: &[S]) {
        let pieces = &mut self.factors[front.factor_range()];
        pieces.fill(S::zero());
        let sources = &symbolic.sources[front.entries.clone()];
        for (&source, &target) in sources.iter().zip(&symbolic.targets[front.entries.clone()]) {
            pieces[target as usize] = values[source as usize];
        }
        let (square, panels) = pieces.split_at_mut(front.square_length());
        let (lower, upper) = panels.split_at_mut(front.panel_length());
        let stack = &self.stacks[1 - front.stack];
        for child in &symbolic.children[front.children.clone()] {
            let contribution = &stack[child.contribution.clone()];
            let pivot_runs = &symbolic.runs[child.to_pivots.clone()];
            let boundary_runs = &symbolic.runs[child.to_boundary.clone()];
            add_columns(square, front.square_stride(), contribution, child, pivot_runs, pivot_runs);
            add_columns(lower, front.panel_stride(), contribution, child, boundary_runs, pivot_runs);
            add_transposed(upper, front.panel_stride(), contribution, child, pivot_runs, boundary_runs);
        }
    }

    /// Elimination of the pivots, then the contribution to the parent, children's included.
    #[inline(always)]
    fn eliminate<const FUSED: bool, const ROWS: usize>(
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
        let mut largest = self.square.factor::<FUSED, ROWS>(square, &symbolic.unknowns[steps], monitor)?;
        if boundary == 0 {
            return Ok(largest);
        }

        let (stride, square_stride) = (front.panel_stride(), front.square_stride());
        let reciprocals = Some(&self.square.reciprocals[..pivots]);
        let transposed = (&self.square.transposed[..], square_stride);
        solve_panel::<S, FUSED, ROWS>((lower, stride), transposed, reciprocals, pivots, stride);
        solve_panel::<S, FUSED, ROWS>((upper, stride), (square, square_stride), None, pivots, stride);
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
        subtract_product::<S, FUSED, false, ROWS>(
            (contribution, stride),
            (lower, stride),
            (upper, stride),
            (stride, boundary, pivots),
        );
        for child in &symbolic.children[front.children.clone()] {
            let runs = &symbolic.runs[child.to_boundary.clone()];
            add_columns(contribution, stride, &others[child.contribution.clone()], child, runs, runs);
        }
        Ok(largest)
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
