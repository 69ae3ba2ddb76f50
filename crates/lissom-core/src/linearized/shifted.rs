//! The saddle-point matrix s² M + s D + K with the constraints, scaled, augmented and factored without pivoting.
//!
//! With time in units of 1/|s| it is the tangent of a scheme whose velocity and acceleration are s/|s| and s²/|s|²
//! times the increment: the same scaling, augmented term and equilibration are used.

use std::ops::Mul;

use lissom_solver::{FactorError, Multifrontal, Structure, Symmetric};
use num_complex::Complex64;

use crate::saddle_point::potential::Noise;
use crate::saddle_point::{Matrix, SaddlePoint, SolverOf};
use crate::scaling::{Representative, Scaled};
use crate::schemes::Weights;
use crate::system::{Blend, Linearization, System};

/// The squared rate from which the search for modes starts, relative to that of the stiffest parts.
pub(super) const START_RATE: f64 = 1e-6;

/// Residual of a random right-hand side of magnitude 1, above which the signs of pivots are not trusted.
pub(super) const ACCURATE: f64 = 1e-3;

/// Solves with K - λ M and the constraints, symmetric, for a real λ = s².
pub(super) struct RealShift<'a> {
    system: &'a System,
    representative: Representative,
    scaled: Scaled,
    saddle: SaddlePoint<Matrix<f64>>,
}

impl<'a> RealShift<'a> {
    pub(super) fn new(system: &'a System, representative: &Representative) -> Self {
        let layout = system.layout();
        let matrix = Matrix::new(Box::new(Symmetric::new(system.structure())), system.structure());
        Self {
            system,
            representative: *representative,
            scaled: Scaled::at_rate(representative, 1.0),
            saddle: SaddlePoint::new(matrix, layout.coordinate_count()).equilibrated(layout.size()),
        }
    }

    /// A squared rate [1/s²] that is small compared with those of the stiffest parts; 1 without stiffness.
    pub(super) fn small_square(&self) -> f64 {
        small_square(&self.representative)
    }

    /// Factorises at λ = `shift` [1/s²]; returns the number of eigenvalues λ below it.
    pub(super) fn factor(&mut self, parts: &Linearization, shift: f64) -> Result<usize, FactorError> {
        self.factor_values(shift, |_, blend, values| {
            for (k, value) in values.iter_mut().enumerate() {
                *value = blend.place * parts.stiffness[k]
                    + blend.acceleration * parts.mass[k]
                    + blend.augmented * parts.gram[k]
                    + blend.constraint * parts.constraint[k];
            }
            Ok(())
        })
    }

    /// Factorises the values that `fill` supplies, the derivatives weighted by these factors; returns the number of eigenvalues below.
    pub(super) fn factor_values(
        &mut self,
        shift: f64,
        fill: impl FnOnce(&Scaled, Blend<f64>, &mut [f64]) -> Result<(), FactorError>,
    ) -> Result<usize, FactorError> {
        let magnitude = if shift == 0.0 { self.small_square() } else { shift.abs() };
        self.scaled = Scaled::at_rate(&self.representative, magnitude.sqrt());
        let blend = self.scaled.blend(Weights::of_motion(0.0, -shift / magnitude));
        fill(&self.scaled, blend, &mut self.saddle.matrices.values)?;
        let (structure, layout) = (self.system.structure(), self.system.layout());
        let report = self.saddle.factor(structure, self.scaled.scale())?;
        let negative = report.negative_pivots.unwrap_or(usize::MAX);
        let forces = layout.size() - layout.coordinate_count();
        Ok(negative.saturating_sub(forces))
    }

    /// Whether the last factorisation solves with its matrix: numbers that grow in an elimination without pivoting spoil the signs of pivots,
    /// too. Errors of the factors that change no sign are small compared with the smallest eigenvalue, and so is this residual.
    pub(super) fn is_accurate(&mut self) -> bool {
        let pattern = &self.system.structure().pattern;
        let mut noise = Noise(3);
        let right: Vec<f64> = (0..pattern.size()).map(|_| noise.number()).collect();
        let (mut solution, mut product) = (right.clone(), vec![0.0; right.len()]);
        self.saddle.solve_equilibrated(&mut solution);
        pattern.multiply(&self.saddle.matrices.values, &solution, &mut product);
        product.iter().zip(&right).all(|(product, right)| (product - right).abs() <= ACCURATE)
    }

    /// Solves for forces and violations in SI: displacements, and multipliers in units of
    /// [`multiplier_factor`](Self::multiplier_factor).
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        self.scaled.scale_residual(self.system.layout(), right);
        self.saddle.solve(right);
    }

    /// Factor from a scaled multiplier to SI.
    pub(super) fn multiplier_factor(&self) -> f64 {
        self.scaled.multiplier_factor()
    }
}

/// A shift s of a model with damping: real, or complex.
pub(super) trait Shift: SolverOf + Mul<f64, Output = Self> {
    /// |s|.
    fn size(self) -> f64;
}

impl Shift for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Shift for Complex64 {
    fn size(self) -> f64 {
        self.norm()
    }
}

/// Solves with s² M + s D + K and the constraints for a complex s.
pub(super) type ComplexShift<'a> = GeneralShift<'a, Complex64>;

/// Solves with s² M + s D + K and the constraints for a real or a complex s.
pub(super) struct GeneralShift<'a, S> {
    system: &'a System,
    structure: Structure,
    representative: Representative,
    scaled: Scaled,
    saddle: SaddlePoint<Matrix<S>>,
}

impl<'a, S: Shift> GeneralShift<'a, S> {
    pub(super) fn new(system: &'a System, representative: &Representative) -> Self {
        Self::on(system, system.structure(), representative)
    }

    /// For matrices with another structure than the system's.
    pub(super) fn on(system: &'a System, structure: &Structure, representative: &Representative) -> Self {
        let layout = system.layout();
        let matrix = Matrix::new(Box::new(Multifrontal::new(structure)), structure);
        Self {
            system,
            structure: structure.clone(),
            representative: *representative,
            scaled: Scaled::at_rate(representative, 1.0),
            saddle: SaddlePoint::new(matrix, layout.coordinate_count()).equilibrated(layout.size()),
        }
    }

    /// Factorises at `shift` [1/s], which is not zero.
    pub(super) fn factor(&mut self, parts: &Linearization, shift: S) -> Result<(), FactorError> {
        self.scaled = Scaled::at_rate(&self.representative, shift.size());
        let unit = shift * shift.size().recip();
        let blend = self.scaled.blend(Weights::of_motion(unit, unit * unit));
        for (k, value) in self.saddle.matrices.values.iter_mut().enumerate() {
            *value = blend.acceleration * parts.mass[k]
                + blend.rate * parts.damping[k]
                + S::from_real(
                    blend.place * parts.stiffness[k]
                        + blend.augmented * parts.gram[k]
                        + blend.constraint * parts.constraint[k],
                );
        }
        // s B + N of constraints of velocities is scaled like the rows of other constraints.
        let (pattern, scale) = (&self.structure.pattern, self.scaled.scale());
        for row in self.system.layout().velocity_rows() {
            for k in pattern.column(row).iter().filter_map(|&column| pattern.position(row, column)) {
                self.saddle.matrices.values[k] = shift * (scale * parts.damping[k])
                    + S::from_real(scale * (parts.stiffness[k] + parts.constraint[k]));
            }
        }
        self.saddle.factor(&self.structure, self.scaled.scale()).map(|_| ())
    }

    /// Solves for forces and violations in SI: displacements in the rows of the coordinates, and multipliers in units of
    /// [`multiplier_factor`](Self::multiplier_factor).
    pub(super) fn solve(&mut self, right: &mut [S]) {
        for (value, factor) in right.iter_mut().zip(self.row_factors()) {
            *value = *value * factor;
        }
        self.saddle.solve_equilibrated(right);
        for (value, &factor) in right.iter_mut().zip(self.saddle.row_factors().unwrap_or_default()) {
            *value = *value * factor;
        }
    }

    /// Whether constraints are redundant in the factored matrix.
    pub(super) fn has_redundant_constraints(&self) -> bool {
        self.saddle.redundant().is_some()
    }

    /// Factors that convert rows in SI to the rows of the factored matrix.
    pub(super) fn row_factors(&self) -> impl Iterator<Item = f64> + '_ {
        let count = self.system.layout().coordinate_count();
        let of_rows = [self.scaled.dynamic_factor(), self.scaled.scale()];
        let factors = self.saddle.row_factors().unwrap_or_default().iter().enumerate();
        factors.map(move |(row, factor)| factor * of_rows[usize::from(row >= count)])
    }

    /// Factor from a scaled multiplier to SI.
    pub(super) fn multiplier_factor(&self) -> f64 {
        self.scaled.multiplier_factor()
    }
}

/// A squared rate [1/s²] that is small compared with those of the stiffest parts.
pub(super) fn small_square(representative: &Representative) -> f64 {
    let square = START_RATE * representative.stiffness / representative.mass;
    if square.is_finite() && square > 0.0 { square } else { 1.0 }
}
