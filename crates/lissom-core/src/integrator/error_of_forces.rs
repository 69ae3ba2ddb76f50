//! Error of the accelerations, and so of the forces, at the end of a step, from the forces that the estimated position error causes.
//!
//! Legend: e, ê position error and the same filtered through the tangent (`error_estimate`), M, K, G mass, stiffness and
//! constraints, J tangent of the step with its constraints, w₂ its weight of M.
//!
//! ```text
//! J x = w₂ M ê,      K ê ≈ w₂ M (ê - x)  up to constraint forces,      error of accelerations = Re(w₂) (ê - x)/h²
//! ```
//!
//! ê satisfies the constraints, so that they do not contribute. Relative to the largest acceleration, this is the relative error of a
//! vibration's amplitude, however small its displacements are.

use super::Integrator;
use super::error_estimate::inertial_part;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::settings::Problem;

impl Integrator {
    /// Largest scaled error of an acceleration at the end of the last attempt, whose position error has been estimated, and
    /// largest scaled acceleration at its ends [1/s²].
    pub(crate) fn error_of_forces(
        &mut self,
        Problem { system, settings }: Problem<'_>,
        end: &Kinematics,
    ) -> (f64, f64) {
        let work = &mut *self.work;
        let coupling = &settings.scheme.coupling;
        let square = self.scaled.step_size().powi(2);
        let count = work.error.unfiltered.len();
        let again = &mut self.refiltered;
        inertial_part(system, end, &work.error.filtered[..count], &mut again[..count]);
        again[count..].fill(0.0);
        work.tangent.scale(again);
        work.tangent.matrices.solve_inertial(coupling, again);
        work.tangent.scale(again);
        let Some(stage) = settings.scheme.stages.last() else { unreachable!("every scheme has a stage") };
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        for (row, size) in work.units.coordinates.iter().enumerate().take(count) {
            let of_row = ((work.error.filtered[row] - again[row]) * size).abs();
            // A NaN counts as the largest.
            error = if of_row <= error || error.is_nan() { error } else { of_row };
            let end = work.unit.combine(&stage.acceleration, &work.increments, row);
            largest = largest.max((work.unit.acceleration[row] * size).abs()).max((end * size).abs());
        }
        let share = coupling.inertial_share();
        ((error - round_off::VIBRATION).max(0.0) / (share * square), largest / square)
    }
}
