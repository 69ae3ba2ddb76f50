//! Supernodal LU with partial pivoting of `faer`.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};
use lissom_solver::Pattern;

use super::Contender;

/// LU of `faer`, in the better of its two forms for these matrices.
pub(crate) struct Lu<'a> {
    pattern: &'a Pattern,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    memory: MemBuffer,
}

impl<'a> Lu<'a> {
    /// Symbolic analysis.
    pub(crate) fn new(pattern: &'a Pattern) -> Self {
        let parameters = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic = factorize_symbolic_lu(shape(pattern), parameters).expect("enough memory");
        let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, faer::Spec::default());
        let solve = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let memory = MemBuffer::new(StackReq::or(factor, solve));
        Self { pattern, symbolic, numeric: NumericLu::new(), memory }
    }
}

pub(super) fn shape(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let size = pattern.size();
    SymbolicSparseColMatRef::new_checked(size, size, pattern.column_starts(), None, pattern.row_indices())
}

impl Contender for Lu<'_> {
    fn factor(&mut self, values: &[f64]) {
        let matrix = SparseColMatRef::new(shape(self.pattern), values);
        let stack = MemStack::new(&mut self.memory);
        let outcome = self.symbolic.factorize_numeric_lu(
            &mut self.numeric,
            matrix,
            Par::Seq,
            stack,
            faer::Spec::default(),
        );
        outcome.expect("a regular matrix");
    }
    fn solve(&mut self, vector: &mut [f64]) {
        let rows = vector.len();
        let factors = LuRef::new_unchecked(&self.symbolic, &self.numeric);
        let vector = MatMut::from_column_major_slice_mut(vector, rows, 1);
        factors.solve_in_place_with_conj(Conj::No, vector, Par::Seq, MemStack::new(&mut self.memory));
    }
}
