//! An attempt at a step: the step control accepts it, requires a shorter one, or rejects it.

use crate::energy_balance::EnergyBalance;
use crate::newton::Outcome;
use crate::system::State;

/// Result of an attempt at a step. The state at its start is not changed.
pub(crate) struct Attempt {
    /// Size of the step [s].
    pub(crate) size: f64,
    /// The state at the start, converted to this step size if the scheme's history depends on the step size.
    pub(crate) converted: State,
    /// Whether `converted` is the start of this attempt.
    pub(crate) is_converted: bool,
    /// The state at the end.
    pub(crate) end: State,
    /// Outcome of Newton's method.
    pub(crate) outcome: Outcome,
    /// Energy and work up to the end.
    pub(crate) energy_balance: EnergyBalance,
    /// Largest violation of a constraint at the end, relative to the representative length, or in radians.
    pub(crate) violation: f64,
}

impl Attempt {
    /// Storage for attempts, with both ends equal to `state`.
    pub(crate) fn new(state: &State, energy_balance: EnergyBalance) -> Self {
        Self {
            size: 0.0,
            converted: state.clone(),
            is_converted: false,
            end: state.clone(),
            outcome: Outcome::default(),
            energy_balance,
            violation: 0.0,
        }
    }

    /// The start of the step: `state`, unless it was converted.
    pub(crate) fn start<'s>(&'s self, state: &'s State) -> &'s State {
        if self.is_converted { &self.converted } else { state }
    }

    /// Makes the end of the attempt the `state`, and its start the `previous` state.
    pub(crate) fn accept(&mut self, previous: &mut State, state: &mut State) {
        let start = if self.is_converted { &mut self.converted } else { &mut *state };
        std::mem::swap(previous, start);
        std::mem::swap(state, &mut self.end);
    }
}
