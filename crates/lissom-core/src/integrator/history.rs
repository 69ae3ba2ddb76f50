//! The history of one-stage schemes depends on the step size: an attempt with another size starts from a converted state.
//!
//! Legend: a algorithmic acceleration, h step size, r ratio of the new to the old one, v velocities, B gradient of the
//! constraints.
//!
//! ```text
//! a ← a + δ (h_new - h_old) ȧ,   ȧ = (a_n - a_(n-1))/h_n,   δ = α_m - α_f
//! v ← v + (r² - 1) v_B,          v_B = M⁻¹Bᵀ (B M⁻¹ Bᵀ)⁻¹ (B v + ∂c/∂t)
//! ```
//!
//! a approximates the acceleration at the time δ h after the state [Arnold and Brüls 2007]. In the direction of the constraint
//! gradients the velocity error of an index-3 scheme is proportional to h². Without the second conversion multipliers lose an order
//! when the step size changes.

use lissom_solver::SolverKind;

use crate::consistent::initial_conditions::{
    ConsistentInitialConditions, add_rates, gather_accelerations, gather_rates, visit_rates,
};
use crate::errors::InitialError;
use crate::scaling::Representative;
use crate::system::{State, System};

/// If the step grows by more than this factor at once, for example after one that ended at an event, ȧ and v_B may be round-off of a
/// short step, which r² would amplify from step to step. Then a is kept, and the velocities are projected onto the constraints.
const MAX_RATIO: f64 = 2.0;

/// Converts the history part of a state to another step size.
pub(crate) struct IntegratorHistory {
    initial: ConsistentInitialConditions,
    /// Step size of the history [s].
    step: f64,
    /// ȧ by row; v_B for the present step size by row.
    slope: Vec<f64>,
    across: Vec<f64>,
    /// Whether ȧ and v_B belong to the present state.
    is_known: bool,
    has_constraints: bool,
}

impl IntegratorHistory {
    pub(crate) fn new(
        system: &System,
        state: &State,
        representative: &Representative,
        solver: &SolverKind,
        step: f64,
    ) -> Self {
        let rows = system.layout().coordinate_count();
        Self {
            initial: ConsistentInitialConditions::new(system, state, representative, solver),
            step,
            slope: vec![0.0; rows],
            across: vec![0.0; rows],
            is_known: false,
            has_constraints: !system.layout().multiplier_rows().is_empty(),
        }
    }

    /// The history as plain values, for snapshots.
    pub(crate) fn to_numbers(&self) -> (f64, bool, Vec<f64>, Vec<f64>) {
        (self.step, self.is_known, self.slope.clone(), self.across.clone())
    }

    /// Restores the history from plain values.
    pub(crate) fn set_numbers(&mut self, (step, is_known, slope, across): &(f64, bool, Vec<f64>, Vec<f64>)) {
        (self.step, self.is_known) = (*step, *is_known);
        self.slope.copy_from_slice(slope);
        self.across.copy_from_slice(across);
    }

    /// Records that the state is a new one, computed with a step of this size [s].
    pub(crate) fn renew(&mut self, step: f64) {
        self.step = step;
        self.is_known = false;
    }

    /// Whether the history belongs to steps of this size [s].
    pub(crate) fn is_of(&self, step: f64) -> bool {
        step == self.step
    }

    /// Writes `state` with the history of steps of size `step` [s] to `out`. `previous` is the state before the last step, or equal
    /// to `state` if there was none; `scratch` is overwritten.
    ///
    /// # Errors
    /// If the velocities cannot be decomposed.
    pub(crate) fn convert(
        &mut self,
        system: &System,
        delay: f64,
        (previous, state, scratch): (&State, &State, &mut State),
        step: f64,
        out: &mut State,
    ) -> Result<(), InitialError> {
        if !self.is_known {
            self.find(system, delay, (previous, state, scratch))?;
            self.is_known = true;
        }
        out.clone_from(state);
        let ratio = step / self.step;
        let is_known = ratio <= MAX_RATIO;
        if is_known {
            for (value, slope) in out.algorithmic.iter_mut().zip(&self.slope) {
                *value += delay * (step - self.step) * slope;
            }
        }
        let square = if is_known { ratio * ratio } else { 0.0 };
        add_rates(system.layout(), (square - 1.0, &self.across), &mut out.kinematics);
        Ok(())
    }

    /// Computes ȧ and v_B.
    fn find(
        &mut self,
        system: &System,
        delay: f64,
        (previous, state, scratch): (&State, &State, &mut State),
    ) -> Result<(), InitialError> {
        let layout = system.layout();
        let elapsed = state.kinematics.time - previous.kinematics.time;
        if elapsed > 0.0 {
            let before = previous.algorithmic.iter();
            for ((slope, now), before) in self.slope.iter_mut().zip(&state.algorithmic).zip(before) {
                *slope = (now - before) / elapsed;
            }
        } else if delay != 0.0 {
            // At the start the algorithmic acceleration is that shortly after it.
            self.slope.copy_from_slice(&state.algorithmic);
            gather_accelerations(layout, &state.kinematics, &mut self.across);
            self.slope.iter_mut().zip(&self.across).for_each(|(slope, acceleration)| *slope -= acceleration);
            self.slope.iter_mut().for_each(|value| *value /= delay * self.step);
        }
        self.across.fill(0.0);
        if !self.has_constraints || elapsed <= 0.0 {
            return Ok(());
        }
        scratch.clone_from(state);
        self.initial.velocities(system, scratch)?;
        gather_rates(layout, &state.kinematics, &mut self.across);
        visit_rates(layout, &mut scratch.kinematics, |row, projected, _| self.across[row] -= *projected);
        Ok(())
    }
}
