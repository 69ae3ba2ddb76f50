//! Units with equations in a simulation: their start, the ends of accepted steps, and their events. State events are roots of
//! indicators, which end steps as other events do; steps also end at events that a unit announces. Events are executed at the start of the
//! next step: until then the unit has the discrete state of the last one, in which records within it are evaluated. After an event
//! states of the unit may jump, and accelerations, multipliers and rates jump with its outputs.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Simulation, SnapshotError};
use crate::consistent::initial_conditions::moved;
use crate::errors::{InitialError, StepError};
use crate::instants;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::signals::exchange::{ExchangedUnit, UnitEquations, UnitFault, UnitSlot};
use crate::system::{State, System};

/// The running units with equations of a simulation, in the order of its graph of signals. They end with this value.
#[derive(Default)]
pub struct ExchangedUnits {
    own: Vec<Exchanged>,
}

struct Exchanged {
    slot: Arc<UnitSlot>,
    events: UnitEvents,
    /// Events since a time [s], at most one planned step ago.
    recent: (f64, usize),
}

/// Largest number of events of a unit within a planned step, or within the longest adaptive one: ten times the samples of a fast controller.
const MAX_EVENTS: usize = 5000;

/// Events of a unit between two steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct UnitEvents {
    /// Next event that is known in advance [s].
    next: Option<f64>,
    /// Inputs at the end of the last step, before they jump there.
    inputs: Vec<f64>,
    /// Time of the last event [s].
    reached: f64,
    /// Indicators that have crossed zero at the state.
    crossed: Vec<usize>,
    /// Whether an event is due at the state.
    is_due: bool,
}

/// Events of a unit with its state, if it can return it.
pub(crate) type SavedEquations = (UnitEvents, Option<Vec<u8>>);

impl Drop for ExchangedUnits {
    fn drop(&mut self) {
        self.own.iter().for_each(|own| own.slot.detach());
    }
}

impl ExchangedUnits {
    /// Initialises units with the inputs at the configuration `at`, in which their states are set. Inputs that depend on outputs are
    /// updated until both agree.
    ///
    /// # Errors
    /// If a unit cannot start, or its inputs and outputs do not agree.
    pub fn begin(
        system: &System,
        at: &mut Kinematics,
        units: Vec<Box<dyn UnitEquations>>,
    ) -> Result<Self, InitialError> {
        let graph = system.signals();
        let mut all = Self::default();
        let failed = |ports: &ExchangedUnit| {
            let unit = ports.slot.name().to_owned();
            |UnitFault { cause, remedy }| InitialError::Unit { unit, cause, remedy }
        };
        for (unit, ports) in units.into_iter().zip(&graph.exchanged) {
            ports.slot.attach(unit).map_err(failed(ports))?;
            let slot = Arc::clone(&ports.slot);
            let (inputs, reached) = (vec![f64::NAN; ports.inputs.len()], at.time);
            let events = UnitEvents { inputs, reached, ..UnitEvents::default() };
            all.own.push(Exchanged { slot, events, recent: (reached, 0) });
        }
        // Units in series pass values on by one unit at a time; a contraction in a loop of feedthrough needs more passes.
        for pass in 0..=100 {
            let mut agree = true;
            for (own, ports) in all.own.iter_mut().zip(&graph.exchanged) {
                let inputs = ports.point(graph, at).inputs;
                if let Some((_, fault)) = ports.slot.fault() {
                    return Err(failed(ports)(fault));
                }
                if pass == 100 || inputs.iter().any(|input| !input.is_finite()) {
                    let cause =
                        "its inputs at the start are not finite, or do not agree with its outputs".to_owned();
                    let remedy = "check the expressions of its inputs, and its start values".to_owned();
                    return Err(failed(ports)(UnitFault { cause, remedy }));
                }
                if pass == 0 || inputs != own.events.inputs {
                    agree = false;
                    let states = own.slot.call(|unit| unit.begin(&inputs)).map_err(failed(ports))?;
                    set_states(ports, &states, at);
                    own.events.inputs = inputs;
                }
            }
            if agree {
                break;
            }
        }
        let points: Vec<_> = graph.exchanged.iter().map(|ports| ports.point(graph, at)).collect();
        for ((own, ports), point) in all.own.iter_mut().zip(&graph.exchanged).zip(points) {
            let after = own.slot.call(|unit| unit.event(&point)).map_err(failed(ports))?;
            own.events.next = after.next;
            set_states(ports, &after.states, at);
        }
        Ok(all)
    }

    /// Number of units.
    pub(super) fn count(&self) -> usize {
        self.own.len()
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.own.is_empty()
    }

    /// The next event that is known in advance [s].
    pub(super) fn next(&self) -> Option<f64> {
        self.own.iter().filter_map(|own| own.events.next).reduce(f64::min)
    }

    /// Events and states of all units.
    pub(super) fn save(&self) -> Vec<SavedEquations> {
        let of = |own: &Exchanged| (own.events.clone(), own.slot.call(|unit| Ok(unit.save())).ok().flatten());
        self.own.iter().map(of).collect()
    }

    /// Returns to what was saved.
    pub(super) fn restore(&mut self, saved: &[SavedEquations]) -> Result<(), SnapshotError> {
        for (own, (events, state)) in self.own.iter_mut().zip(saved) {
            let state = state.as_deref().unwrap_or_default();
            own.slot.call(|unit| unit.restore(state)).map_err(|fault| SnapshotError::UnitRestore {
                unit: own.slot.name().to_owned(),
                reason: fault.cause,
            })?;
            own.events.clone_from(events);
        }
        Ok(())
    }
}

fn set_states(ports: &ExchangedUnit, states: &[f64], at: &mut Kinematics) {
    for (&coordinate, value) in ports.states.iter().zip(states) {
        at.coordinates[coordinate].value = *value;
    }
}

/// Whether inputs differ by more than round-off.
fn have_jumped(before: &[f64], after: &[f64]) -> bool {
    // Far above the round-off of expressions, far below changes that a unit must not miss.
    before
        .iter()
        .zip(after)
        .any(|(before, after)| (after - before).abs() > 1e-9 * (before.abs() + after.abs()))
}

fn error_of(slot: &UnitSlot, time: f64, UnitFault { cause, remedy }: UnitFault) -> StepError {
    StepError::Unit { time, unit: slot.name().to_owned(), cause, remedy }
}

impl Simulation {
    /// Attaches the units with equations from which this simulation was started.
    pub fn attach_exchanged(&mut self, units: ExchangedUnits) {
        self.exchanged = units;
        self.restart_indicators();
    }

    /// Why a unit cannot continue.
    pub(super) fn unit_fault(&self) -> Option<StepError> {
        let mut slots = self.exchanged.own.iter().map(|own| &own.slot);
        slots.find_map(|slot| slot.fault().map(|(time, fault)| error_of(slot, time, fault)))
    }

    /// Why a unit has discarded a point since the last call.
    pub(super) fn take_discarded(&self) -> Option<StepError> {
        let time = self.state.kinematics.time;
        let all = self.exchanged.own.iter().map(|own| &own.slot);
        let mut discarded = all.filter_map(|slot| Some(error_of(slot, time, slot.take_discarded()?)));
        let first = discarded.next();
        discarded.for_each(drop);
        first
    }

    /// Fails if a unit has failed, or discarded a point, at the state.
    fn check_evaluation(&self) -> Result<(), StepError> {
        self.unit_fault().or_else(|| self.take_discarded()).map_or(Ok(()), Err)
    }

    /// Fails if the state is before the last event of a unit, which cannot return.
    pub(super) fn check_units(&self) -> Result<(), StepError> {
        let now = self.now();
        let ahead = self
            .exchanged
            .own
            .iter()
            .find(|own| own.events.reached - now > instants::tolerance(now, self.control.longest()));
        ahead.map_or(Ok(()), |own| {
            let cause =
                format!("it had an event at t = {} s, and cannot return to before it", own.events.reached);
            let remedy = "start the simulation again, or restore a snapshot".to_owned();
            Err(error_of(&own.slot, now, UnitFault { cause, remedy }))
        })
    }

    /// Ends an accepted step in all units.
    pub(super) fn complete_units(&mut self) -> Result<(), StepError> {
        if self.exchanged.is_empty() {
            return Ok(());
        }
        // Before this, points of attempts that were not accepted may have been discarded.
        let _ = self.take_discarded();
        let (graph, at) = (self.system.signals(), &self.state.kinematics);
        for (own, ports) in self.exchanged.own.iter_mut().zip(&graph.exchanged) {
            let point = ports.point(graph, at);
            own.events.is_due |=
                own.slot.complete(&point).map_err(|fault| error_of(&own.slot, at.time, fault))?;
            own.events.inputs = point.inputs;
        }
        self.check_evaluation()
    }

    /// Notes which events were indicators of units.
    pub(super) fn note_indicators(&mut self, happened: &[usize]) {
        for (own, ports) in self.exchanged.own.iter_mut().zip(&self.system.signals().exchanged) {
            own.events.crossed =
                happened.iter().copied().filter(|event| ports.indicators.contains(event)).collect();
            own.events.is_due |= !own.events.crossed.is_empty();
        }
    }

    /// Executes all events of units that are due at the state: of indicators and of announced times, those that units have requested
    /// after the step, and those of inputs that have jumped.
    pub(super) fn execute_unit_events(&mut self) -> Result<(), StepError> {
        if self.exchanged.is_empty() {
            return Ok(());
        }
        let (now, longest) = (self.now(), self.control.longest());
        for own in &mut self.exchanged.own {
            let Some(next) = own.events.next.filter(|next| *next <= now + instants::tolerance(now, longest))
            else {
                continue;
            };
            own.events.is_due = true;
            if next > self.state.kinematics.time {
                // The unit compares its time with the one it has announced.
                (self.state.kinematics.time, self.state.time_remainder) = (next, 0.0);
            }
        }
        let time = self.state.kinematics.time;
        let mut before = None;
        for _ in 0..100 {
            let graph = self.system.signals();
            for (own, ports) in self.exchanged.own.iter_mut().zip(&graph.exchanged) {
                let inputs = ports.point(graph, &self.state.kinematics).inputs;
                own.events.is_due |= have_jumped(&own.events.inputs, &inputs);
                own.events.inputs = inputs;
            }
            if !self.exchanged.own.iter().any(|own| own.events.is_due) {
                return before.map_or(Ok(()), |before: Vec<f64>| self.end_unit_events(&before));
            }
            if before.is_none() {
                before = Some(self.accelerations_of_state()?);
            }
            for (index, ports) in self.system.signals().exchanged.iter().enumerate() {
                let own = &mut self.exchanged.own[index];
                if !std::mem::take(&mut own.events.is_due) {
                    continue;
                }
                let (since, count) = own.recent;
                own.recent = if time - since > longest { (time, 1) } else { (since, count + 1) };
                if own.recent.1 > MAX_EVENTS {
                    let cause = format!("it had {count} events between t = {since} s and t = {time} s");
                    let remedy =
                        "look for events that follow each other without end, or decrease `analysis.step`";
                    return Err(error_of(&own.slot, time, UnitFault { cause, remedy: remedy.to_owned() }));
                }
                let crossed = std::mem::take(&mut own.events.crossed);
                let beyond = self.beyond(&crossed);
                let mut point = ports.point(self.system.signals(), &beyond.kinematics);
                point.time = time;
                let own = &mut self.exchanged.own[index];
                let after = own.slot.call(|unit| unit.event(&point));
                let after = after.map_err(|fault| error_of(&own.slot, time, fault))?;
                (own.events.next, own.events.reached) = (after.next, time);
                for ((&coordinate, before), after) in
                    ports.states.iter().zip(&point.states).zip(&after.states)
                {
                    if before != after {
                        self.state.kinematics.coordinates[coordinate].value = *after;
                    }
                }
            }
        }
        let fault = UnitFault {
            cause: "events of units change their inputs, and cause further events without end".to_owned(),
            remedy: "look for a loop through the outputs of the unit".to_owned(),
        };
        Err(error_of(&self.exchanged.own[0].slot, time, fault))
    }

    fn accelerations_of_state(&mut self) -> Result<Vec<f64>, StepError> {
        let time = self.state.kinematics.time;
        let Some(initial) = &mut self.held_values else { return Ok(Vec::new()) };
        let found = initial.acceleration_at(&self.system, &self.state);
        found.map_err(|error| StepError::Velocities { time, error })
    }

    /// Continues after events of units, before which the accelerations were `before`.
    fn end_unit_events(&mut self, before: &[f64]) -> Result<(), StepError> {
        let time = self.state.kinematics.time;
        let mut jump = self.accelerations_of_state()?;
        self.check_evaluation()?;
        jump.iter_mut().zip(before).for_each(|(after, before)| *after -= before);
        if !jump.is_empty() {
            self.add_jump(jump);
        }
        if self.system.has_rigid_contacts() {
            let switched = self.switch_constraints(&[], None, [time; 2]);
            switched.map_err(|error| StepError::Velocities { time, error })?;
        }
        self.system.signals().check(&self.state.kinematics).map_err(StepError::Signal)?;
        self.integrator.work.forget_predictions();
        self.integrator.jacobian_state.has_tangent = false;
        self.integrator.has_last_step = false;
        self.events.known.has_switched = true;
        self.restart_indicators();
        self.rearm_contacts();
        self.freeze_switches()
    }

    /// Determines the signs of all indicators anew.
    fn restart_indicators(&mut self) {
        let ahead = moved(&self.state, round_off::STEP_END * self.settings.step_size);
        let indicators = self.system.signals().exchanged.iter().flat_map(|ports| ports.indicators.clone());
        self.events.restart(&self.system, [&self.state, &ahead], &indicators.collect::<Vec<_>>());
    }

    /// The state, or the nearest one ahead in which these indicators have changed their signs: a root is located up to round-off, and the
    /// unit examines its indicators beyond it.
    fn beyond(&self, crossed: &[usize]) -> State {
        let size = self.attempt.size;
        let mut ahead =
            [0.0, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6].into_iter().map(|share| moved(&self.state, share * size));
        let found = ahead.find(|ahead| {
            let mut values = Vec::new();
            self.system.signals().event_values(&ahead.kinematics, |value| values.push(value));
            crossed.iter().all(|&event| self.events.is_beyond(event, values[event]))
        });
        found.unwrap_or_else(|| self.state.clone())
    }
}
