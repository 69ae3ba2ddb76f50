//! The table of the kinds of solvers.

use num_complex::Complex64;

use crate::solver::LinearSolver;
use crate::structure::Structure;
use crate::{multifrontal, pivoting};

/// Word of the solver that shows what the method does without help.
const STRICT: &str = "strict";

/// A kind of solver: one line in [`KINDS`].
pub struct SolverKind {
    /// Name, as written in input files.
    pub name: &'static str,
    /// One line for manuals.
    pub summary: &'static str,
    /// Whether nothing is to help where its elimination stops or loses digits: no exchange of rows, no omitted equation, no shorter step.
    pub is_strict: bool,
    /// Symbolic analysis for real matrices.
    pub real: fn(&Structure) -> Box<dyn LinearSolver<f64>>,
    /// Symbolic analysis for complex matrices.
    pub complex: fn(&Structure) -> Box<dyn LinearSolver<Complex64>>,
}

/// Every kind of solver, the default first. The constructors panic on a structure that
/// [`Structure::check`] rejects.
pub static KINDS: &[SolverKind] = &[
    SolverKind {
        name: multifrontal::NAME,
        summary: "multifrontal without pivoting: the default, fast for chains, trees and grids alike",
        is_strict: false,
        real: |structure| Box::new(multifrontal::Multifrontal::<f64>::new(structure)),
        complex: |structure| Box::new(multifrontal::Multifrontal::<Complex64>::new(structure)),
    },
    SolverKind {
        name: pivoting::NAME,
        summary: "sparse LU with partial pivoting: fallback, and for comparison",
        is_strict: false,
        real: |structure| Box::new(pivoting::Pivoting::<f64>::new(structure)),
        complex: |structure| Box::new(pivoting::Pivoting::<Complex64>::new(structure)),
    },
    SolverKind {
        name: STRICT,
        summary: "`sparse`, and a step fails where its elimination stops or loses the digits of the solution",
        is_strict: true,
        real: |structure| Box::new(multifrontal::Multifrontal::<f64>::new(structure)),
        complex: |structure| Box::new(multifrontal::Multifrontal::<Complex64>::new(structure)),
    },
];

/// The kind of that name.
pub fn kind(name: &str) -> Option<&'static SolverKind> {
    KINDS.iter().find(|kind| kind.name == name)
}

/// Multifrontal LDLᵀ without pivoting, for matrices that are symmetric, or so nearly that iterations converge with their lower half.
pub static SYMMETRIC: SolverKind = SolverKind {
    name: "symmetric",
    summary: "multifrontal without pivoting for symmetric matrices: half the work",
    is_strict: false,
    real: |structure| Box::new(multifrontal::Symmetric::<f64>::new(structure)),
    complex: |structure| Box::new(multifrontal::Symmetric::<Complex64>::new(structure)),
};
