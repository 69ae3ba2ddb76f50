//! Supernodal sparse LU with partial pivoting, by the crate `faer`: what to fall back on when a matrix does not
//! bear elimination without pivoting. Ignores groups; orders columns by itself.
//!
//! `faer` keeps its pivots to itself, so the report is an estimate from one solve with a random right-hand side.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par};

use crate::entries::largest_entry;
use crate::pattern::Pattern;
use crate::report::{FactorError, FactorReport, Monitor};
use crate::scalar::Scalar;
use crate::solver::LinearSolver;
use crate::structure::Structure;

pub(crate) const NAME: &str = "pivoting";

/// Backward error of the solve behind the report above which the factors are refused.
const UNUSABLE: f64 = 1e-6;

/// Sparse LU with partial pivoting.
pub struct Pivoting<S> {
    pattern: Arc<Pattern>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, S>,
    memory: MemBuffer,
    factored: bool,
    probe: Vec<S>,
    solution: Vec<S>,
    product: Vec<S>,
}

impl<S: Scalar + ComplexField> Pivoting<S> {
    /// Symbolic analysis.
    ///
    /// # Panics
    /// If memory runs out.
    pub fn new(structure: &Structure) -> Self {
        let pattern = Arc::clone(&structure.pattern);
        let size = pattern.size();
        // The choice left to the library takes the column-wise algorithm too often, at up to four times the time.
        let parameters = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic = factorize_symbolic_lu(shape(&pattern), parameters).expect("enough memory");
        let factor = symbolic.factorize_numeric_lu_scratch::<S>(Par::Seq, faer::Spec::default());
        let solve = symbolic.solve_in_place_scratch::<S>(1, Par::Seq);
        // Numbers without a short binary form, of one size, so that every direction is tried.
        let probe = (0..size).map(|unknown| S::from_real((1.0 + unknown as f64).sin() + 2.0)).collect();
        Pivoting {
            memory: MemBuffer::new(StackReq::or(factor, solve)),
            symbolic,
            numeric: NumericLu::new(),
            factored: false,
            probe,
            solution: vec![S::zero(); size],
            product: vec![S::zero(); size],
            pattern,
        }
    }

    fn triangular(&mut self, right_hand_side: &mut [S], transposed: bool) {
        let size = self.pattern.size();
        assert_eq!(right_hand_side.len(), size, "one number for each unknown");
        if !self.factored {
            return;
        }
        let stack = MemStack::new(&mut self.memory);
        let factors = LuRef::new_unchecked(&self.symbolic, &self.numeric);
        let vector = MatMut::from_column_major_slice_mut(right_hand_side, size, 1);
        if transposed {
            factors.solve_transpose_in_place_with_conj(Conj::No, vector, Par::Seq, stack);
        } else {
            factors.solve_in_place_with_conj(Conj::No, vector, Par::Seq, stack);
        }
    }

    /// Solves once and looks at the size of the solution and of the residual.
    fn inspect(&mut self, values: &[S], largest: f64) -> Result<FactorReport, FactorError> {
        let mut solution = std::mem::take(&mut self.solution);
        solution.copy_from_slice(&self.probe);
        self.triangular(&mut solution, false);
        self.pattern.multiply(values, &solution, &mut self.product);
        let (mut size, mut unknown) = (0.0, 0);
        for (index, value) in solution.iter().enumerate() {
            // What is not a number is worse than any number.
            if value.magnitude() > size || value.magnitude().is_nan() {
                (size, unknown) = (value.magnitude(), index);
            }
        }
        self.solution = solution;
        let distance = |(&product, &probe): (&S, &S)| (product - probe).magnitude();
        let residual = self.product.iter().zip(&self.probe).map(distance).fold(0.0, f64::max);
        let probe = self.probe.iter().fold(0.0, |largest: f64, value| largest.max(value.magnitude()));
        let backward_error = residual / (largest * size + probe);
        let pivot = probe / size;
        if !size.is_finite() || !backward_error.is_finite() || backward_error > UNUSABLE {
            return Err(FactorError::ZeroPivot { unknown, pivot: 0.0, largest });
        }
        Ok(FactorReport {
            smallest_pivot: pivot,
            smallest_pivot_unknown: unknown,
            largest_diagonal: largest,
            growth: f64::NAN,
            worst_cancellation: pivot / largest,
            worst_cancellation_unknown: unknown,
            negative_pivots: None,
        })
    }
}

fn shape(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let size = pattern.size();
    SymbolicSparseColMatRef::new_checked(size, size, pattern.column_starts(), None, pattern.row_indices())
}

impl<S: Scalar + ComplexField> LinearSolver<S> for Pivoting<S> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn factor(&mut self, values: &[S]) -> Result<FactorReport, FactorError> {
        assert_eq!(values.len(), self.pattern.entries(), "one value for each entry of the pattern");
        self.factored = false;
        let largest = largest_entry(&self.pattern, values)?;
        if self.pattern.size() == 0 {
            return Ok(Monitor::new().report::<S>(0.0, largest));
        }
        if largest == 0.0 {
            return Err(FactorError::ZeroPivot { unknown: 0, pivot: 0.0, largest });
        }
        let matrix = SparseColMatRef::new(shape(&self.pattern), values);
        let stack = MemStack::new(&mut self.memory);
        let parameters = faer::Spec::default();
        let outcome =
            self.symbolic.factorize_numeric_lu(&mut self.numeric, matrix, Par::Seq, stack, parameters);
        if outcome.is_err() {
            return Err(FactorError::ZeroPivot { unknown: 0, pivot: 0.0, largest });
        }
        self.factored = true;
        self.inspect(values, largest)
    }

    fn solve(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, false);
    }

    fn solve_transposed(&mut self, right_hand_side: &mut [S]) {
        self.triangular(right_hand_side, true);
    }

    /// Not told by `faer`: the entries of the matrix, a lower bound.
    fn factor_entries(&self) -> usize {
        self.pattern.entries()
    }
}
