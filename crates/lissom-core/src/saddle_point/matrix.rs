//! One saddle-point matrix, with a solver for it.

use lissom_solver::{FactorError, FactorReport, Kernels, LinearSolver, SolverKind, Structure};
use num_complex::Complex64;

use super::Matrices;
use super::equilibration::Equilibration;

/// A scalar of which there are solvers of every kind.
pub(crate) trait SolverOf: Kernels {
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
}

impl<S: SolverOf> Matrix<S> {
    /// Zeros.
    pub(crate) fn new(solver: Box<dyn LinearSolver<S>>, structure: &Structure) -> Self {
        Self { solver, values: vec![S::zero(); structure.pattern.entries()] }
    }
}

impl<S: SolverOf> Matrices for Matrix<S> {
    fn equilibrate(&mut self, structure: &Structure, equilibration: &mut Equilibration) {
        equilibration.apply(&structure.pattern, &mut self.values);
    }

    fn omit(&mut self, structure: &Structure, unknown: usize, by: f64) {
        if let Some(diagonal) = structure.pattern.position(unknown, unknown) {
            self.values[diagonal] -= S::from_real(by);
        }
    }

    fn factor(&mut self) -> Result<FactorReport, FactorError> {
        self.solver.factor(&self.values)
    }

    fn exchanges_rows(&self) -> bool {
        self.solver.exchanges_rows()
    }

    fn restore_differences(&mut self, _: &Structure) -> bool {
        false
    }

    fn replace_solver(&mut self, kind: &SolverKind, structure: &Structure) {
        self.solver = S::solver(kind, structure);
    }
}
