//! Amplitudes of the linear model under inputs e^{st}, one sparse complex solve for each s:
//!
//! ```text
//! (s² M + s D + K) x + Bᵀ μ = f,    B x = g
//! ```
//!
//! Each solution is refined with the original equations, and checked by their residual.

use num_complex::Complex64;

use super::model::{LinearError, LinearModel};
use super::shifted::ComplexShift;
use crate::diagnostics::{Diagnostic, diagnostics};
use crate::{interrupt, round_off};

/// … or this number of times.
const REFINEMENTS: usize = 8;

diagnostics! {
    /// A response that could not be computed.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure ResponseError {
        /// A solution leaves too large a residual.
        Inexact {
            /// The rate at which the input changes [1/s].
            s: Complex64,
            /// The residual, relative to the terms of the equations.
            left: f64,
        } => "response-inexact" {
            cause: ("the response at s = {s} 1/s is not determined: the residual of the solution is {left:.1e} of the terms of its equations"),
            remedy: "check the constraints of the model; without damping, choose a frequency farther from a natural frequency",
            meaning: "The equations of a frequency response are nearly singular.",
            advice: "Hold the model, add damping, or choose a frequency farther from a natural frequency.",
        }
    }
    wraps {
        /// The matrix could not be factored.
        Linear {
            /// The rate at which the input changes [1/s].
            s: Complex64,
            /// The cause.
            error: LinearError,
        }, { s, error } => {
            let diagnostic = error.diagnostic().within(&format!("the response at s = {s} 1/s"));
            let remedy = format!("{}; without damping it is unbounded at a natural frequency", diagnostic.remedy);
            Diagnostic { remedy, ..diagnostic }
        },
    }
}

/// Solves for one s after another.
pub struct FrequencyResponse<'m, 'a> {
    model: &'m LinearModel<'a>,
    solver: ComplexShift<'a>,
    values: Vec<Complex64>,
}

impl<'a> LinearModel<'a> {
    /// The response to inputs e^{st}.
    pub fn frequency_response(&self) -> FrequencyResponse<'_, 'a> {
        FrequencyResponse {
            model: self,
            solver: ComplexShift::new(self.system, &self.representative),
            values: vec![Complex64::default(); self.pattern().entries()],
        }
    }
}

impl FrequencyResponse<'_, '_> {
    /// Amplitudes of coordinates [m, rad] and multipliers [N, N m], by row, for each right-hand side: amplitudes of forces and
    /// constraint violations, by row. `s` [1/s] is not zero.
    ///
    /// # Errors
    /// If s is an eigenvalue, or so near to one that the solution is inaccurate.
    pub fn amplitudes(
        &mut self,
        s: Complex64,
        inputs: &[Vec<f64>],
    ) -> Result<Vec<Vec<Complex64>>, ResponseError> {
        let parts = self.model.parts();
        let failed = |error| ResponseError::Linear { s, error };
        interrupt::check().map_err(|interrupted| failed(interrupted.into()))?;
        self.solver.factor(parts, s).map_err(|error| failed(self.model.stopped(&error)))?;
        for (k, value) in self.values.iter_mut().enumerate() {
            *value = s * (s * parts.mass[k] + parts.damping[k]) + parts.stiffness[k] + parts.constraint[k];
        }
        inputs.iter().map(|input| self.solve(s, input)).collect()
    }

    fn solve(&mut self, s: Complex64, input: &[f64]) -> Result<Vec<Complex64>, ResponseError> {
        let count = self.model.coordinate_count();
        let mut x = vec![Complex64::default(); input.len()];
        let mut rest: Vec<Complex64> = input.iter().copied().map(Complex64::from).collect();
        if input.iter().all(|&value| value == 0.0) {
            return Ok(x);
        }
        let (mut best, mut left) = (x.clone(), f64::INFINITY);
        for _ in 0..=REFINEMENTS {
            self.solver.solve(&mut rest);
            let factor = self.solver.multiplier_factor();
            for (row, (value, change)) in x.iter_mut().zip(&rest).enumerate() {
                *value += change * if row < count { 1.0 } else { factor };
            }
            let now = self.remainder(input, &x, &mut rest);
            if now.is_nan() || now >= left {
                break;
            }
            left = now;
            best.copy_from_slice(&x);
            if left <= round_off::SOLUTION {
                break;
            }
        }
        if left <= round_off::FORCE { Ok(best) } else { Err(ResponseError::Inexact { s, left }) }
    }

    /// Residual of the equations; returns its magnitude relative to their terms, rows and terms scaled as for the
    /// factorisation.
    fn remainder(&self, input: &[f64], x: &[Complex64], rest: &mut [Complex64]) -> f64 {
        let pattern = self.model.pattern();
        let mut terms: Vec<f64> = input.iter().map(|value| value.abs()).collect();
        for (value, &input) in rest.iter_mut().zip(input) {
            *value = Complex64::from(input);
        }
        for (column, factor) in x.iter().enumerate() {
            let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            for (&row, value) in pattern.row_indices()[range.clone()].iter().zip(&self.values[range]) {
                let term = value * factor;
                rest[row] -= term;
                terms[row] += term.l1_norm();
            }
        }
        let (mut left, mut whole) = (0.0_f64, 0.0_f64);
        for ((value, term), factor) in rest.iter().zip(&terms).zip(self.solver.row_factors()) {
            if !value.is_finite() {
                return f64::INFINITY;
            }
            left = left.max(value.norm() * factor);
            whole = whole.max(term * factor);
        }
        if whole > 0.0 { left / whole } else { f64::INFINITY }
    }
}
