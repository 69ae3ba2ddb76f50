//! The error of a step: the error at its end of the scheme's prediction from its start, filtered once through the
//! tangent, so that motions faster than the step are damped as by the scheme itself.
//!
//! Legend: z departure from extrapolation at the end of the step, z_predicted = ½ h² times the acceleration (or the
//! scheme's memory of it) at the start, r ratio of the step to the previous one, κ the scheme's constant, J tangent in
//! use with its constraints, so that constrained directions have no error, w₂ M its inertial part, τ relative tolerance.
//!
//! ```text
//! m_n = z - z_predicted = O(h³)     or, where it is larger,     m_v = (q'_end - q'_start - q''_start)/3
//! third order:   e = κ m_n,                             ε = |J⁻¹ w₂ M e| / (reference · τ^(3/2)/2)
//! fourth order:  e = (m_n - r³ m_{n-1}) 4/(1 + 3/r),    ε = (|J⁻¹ w₂ M e| / (reference · τ^(4/3)/2))^(3/4)
//! ```
//!
//! The local error of second-order schemes is of third order, that of third-order schemes of fourth. The latter is estimated
//! by the part of a step's prediction error that the previous step does not predict, scaled to a constant step size by its
//! last factor. If N steps of size h = 1/N have errors of h³ or h⁴ each, positions at the end have errors of h² or h³, and
//! so of τ, with every scheme. The first step of a third-order scheme, and one after a breakpoint or a switch, has only the
//! third-order estimate; it may be a tenth of τ. The filter is that of [Hairer and Wanner 1996, IV.8]. The norm is the
//! largest entry, with lengths relative to ℓ_r. The reference is the largest displacement or rotation of a node since the
//! start, or that of a drive within the longest step, at most 1.

use super::Integrator;
use crate::analysis::Problem;
use crate::elements::contribution::CoordinateMass;
use crate::kinematics::{CoordinateId, Kinematics, LOCKED, Quantity, Subject};
use crate::scaling::UnitStepState;
use crate::schemes::Stage;
use crate::system::{Drive, System};

/// Order of an estimate in the step size.
#[derive(Clone, Copy)]
pub(crate) enum ErrorOrder {
    Third,
    Fourth,
}

/// Motions smaller than this fraction of the model's size are not resolved individually.
pub(crate) const MIN_REFERENCE: f64 = 1e-6;

/// Errors of a step below this fraction of the model's size are round-off, which no smaller step reduces.
pub(crate) const MIN_ERROR: f64 = 3e-13;

/// Largest scaled displacement or rotation of a node, or change of a generalised coordinate, between two instants, at
/// most 1.
pub(crate) fn excursion(system: &System, (from, to): (&Kinematics, &Kinematics), length: f64) -> f64 {
    let way = |&own: &CoordinateId| {
        let change = (to.coordinates[own].value - from.coordinates[own].value).abs();
        if system.layout().coordinate_quantity(own) == Quantity::Length { change / length } else { change }
    };
    // Coordinates of joints appear in the motion of the attached nodes.
    let mut most = system.free_coordinates.iter().map(way).fold(0.0_f64, f64::max).min(1.0);
    for (a, b) in from.nodes.iter().zip(&to.nodes) {
        let shift = (b.frame.position - a.frame.position).norm() / length;
        let [p, q] = [a, b].map(|node| node.frame.rotation.quaternion());
        // |sin(φ/2)| of the relative rotation, from the chord between the two unit quaternions.
        let chord = |sign: f64| p.iter().zip(&q).map(|(p, q)| (p - sign * q).powi(2)).sum::<f64>();
        let turn = 2.0 * chord(1.0).min(chord(-1.0)).sqrt();
        most = most.max(shift).max(turn);
        if most >= 1.0 {
            return 1.0;
        }
    }
    most
}

/// Largest change of a drive between two instants, at most 1.
pub(crate) fn driven(system: &System, (from, to): (f64, f64), length: f64) -> f64 {
    let of = |drive: &Drive| {
        let function = &drive.prescribed.value;
        let way = (function.value(to) - function.value(from)).abs();
        let row = system.layout().row_of_coordinate(drive.prescribed.coordinate);
        if system.layout().quantities()[row] == Quantity::Length { way / length } else { way }
    };
    system.drives().iter().map(of).fold(0.0_f64, f64::max).min(1.0)
}

/// `out = M e` over the coordinate rows; zero for massless coordinates.
pub(crate) fn inertial_part(system: &System, at: &Kinematics, error: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for inertia in system.inertias() {
        let rows = system.layout().rows_of_node(inertia.node());
        for (i, &row) in rows.iter().enumerate().filter(|&(_, &row)| row != LOCKED) {
            let mut sum = 0.0;
            for (k, &column) in rows.iter().enumerate().filter(|&(_, &column)| column != LOCKED) {
                sum += inertia.mass()[(i, k)] * error[column as usize];
            }
            out[row as usize] += sum;
        }
    }
    system.masses(at, &mut |mass| {
        let value = |&row: &u32| if row == LOCKED { 0.0 } else { error[row as usize] };
        let local: Vec<f64> = mass.rows.iter().map(value).collect();
        mass.times(&local, |row, sum| {
            if mass.rows[row] != LOCKED {
                out[mass.rows[row] as usize] += sum;
            }
        });
    });
    for CoordinateMass { coordinates, matrix } in &system.coordinate_masses {
        let rows: Vec<usize> =
            coordinates.iter().map(|&own| system.layout().row_of_coordinate(own)).collect();
        for (i, &row) in rows.iter().enumerate() {
            let products = rows.iter().enumerate().map(|(k, &column)| matrix[(i, k)] * error[column]);
            out[row] += products.sum::<f64>();
        }
    }
}

/// Error of the velocity prediction at the end of a step, expressed as a position error: both are equal if the
/// acceleration changes linearly.
///
/// ```text
/// v_end - v_start - a_start = a'/2,   z_end - a_start/2 = a'/6      (step of unit length)
/// ```
///
/// In two-stage Radau IIA the force of the last stage has no weight in the position at the end, (A²)₂₂ = 0: a force that
/// begins late in a step changes only the velocity.
fn velocity_miss(stage: &Stage, unit: &UnitStepState, increments: &[Vec<f64>], row: usize) -> f64 {
    (unit.combine(&stage.rate, increments, row) - unit.curvature[row]) / 3.0
}

impl Integrator {
    /// Stores the estimated error of the last attempt, which ended at `end` after a step of `last_size` [s], in the workspace,
    /// unfiltered and filtered. Forces may have switched at its start.
    pub(crate) fn estimate_error(
        &mut self,
        problem: Problem<'_>,
        end: &Kinematics,
        last_size: f64,
        order: ErrorOrder,
        has_switched: bool,
    ) {
        self.miss_of_attempt(problem, last_size, order, has_switched);
        let work = &mut *self.work;
        let (motion, constraints) = work.filtered.split_at_mut(work.error.len());
        if has_switched {
            // The filter would hide a motion that the switch has just started, such as an impact on a stiff stop.
            motion.copy_from_slice(&work.error);
            problem.system.layout().rate_rows().for_each(|row| motion[row] = 0.0);
            return;
        }
        inertial_part(problem.system, end, &work.error, motion);
        constraints.fill(0.0);
        work.tangent.scale(&mut work.filtered);
        work.tangent.matrices.solve_inertial(&problem.settings.scheme.coupling, &mut work.filtered);
        work.tangent.scale(&mut work.filtered);
    }

    /// The prediction error from which the error of the last attempt is estimated, by row: that of the position or of
    /// the velocity, whichever is larger, times the scheme's constant, or the part by which it exceeds that of the
    /// previous step.
    fn miss_of_attempt(
        &mut self,
        Problem { system, settings }: Problem<'_>,
        last_size: f64,
        order: ErrorOrder,
        has_switched: bool,
    ) {
        let scheme = &settings.scheme;
        let work = &mut *self.work;
        let Some((stage, predicted)) = scheme.stages.iter().zip(&mut work.predicted).last() else {
            unreachable!("every scheme has a stage")
        };
        work.unit.predict(&stage.prediction, predicted);
        let unit = &work.unit;
        let (Some(found), Some(predicted)) = (work.increments.last(), work.predicted.last()) else { return };
        let weight = 4.0 / (1.0 + 3.0 * last_size / self.scaled.step_size());
        // After a switch the motion is not smooth, and constants that assume smoothness do not apply.
        let constant = if has_switched { 1.0 } else { scheme.error_constant };
        let mut error = std::mem::take(&mut work.error);
        let quantities = system.layout().quantities();
        for ((row, error), last) in error.iter_mut().enumerate().zip(work.last_miss()) {
            let judge = |miss: f64| match order {
                ErrorOrder::Third => constant * miss,
                ErrorOrder::Fourth => weight * (miss - last),
            };
            *error = judge(found[row] - predicted[row]);
            // A state has no acceleration from which its rate could be predicted.
            if quantities[row] != Quantity::State {
                let velocity = judge(velocity_miss(stage, unit, &work.increments, row));
                if velocity.abs() > error.abs() {
                    *error = velocity;
                }
            }
        }
        work.error = error;
    }

    /// The unknown with the largest estimated error of the last attempt.
    pub(crate) fn most_inaccurate(&self, system: &System) -> Subject {
        let errors =
            self.work.filtered.iter().zip(&self.work.sizes).map(|(error, size)| (error * size).abs());
        let most = errors.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        system.layout().subject_of(most.map_or(0, |(row, _)| row))
    }
}
