//! Multifrontal LDLᵀ without pivoting, for symmetric matrices: half the panels and half the products of LU. Shares
//! the symbolic analysis and all kernels with it.
//!
//! Squares of fronts are factorised by LU, whose `U` is `D Lᵀ`; of the contribution of a front to its parent only the
//! lower triangle is computed.

#![expect(clippy::inline_always, reason = "only code inlined into the dispatched caller uses its vectors")]

use super::factorisation::Numeric;
use super::fronts::{Part, Symbolic};
use super::triangular::{self, FrontVectors};
use super::{Multifrontal, Way, small, small_solves};
use crate::report::{FactorError, FactorReport};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

/// Multifrontal LDLᵀ without pivoting. Of each pair of symmetric entries the one in the row that is eliminated later
/// is read. Complex matrices are symmetric, not Hermitian.
pub struct Symmetric<S>(Multifrontal<S>);

impl<S: Scalar> Symmetric<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] rejects the structure.
    pub fn new(structure: &Structure) -> Self {
        Self(Multifrontal::of_panels(structure, 1))
    }
}

impl<S: Scalar> LinearSolver<S> for Symmetric<S> {
    fn name(&self) -> &'static str {
        "symmetric"
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        self.0.factor_values(values)
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        self.0.triangular(right_hand_side, Way::Symmetric);
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        self.solve(right_hand_side);
    }

    fn factor_entries(&self) -> usize {
        self.0.factor_entries()
    }

    fn set_threads(&mut self, threads: usize) {
        self.0.set_threads(threads);
    }
}

/// `x = (D Lᵀ)⁻¹ x` in a part.
#[inline(always)]
pub(super) fn backward<S: Scalar, const FUSED: bool>(
    (symbolic, part): (&Symbolic, &Part),
    numeric: &Numeric<S>,
    x: &mut [S],
    vectors: &mut FrontVectors<S>,
) {
    for front in symbolic.fronts[part.fronts.clone()].iter().rev() {
        if const { small::is_for::<S>(FUSED) } && front.is_small() {
            let (square, lower, _) = small_solves::pieces(front, &numeric.factors);
            small_solves::backward::<S, FUSED, true>(
                (symbolic, part),
                front,
                (square, lower),
                x,
                &mut vectors.boundary,
            );
            continue;
        }
        let (square, lower) = numeric.factors[front.factor_range()].split_at(front.square_length());
        triangular::gather(symbolic, front, x, &mut vectors.boundary);
        let steps = part.steps_of(front);
        let of_front = &numeric.pivots[front.first..front.first + front.pivots];
        let pivots = &mut vectors.pivots[..front.square_stride()];
        pivots.fill(S::zero());
        let known = &vectors.boundary[..front.panel_stride()];
        triangular::subtract_dots::<S, FUSED>(&mut pivots[..front.pivots], lower, known);
        for ((value, &right), &pivot) in pivots.iter_mut().zip(&x[steps.clone()]).zip(of_front) {
            *value = S::multiply_add::<FUSED>(*value, pivot, right);
        }
        triangular::solve_upper::<S, FUSED>(pivots, square, front.pivots);
        x[steps].copy_from_slice(&pivots[..front.pivots]);
    }
}
