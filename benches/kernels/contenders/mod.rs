//! Other solvers, behind one interface: refactor numbers on a known pattern, solve in place.

pub(crate) mod ldlt;
pub(crate) mod lu;

#[cfg(feature = "klu")]
pub(crate) mod klu;

use lissom_solver::{LinearSolver, Multifrontal, Structure, Symmetric};

/// Refactors and solves.
pub(crate) trait Contender {
    /// Factors the values on the pattern it was made for.
    fn factor(&mut self, values: &[f64]);
    /// Solves in place with the last factors.
    fn solve(&mut self, vector: &mut [f64]);
}

/// The solvers of this crate.
pub(crate) struct Ours(Box<dyn LinearSolver<f64>>);

impl Ours {
    /// LU.
    pub(crate) fn lu(structure: &Structure) -> Self {
        Self(Box::new(Multifrontal::new(structure)))
    }

    /// LDLᵀ.
    pub(crate) fn ldlt(structure: &Structure) -> Self {
        Self(Box::new(Symmetric::new(structure)))
    }
}

impl Contender for Ours {
    fn factor(&mut self, values: &[f64]) {
        self.0.factor(values).expect("a regular matrix");
    }
    fn solve(&mut self, vector: &mut [f64]) {
        self.0.solve(vector);
    }
}
