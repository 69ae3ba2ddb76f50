//! The factored tangents of the decoupled systems of a scheme's stages: one real system for one stage, a complex one for a
//! pair of conjugate eigenvalues.

use lissom_motion::Block;
use lissom_solver::{
    FactorError, FactorReport, LinearSolver, Pattern, SEVERAL, Scalar, SolverKind, Structure,
    condition_estimate,
};
use num_complex::Complex64;

use super::Matrices;
use super::equilibration::Equilibration;
use super::tangent_numbers::TangentNumbers;
use super::tangent_values::TangentValues;
use crate::round_off;
use crate::schemes::{Coupling, StageSystem};

/// A solver with the values it factors.
pub(crate) struct Factored<S> {
    pub(crate) solver: Box<dyn LinearSolver<S>>,
    pub(crate) values: Vec<S>,
    right_hand_side: Vec<S>,
}

impl<S: Scalar> Factored<S> {
    fn new(solver: Box<dyn LinearSolver<S>>, structure: &Structure) -> Self {
        let (entries, size) = (structure.pattern.entries(), structure.pattern.size());
        Self { solver, values: vec![S::zero(); entries], right_hand_side: vec![S::zero(); size] }
    }

    /// Solves for the combination Σ left_i r_i of residuals.
    fn solve(&mut self, left: &[S], stages: &[Vec<f64>]) {
        // Stage by stage, as the numbers lie.
        for (index, (factor, residual)) in left.iter().zip(stages).enumerate() {
            let [re, im] = factor.parts();
            for (sum, residual) in self.right_hand_side.iter_mut().zip(residual) {
                let own = S::from_parts(re * residual, im * residual);
                *sum = if index == 0 { own } else { *sum + own };
            }
        }
        self.solver.solve(&mut self.right_hand_side);
    }

    /// Adds Re(right_i w) to the corrections, or begins them with it.
    fn add(&self, right: &[S], is_first: bool, real: impl Fn(S) -> f64, stages: &mut [Vec<f64>]) {
        for (factor, corrections) in right.iter().zip(stages) {
            let solutions = self.right_hand_side.iter().map(|value| real(*factor * *value));
            let pairs = corrections.iter_mut().zip(solutions);
            if is_first {
                pairs.for_each(|(correction, own)| *correction = own);
            } else {
                pairs.for_each(|(correction, own)| *correction += own);
            }
        }
    }

    /// Solutions of several right-hand sides at once, one in each lane.
    fn solve_several(&mut self, left: &[S], stages: &[Vec<Block>]) -> Vec<[S; SEVERAL]> {
        let mixed = |row: usize| {
            std::array::from_fn(|lane| {
                let mut sum = left[0] * S::from_real(stages[0][row][lane]);
                for (factor, residual) in left.iter().zip(stages).skip(1) {
                    sum += *factor * S::from_real(residual[row][lane]);
                }
                sum
            })
        };
        let mut right_hand_sides: Vec<[S; SEVERAL]> = (0..self.right_hand_side.len()).map(mixed).collect();
        self.solver.solve_several(&mut right_hand_sides);
        right_hand_sides
    }

    /// Solves for `weight` times these values.
    fn solve_weighted(&mut self, weight: S, values: &[f64]) {
        for (value, real) in self.right_hand_side.iter_mut().zip(values) {
            *value = weight * S::from_real(*real);
        }
        self.solver.solve(&mut self.right_hand_side);
    }
}

/// Adds the parts of the corrections that belong to these solutions, or begins with them.
fn add_several<S: Scalar>(
    solutions: &[[S; SEVERAL]],
    right: &[S],
    is_first: bool,
    real: impl Fn(S) -> f64,
    stages: &mut [Vec<Block>],
) {
    for (factor, corrections) in right.iter().zip(stages) {
        for (correction, value) in corrections.iter_mut().zip(solutions) {
            for lane in 0..SEVERAL {
                let own = real(*factor * value[lane]);
                correction[lane] = if is_first { own } else { correction[lane] + own };
            }
        }
    }
}

/// Unknowns from which on the mean of mirrored values is factored: its iterations converge linearly, so that small models, which cost little
/// anyway, would lose digits.
const MANY: usize = 3000;
/// Difference of mirrored equilibrated values up to which their mean is factored: iterations converge with it.
const LARGEST_ASYMMETRY: f64 = 0.2;

/// The factored tangent of one decoupled system.
pub(crate) enum FactoredSystem {
    Real(Factored<f64>),
    Complex(Factored<Complex64>),
}

/// The factored tangents of a scheme, in the order of its decoupled systems.
pub(crate) struct StageTangents {
    pub(crate) systems: Vec<FactoredSystem>,
    /// The solver to continue with after the first matrix that is not symmetric, if the one in use is for symmetric matrices.
    general: Option<&'static SolverKind>,
    /// Halves of the differences of mirrored values whose means are factored; empty if none are.
    differences: Vec<f64>,
    threads: usize,
}

impl StageTangents {
    pub(crate) fn new(kind: &SolverKind, structure: &Structure, coupling: &Coupling) -> Self {
        let systems = coupling.systems.iter().map(|system| match system {
            StageSystem::Real(_) => FactoredSystem::Real(Factored::new((kind.real)(structure), structure)),
            StageSystem::Complex(_) => {
                FactoredSystem::Complex(Factored::new((kind.complex)(structure), structure))
            }
        });
        Self { systems: systems.collect(), general: None, differences: Vec::new(), threads: 1 }
    }

    /// For matrices that are symmetric as a rule; `general` is the solver for others.
    pub(crate) fn symmetric(
        general: &'static SolverKind,
        structure: &Structure,
        coupling: &Coupling,
    ) -> Self {
        let tangents = Self::new(&lissom_solver::SYMMETRIC, structure, coupling);
        Self { general: Some(general), ..tangents }
    }

    /// Whether a solver for symmetric matrices is in use.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.general.is_some()
    }

    /// Changes to the solver for matrices that are not symmetric.
    pub(crate) fn generalise(&mut self, structure: &Structure) {
        if let Some(kind) = self.general {
            self.replace_solver(kind, structure);
            self.set_threads(self.threads);
        }
    }

    /// Sets the number of threads that share factorisations and solves that are large enough.
    pub(crate) fn set_threads(&mut self, threads: usize) {
        self.threads = threads;
        for system in &mut self.systems {
            match system {
                FactoredSystem::Real(own) => own.solver.set_threads(threads),
                FactoredSystem::Complex(own) => own.solver.set_threads(threads),
            }
        }
    }

    /// Whether equilibrated values are symmetric except for round-off.
    pub(crate) fn has_symmetric_values(&self, pattern: &Pattern) -> bool {
        self.systems.iter().all(|system| match system {
            FactoredSystem::Real(Factored { values, .. }) => pattern
                .mirrors()
                .all(|(.., [below, above])| (values[below] - values[above]).abs() <= round_off::MATRIX_ENTRY),
            FactoredSystem::Complex(_) => false,
        })
    }

    /// Replaces mirrored values by their means, if they differ little, as by loads that follow the motion; whether they do.
    fn symmetrise(&mut self, pattern: &Pattern) -> bool {
        self.differences.clear();
        let [FactoredSystem::Real(Factored { values, .. })] = &mut self.systems[..] else { return false };
        if pattern.size() < MANY {
            return false;
        }
        let half = |[below, above]: [usize; 2]| 0.5 * (values[below] - values[above]);
        self.differences.extend(pattern.mirrors().map(|(.., both)| half(both)));
        if !self.differences.iter().all(|half| 2.0 * half.abs() <= LARGEST_ASYMMETRY) {
            self.differences = Vec::new();
            return false;
        }
        for ((.., [below, above]), half) in pattern.mirrors().zip(&self.differences) {
            (values[below], values[above]) = (values[below] - half, values[below] - half);
        }
        true
    }

    /// Stored numbers of the factors.
    pub(crate) fn entries(&self) -> usize {
        let entries = |system: &FactoredSystem| match system {
            FactoredSystem::Real(own) => own.solver.factor_entries(),
            FactoredSystem::Complex(own) => own.solver.factor_entries(),
        };
        self.systems.iter().map(entries).sum()
    }

    /// The values of a system's tangent, to be given back.
    pub(crate) fn take_values(&mut self, system: usize) -> TangentValues {
        match &mut self.systems[system] {
            FactoredSystem::Real(own) => TangentValues::Real(std::mem::take(&mut own.values)),
            FactoredSystem::Complex(own) => TangentValues::Complex(std::mem::take(&mut own.values)),
        }
    }

    /// The tangents' values as plain numbers.
    pub(crate) fn numbers(&self) -> Vec<TangentNumbers> {
        let numbers = |system: &FactoredSystem| match system {
            FactoredSystem::Real(own) => TangentNumbers::Real(own.values.clone()),
            FactoredSystem::Complex(own) => TangentNumbers::of_complex(&own.values),
        };
        self.systems.iter().map(numbers).collect()
    }

    /// Sets the values of the tangents from plain numbers.
    pub(crate) fn set_numbers(&mut self, numbers: &[TangentNumbers]) {
        for (system, numbers) in self.systems.iter_mut().zip(numbers) {
            match (system, numbers) {
                (FactoredSystem::Real(own), TangentNumbers::Real(numbers)) => {
                    own.values.copy_from_slice(numbers);
                }
                (FactoredSystem::Complex(own), TangentNumbers::Complex(numbers)) => {
                    for (value, [re, im]) in own.values.iter_mut().zip(numbers) {
                        *value = Complex64::new(*re, *im);
                    }
                }
                _ => unreachable!("a snapshot belongs to the scheme it was taken with"),
            }
        }
    }

    /// Sets the values of a system's new tangent.
    pub(crate) fn set_values(&mut self, system: usize, tangent: TangentValues) {
        match (&mut self.systems[system], tangent) {
            (FactoredSystem::Real(own), TangentValues::Real(tangent)) => own.values = tangent,
            (FactoredSystem::Complex(own), TangentValues::Complex(tangent)) => own.values = tangent,
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm, with any units of the unknowns `states`: the largest of
    /// all systems.
    pub(crate) fn condition_estimate(&mut self, pattern: &Pattern, states: &[usize]) -> f64 {
        let estimate = |system: &mut FactoredSystem| match system {
            FactoredSystem::Real(own) => condition_estimate(&mut *own.solver, pattern, &own.values, states),
            FactoredSystem::Complex(own) => {
                condition_estimate(&mut *own.solver, pattern, &own.values, states)
            }
        };
        let estimates = self.systems.iter_mut().map(estimate);
        estimates.reduce(|most, own| if own <= most { most } else { own }).unwrap_or(1.0)
    }

    /// Solves for the corrections of all stages: residuals in, corrections out.
    pub(crate) fn solve(&mut self, coupling: &Coupling, stages: &mut [Vec<f64>]) {
        if let ([FactoredSystem::Real(alone)], [stage]) = (&mut self.systems[..], &mut *stages) {
            alone.solver.solve(stage);
            return;
        }
        for pair in self.systems.iter_mut().zip(&coupling.systems) {
            match pair {
                (FactoredSystem::Real(own), StageSystem::Real(of)) => own.solve(&of.left, stages),
                (FactoredSystem::Complex(own), StageSystem::Complex(of)) => own.solve(&of.left, stages),
                _ => unreachable!("a factorisation is made for its scheme's coupling"),
            }
        }
        for (index, pair) in self.systems.iter().zip(&coupling.systems).enumerate() {
            match pair {
                (FactoredSystem::Real(own), StageSystem::Real(of)) => {
                    own.add(&of.right, index == 0, |value| value, stages);
                }
                (FactoredSystem::Complex(own), StageSystem::Complex(of)) => {
                    own.add(&of.right, index == 0, |value| value.re, stages);
                }
                _ => unreachable!("a factorisation is made for its scheme's coupling"),
            }
        }
    }

    /// Solves for several right-hand sides at once: one in each lane.
    pub(crate) fn solve_several(&mut self, coupling: &Coupling, stages: &mut [Vec<Block>]) {
        enum Solutions {
            Real(Vec<[f64; SEVERAL]>),
            Complex(Vec<[Complex64; SEVERAL]>),
        }
        if let ([FactoredSystem::Real(alone)], [stage]) = (&mut self.systems[..], &mut *stages) {
            alone.solver.solve_several(stage);
            return;
        }
        let solve = |pair: (&mut FactoredSystem, &StageSystem)| match pair {
            (FactoredSystem::Real(own), StageSystem::Real(of)) => {
                Solutions::Real(own.solve_several(&of.left, stages))
            }
            (FactoredSystem::Complex(own), StageSystem::Complex(of)) => {
                Solutions::Complex(own.solve_several(&of.left, stages))
            }
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        };
        let solutions: Vec<Solutions> = self.systems.iter_mut().zip(&coupling.systems).map(solve).collect();
        for (index, pair) in solutions.iter().zip(&coupling.systems).enumerate() {
            match pair {
                (Solutions::Real(own), StageSystem::Real(of)) => {
                    add_several(own, &of.right, index == 0, |value| value, stages);
                }
                (Solutions::Complex(own), StageSystem::Complex(of)) => {
                    add_several(own, &of.right, index == 0, |value| value.re, stages);
                }
                _ => unreachable!("solutions are in the order of the systems"),
            }
        }
    }

    /// Solves the first system's equations for inertia times real values: of a complex one, the real part of the solution.
    pub(crate) fn solve_inertial(&mut self, coupling: &Coupling, values: &mut [f64]) {
        match (self.systems.first_mut(), coupling.systems.first()) {
            (Some(FactoredSystem::Real(own)), Some(StageSystem::Real(of))) => {
                own.solve_weighted(of.weights.acceleration, values);
                values.copy_from_slice(&own.right_hand_side);
            }
            (Some(FactoredSystem::Complex(own)), Some(StageSystem::Complex(of))) => {
                own.solve_weighted(of.weights.acceleration, values);
                for (value, real) in own.right_hand_side.iter().zip(values) {
                    *real = value.re;
                }
            }
            _ => unreachable!("a factorisation is made for its scheme's coupling"),
        }
    }
}

impl Matrices for StageTangents {
    /// With the factors of the first for all of them.
    fn equilibrate(&mut self, structure: &Structure, equilibration: &mut Equilibration) {
        let pattern = &structure.pattern;
        for (index, system) in self.systems.iter_mut().enumerate() {
            match system {
                FactoredSystem::Real(own) => {
                    if index == 0 {
                        equilibration.find(pattern, &own.values);
                    }
                    equilibration.scale_matrix(pattern, &mut own.values);
                }
                FactoredSystem::Complex(own) => {
                    if index == 0 {
                        equilibration.find(pattern, &own.values);
                    }
                    equilibration.scale_matrix(pattern, &mut own.values);
                }
            }
        }
        self.differences.clear();
        if self.is_symmetric() && !self.has_symmetric_values(pattern) && !self.symmetrise(pattern) {
            self.generalise(structure);
        }
    }

    fn restore_differences(&mut self, structure: &Structure) -> bool {
        let [FactoredSystem::Real(Factored { values, .. })] = &mut self.systems[..] else { return false };
        if self.differences.is_empty() {
            return false;
        }
        for ((.., [below, above]), half) in
            structure.pattern.mirrors().zip(std::mem::take(&mut self.differences))
        {
            values[below] += half;
            values[above] -= half;
        }
        self.generalise(structure);
        true
    }

    fn omit(&mut self, structure: &Structure, unknown: usize, by: f64) {
        let Some(diagonal) = structure.pattern.position(unknown, unknown) else { return };
        for system in &mut self.systems {
            match system {
                FactoredSystem::Real(own) => own.values[diagonal] -= by,
                FactoredSystem::Complex(own) => own.values[diagonal] -= by,
            }
        }
    }

    /// Reports the system with the smallest relative pivot, with the worst cancellation of all systems.
    fn factor(&mut self) -> Result<FactorReport, FactorError> {
        let mut worst: Option<FactorReport> = None;
        for system in &mut self.systems {
            let own = match system {
                FactoredSystem::Real(own) => own.solver.factor(&own.values)?,
                FactoredSystem::Complex(own) => own.solver.factor(&own.values)?,
            };
            worst = Some(match worst {
                Some(worst) => worse(worst, own),
                None => own,
            });
        }
        let Some(report) = worst else { unreachable!("every scheme has a stage") };
        Ok(report)
    }

    fn exchanges_rows(&self) -> bool {
        self.systems.iter().any(|system| match system {
            FactoredSystem::Real(own) => own.solver.exchanges_rows(),
            FactoredSystem::Complex(own) => own.solver.exchanges_rows(),
        })
    }

    fn replace_solver(&mut self, kind: &SolverKind, structure: &Structure) {
        self.general = None;
        for system in &mut self.systems {
            match system {
                FactoredSystem::Real(own) => own.solver = (kind.real)(structure),
                FactoredSystem::Complex(own) => own.solver = (kind.complex)(structure),
            }
        }
    }
}

/// The report with the smaller relative pivot, and the worst cancellation of both.
fn worse(a: FactorReport, b: FactorReport) -> FactorReport {
    let cancellation = if a.worst_cancellation <= b.worst_cancellation { a } else { b };
    FactorReport {
        worst_cancellation: cancellation.worst_cancellation,
        worst_cancellation_unknown: cancellation.worst_cancellation_unknown,
        ..if a.relative_pivot() <= b.relative_pivot() { a } else { b }
    }
}
