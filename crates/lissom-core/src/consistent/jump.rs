//! Accelerations and multipliers close to known ones: where held values change between two steps, and a fraction of a step away.
//!
//! Legend: r left-hand sides of the equations of motion, g̈ accelerations of the violations, w what they are to be, S matrix of the
//! inertias and the constraints.
//!
//! ```text
//! S (Δa, Δλ) = w - (r(a + Δa, λ + Δλ), g̈(a + Δa)),     repeated to round-off
//! ```
//!
//! S is that of the last positions until its corrections cost more than another one: a control loop changes inputs at every step. Its
//! positions are part of snapshots, so that restarts continue to the last bit.

use super::initial_conditions::{
    ConsistentInitialConditions, Inertias, gather_accelerations, scatter_accelerations, without_accelerations,
};
use crate::errors::InitialError;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::system::{State, System};
use crate::tuning::{MAX_ITERATIONS, Tuning, TuningParameter};

impl ConsistentInitialConditions {
    /// Jump of accelerations and multipliers, by row, at a change to the held values `held`. The rows of first-order states contain the
    /// change of their rates.
    ///
    /// # Errors
    /// If there are no consistent accelerations.
    pub(crate) fn acceleration_jump(
        &mut self,
        system: &System,
        state: &State,
        held: &[f64],
    ) -> Result<Vec<f64>, InitialError> {
        if !system.sees_multipliers() {
            let mut at = state.kinematics.clone();
            let before = self.left_side(system, &at, &state.multipliers);
            at.held.copy_from_slice(held);
            if let Some(jump) = self.corrected(system, state, (&at, &before))? {
                return Ok(jump);
            }
        }
        self.factor(system, state, Inertias::All)?;
        let mut at = without_accelerations(system.layout(), state);
        let before = self.repeated(system, at.clone())?;
        at.held.copy_from_slice(held);
        let mut jump = self.repeated(system, at)?;
        jump.iter_mut().zip(&before).for_each(|(after, before)| *after -= before);
        Ok(jump)
    }

    /// Accelerations and multipliers by row at positions and velocities close to those of the last factor, with which those of `state`
    /// were found.
    pub(super) fn neighbouring_accelerations(
        &mut self,
        system: &System,
        state: &State,
    ) -> Result<Vec<f64>, InitialError> {
        let layout = system.layout();
        if !system.sees_multipliers() {
            let zero = vec![0.0; layout.size()];
            if let Some(mut found) = self.corrected(system, state, (&state.kinematics, &zero))? {
                let mut own = vec![0.0; layout.size()];
                gather_accelerations(layout, &state.kinematics, &mut own);
                own[layout.coordinate_count()..].copy_from_slice(&state.multipliers);
                found.iter_mut().zip(&own).for_each(|(found, own)| *found += own);
                return Ok(found);
            }
        }
        self.factor(system, state, Inertias::All)?;
        self.acceleration_with_factors(system, state)
    }

    /// Changes of the accelerations and multipliers of `state` with which the left sides become those that are `wanted`, with the last
    /// factor, or one of these positions; none if they do not converge.
    fn corrected(
        &mut self,
        system: &System,
        state: &State,
        wanted: (&Kinematics, &[f64]),
    ) -> Result<Option<Vec<f64>>, InitialError> {
        for is_new in [false, true] {
            if is_new || self.near.is_none() {
                self.factor(system, state, Inertias::All)?;
            }
            if let Some((change, corrections)) = self.corrections(system, state, wanted) {
                if corrections > Tuning::default().of(TuningParameter::TangentCost) {
                    self.near = None;
                }
                return Ok(Some(change));
            }
        }
        Ok(None)
    }

    /// Changes with the last factor, and the number of corrections; none if they do not decrease to round-off.
    fn corrections(
        &mut self,
        system: &System,
        state: &State,
        (wanted_at, wanted): (&Kinematics, &[f64]),
    ) -> Option<(Vec<f64>, f64)> {
        let (layout, count) = (system.layout(), system.layout().coordinate_count());
        let mut at = wanted_at.clone();
        let mut accelerations = vec![0.0; layout.size()];
        gather_accelerations(layout, &at, &mut accelerations);
        let (mut sum, mut multipliers) = (vec![0.0; layout.size()], state.multipliers.clone());
        let (mut first, mut last) = (0.0, f64::INFINITY);
        for repetition in 0..MAX_ITERATIONS {
            let mut change = self.left_side(system, &at, &multipliers);
            change.iter_mut().zip(wanted).for_each(|(change, wanted)| *change = wanted - *change);
            if repetition > 0 {
                // Rates of states follow at once.
                layout.states().for_each(|(row, ..)| change[row] = 0.0);
            }
            self.solve_once(system, &mut change);
            sum.iter_mut().zip(&change).for_each(|(sum, change)| *sum += change);
            let size = self.largest_force(&change, count);
            if repetition == 0 {
                first = size;
            }
            let contraction = size / last;
            let is_slow = size.is_nan() || contraction > 0.5;
            let remaining = if repetition == 0 || is_slow { size } else { size * contraction };
            if remaining <= round_off::SOLUTION * first || is_slow && size <= round_off::ITERATION * first {
                self.reduce_to_least_norm(&mut sum[count..]);
                return sum.iter().all(|value| value.is_finite()).then_some((sum, repetition as f64));
            }
            if is_slow {
                break;
            }
            last = size;
            let mut total = accelerations.clone();
            total.iter_mut().zip(&sum).for_each(|(total, change)| *total += change);
            layout.states().for_each(|(row, ..)| total[row] = accelerations[row]);
            scatter_accelerations(layout, &total, &mut at);
            let changes = state.multipliers.iter().zip(&sum[count..]);
            multipliers.iter_mut().zip(changes).for_each(|(sum, (own, change))| *sum = own + change);
        }
        None
    }

    /// Continues from a snapshot, with the factor of these positions.
    pub(crate) fn keep_from(&mut self, system: &System, near: Option<State>) -> Result<(), InitialError> {
        self.near = None;
        near.map_or(Ok(()), |near| self.factor(system, &near, Inertias::All))
    }
}
