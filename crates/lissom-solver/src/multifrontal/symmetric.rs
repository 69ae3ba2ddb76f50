//! Multifrontal LDLᵀ without pivoting, for symmetric matrices: half the panels and half the products of LU. Shares
//! the symbolic analysis and all kernels with it.
//!
//! Squares of fronts are factorised by LU, whose `U` is `D Lᵀ`; of the contribution of a front to its parent only the
//! lower triangle is computed.

use super::sweeps::Way;
use super::{Kernels, Multifrontal};
use crate::report::{FactorError, FactorReport};
use crate::solver::LinearSolver;
use crate::structure::Structure;

/// Multifrontal LDLᵀ without pivoting. Only one entry of each symmetric pair is read, the one in the row that is eliminated
/// later. Complex matrices are symmetric, not Hermitian.
pub struct Symmetric<S>(Multifrontal<S>);

impl<S: Kernels> Symmetric<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If [`Structure::check`] rejects the structure.
    pub fn new(structure: &Structure) -> Self {
        Self(Multifrontal::of_panels(structure, 1))
    }
}

impl<S: Kernels> LinearSolver<S> for Symmetric<S> {
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
