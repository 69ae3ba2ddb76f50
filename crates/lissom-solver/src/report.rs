//! Report of a factorisation, and the causes of its failure. Unknowns are identified by index only.

use crate::scalar::Scalar;

/// A pivot is rejected if elimination has cancelled it down to this fraction of the sum of its terms: `|pivot| ≤
/// TINY_PIVOT (|a_ii| + Σ |l_ik u_ki|)`.
///
/// About 45 units of round-off: the remainder is then noise. The comparison is with the terms of the pivot's own
/// diagonal, so it is invariant under scaling of rows and columns: in an unscaled index-3 matrix a good pivot may be
/// 1e-27 of the largest one.
pub const TINY_PIVOT: f64 = 1e-14;

/// Monitor of a successful factorisation. The solver `pivoting` reports values derived from the size of a solution
/// instead of its pivots, which do not reveal every near singularity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorReport {
    /// Smallest magnitude of a pivot.
    pub smallest_pivot: f64,
    /// The unknown of that pivot.
    pub smallest_pivot_unknown: usize,
    /// Largest magnitude of a pivot.
    pub largest_diagonal: f64,
    /// Largest `|u_ij|` over largest `|a_ij|`. Not a number if the solver does not compute it.
    pub growth: f64,
    /// Smallest ratio of a pivot to the sum of the magnitudes of its terms: 1 without cancellation, near the round-off unit for
    /// a redundant constraint. It is invariant under scaling of rows and columns. Solvers that pivot report the ratio of the
    /// smallest to the largest pivot here.
    pub worst_cancellation: f64,
    /// The unknown of that pivot.
    pub worst_cancellation_unknown: usize,
    /// Number of negative pivots. For a symmetric matrix this is the number of negative eigenvalues (Sylvester's law of
    /// inertia): a saddle-point matrix `[A, Bᵀ; B, 0]` has one for each equation, and one for each direction that satisfies
    /// them in which A is not stable. For other matrices only its parity has a meaning: the sign of the determinant. None
    /// for complex matrices and from solvers that exchange rows.
    pub negative_pivots: Option<usize>,
}

impl FactorReport {
    /// Smallest over largest pivot.
    pub fn relative_pivot(&self) -> f64 {
        self.smallest_pivot / self.largest_diagonal
    }
}

/// Why a factorisation failed. The factors must then not be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FactorError {
    /// A pivot is zero, or round-off: the matrix is singular, or this unknown needs pivoting.
    #[error("the pivot of unknown {unknown} vanishes: {pivot:e} is left of terms that sum up to {largest:e}")]
    ZeroPivot {
        /// The unknown.
        unknown: usize,
        /// Magnitude of the pivot.
        pivot: f64,
        /// Sum of the magnitudes of the terms of the pivot.
        largest: f64,
    },
    /// An entry, or an intermediate number, is infinite or not a number.
    #[error("a number in the equations of unknown {unknown} is infinite or not a number")]
    NotFinite {
        /// The unknown: column of the entry, or of the pivot.
        unknown: usize,
    },
    /// It was cancelled, see [`interrupt`](crate::interrupt).
    #[error("interrupted")]
    Interrupted,
}

/// Collects the report during elimination.
#[derive(Clone, Copy, Debug)]
pub struct Monitor {
    smallest: (f64, usize),
    largest: f64,
    cancellation: (f64, usize),
    negative: usize,
}

impl Monitor {
    pub(crate) fn new() -> Monitor {
        Monitor { smallest: (f64::INFINITY, 0), largest: 0.0, cancellation: (f64::INFINITY, 0), negative: 0 }
    }

    /// Records a pivot, or rejects it; `terms` is the sum of the magnitudes of its terms. Returns its magnitude.
    #[inline]
    pub(crate) fn pivot<S: Scalar>(
        &mut self,
        unknown: usize,
        pivot: S,
        terms: f64,
    ) -> Result<f64, FactorError> {
        self.negative += usize::from(pivot.parts()[0] < 0.0);
        let pivot = pivot.magnitude();
        // Infinite terms with a finite pivot are impossible; a pivot that is not a number fails both comparisons.
        if pivot > TINY_PIVOT * terms && pivot < f64::INFINITY {
            if pivot < self.smallest.0 {
                self.smallest = (pivot, unknown);
            }
            self.largest = self.largest.max(pivot);
            if pivot < self.cancellation.0 * terms {
                self.cancellation = (pivot / terms, unknown);
            }
            return Ok(pivot);
        }
        Err(refusal(unknown, pivot, terms))
    }

    /// Merges the records of another monitor.
    pub(crate) fn join(&mut self, other: &Monitor) {
        if other.smallest.0 < self.smallest.0 {
            self.smallest = other.smallest;
        }
        self.largest = self.largest.max(other.largest);
        if other.cancellation.0 < self.cancellation.0 {
            self.cancellation = other.cancellation;
        }
        self.negative += other.negative;
    }

    /// The report for a matrix of numbers `S`.
    pub(crate) fn report<S: Scalar>(&self, largest_upper: f64, largest_entry: f64) -> FactorReport {
        let growth = if largest_entry > 0.0 { largest_upper / largest_entry } else { 0.0 };
        FactorReport {
            smallest_pivot: self.smallest.0,
            smallest_pivot_unknown: self.smallest.1,
            largest_diagonal: self.largest,
            growth,
            worst_cancellation: self.cancellation.0,
            worst_cancellation_unknown: self.cancellation.1,
            negative_pivots: (!S::COMPLEX).then_some(self.negative),
        }
    }
}

#[cold]
fn refusal(unknown: usize, pivot: f64, terms: f64) -> FactorError {
    if pivot.is_finite() && terms.is_finite() {
        FactorError::ZeroPivot { unknown, pivot, largest: terms }
    } else {
        FactorError::NotFinite { unknown }
    }
}
