//! An attempt at a step: control accepts it, asks for a shorter one, or rejects it.

use crate::judge::EnergyBalance;
use crate::newton::Outcome;
use crate::system::State;

/// What an attempt at a step has led to. The state it starts from is not changed by it.
pub(crate) struct Attempt {
    /// Size of the step [s].
    pub(crate) size: f64,
    /// The state at the start as steps of this size see it, where the scheme remembers what belongs to the step size.
    pub(crate) converted: State,
    /// Whether `converted` is the start of this attempt.
    pub(crate) is_converted: bool,
    /// The state at the end.
    pub(crate) end: State,
    /// How Newton's method found it.
    pub(crate) outcome: Outcome,
    /// Energy and work up to the end.
    pub(crate) energy_balance: EnergyBalance,
    /// Largest violation of a constraint at the end, relative to the representative length, or in radians.
    pub(crate) violation: f64,
}

impl Attempt {
    /// Room for attempts, `state` standing for both ends.
    pub(crate) fn new(state: &State, energy_balance: EnergyBalance) -> Self {
        Self {
            size: 0.0,
            converted: state.clone(),
            is_converted: false,
            end: state.clone(),
            outcome: Outcome { iterations: 0, factorizations: 0, correction: 0.0, stagnated: false },
            energy_balance,
            violation: 0.0,
        }
    }

    /// The start of the step, which is `state` unless it was converted.
    pub(crate) fn start<'s>(&'s self, state: &'s State) -> &'s State {
        if self.is_converted { &self.converted } else { state }
    }

    /// Makes the end of the attempt the `state`, and its start the one `previous` to it.
    pub(crate) fn accept(&mut self, previous: &mut State, state: &mut State) {
        let start = if self.is_converted { &mut self.converted } else { &mut *state };
        std::mem::swap(previous, start);
        std::mem::swap(state, &mut self.end);
    }
}
