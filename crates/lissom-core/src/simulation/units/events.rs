//! Units with equations in a simulation: their start, the ends of accepted steps, and their events. State events are roots of
//! indicators, which end steps as other events do; steps also end at events that a unit announces. Events are executed at the start of the
//! next step: until then the unit has the discrete state of the last one, in which records within it are evaluated. After an event
//! states of the unit may jump, and accelerations, multipliers and rates jump with its outputs.

use super::{RunningUnit, Simulation, UnitFault, initial_error, step_error};
use crate::consistent::initial_conditions::moved;
use crate::errors::{InitialError, StepError};
use crate::instants;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::signals::Graph;
use crate::signals::unit_ports::{EquationPorts, UnitPorts};
use crate::system::State;

/// Largest number of events of a unit within a planned step, or within the longest adaptive one: ten times the samples of a fast controller.
const MAX_EVENTS: usize = 5000;

/// The units with equations.
fn with_equations<'a>(
    graph: &'a Graph,
    units: &'a mut [RunningUnit],
) -> impl Iterator<Item = (&'a mut RunningUnit, &'a UnitPorts, &'a EquationPorts)> {
    units.iter_mut().zip(&graph.units).filter_map(|(own, ports)| Some((own, ports, ports.equations()?)))
}

/// Executes the first event of units with equations at the start, where their states are set.
///
/// # Errors
/// If a unit cannot continue.
pub(super) fn end_initialisation(
    graph: &Graph,
    units: &mut [RunningUnit],
    at: &mut Kinematics,
) -> Result<(), InitialError> {
    let equations = graph.units.iter().filter_map(UnitPorts::equations);
    let points: Vec<_> = equations.map(|equations| equations.point(graph, at)).collect();
    for ((own, ports, _), point) in with_equations(graph, units).zip(points) {
        let after = own.unit.event(&point).map_err(initial_error(ports))?;
        own.progress.next = after.next;
        ports.set(&after.states, at).map_err(initial_error(ports))?;
    }
    Ok(())
}

/// Whether inputs differ by more than round-off.
fn have_jumped(before: &[f64], after: &[f64]) -> bool {
    // Far above the round-off of expressions, far below changes that a unit must not miss.
    before
        .iter()
        .zip(after)
        .any(|(before, after)| (after - before).abs() > 1e-9 * (before.abs() + after.abs()))
}

impl Simulation {
    /// Why a unit cannot continue, or else, if these count, why one has discarded a point since the last accepted step.
    pub(in crate::simulation) fn unit_fault(&self, counts_discarded: bool) -> Option<StepError> {
        let units = self.units.iter().zip(&self.system.signals().units);
        let found = units.filter_map(|(own, ports)| Some((ports, own.unit.fault()?)));
        let found = found.filter(|(_, found)| counts_discarded || found.fails_at.is_some());
        let (ports, found) = found.min_by_key(|(_, found)| found.fails_at.is_none())?;
        Some(step_error(ports, found.fails_at.unwrap_or(self.state.kinematics.time))(found.fault))
    }

    /// Fails if the state is before the last event of a unit, which cannot return.
    pub(in crate::simulation) fn check_units(&self) -> Result<(), StepError> {
        let now = self.now();
        let latest = now + instants::tolerance(now, self.control.longest());
        let mut units = self.units.iter().zip(&self.system.signals().units);
        let is_ahead = |(own, ports): &(&RunningUnit, &UnitPorts)| {
            ports.equations().is_some() && own.progress.reached > latest
        };
        units.find(is_ahead).map_or(Ok(()), |(own, ports)| {
            let reached = own.progress.reached;
            let cause = format!("it had an event at t = {reached} s, and cannot return to before it");
            let remedy = "start the simulation again, or restore a snapshot".to_owned();
            Err(step_error(ports, now)(UnitFault { cause, remedy }))
        })
    }

    /// Ends an accepted step in all units.
    pub(in crate::simulation) fn complete_units(&mut self) -> Result<(), StepError> {
        let (graph, at) = (self.system.signals(), &self.state.kinematics);
        for (own, ports, equations) in with_equations(graph, &mut self.units) {
            let point = equations.point(graph, at);
            own.progress.is_due |= own.unit.complete(&point).map_err(step_error(ports, at.time))?;
            own.progress.inputs = point.inputs;
        }
        self.unit_fault(true).map_or(Ok(()), Err)
    }

    /// Notes which events were indicators of units.
    pub(in crate::simulation) fn note_indicators(&mut self, happened: &[usize]) {
        for (own, _, equations) in with_equations(self.system.signals(), &mut self.units) {
            let crossed = happened.iter().copied().filter(|event| equations.indicators.contains(event));
            own.progress.crossed = crossed.collect();
            own.progress.is_due |= !own.progress.crossed.is_empty();
        }
    }

    /// The next event of a unit that is known in advance [s].
    pub(in crate::simulation) fn next_unit_event(&self) -> Option<f64> {
        self.units.iter().filter_map(|own| own.progress.next).reduce(f64::min)
    }

    /// Executes all events of units that are due at the state: of indicators and of announced times, those that units have requested
    /// after the step, and those of inputs that have jumped.
    pub(in crate::simulation) fn execute_unit_events(&mut self) -> Result<(), StepError> {
        let (now, longest) = (self.now(), self.control.longest());
        let latest = now + instants::tolerance(now, longest);
        for own in &mut self.units {
            let Some(next) = own.progress.next.filter(|next| *next <= latest) else { continue };
            own.progress.is_due = true;
            if next > self.state.kinematics.time {
                // The unit compares its time with the one it has announced.
                (self.state.kinematics.time, self.state.time_remainder) = (next, 0.0);
            }
        }
        let (time, system) = (self.state.kinematics.time, self.shared_system());
        let graph = system.signals();
        let mut before = None;
        for _ in 0..100 {
            for (own, ports, _) in with_equations(graph, &mut self.units) {
                let inputs = ports.inputs(graph, &self.state.kinematics);
                own.progress.is_due |= have_jumped(&own.progress.inputs, &inputs);
                own.progress.inputs = inputs;
            }
            if !self.units.iter().any(|own| own.progress.is_due) {
                return before.map_or(Ok(()), |before: Vec<f64>| self.end_unit_events(&before));
            }
            if before.is_none() {
                before = Some(self.accelerations_of_state()?);
            }
            for (index, ports) in graph.units.iter().enumerate() {
                let own = &mut self.units[index];
                let is_due = std::mem::take(&mut own.progress.is_due);
                let Some(equations) = ports.equations().filter(|_| is_due) else { continue };
                let (since, count) = own.recent;
                own.recent = if time - since > longest { (time, 1) } else { (since, count + 1) };
                if own.recent.1 > MAX_EVENTS {
                    let cause = format!("it had {count} events between t = {since} s and t = {time} s");
                    let remedy =
                        "look for events that follow each other without end, or decrease `analysis.step`";
                    return Err(step_error(ports, time)(UnitFault { cause, remedy: remedy.to_owned() }));
                }
                let crossed = std::mem::take(&mut own.progress.crossed);
                let beyond = self.beyond(&crossed);
                let mut point = equations.point(graph, &beyond.kinematics);
                point.time = time;
                let own = &mut self.units[index];
                let after = own.unit.event(&point).map_err(step_error(ports, time))?;
                (own.progress.next, own.progress.reached) = (after.next, time);
                let states = equations.states.iter().zip(&point.states).zip(&after.states);
                for ((&coordinate, before), after) in states {
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
        let first = graph.units.iter().find(|ports| ports.equations().is_some());
        first.map_or(Ok(()), |ports| Err(step_error(ports, time)(fault)))
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
        self.unit_fault(true).map_or(Ok(()), Err)?;
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
    pub(super) fn restart_indicators(&mut self) {
        let ahead = moved(&self.state, round_off::STEP_END * self.settings.step_size);
        let equations = self.system.signals().units.iter().filter_map(UnitPorts::equations);
        let indicators: Vec<_> = equations.flat_map(|own| own.indicators.clone()).collect();
        self.events.restart(&self.system, [&self.state, &ahead], &indicators);
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
