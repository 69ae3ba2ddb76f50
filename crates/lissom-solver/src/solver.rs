//! The interface of all solvers.

use crate::report::{FactorError, FactorReport};
use crate::scalar::Scalar;

/// Number of right-hand sides that are solved for at once.
pub const SEVERAL: usize = 8;

/// Factorises matrices of one structure repeatedly, and solves with the last one factored.
pub trait LinearSolver<S: Scalar>: Send {
    /// Name of its kind.
    fn name(&self) -> &'static str;

    /// Whether it exchanges rows. Its report then compares pivots with each other, not with their terms.
    fn exchanges_rows(&self) -> bool {
        false
    }

    /// Factorises the matrix with the given values, in the order of the pattern. Without allocation if the solver
    /// does not pivot.
    ///
    /// # Errors
    /// If a pivot vanishes or a number is not finite. The solver must then not be used to solve until a later
    /// factorisation succeeds.
    ///
    /// # Panics
    /// If there are not as many values as entries in the pattern.
    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError>;

    /// Solves `A x = b` in place, without allocation.
    ///
    /// # Panics
    /// If the right-hand side has the wrong length.
    fn solve(&mut self, right_hand_side: &mut [S]);

    /// Solves `Aᵀ x = b` in place, without allocation. Transposed, not conjugated.
    ///
    /// # Panics
    /// If the right-hand side has the wrong length.
    fn solve_transposed(&mut self, right_hand_side: &mut [S]);

    /// Solves `A x = b` in place for several right-hand sides, which are stored side by side.
    ///
    /// # Panics
    /// If there are not as many rows as unknowns.
    fn solve_several(&mut self, right_hand_sides: &mut [[S; SEVERAL]]) {
        let mut own = vec![S::zero(); right_hand_sides.len()];
        for lane in 0..SEVERAL {
            for (value, row) in own.iter_mut().zip(&*right_hand_sides) {
                *value = row[lane];
            }
            self.solve(&mut own);
            for (row, value) in right_hand_sides.iter_mut().zip(&own) {
                row[lane] = *value;
            }
        }
    }

    /// Number of stored entries of L and U.
    fn factor_entries(&self) -> usize;

    /// Sets the number of threads that share the work if it is large enough to be efficient. Without this call, and for
    /// solvers without parallel algorithms, there is one thread. Results are bitwise independent of it. Waking threads
    /// allocates slightly.
    fn set_threads(&mut self, _threads: usize) {}
}
