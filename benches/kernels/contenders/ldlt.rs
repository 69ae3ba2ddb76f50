//! LDLᵀ without pivoting of `faer`, which needs a symmetric matrix: it is given the lower triangle. With its own
//! ordering it meets a zero pivot where a multiplier comes before its coordinates: it is given this crate's.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side};
use lissom_solver::{Pattern, Structure, minimum_degree_order};

use super::Contender;
use super::lu::shape;

/// LDLᵀ of `faer`, which chooses its form by itself.
pub(crate) struct Ldlt<'a> {
    pattern: &'a Pattern,
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl<'a> Ldlt<'a> {
    /// Symbolic analysis.
    pub(crate) fn new(structure: &'a Structure) -> Self {
        let pattern = &*structure.pattern;
        let groups = minimum_degree_order(structure);
        let forward: Vec<usize> =
            groups.iter().flat_map(|&group| structure.groups[group].unknowns.iter().copied()).collect();
        let mut inverse = vec![0; forward.len()];
        for (place, &unknown) in forward.iter().enumerate() {
            inverse[unknown] = place;
        }
        let order = PermRef::new_checked(&forward, &inverse, forward.len());
        let parameters = CholeskySymbolicParams::default();
        let symbolic = factorize_symbolic_cholesky(
            shape(pattern),
            Side::Lower,
            SymmetricOrdering::Custom(order),
            parameters,
        )
        .expect("enough memory");
        let factor = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let solve = symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let memory = MemBuffer::new(StackReq::or(factor, solve));
        Self { pattern, values: vec![0.0; symbolic.len_val()], symbolic, memory }
    }
}

impl Contender for Ldlt<'_> {
    fn factor(&mut self, values: &[f64]) {
        let matrix = SparseColMatRef::new(shape(self.pattern), values);
        let outcome = self.symbolic.factorize_numeric_ldlt(
            &mut self.values,
            matrix,
            Side::Lower,
            faer::linalg::cholesky::ldlt::factor::LdltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            faer::Spec::default(),
        );
        outcome.expect("no pivot vanishes");
    }
    fn solve(&mut self, vector: &mut [f64]) {
        let rows = vector.len();
        let vector = MatMut::from_column_major_slice_mut(vector, rows, 1);
        let factors = LdltRef::new(&self.symbolic, &self.values);
        factors.solve_in_place_with_conj(Conj::No, vector, Par::Seq, MemStack::new(&mut self.memory));
    }
}
