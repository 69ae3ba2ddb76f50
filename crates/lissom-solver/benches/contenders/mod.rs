//! Other solvers, behind one interface: refactor numbers on a known pattern, solve in place.

pub(crate) mod ldlt;
pub(crate) mod lu;

#[cfg(feature = "klu")]
pub(crate) mod klu;

use lissom_solver::{LinearSolver, Structure, kind};

/// Refactors and solves.
pub(crate) trait Contender {
    /// Factors the values on the pattern it was made for.
    fn factor(&mut self, values: &[f64]);
    /// Solves in place with the last factors.
    fn solve(&mut self, vector: &mut [f64]);
}

/// The solver of this crate.
pub(crate) struct Ours(Box<dyn LinearSolver<f64>>);

impl Ours {
    /// Symbolic analysis.
    pub(crate) fn new(structure: &Structure) -> Self {
        Self((kind("sparse").expect("the default solver").real)(structure))
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
