//! Held values at the start, and their changes between two steps: inputs that are set, and samples.
//!
//! Forces jump with them, and accelerations by M⁻¹ ΔF. The accelerations in a scheme's history jump as well. Otherwise the scheme would
//! include the change late by a fraction of a step: an error of first order in every velocity.

use crate::consistent::initial_conditions::{ConsistentInitialConditions, visit_rates};
use crate::diagnostics::diagnostics;
use crate::errors::InitialError;
use crate::joints::latch::{Latch, holds};
use crate::kinematics::{DiscreteValueId, Kinematics, Quantity, Subject};
use crate::settings::Settings;
use crate::signals::SignalError;
use crate::simulation::Simulation;
use crate::simulation::rigid_contacts::impact_of_latches;
use crate::simulation::signal_history::{Break, SignalHistory};
use crate::system::{State, System};

diagnostics! {
    /// An input that cannot be set.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure InputError {
        /// The model has no such input.
        Unknown {
            /// The name that was given.
            name: String,
            /// Names of all inputs.
            known: String,
        } => "unknown-input" {
            subject: Subject::new("input", name),
            cause: ("the model has no input `{name}`"),
            remedy: "its inputs are: {known}",
            meaning: "An input was set that the model does not have.",
            advice: "Use a name of the section `[inputs]`.",
        }
        /// The value is not finite.
        NotFinite {
            /// The input.
            name: String,
            /// The value that was given.
            value: f64,
        } => "input-not-finite" {
            subject: Subject::new("input", name),
            cause: ("input `{name}` cannot be {value}"),
            remedy: "specify a finite number",
            meaning: "An input was set to a value that is not finite.",
        }
    }
    wraps {
        /// A signal is not finite with this value.
        Signal(SignalError), (error) => error.diagnostic().within("with this input"),
        /// There are no consistent accelerations with it.
        Initial(InitialError), (error) => error.diagnostic(),
    }
}

impl From<InitialError> for InputError {
    fn from(error: InitialError) -> Self {
        Self::Initial(error)
    }
}

/// Takes the first samples, and makes rates of states, accelerations and multipliers consistent with positions and velocities.
pub(crate) fn settle(
    system: &System,
    state: &mut State,
    initial: &mut ConsistentInitialConditions,
    settings: &Settings,
) -> Result<(), InitialError> {
    system.signals().fill_windows_before_start(&mut state.kinematics);
    if system.has_readings() {
        // The first samples read accelerations and multipliers computed without these samples.
        system.signals().set_values_before_first_sample(&mut state.kinematics);
        initial.set_state_rates(system, &mut state.kinematics)?;
        initial.accelerations(system, state)?;
        let readings: Vec<_> = system.take_readings(state).collect();
        for (held, value) in readings {
            state.kinematics.held[held.index()] = value;
        }
    }
    let graph = system.signals();
    for _ in graph.delays() {
        // Delayed signals and samples may depend on each other. Values of the first passes may not be finite.
        graph.fill_windows_before_start(&mut state.kinematics);
        let _ = graph.begin(&mut state.kinematics);
    }
    graph.begin(&mut state.kinematics).map_err(InitialError::Signal)?;
    system.check_functions(&state.kinematics).map_err(InitialError::Signal)?;
    initial.set_state_rates(system, &mut state.kinematics)?;
    initial.accelerations(system, state)?;
    initial.accelerate_states(system, state, settings.step_size);
    let delay = settings.scheme.memory_delay * settings.step_size;
    state.algorithmic = initial.delayed_accelerations(system, state, delay)?;
    Ok(())
}

impl Simulation {
    /// Sets inputs simultaneously [SI]. Before the first step samples and initial accelerations are recomputed.
    ///
    /// # Errors
    /// If there is no such input, a value is not finite, or there are no consistent accelerations. The simulation is then unchanged.
    pub fn set_inputs<'n>(
        &mut self,
        inputs: impl IntoIterator<Item = (&'n str, f64)>,
    ) -> Result<(), InputError> {
        let graph = self.system.signals();
        let mut changed: Vec<(DiscreteValueId, f64)> = Vec::new();
        for (name, value) in inputs {
            let Some(held) = graph.input(name) else {
                let names: Vec<&str> = graph.input_names().collect();
                let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                return Err(InputError::Unknown { name: name.to_owned(), known });
            };
            if !value.is_finite() {
                return Err(InputError::NotFinite { name: name.to_owned(), value });
            }
            changed.push((held, value));
        }
        changed.retain(|(held, value)| self.state.kinematics.held[held.index()] != *value);
        if changed.is_empty() {
            return Ok(());
        }
        let mut at = self.state.kinematics.clone();
        for (held, value) in changed {
            at.held[held.index()] = value;
        }
        graph.check(&at).map_err(InputError::Signal)?;
        if self.report.totals.steps > 0 {
            return Ok(self.change_held_values(at)?);
        }
        self.begin_with(at)?;
        Ok(self.begin_samples()?)
    }

    /// Begins again with the held values of `at`, before the first step.
    ///
    /// # Errors
    /// If there are no consistent initial values; the state is then unchanged.
    pub(super) fn begin_with(&mut self, at: Kinematics) -> Result<(), InitialError> {
        let mut state = self.state.clone();
        let (_, engages) = self.latches_switch(&at.held);
        state.kinematics = at;
        if let Some(initial) = &mut self.held_values {
            if engages {
                impact_of_latches(&self.system, initial, &mut state)?;
                let before = &self.state.kinematics;
                self.report.energy_balance.record_impact(&self.system, before, &state, None);
            }
            settle(&self.system, &mut state, initial, &self.settings)?;
        }
        self.stops.history = SignalHistory::new(self.system.signals(), &state.kinematics);
        self.previous.clone_from(&state);
        self.state = state;
        self.begin_contacts()
    }

    /// Whether a latch engages or disengages with these held values, and whether one engages.
    pub(super) fn latches_switch(&self, held: &[f64]) -> (bool, bool) {
        let present = &self.state.kinematics.held;
        let of = |latch: &Latch| [held, present].map(|values| holds(values[latch.engaged.index()]));
        let all = || self.system.latches().iter().map(of);
        (all().any(|[now, before]| now != before), all().any(|[now, before]| now && !before))
    }

    /// Changes to the held values of `at`, which is otherwise the present state: accelerations, multipliers and the rates of states
    /// jump. If a latch engages, velocities jump as well, by an inelastic impact.
    ///
    /// # Errors
    /// If there are no consistent accelerations; the state is then unchanged.
    pub(crate) fn change_held_values(&mut self, at: Kinematics) -> Result<(), InitialError> {
        if self.system.has_rigid_contacts() || self.latches_switch(&at.held).0 {
            let time = self.state.kinematics.time;
            return self.switch_constraints(&[], Some(at.held), [time; 2]);
        }
        let Some(initial) = &mut self.held_values else {
            self.state.kinematics = at;
            return Ok(());
        };
        if self.system.has_balances() {
            return self.balanced_jump(self.state.kinematics.time, |state| state.kinematics.held = at.held);
        }
        let jump = initial.acceleration_jump(&self.system, &self.state, &at.held)?;
        self.state.kinematics.held = at.held;
        self.add_jump(jump);
        Ok(())
    }

    /// Adds to accelerations, multipliers and the rates of states the jump that forces have between two instants close to each other,
    /// from functions of time.
    ///
    /// # Errors
    /// If there are no consistent accelerations.
    pub(crate) fn jump_between(&mut self, earlier: f64, later: f64) -> Result<(), InitialError> {
        if self.system.has_rigid_contacts() {
            return self.switch_constraints(&[], None, [earlier, later]);
        }
        let Some(initial) = &mut self.held_values else { return Ok(()) };
        if self.system.has_balances() {
            return self.balanced_jump(earlier, |state| state.kinematics.time = later);
        }
        let time = self.state.kinematics.time;
        let mut at = |instant: f64| {
            self.state.kinematics.time = instant;
            initial.acceleration_at(&self.system, &self.state)
        };
        let found = at(earlier).and_then(|before| Ok((before, at(later)?)));
        self.state.kinematics.time = time;
        let (before, mut jump) = found?;
        jump.iter_mut().zip(&before).for_each(|(after, before)| *after -= before);
        self.add_jump(jump);
        Ok(())
    }

    /// Adds the jump from the instant `earlier` to a changed state, in which algebraic unknowns satisfy their balances.
    fn balanced_jump(&mut self, earlier: f64, change: impl FnOnce(&mut State)) -> Result<(), InitialError> {
        let Self { system, state, held_values: Some(initial), .. } = self else { return Ok(()) };
        let time = std::mem::replace(&mut state.kinematics.time, earlier);
        let mut changed = state.clone();
        changed.kinematics.time = time;
        change(&mut changed);
        let before = initial.acceleration_at(system, state);
        state.kinematics.time = time;
        let before = before?;
        initial.set_state_rates(system, &mut changed.kinematics)?;
        let mut jump = initial.acceleration_at(system, &changed)?;
        jump.iter_mut().zip(&before).for_each(|(after, before)| *after -= before);
        system.layout().states().for_each(|(row, ..)| jump[row] = 0.0);
        changed.kinematics.time = time;
        *state = changed;
        self.add_jump(jump);
        Ok(())
    }

    /// Adds the jump of accelerations, multipliers and rates of states.
    pub(super) fn add_jump(&mut self, mut jump: Vec<f64>) {
        self.stops.history.add_break(Break::Slope);
        let layout = self.system.layout();
        visit_rates(layout, &mut self.state.kinematics, |row, rate, acceleration| {
            if layout.quantities[row] == Quantity::State {
                // The entry of a first-order state is the change of its rate.
                *rate += std::mem::take(&mut jump[row]);
            } else {
                *acceleration += jump[row];
            }
        });
        let (motion, constraints) = jump.split_at(layout.coordinate_count());
        // The previous state as well: the difference of the two is the change of accelerations between jumps.
        for memory in [&mut self.previous.algorithmic, &mut self.state.algorithmic] {
            memory.iter_mut().zip(motion).for_each(|(value, jump)| *value += jump);
        }
        self.state.multipliers.iter_mut().zip(constraints).for_each(|(value, jump)| *value += jump);
        self.state.kinematics.show_multipliers(&self.state.multipliers);
    }
}
