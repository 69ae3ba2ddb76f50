//! Redundant constraints. Where the pivot of a multiplier vanishes, its equation repeats others: the motion is
//! determined, the multipliers are not. From then on all constraints yield a little,
//!
//! ```text
//! s C - δ s λ̂ = 0,   δ ≪ 1,   of the equilibrated tangent: -δ on the diagonal of every multiplier
//! ```
//!
//! which leaves the motion as it is, up to violations of δ times those a spring as stiff as the model would show, and
//! makes the multipliers unique: of all that hold the same motion, those of least size. Every pivot is at least δ.

use lissom_solver::{Pattern, Scalar};
use serde::{Deserialize, Serialize};

use crate::equilibration::Equilibration;

/// δ: violations stay below what is solved for; multipliers keep the digits that round-off of violations over δ leaves.
const COMPLIANCE: f64 = 1e-8;

/// Corrections of a solution whose factors have the compliance of redundant constraints, at most …
const MAX_REFINEMENTS: usize = 40;
/// … and the part of the right-hand side, per row, below which the residual is round-off.
const RESIDUAL: f64 = 1e-15;
/// The least reduction of the residual by a correction that is worth another one.
const REDUCTION: f64 = 0.5;

/// Iterative refinement of solutions with the matrix of redundant constraints, whose factors have a compliance in them. The
/// right-hand sides of the constraints are consistent, so that the solution without the compliance exists.
pub(crate) struct Refinement<S> {
    is_needed: bool,
    values: Vec<S>,
    right: Vec<S>,
    residual: Vec<S>,
    solution: Vec<S>,
}

impl<S: Scalar> Refinement<S> {
    /// Without a compliance.
    pub(crate) fn new() -> Self {
        let empty = Vec::new;
        Self { is_needed: false, values: empty(), right: empty(), residual: empty(), solution: empty() }
    }

    /// Stores the matrix before the compliance enters it.
    pub(crate) fn start(&mut self, values: &[S]) {
        self.is_needed = true;
        self.values.clear();
        self.values.extend_from_slice(values);
    }

    /// The factors have no compliance.
    pub(crate) fn stop(&mut self) {
        self.is_needed = false;
    }

    /// Whether the factors have a compliance.
    pub(crate) fn is_needed(&self) -> bool {
        self.is_needed
    }

    /// Solves in place with `solve`, which uses the factors.
    pub(crate) fn solve(&mut self, pattern: &Pattern, right: &mut [S], mut solve: impl FnMut(&mut [S])) {
        if !self.is_needed {
            return solve(right);
        }
        self.right.clear();
        self.right.extend_from_slice(right);
        self.residual.clear();
        self.residual.extend_from_slice(right);
        self.solution.clear();
        self.solution.resize(right.len(), S::zero());
        let size = |values: &[S]| values.iter().fold(0.0_f64, |most, value| most.max(value.magnitude()));
        let mut last = size(right);
        let enough = RESIDUAL * last;
        for _ in 0..MAX_REFINEMENTS {
            solve(&mut self.residual);
            for (value, &change) in self.solution.iter_mut().zip(&self.residual) {
                *value += change;
            }
            self.residual.copy_from_slice(&self.right);
            for (column, &factor) in self.solution.iter().enumerate() {
                let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
                for (&row, &value) in pattern.row_indices()[range.clone()].iter().zip(&self.values[range]) {
                    self.residual[row] += S::zero() - factor * value;
                }
            }
            let rest = size(&self.residual);
            // Also left where the residual is not a number.
            if !(rest > enough && rest <= REDUCTION * last) {
                break;
            }
            last = rest;
        }
        right.copy_from_slice(&self.solution);
    }
}

/// The compliance of all constraints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Regularization {
    /// Positions of the multipliers' diagonal entries.
    diagonals: Vec<usize>,
    /// Compliance of each multiplier's scaled equation.
    of: Vec<f64>,
}

impl Regularization {
    /// Of the multipliers in the rows from `first` on.
    pub(crate) fn new(pattern: &Pattern, first: usize) -> Self {
        let diagonals: Vec<usize> =
            (first..pattern.size()).filter_map(|row| pattern.position(row, row)).collect();
        Self { of: vec![0.0; diagonals.len()], diagonals }
    }

    /// Enters the compliance into a tangent of scale `scale`, after its equilibration.
    pub(crate) fn enter<S: Scalar>(
        &mut self,
        scale: f64,
        equilibration: Option<&Equilibration>,
        values: &mut [S],
    ) {
        let first = equilibration.map_or(0, |found| found.factors().len() - self.of.len());
        for (k, (&position, of)) in self.diagonals.iter().zip(&mut self.of).enumerate() {
            let (own, square) = match equilibration {
                Some(found) => (COMPLIANCE, found.factors()[first + k].powi(2)),
                None => (COMPLIANCE * scale, 1.0),
            };
            values[position] -= S::from_parts(own, 0.0);
            *of = own / square;
        }
    }

    /// Violations that the compliance would allow at these multipliers, likewise.
    pub(crate) fn allowances<'a>(
        &'a self,
        factor: f64,
        multipliers: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        self.of.iter().zip(multipliers).map(move |(of, multiplier)| (of * multiplier / factor).abs())
    }

    /// Lets residuals of the constraints yield to the multipliers; `factor` is what a scaled residual times a unit of
    /// the scaled multipliers is in SI.
    pub(crate) fn relax(&self, factor: f64, multipliers: &[f64], constraints: &mut [f64]) {
        for ((value, multiplier), of) in constraints.iter_mut().zip(multipliers).zip(&self.of) {
            *value -= of * multiplier / factor;
        }
    }
}
