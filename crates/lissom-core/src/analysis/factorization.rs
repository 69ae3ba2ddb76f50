//! The factored tangent: real for schemes of one stage, complex for coupled pairs.

use lissom_motion::Block;
use lissom_solver::{
    FactorError, FactorReport, LinearSolver, Pattern, SEVERAL, SolverKind, Structure, condition_estimate,
};
use num_complex::Complex64;

use super::compliance::Compliance;
use super::tangent_numbers::TangentNumbers;
use super::tangent_values::TangentValues;
use crate::equilibration::Equilibration;
use crate::schemes::Coupling;

/// A solver with the values it factors.
pub(crate) enum Factorization {
    Single { solver: Box<dyn LinearSolver<f64>>, values: Vec<f64> },
    Pair { solver: Box<dyn LinearSolver<Complex64>>, values: Vec<Complex64>, right_hand_side: Vec<Complex64> },
}

impl Factorization {
    pub(crate) fn new(kind: &SolverKind, structure: &Structure, coupling: &Coupling) -> Self {
        let entries = structure.pattern.entries();
        let size = structure.pattern.size();
        match coupling {
            Coupling::Single(_) => {
                Self::Single { solver: (kind.real)(structure), values: vec![0.0; entries] }
            }
            Coupling::Pair { .. } => Self::Pair {
                solver: (kind.complex)(structure),
                values: vec![Complex64::default(); entries],
                right_hand_side: vec![Complex64::default(); size],
            },
        }
    }

    /// Lets so many threads share factorisations and solves that are large enough.
    pub(crate) fn set_threads(&mut self, threads: usize) {
        match self {
            Self::Single { solver, .. } => solver.set_threads(threads),
            Self::Pair { solver, .. } => solver.set_threads(threads),
        }
    }

    /// Stored numbers of the factors.
    pub(crate) fn entries(&self) -> usize {
        match self {
            Self::Single { solver, .. } => solver.factor_entries(),
            Self::Pair { solver, .. } => solver.factor_entries(),
        }
    }

    /// Goes on with another solver and the same tangent.
    pub(crate) fn replace_solver(&mut self, kind: &SolverKind, structure: &Structure) {
        match self {
            Self::Single { solver, .. } => *solver = (kind.real)(structure),
            Self::Pair { solver, .. } => *solver = (kind.complex)(structure),
        }
    }

    /// The tangent's values, to be given back.
    pub(crate) fn take_values(&mut self) -> TangentValues {
        match self {
            Self::Single { values, .. } => TangentValues::Real(std::mem::take(values)),
            Self::Pair { values, .. } => TangentValues::Complex(std::mem::take(values)),
        }
    }

    /// The tangent's values as plain numbers.
    pub(crate) fn numbers(&self) -> TangentNumbers {
        match self {
            Self::Single { values, .. } => TangentNumbers::Real(values.clone()),
            Self::Pair { values, .. } => TangentNumbers::of_complex(values),
        }
    }

    /// Takes the values of a tangent as plain numbers.
    pub(crate) fn set_numbers(&mut self, numbers: &TangentNumbers) {
        match (self, numbers) {
            (Self::Single { values, .. }, TangentNumbers::Real(numbers)) => values.copy_from_slice(numbers),
            (Self::Pair { values, .. }, TangentNumbers::Complex(numbers)) => {
                for (value, [re, im]) in values.iter_mut().zip(numbers) {
                    *value = Complex64::new(*re, *im);
                }
            }
            _ => unreachable!("a snapshot belongs to the scheme it was taken with"),
        }
    }

    /// Takes the values of a new tangent.
    pub(crate) fn set_values(&mut self, tangent: TangentValues) {
        match (self, tangent) {
            (Self::Single { values, .. }, TangentValues::Real(tangent)) => *values = tangent,
            (Self::Pair { values, .. }, TangentValues::Complex(tangent)) => *values = tangent,
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }

    /// Brings rows and columns of a new tangent to one size.
    pub(crate) fn equilibrate(&mut self, pattern: &Pattern, equilibration: &mut Equilibration) {
        match self {
            Self::Single { values, .. } => equilibration.apply(pattern, values),
            Self::Pair { values, .. } => equilibration.apply(pattern, values),
        }
    }

    /// Lets constraints yield, after equilibration.
    pub(crate) fn relax(
        &mut self,
        compliance: &mut Compliance,
        scale: f64,
        equilibration: Option<&Equilibration>,
    ) {
        match self {
            Self::Single { values, .. } => compliance.enter(scale, equilibration, values),
            Self::Pair { values, .. } => compliance.enter(scale, equilibration, values),
        }
    }

    /// Factors the tangent.
    pub(crate) fn factor(&mut self) -> Result<FactorReport, FactorError> {
        match self {
            Self::Single { solver, values } => solver.factor(values),
            Self::Pair { solver, values, .. } => solver.factor(values),
        }
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm.
    pub(crate) fn condition_estimate(&mut self, pattern: &Pattern) -> f64 {
        match self {
            Self::Single { solver, values } => condition_estimate(&mut **solver, pattern, values),
            Self::Pair { solver, values, .. } => condition_estimate(&mut **solver, pattern, values),
        }
    }

    /// Solves for the corrections of all stages: residuals in, corrections out.
    pub(crate) fn solve(&mut self, coupling: &Coupling, stages: &mut [Vec<f64>]) {
        match (self, coupling) {
            (Self::Single { solver, .. }, Coupling::Single(_)) => solver.solve(&mut stages[0]),
            (Self::Pair { solver, right_hand_side, .. }, Coupling::Pair { left, right, .. }) => {
                let (first, second) = stages.split_at_mut(1);
                let (first, second) = (&mut first[0], &mut second[0]);
                for (value, (a, b)) in right_hand_side.iter_mut().zip(first.iter().zip(second.iter())) {
                    *value = left[0] * a + left[1] * b;
                }
                solver.solve(right_hand_side);
                for (value, (a, b)) in right_hand_side.iter().zip(first.iter_mut().zip(second.iter_mut())) {
                    *a = (right[0] * value).re;
                    *b = (right[1] * value).re;
                }
            }
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }

    /// The same for several right-hand sides at once: one in each lane.
    pub(crate) fn solve_several(&mut self, coupling: &Coupling, stages: &mut [Vec<Block>]) {
        match (self, coupling) {
            (Self::Single { solver, .. }, Coupling::Single(_)) => solver.solve_several(&mut stages[0]),
            (Self::Pair { solver, .. }, Coupling::Pair { left, right, .. }) => {
                let (first, second) = stages.split_at_mut(1);
                let (first, second) = (&mut first[0], &mut second[0]);
                let mixed = |(a, b): (&Block, &Block)| {
                    std::array::from_fn(|lane| left[0] * a[lane] + left[1] * b[lane])
                };
                let mut right_hand_sides: Vec<[Complex64; SEVERAL]> =
                    first.iter().zip(second.iter()).map(mixed).collect();
                solver.solve_several(&mut right_hand_sides);
                for (value, (a, b)) in right_hand_sides.iter().zip(first.iter_mut().zip(second.iter_mut())) {
                    *a = value.map(|value| (right[0] * value).re);
                    *b = value.map(|value| (right[1] * value).re);
                }
            }
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }

    /// Solves the tangent's equations for inertia times real values: of a pair, the real part of the solution.
    pub(crate) fn solve_inertial(&mut self, coupling: &Coupling, values: &mut [f64]) {
        match (self, coupling) {
            (Self::Single { solver, .. }, Coupling::Single(weights)) => {
                for value in values.iter_mut() {
                    *value *= weights.curvature;
                }
                solver.solve(values);
            }
            (Self::Pair { solver, right_hand_side, .. }, Coupling::Pair { weights, .. }) => {
                for (value, real) in right_hand_side.iter_mut().zip(values.iter()) {
                    *value = weights.curvature * real;
                }
                solver.solve(right_hand_side);
                for (value, real) in right_hand_side.iter().zip(values) {
                    *real = value.re;
                }
            }
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }
}
