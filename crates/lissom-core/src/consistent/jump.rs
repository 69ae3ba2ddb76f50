//! Jumps of accelerations and multipliers where held values change between two steps.
//!
//! Legend: r left-hand sides of the equations of motion, g̈ accelerations of the violations, ' with the new values, S matrix of the
//! inertias and the constraints.
//!
//! ```text
//! S (Δa, Δλ) = (r(a, λ) - r'(a + Δa, λ + Δλ),  g̈(a) - g̈'(a + Δa)),     repeated to round-off
//! ```
//!
//! S is that of an earlier jump until its corrections cost more than another one: a control loop changes inputs at every step. Its
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
            for near in [self.near.take(), Some(state.kinematics.clone())].into_iter().flatten() {
                if !std::mem::take(&mut self.is_kept) {
                    let near = State { kinematics: near.clone(), ..state.clone() };
                    self.factor(system, &near, Inertias::All)?;
                }
                if let Some((jump, corrections)) = self.corrected_jump(system, state, held) {
                    let is_worth = corrections <= Tuning::default().of(TuningParameter::TangentCost);
                    (self.near, self.is_kept) = (Some(near).filter(|_| is_worth), is_worth);
                    return Ok(jump);
                }
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

    /// The jump with the last factor, and the number of corrections; none if they do not decrease to round-off.
    fn corrected_jump(&mut self, system: &System, state: &State, held: &[f64]) -> Option<(Vec<f64>, f64)> {
        let (layout, count) = (system.layout(), system.layout().coordinate_count());
        let mut at = state.kinematics.clone();
        let mut accelerations = vec![0.0; layout.size()];
        gather_accelerations(layout, &at, &mut accelerations);
        let before = self.left_side(system, &at, &state.multipliers);
        at.held.copy_from_slice(held);
        let (mut jump, mut multipliers) = (vec![0.0; layout.size()], state.multipliers.clone());
        let (mut first, mut last) = (0.0, f64::INFINITY);
        for repetition in 0..MAX_ITERATIONS {
            let mut change = self.left_side(system, &at, &multipliers);
            change.iter_mut().zip(&before).for_each(|(change, before)| *change = before - *change);
            if repetition > 0 {
                // Rates of states follow at once.
                layout.states().for_each(|(row, ..)| change[row] = 0.0);
            }
            self.solve_once(system, &mut change);
            jump.iter_mut().zip(&change).for_each(|(jump, change)| *jump += change);
            let size = self.largest_force(&change, count);
            if repetition == 0 {
                first = size;
            }
            let contraction = size / last;
            let is_slow = size.is_nan() || contraction > 0.5;
            let remaining = if repetition == 0 || is_slow { size } else { size * contraction };
            if remaining <= round_off::SOLUTION * first || is_slow && size <= round_off::ITERATION * first {
                self.reduce_to_least_norm(&mut jump[count..]);
                return jump.iter().all(|value| value.is_finite()).then_some((jump, repetition as f64));
            }
            if is_slow {
                break;
            }
            last = size;
            let mut total = accelerations.clone();
            total.iter_mut().zip(&jump).for_each(|(sum, jump)| *sum += jump);
            layout.states().for_each(|(row, ..)| total[row] = accelerations[row]);
            scatter_accelerations(layout, &total, &mut at);
            let changes = state.multipliers.iter().zip(&jump[count..]);
            multipliers.iter_mut().zip(changes).for_each(|(sum, (own, change))| *sum = own + change);
        }
        None
    }

    /// Continues from a snapshot, with the factor of these positions.
    pub(crate) fn keep_from(&mut self, near: Option<Kinematics>) {
        (self.near, self.is_kept) = (near, false);
    }
}
