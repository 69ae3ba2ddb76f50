//! Solutions with the matrix of positions near the present ones, corrected until they satisfy the equations at these.
//!
//! A matrix of other positions errs by what has turned since. Right-hand sides are residuals at the present positions, so that the fixed
//! point is the solution there, with constraint forces in their present directions.

use super::matrix::RecoveryMatrix;
use crate::integrator::anderson::Anderson;
use crate::simulation::Simulation;
use crate::tuning::Tuning;

/// Remaining correction over the first one below which no further one is made, over the tolerance of the steps: jumps act like exact ones.
const SHARE: f64 = 1e-7;
/// Contraction beyond which a matrix of the present positions is cheaper, and number of corrections beyond which it is.
const SLOWEST: f64 = 0.7;
const MAX_CORRECTIONS: usize = 10;
/// Share of the first correction at which a slow one is round-off.
const STALLED: f64 = 1e-5;

/// The iteration, with secants of the corrections.
pub(super) struct Corrections {
    secants: Anderson,
    tuning: Tuning,
    tolerance: f64,
    /// Forces of a unit of each entry.
    units: Vec<f64>,
    right: Vec<f64>,
    /// Multipliers at which residuals are evaluated.
    seen: Vec<f64>,
}

impl Corrections {
    pub(super) fn new(simulation: &Simulation, matrix: &RecoveryMatrix) -> Self {
        let (limits, layout) = (&simulation.settings().limits, simulation.system().layout());
        let units = matrix.units(layout, simulation.representative().length);
        Self {
            secants: Anderson::new(1, layout.size(), &units),
            tuning: limits.tuning,
            tolerance: limits.tolerance,
            units,
            right: vec![0.0; layout.size()],
            seen: vec![0.0; layout.multiplier_count],
        }
    }

    /// Solves in place; none if the corrections do not converge. `wanted` evaluates what is lacking with the present solution.
    pub(super) fn solve(
        &mut self,
        matrix: &mut RecoveryMatrix,
        solution: &mut [f64],
        mut wanted: impl FnMut(&[f64], &mut [f64], &RecoveryMatrix, &mut [f64]),
    ) -> Option<()> {
        self.secants.forget();
        self.right.copy_from_slice(solution);
        solution.fill(0.0);
        let (mut first, mut last) = (0.0, f64::INFINITY);
        for count in 0..MAX_CORRECTIONS {
            if count > 0 {
                wanted(solution, &mut self.right, matrix, &mut self.seen);
            }
            matrix.solve(&mut self.right);
            let size = self.size(&self.right);
            self.secants.improve(std::slice::from_mut(&mut self.right), &self.tuning);
            solution.iter_mut().zip(&self.right).for_each(|(solution, change)| *solution += change);
            if count == 0 {
                first = size;
            }
            let negligible = SHARE * self.tolerance * first;
            let contraction = size / last;
            let remaining = size * contraction / (1.0 - contraction);
            if size <= negligible || count > 0 && contraction < SLOWEST && remaining <= negligible {
                return Some(());
            }
            if contraction.is_nan() || contraction > SLOWEST {
                return (size <= STALLED * first).then_some(());
            }
            last = size;
        }
        None
    }

    /// Largest entry, as a force.
    fn size(&self, values: &[f64]) -> f64 {
        let sizes = values.iter().zip(&self.units).map(|(value, unit)| (value * unit).abs());
        sizes.fold(0.0_f64, |most, size| if size > most || size.is_nan() { size } else { most })
    }
}
