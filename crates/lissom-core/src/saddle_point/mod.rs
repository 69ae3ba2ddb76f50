//! The linear systems of all analyses: saddle-point matrices of coordinates and multipliers,
//!
//! ```text
//! [ A  Bᵀ ]
//! [ B  0  ]
//! ```
//!
//! equilibrated, factored without pivoting, and factored again where a pivot vanishes: without the equation of a multiplier, which
//! then depends on the others; with exchanges of rows, if that does not help. Steps, paths, initial values, linear models, condition
//! numbers and assembly have this sequence in common. Knows no mechanics.
//!
//! An omitted equation has -1 on the diagonal of the equilibrated matrix. The others imply it, so that the solution satisfies it with
//! a multiplier of zero. Iterates of a nonlinear problem do not yet satisfy one that is dependent in their position only: it has a small
//! compliance.
//!
//! Only steps and condition numbers fall back on exchanges of rows; assembly begins with them. Paths and the search for modes count negative pivots, which
//! exchanges hide; and initial values and linear models report a coordinate whose pivot vanishes as one that nothing
//! determines, where exchanges of rows would find some solution of a singular system.

pub(crate) mod equilibration;
mod matrix;
pub(crate) mod potential;
pub(crate) mod stage_tangents;
mod tangent_numbers;
mod tangent_values;

use lissom_solver::{FactorError, FactorReport, Pattern, SolverKind, Structure};
use serde::{Deserialize, Serialize};

use equilibration::Equilibration;
pub(crate) use matrix::{Matrix, SolverOf};
use stage_tangents::StageTangents;
use tangent_numbers::TangentNumbers;
pub use tangent_values::TangentValues;

/// The pivot of a redundant constraint's multiplier is this fraction of the terms it is made of, or less.
pub(crate) const REDUNDANT: f64 = 1e-12;

/// Compliance in the equation of a multiplier whose pivot vanishes, as in a singular position. The equation remains, since the
/// step must determine the multiplier.
const COMPLIANCE: f64 = 1e-9;

/// What is factored: one matrix, or those of the decoupled systems of a scheme's stages.
pub(crate) trait Matrices {
    /// Brings rows and columns to one size.
    fn equilibrate(&mut self, structure: &Structure, equilibration: &mut Equilibration);

    /// Returns to values that are not symmetric if their symmetric part is in use; whether it was.
    fn restore_differences(&mut self, structure: &Structure) -> bool;

    /// Subtracts `by` from the diagonal entry of `unknown`.
    fn omit(&mut self, structure: &Structure, unknown: usize, by: f64);

    /// Factors the values as they are.
    ///
    /// # Errors
    /// If a pivot vanishes or a number is not finite.
    fn factor(&mut self) -> Result<FactorReport, FactorError>;

    /// Whether the solver exchanges rows, so that its report does not compare pivots with their terms.
    fn exchanges_rows(&self) -> bool;

    /// Continues with another solver and the same values.
    fn replace_solver(&mut self, kind: &SolverKind, structure: &Structure);
}

/// A saddle-point matrix with its factors.
pub(crate) struct SaddlePoint<M> {
    pub(crate) matrices: M,
    coordinate_count: usize,
    equilibration: Option<Equilibration>,
    /// Whether equations of multipliers may be omitted.
    omits: bool,
    /// Unknowns whose equations are omitted.
    omitted: Vec<usize>,
    /// Further ones, whose pivots have vanished.
    dependent: Vec<usize>,
    /// The solver to continue with where a pivot vanishes, until it is needed.
    fall_back: Option<&'static SolverKind>,
    /// The unknown whose pivot vanished, and the pivot, once it was needed.
    fell_back: Option<(usize, f64)>,
    /// Report of the last factorisation, if it has succeeded.
    report: Option<FactorReport>,
}

/// What outlives a step of the factors, for snapshots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learned {
    /// The values factored last, if there are any.
    numbers: Option<Vec<TangentNumbers>>,
    equilibration: Option<Vec<f64>>,
    omitted: Vec<usize>,
    dependent: Vec<usize>,
    fell_back: Option<(usize, f64)>,
    /// Whether the solver is for symmetric matrices.
    is_symmetric: bool,
}

impl<M: Matrices> SaddlePoint<M> {
    /// Not equilibrated, and with no other solver to fall back on; the unknowns from `coordinate_count` on are multipliers.
    pub(crate) fn new(matrices: M, coordinate_count: usize) -> Self {
        Self {
            matrices,
            coordinate_count,
            equilibration: None,
            omits: true,
            omitted: Vec::new(),
            dependent: Vec::new(),
            fall_back: None,
            fell_back: None,
            report: None,
        }
    }

    /// This problem with rows and columns of one size, for `size` unknowns.
    pub(crate) fn equilibrated(mut self, size: usize) -> Self {
        self.equilibration = Some(Equilibration::new(size, self.coordinate_count));
        self
    }

    /// This problem with a matrix that determines its multipliers: none of its constraints is redundant.
    pub(crate) fn with_all_equations(mut self) -> Self {
        self.omits = false;
        self
    }

    /// This problem, continued with a solver that exchanges rows where a pivot vanishes without; `own` is the solver in use.
    pub(crate) fn falling_back(mut self, own: &SolverKind) -> Self {
        self.fall_back =
            lissom_solver::kind("pivoting").filter(|kind| kind.name != own.name && !own.is_strict);
        self.omits &= !own.is_strict;
        self
    }

    /// Omits the equations of these multipliers, and no others, from the next factorisation on.
    pub(crate) fn omit(&mut self, multipliers: &[usize]) {
        self.omitted.clear();
        self.omitted.extend(multipliers.iter().map(|multiplier| self.coordinate_count + multiplier));
    }

    /// Factors the values of the matrices, which it scales. `scale` is that of the constraints' rows.
    ///
    /// # Errors
    /// If a pivot vanishes with and without exchanges of rows, or a number is not finite.
    pub(crate) fn factor(&mut self, structure: &Structure, scale: f64) -> Result<FactorReport, FactorError> {
        self.dependent.clear();
        self.factor_with(structure, scale, 1.0, &mut |_| true)
    }

    /// Factors an iterate of a nonlinear problem. What `is_dependent` in its position is not omitted, but has a small compliance, and
    /// retains it at all further iterates; other pivots are lost to round-off, and require exchanges of rows.
    ///
    /// # Errors
    /// As of [`factor`](Self::factor).
    pub(crate) fn renew(
        &mut self,
        structure: &Structure,
        scale: f64,
        is_dependent: &mut dyn FnMut(usize) -> bool,
    ) -> Result<FactorReport, FactorError> {
        self.factor_with(structure, scale, COMPLIANCE, is_dependent)
    }

    /// Factors with this `compliance` of dependent equations.
    fn factor_with(
        &mut self,
        structure: &Structure,
        scale: f64,
        compliance: f64,
        is_dependent: &mut dyn FnMut(usize) -> bool,
    ) -> Result<FactorReport, FactorError> {
        self.report = None;
        if let Some(equilibration) = &mut self.equilibration {
            self.matrices.equilibrate(structure, equilibration);
        }
        let diagonal = if self.equilibration.is_some() { 1.0 } else { scale };
        for &unknown in &self.omitted {
            self.matrices.omit(structure, unknown, diagonal);
        }
        for &unknown in &self.dependent {
            self.matrices.omit(structure, unknown, compliance * diagonal);
        }
        let mut result = self.matrices.factor();
        let negative = result.as_ref().ok().and_then(|report| report.negative_pivots);
        // Iterations by an indefinite symmetric part may leave the path of the equilibria.
        if negative != Some(structure.pattern.size() - self.coordinate_count)
            && self.matrices.restore_differences(structure)
        {
            result = self.matrices.factor();
        }
        let mut lost = None;
        while self.omits
            && let Some((unknown, pivot)) = self.depending(&result)
            && !self.omitted.contains(&unknown)
            && !self.dependent.contains(&unknown)
        {
            if !is_dependent(unknown) {
                lost = Some((unknown, pivot));
                break;
            }
            self.dependent.push(unknown);
            self.matrices.omit(structure, unknown, compliance * diagonal);
            result = self.matrices.factor();
        }
        if let Err(FactorError::ZeroPivot { unknown, pivot, .. }) = result {
            lost = Some((unknown, pivot));
        }
        if lost.is_some()
            && let Some(kind) = self.fall_back.take()
        {
            self.fell_back = lost;
            self.matrices.replace_solver(kind, structure);
            // What elimination without exchanges stops at says more than where exchanges end.
            result = self.matrices.factor().or_else(|error| result.and(Err(error)));
        }
        self.report = result.ok();
        result
    }

    /// The multiplier whose equation may depend on others, if there is one: its pivot, after those of the coordinates, is only
    /// round-off. With the pivot, relative to its terms if elimination went on.
    fn depending(&self, result: &Result<FactorReport, FactorError>) -> Option<(usize, f64)> {
        let (unknown, pivot) = match result {
            Ok(report) if report.worst_cancellation < REDUNDANT && !self.matrices.exchanges_rows() => {
                (report.worst_cancellation_unknown, report.worst_cancellation)
            }
            Err(FactorError::ZeroPivot { unknown, pivot, .. }) => (*unknown, *pivot),
            Ok(_) | Err(FactorError::NotFinite { .. } | FactorError::Interrupted) => return None,
        };
        (unknown >= self.coordinate_count).then_some((unknown, pivot))
    }

    /// The report of the last factorisation, if it has succeeded.
    pub(crate) fn report(&self) -> Option<&FactorReport> {
        self.report.as_ref()
    }

    /// The factors of rows and columns, if they are equilibrated.
    pub(crate) fn row_factors(&self) -> Option<&[f64]> {
        self.equilibration.as_ref().map(Equilibration::factors)
    }

    /// A right-hand side of the equilibrated matrix, or from its solution to that of the matrix itself.
    pub(crate) fn scale(&self, vector: &mut [f64]) {
        if let Some(equilibration) = &self.equilibration {
            equilibration.scale(vector);
        }
    }

    /// Unknowns whose equations are omitted as redundant.
    pub(crate) fn omitted(&self) -> &[usize] {
        &self.omitted
    }

    /// Compliance of the equations that were dependent in a factorisation, by unknown, of the matrix itself, in which `scale` is that of
    /// the constraints' rows.
    pub(crate) fn compliances(&self, scale: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        let factors = self.row_factors();
        let unit = move |unknown: usize| factors.map_or(scale, |factors| factors[unknown].powi(-2));
        self.dependent.iter().map(move |&unknown| (unknown, COMPLIANCE * unit(unknown)))
    }

    /// The first multiplier whose equation was omitted from the last factorisation, if there is one.
    pub(crate) fn redundant(&self) -> Option<usize> {
        self.omitted.iter().chain(&self.dependent).min().copied()
    }

    /// The unknown whose pivot vanished, and the pivot, if rows are exchanged since then.
    pub(crate) fn fell_back(&self) -> Option<(usize, f64)> {
        self.fell_back
    }
}

impl<S: SolverOf> SaddlePoint<Matrix<S>> {
    /// Solves in place for a right-hand side of the equilibrated matrix.
    pub(crate) fn solve_equilibrated(&mut self, right: &mut [S]) {
        self.matrices.solver.solve(right);
    }

    /// Solves in place.
    pub(crate) fn solve(&mut self, right: &mut [S]) {
        self.scale_any(right);
        self.solve_equilibrated(right);
        self.scale_any(right);
    }

    fn scale_any(&self, vector: &mut [S]) {
        if let Some(factors) = self.row_factors() {
            for (value, &factor) in vector.iter_mut().zip(factors) {
                *value *= S::from_real(factor);
            }
        }
    }
}

impl SaddlePoint<StageTangents> {
    /// Scales the values of another matrix like the factored one, and omits the same equations; `scale` is that of the constraints' rows.
    pub(crate) fn scale_as_factored(&self, pattern: &Pattern, values: &mut [f64], scale: f64) {
        if let Some(equilibration) = &self.equilibration {
            equilibration.scale_matrix(pattern, values);
        }
        let diagonal = if self.equilibration.is_some() { 1.0 } else { scale };
        for (unknowns, by) in [(&self.omitted, diagonal), (&self.dependent, COMPLIANCE * diagonal)] {
            for position in unknowns.iter().filter_map(|&unknown| pattern.position(unknown, unknown)) {
                values[position] -= by;
            }
        }
    }

    /// What outlives a step.
    pub(crate) fn learned(&self) -> Learned {
        Learned {
            numbers: self.report.as_ref().map(|_| self.matrices.numbers()),
            equilibration: self.row_factors().map(<[f64]>::to_vec),
            omitted: self.omitted.clone(),
            dependent: self.dependent.clone(),
            fell_back: self.fell_back,
            is_symmetric: self.matrices.is_symmetric(),
        }
    }

    /// Restores what was learned, and factors the values again.
    ///
    /// # Errors
    /// If a matrix cannot be factored: it is not the one that was taken.
    pub(crate) fn restore(&mut self, structure: &Structure, from: &Learned) -> Result<(), FactorError> {
        if let (Some(equilibration), Some(factors)) = (&mut self.equilibration, &from.equilibration) {
            equilibration.set_factors(factors);
        }
        self.omitted.clone_from(&from.omitted);
        self.dependent.clone_from(&from.dependent);
        if !from.is_symmetric {
            self.matrices.generalise(structure);
        }
        if from.fell_back.is_some()
            && self.fell_back.is_none()
            && let Some(kind) = self.fall_back.take()
        {
            self.matrices.replace_solver(kind, structure);
        }
        self.fell_back = from.fell_back;
        self.report = None;
        if let Some(numbers) = &from.numbers {
            self.matrices.set_numbers(numbers);
            self.report = Some(self.matrices.factor()?);
        }
        Ok(())
    }

    /// Exchanges the factors with those of another one, and takes over its omitted equations.
    pub(crate) fn borrow_factors(&mut self, other: &mut Self) {
        self.omitted.clone_from(&other.omitted);
        self.dependent.clone_from(&other.dependent);
        self.exchange_factors(other);
    }

    /// Exchanges the factors with those of another one.
    pub(crate) fn exchange_factors(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.matrices, &mut other.matrices);
        std::mem::swap(&mut self.equilibration, &mut other.equilibration);
    }
}

#[cfg(test)]
#[path = "../../tests/unit/saddle_point/mod.rs"]
mod tests;
