//! One saddle-point matrix, with a solver for it.

use lissom_solver::{FactorError, FactorReport, LinearSolver, Pattern, Scalar, SolverKind, Structure};
use num_complex::Complex64;

use super::Matrices;
use super::equilibration::Equilibration;
use super::refinement::Refinement;
use super::regularization::Regularization;

/// A scalar of which there are solvers of every kind.
pub(crate) trait SolverOf: Scalar {
    /// The solver of that kind.
    fn solver(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<Self>>;
}

impl SolverOf for f64 {
    fn solver(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<Self>> {
        (kind.real)(structure)
    }
}

impl SolverOf for Complex64 {
    fn solver(kind: &SolverKind, structure: &Structure) -> Box<dyn LinearSolver<Self>> {
        (kind.complex)(structure)
    }
}

/// Values on a pattern, and a solver.
pub(crate) struct Matrix<S> {
    pub(crate) solver: Box<dyn LinearSolver<S>>,
    pub(crate) values: Vec<S>,
    refinement: Refinement<S>,
}

impl<S: SolverOf> Matrix<S> {
    /// Zeros.
    pub(crate) fn new(solver: Box<dyn LinearSolver<S>>, structure: &Structure) -> Self {
        Self { solver, values: vec![S::zero(); structure.pattern.entries()], refinement: Refinement::new() }
    }

    /// Solves in place; without the compliance that is in the factors if `refined`.
    pub(super) fn solve(&mut self, pattern: &Pattern, refined: bool, right: &mut [S]) {
        let Self { solver, refinement, .. } = self;
        if refined {
            refinement.solve(pattern, right, |right| solver.solve(right));
        } else {
            solver.solve(right);
        }
    }
}

impl<S: SolverOf> Matrices for Matrix<S> {
    fn equilibrate(&mut self, structure: &Structure, equilibration: &mut Equilibration) {
        equilibration.apply(&structure.pattern, &mut self.values);
    }

    fn relax(
        &mut self,
        regularization: &mut Regularization,
        scale: f64,
        equilibration: Option<&Equilibration>,
    ) {
        self.refinement.start(&self.values);
        regularization.enter(scale, equilibration, &mut self.values);
    }

    fn factor(&mut self) -> Result<FactorReport, FactorError> {
        self.solver.factor(&self.values)
    }

    fn exchanges_rows(&self) -> bool {
        self.solver.exchanges_rows()
    }

    fn replace_solver(&mut self, kind: &SolverKind, structure: &Structure) {
        self.solver = S::solver(kind, structure);
    }
}
