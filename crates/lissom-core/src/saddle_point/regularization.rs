//! Redundant constraints. Where the pivot of a multiplier vanishes, its equation repeats others: the motion is
//! determined, the multipliers are not. From then on all constraints yield a little,
//!
//! ```text
//! s C - δ s λ̂ = 0,   δ ≪ 1,   of the equilibrated tangent: -δ on the diagonal of every multiplier
//! ```
//!
//! which leaves the motion as it is, up to violations of δ times those a spring as stiff as the model would show, and
//! makes the multipliers unique: of all that hold the same motion, those of least size. Every pivot is at least δ.

use lissom_solver::{Pattern, Scalar};
use serde::{Deserialize, Serialize};

use super::equilibration::Equilibration;

/// δ: violations stay below what is solved for, also beside singular positions, where small ones are large motions; multipliers
/// keep the seven digits that round-off of violations over δ leaves, and recorded reactions are refined.
const COMPLIANCE: f64 = 1e-9;

/// The compliance of all constraints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Regularization {
    /// Positions of the multipliers' diagonal entries.
    diagonals: Vec<usize>,
    /// Compliance of each multiplier's scaled equation.
    of: Vec<f64>,
}

impl Regularization {
    /// Of the multipliers in the rows from `first` on.
    pub(crate) fn new(pattern: &Pattern, first: usize) -> Self {
        let diagonals: Vec<usize> =
            (first..pattern.size()).filter_map(|row| pattern.position(row, row)).collect();
        Self { of: vec![0.0; diagonals.len()], diagonals }
    }

    /// Enters the compliance into a tangent of scale `scale`, after its equilibration.
    pub(crate) fn enter<S: Scalar>(
        &mut self,
        scale: f64,
        equilibration: Option<&Equilibration>,
        values: &mut [S],
    ) {
        let first = equilibration.map_or(0, |found| found.factors().len() - self.of.len());
        for (k, (&position, of)) in self.diagonals.iter().zip(&mut self.of).enumerate() {
            let (own, square) = match equilibration {
                Some(found) => (COMPLIANCE, found.factors()[first + k].powi(2)),
                None => (COMPLIANCE * scale, 1.0),
            };
            values[position] -= S::from_parts(own, 0.0);
            *of = own / square;
        }
    }

    /// Violations that the compliance would allow at these multipliers, likewise.
    pub(crate) fn allowances<'a>(
        &'a self,
        factor: f64,
        multipliers: &'a [f64],
    ) -> impl Iterator<Item = f64> + 'a {
        self.of.iter().zip(multipliers).map(move |(of, multiplier)| (of * multiplier / factor).abs())
    }

    /// Lets residuals of the constraints yield to the multipliers; `factor` is what a scaled residual times a unit of
    /// the scaled multipliers is in SI.
    pub(crate) fn relax(&self, factor: f64, multipliers: &[f64], constraints: &mut [f64]) {
        for ((value, multiplier), of) in constraints.iter_mut().zip(multipliers).zip(&self.of) {
            *value -= of * multiplier / factor;
        }
    }
}
