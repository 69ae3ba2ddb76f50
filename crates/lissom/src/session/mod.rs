//! A run of one model from start to end: steps, and the records between them. Contains the only loop over steps.
//! Independent of files and terminal.

mod handles;
mod joint_coordinates;
mod joint_dynamics;
mod observed;
mod prepared;
mod snapshot;
mod walls;

use lissom_core::diagnostics::Diagnose;
use std::collections::BTreeMap;
use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use crate::start::Lowered;
use lissom_core::errors::Warning;
use lissom_core::errors::{InitialError, StepError};
use lissom_core::instants;
use lissom_core::interrupt;
use lissom_core::settings::StepReport;
use lissom_core::signals::Argument;
use lissom_core::signals::event::Occurrence;
use lissom_core::simulation::{InputError, Simulation};
use lissom_core::system::State;
use lissom_model::channels::{Channel, signal_value};
use lissom_model::document::OutputKind;
use lissom_model::lower::Plan;
use lissom_model::output::{Column, Record, Writer};
use lissom_model::sweep::{Accumulator, TimeWindow, WindowError, WindowedHistory};
use lissom_model::{Document, Report, component_position};

use crate::ids::IdNames;
use crate::run::report::{EnergyChange, RunError, RunReport, Stopped};
use crate::run::results::{IncompleteRun, Results};
use crate::run::schedule::{Due, Next, Schedule};
use crate::run::state_writer::StateWriter;
use crate::run::telemetry::Telemetry;
use crate::run::timings::Timings;

pub use handles::ReadError;
pub use joint_coordinates::{JointCoordinateError, JointCoordinates};
pub use joint_dynamics::JointDynamics;
pub(crate) use observed::Observed;
pub use prepared::{PartError, Prepared, StartError};
use snapshot::NoCheckpoints;
pub use snapshot::{Checkpoints, SessionSnapshot};
use walls::ModelWarnings;

/// Times this close to the end of a planned step, relative to the step, are equal to its end.
const WHOLE: f64 = 1e-9;

/// Why a session cannot start.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The model is invalid.
    #[error(transparent)]
    Model(#[from] Report),
    /// There are no consistent initial values.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// The analysis has no time history.
    #[error("{}", self.diagnostic())]
    NotInTime(&'static str),
}

/// Progress of a session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time [s].
    pub time: f64,
    /// End time [s].
    pub end: f64,
    /// Planned steps done; for adaptive steps, thousandths of the time.
    pub done: usize,
    /// The total of these.
    pub planned: usize,
}

/// A model during a run.
pub struct Session {
    simulation: Simulation,
    observed: Observed,
    columns: Vec<Column>,
    signals: BTreeMap<String, Argument>,
    schedule: Schedule,
    statistics_window: TimeWindow,
    tally: Tally,
    timings: Timings,
    scale: f64,
    telemetry: Telemetry,
    /// Values of the output that was read last.
    read: Vec<f64>,
    /// Room for a state within a step.
    between: Box<State>,
    state_writers: Vec<Box<dyn StateWriter>>,
    /// Warnings of the model, before the run and at its end.
    warnings: ModelWarnings,
    /// Names of ids, if the model was built in code.
    ids: Option<Arc<IdNames>>,
    began: Instant,
}

/// Values accumulated over the records.
#[derive(Clone, Default)]
struct Tally {
    records: usize,
    violation: f64,
    energy: EnergyChange,
    values: Vec<f64>,
    violations: Vec<f64>,
    /// Statistics of each column.
    histories: Vec<WindowedHistory>,
}

/// The columns of a lowered model's outputs.
pub fn columns(channels: &[Channel]) -> Vec<Column> {
    let of = |channel: &Channel| {
        // What an expression is follows from its name alone.
        let quantity = match channel.kind {
            OutputKind::Expression | OutputKind::Signal => channel.name.clone(),
            kind => kind.name().replace('_', " "),
        };
        let column = |(component, unit): (&String, &String)| {
            let column = Column::new(&channel.name, component, &quantity, unit);
            column.with_fatigue(channel.fatigue).in_plot(channel.plot.clone())
        };
        channel.components.iter().zip(&channel.units).map(column).collect::<Vec<_>>()
    };
    channels.iter().flat_map(of).collect()
}

impl Session {
    /// A session at the start of the analysis of `document`.
    ///
    /// # Errors
    /// If the model is invalid, or has no consistent initial values.
    pub fn new(document: &Document) -> Result<Self, SessionError> {
        Ok(Prepared::new(document, None)?.session()?)
    }

    /// A session at the start of a lowered model.
    ///
    /// # Errors
    /// If there are no consistent initial values.
    pub fn start(lowered: Lowered) -> Result<Self, InitialError> {
        let began = Instant::now();
        let Lowered {
            system,
            state,
            settings,
            plan,
            channels,
            statistics_window,
            accumulated,
            names,
            warnings,
            units,
            ..
        } = lowered;
        let origin = state.kinematics.time;
        let warnings = ModelWarnings::of(warnings, &names, (&system, &state.kinematics));
        let schedule = Schedule::new(plan, settings.step_size);
        let started = units.iter().map(|unit| unit.start(origin));
        let mut simulation = Simulation::with_units(system, state, settings, started)?;
        simulation.accumulate(accumulated);
        let violations = vec![0.0; simulation.system().layout().multiplier_rows().len()];
        let mut timings = Timings::new();
        timings.start = began.elapsed();
        Ok(Self {
            columns: columns(&channels),
            observed: Observed::new(&simulation, channels),
            timings,
            statistics_window,
            tally: Tally { violations, ..Tally::default() },
            scale: simulation.scaled().scale(),
            telemetry: Telemetry::default(),
            read: Vec::new(),
            between: Box::new(simulation.state().clone()),
            state_writers: Vec::new(),
            simulation,
            signals: names.signals,
            schedule,
            warnings,
            ids: None,
            began,
        })
    }

    /// Cancels a step that is repeated many times, once `cancelled` is set; the run is then interrupted.
    pub fn cancel_by(&mut self, cancelled: Arc<AtomicBool>) {
        self.timings.cancelled = Some(cancelled);
    }

    /// The simulation: system, state, totals.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The outputs, as they are evaluated.
    pub(crate) fn observed(&self) -> &Observed {
        &self.observed
    }

    /// The outputs, without the rest.
    pub(crate) fn into_observed(self) -> Observed {
        self.observed
    }

    /// Also passes the states of a [`run`](Self::run) to `writer`.
    pub fn write_states_to(&mut self, writer: Box<dyn StateWriter>) {
        self.state_writers.push(writer);
    }

    /// The simulation, for analyses along its steps.
    pub(crate) fn simulation_mut(&mut self) -> &mut Simulation {
        &mut self.simulation
    }

    /// Warnings so far.
    pub fn warnings(&self) -> impl Iterator<Item = &Warning> {
        self.warnings.all.iter().chain(self.simulation.warnings())
    }

    /// Time range and steps.
    pub fn plan(&self) -> &Plan {
        self.schedule.plan()
    }

    /// The recorded columns, in the order of [`values`](Self::values).
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Statistics of the records of each column, in the order of [`columns`](Self::columns); none before the first
    /// record.
    ///
    /// # Errors
    /// If the window of the statistics has no records.
    pub fn histories(&self) -> Result<Vec<Accumulator>, WindowError> {
        let events = self.events().collect::<Vec<_>>();
        self.tally.histories.iter().map(|history| history.close(&events)).collect()
    }

    /// Scale factor s of the planned step.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Data about the tangents of the steps so far.
    pub fn telemetry(&self) -> &Telemetry {
        &self.telemetry
    }

    /// Progress of the run.
    pub fn progress(&self) -> Progress {
        let (done, planned) = self.schedule.done();
        Progress { time: self.schedule.time(), end: self.schedule.plan().end, done, planned }
    }

    /// Whether the end is reached, or an event has ended the run.
    pub fn is_finished(&self) -> bool {
        self.schedule.is_finished() || self.stopped_by().is_some()
    }

    /// Name of the event at the present state, if it ends the run. The session can still be continued.
    pub fn stopped_by(&self) -> Option<&str> {
        self.simulation.stopped_by()
    }

    /// Names and times [s] of the events that have happened.
    pub fn events(&self) -> impl Iterator<Item = (&str, f64)> {
        let events = self.simulation.system().signals().events();
        let of = |occurrence: &Occurrence| (events[occurrence.event].name.as_str(), occurrence.time);
        self.simulation.occurrences().iter().map(of)
    }

    /// Appends the present values of all columns.
    pub fn values(&self, out: &mut Vec<f64>) {
        self.observed.values(self.simulation.state(), self.simulation.step_of_rates(), out);
    }

    /// Appends the present values of one channel.
    fn values_of(&self, channel: &Channel, out: &mut Vec<f64>) {
        self.observed.values_of(channel, self.simulation.state(), self.simulation.step_of_rates(), out);
    }

    /// The present value of a column, counted from 0; NaN if there is none.
    pub fn column_value(&self, column: usize) -> f64 {
        self.observed.value(column, self.simulation.state(), self.simulation.step_of_rates())
    }

    /// Whether a column needs more than positions, which are known without a solution of equations.
    pub fn recovers(&self, column: usize) -> bool {
        self.observed.recovers(column)
    }

    /// The present value of a signal, an input or a state, or of a column, such as `tip.u1`; none if the name is unknown.
    pub fn value(&self, name: &str) -> Option<f64> {
        let (system, state) = (self.simulation.system(), self.simulation.state());
        if let Some(&argument) = self.signals.get(name) {
            return Some(signal_value(system, &state.kinematics, argument));
        }
        let (owner, component) = name.rsplit_once('.')?;
        let channel = self.observed.channels().iter().find(|channel| channel.name == owner)?;
        let index = component_position(channel.components.iter().map(String::as_str), component)?;
        let mut values = Vec::with_capacity(channel.components.len());
        self.values_of(channel, &mut values);
        values.get(index).copied()
    }

    /// Names of signals, inputs and states.
    pub fn signal_names(&self) -> impl Iterator<Item = &str> {
        self.signals.keys().map(String::as_str)
    }

    /// Sets an input from now on, until it is set again.
    ///
    /// # Errors
    /// If the model has no such input, or the value is not finite.
    pub fn set_input(&mut self, name: &str, value: f64) -> Result<(), InputError> {
        self.set_inputs([(name, value)])
    }

    /// Sets inputs, all at once, until they are set again: this costs as much as one of them.
    ///
    /// # Errors
    /// If the model has no such input, or a value is not finite; then none is set.
    pub fn set_inputs<'n>(
        &mut self,
        inputs: impl IntoIterator<Item = (&'n str, f64)>,
    ) -> Result<(), InputError> {
        self.simulation.set_inputs(inputs)
    }

    /// Performs one step: the next planned one, or one whose size is limited by its error. On failure the state remains
    /// unchanged.
    ///
    /// # Errors
    /// If the step has no solution.
    pub fn advance(&mut self) -> Result<StepReport, StepError> {
        let outcome = self.step();
        self.timings.pause();
        // Nothing is recorded.
        while self.schedule.due().is_some() {}
        outcome
    }

    /// Continues to `time` [s], which is reached exactly; with a constant step size the last step is shorter. Does
    /// nothing if `time` has been reached, and stops before it at an event that ends the run. Planned steps, and
    /// [`run`](Self::run), continue from there.
    ///
    /// # Errors
    /// If `time` is not finite, or a step has no solution; the session is then at the end of the last successful
    /// step.
    pub fn step_to(&mut self, time: f64) -> Result<(), StepError> {
        self.step_to_watched(time, &mut |_| ControlFlow::Continue(())).map(|_| ())
    }

    /// Continues to `time` [s] as [`step_to`](Self::step_to) does. `watch` decides before every step whether to continue;
    /// if it stops, the session is at the end of a step before `time`.
    ///
    /// # Errors
    /// As [`step_to`](Self::step_to).
    pub fn step_to_watched(
        &mut self,
        time: f64,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        let outcome = self.go_to(time, watch);
        self.timings.pause();
        outcome
    }

    fn go_to(
        &mut self,
        time: f64,
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        if !time.is_finite() {
            return Err(StepError::NoTime { target: time });
        }
        let is_controlled = self.schedule.plan().is_controlled;
        let time = self.distinguished(time);
        while time - self.schedule.time() > WHOLE * self.schedule.step_size() {
            if watch(&self.progress()).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            let now = self.schedule.time();
            if is_controlled {
                self.take(Next::Until(time))?;
                self.schedule.divert(self.simulation.state().kinematics.time);
                if self.stopped_by().is_some() {
                    return Ok(ControlFlow::Continue(()));
                }
                continue;
            }
            let planned = match self.schedule.next() {
                Next::Planned { size, .. } if !self.schedule.is_finished() => size,
                _ => self.schedule.step_size(),
            };
            let rest = time - now;
            if rest > planned * (1.0 + WHOLE) && !self.schedule.is_finished() {
                self.step()?;
                if self.stopped_by().is_some() {
                    return Ok(ControlFlow::Continue(()));
                }
            } else if (rest - planned).abs() <= WHOLE * planned && !self.schedule.is_finished() {
                self.step()?;
                return Ok(ControlFlow::Continue(()));
            } else {
                let size = rest.min(planned);
                let end = if size == rest { time } else { now + size };
                self.take(Next::Planned { size, end })?;
                if self.stopped_by().is_some() {
                    self.schedule.divert(self.simulation.state().kinematics.time);
                    return Ok(ControlFlow::Continue(()));
                }
                self.schedule.divert(end);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Allowed difference between an external clock and that of the session [s], if the clock adds steps of `size` [s] to a
    /// sum.
    pub fn clock_tolerance(&self, size: f64) -> f64 {
        let (now, start) = (self.schedule.time(), self.schedule.plan().start);
        instants::accumulated_tolerance(now + size, now + size - start, size)
    }

    /// The sample, breakpoint, record or end at `time` [s] up to the round-off of a clock that adds steps; otherwise
    /// `time`. A step between the two would be so short that its accelerations are round-off.
    fn distinguished(&self, time: f64) -> f64 {
        let now = self.schedule.time();
        let allowed = self.clock_tolerance(time - now);
        let known = self.simulation.distinguished_instant(time, allowed);
        let instants = known.into_iter().chain(self.schedule.next_instants(time));
        let nearest = instants.min_by(|a, b| (a - time).abs().total_cmp(&(b - time).abs()));
        nearest.filter(|instant| (instant - time).abs() <= allowed && *instant > now).unwrap_or(time)
    }

    /// Takes the next step of a sequence.
    fn step(&mut self) -> Result<StepReport, StepError> {
        let report = self.take(self.schedule.next())?;
        let time = self.simulation.state().kinematics.time;
        if self.stopped_by().is_some() && !self.schedule.plan().is_controlled {
            // The step ends where the event happened.
            self.schedule.divert(time);
        } else {
            self.schedule.accept(time);
        }
        Ok(report)
    }

    fn take(&mut self, next: Next) -> Result<StepReport, StepError> {
        let limit = match next {
            Next::Planned { size, end } => {
                self.simulation.set_step_size(size);
                end
            }
            Next::Until(limit) => limit,
        };
        self.timings.begin_step();
        let outcome = self.simulation.step_watched(limit, &mut self.timings);
        self.timings.end_step();
        let report = outcome?;
        if self.telemetry.will_estimate(&self.simulation, &report) {
            self.timings.pause();
        }
        self.telemetry.note(&mut self.simulation, &report);
        Ok(report)
    }

    /// Runs to the end and stores the results in memory.
    ///
    /// # Errors
    /// If a step has no solution, or the run was cancelled: the error contains the results so far.
    pub fn run(&mut self) -> Result<Results, IncompleteRun> {
        let mut record = Record::default();
        let report = self.run_with(&mut [&mut record], &mut |_| ControlFlow::Continue(()));
        let warnings = self.warnings().cloned().collect();
        Results::of(record, report, warnings)
    }

    /// Runs to the end. `writers` receive a row at the start, after every `output_every` planned steps, and at the
    /// end of the last step, for whatever reason it is the last. `watch` decides after every step whether to
    /// continue.
    pub fn run_with(
        &mut self,
        writers: &mut [&mut dyn Writer],
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> RunReport {
        self.run_with_checkpoints(writers, watch, &mut NoCheckpoints, false)
    }

    /// Runs to the end as [`run_with`](Self::run_with) does, and calls `checkpoints` after every step. With `goes_on` the writers
    /// already contain the rows up to the present state.
    pub fn run_with_checkpoints(
        &mut self,
        writers: &mut [&mut dyn Writer],
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
        checkpoints: &mut dyn Checkpoints,
        goes_on: bool,
    ) -> RunReport {
        let stopped = match self.steps(writers, watch, checkpoints, goes_on) {
            Ok(ControlFlow::Continue(())) => Stopped::End,
            Ok(ControlFlow::Break(())) => Stopped::Interrupted,
            Err(error) => Stopped::Failed(error),
        };
        if matches!(stopped, Stopped::End) {
            self.warnings.check_end(&self.simulation.state().kinematics);
        }
        self.timings.pause();
        self.check_expressions();
        let finished = writers.iter_mut().try_for_each(|writer| writer.finish());
        let simulation = &self.simulation;
        let states = self.state_writers.iter_mut().try_for_each(|writer| writer.finish(simulation));
        let finished = finished.and(states);
        let stopped = match (stopped, finished) {
            (Stopped::Failed(error), _) => Stopped::Failed(error),
            (_, Err(error)) => Stopped::Failed(error.into()),
            (stopped, Ok(())) => stopped,
        };
        RunReport {
            stopped,
            time: self.schedule.time(),
            records: self.tally.records,
            totals: *self.simulation.totals(),
            wall: self.began.elapsed(),
            solving: self.timings.steps(),
            seconds: self.timings.seconds(),
            violation: self.tally.violation,
            energy: self.tally.energy,
            conditions: [self.telemetry.first_condition(), self.simulation.condition_estimate()],
        }
    }

    fn steps(
        &mut self,
        writers: &mut [&mut dyn Writer],
        watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
        checkpoints: &mut dyn Checkpoints,
        goes_on: bool,
    ) -> Result<ControlFlow<()>, RunError> {
        if !goes_on {
            for writer in writers.iter_mut() {
                writer.begin(&self.columns)?;
            }
            self.write_row(writers, Due::End)?;
            let simulation = &self.simulation;
            self.state_writers.iter_mut().try_for_each(|writer| writer.begin(simulation))?;
        }
        let mut recorded = true;
        self.keep(writers, checkpoints)?;
        while !self.is_finished() {
            let before = self.schedule.time();
            match self.step() {
                Ok(report) => {
                    // Only the last part of a step can be interpolated, and load steps are not a motion in time.
                    let is_known = report.parts <= 1 && !self.schedule.plan().is_static;
                    self.write_states(is_known.then_some(before))?;
                }
                Err(error) => {
                    if !recorded {
                        self.write_row(writers, Due::End)?;
                    }
                    // A unit that computes is ended by an interruption.
                    let is_asked = interrupt::is_asked() && matches!(error, StepError::Unit { .. });
                    if is_asked || matches!(error, StepError::Interrupted { .. }) {
                        return Ok(ControlFlow::Break(()));
                    }
                    return Err(error.into());
                }
            }
            recorded = false;
            while let Some(due) = self.schedule.due() {
                recorded = due == Due::End;
                self.write_row(writers, due)?;
            }
            if checkpoints.is_due(self.simulation.totals().steps) {
                self.keep(writers, checkpoints)?;
            }
            if watch(&self.progress()).is_break() && !self.is_finished() {
                if !recorded {
                    self.write_row(writers, Due::End)?;
                }
                return Ok(ControlFlow::Break(()));
            }
        }
        if !recorded {
            self.write_row(writers, Due::End)?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Warns of expressions that are not finite at any record.
    fn check_expressions(&mut self) {
        let mut histories = self.tally.histories.iter();
        for channel in self.observed.channels() {
            let is_finite = histories
                .by_ref()
                .take(channel.components.len())
                .fold(false, |any, own| any | own.has_finite());
            let warning = Warning::NeverFinite { output: channel.name.clone() };
            let is_doubtful = channel.kind == OutputKind::Expression && self.tally.records > 0 && !is_finite;
            if is_doubtful && !self.warnings.all.contains(&warning) {
                self.warnings.all.push(warning);
            }
        }
    }

    /// Passes on a snapshot, after all earlier rows have been written.
    fn keep(&mut self, writers: &mut [&mut dyn Writer], checkpoints: &mut dyn Checkpoints) -> io::Result<()> {
        if !checkpoints.are_wanted() {
            return Ok(());
        }
        self.timings.pause();
        writers.iter_mut().try_for_each(|writer| writer.finish())?;
        self.state_writers.iter_mut().try_for_each(|writer| writer.flush())?;
        checkpoints.keep(&self.snapshot())
    }

    /// Passes the last step to the state writer; states may be interpolated from `known_from` [s] on.
    fn write_states(&mut self, known_from: Option<f64>) -> io::Result<()> {
        let now = self.simulation.state().kinematics.time;
        if !self.state_writers.iter().any(|writer| writer.is_due(now)) {
            return Ok(());
        }
        self.timings.pause();
        let began = Instant::now();
        let known_from = known_from.unwrap_or(now);
        let simulation = &self.simulation;
        let mut due = self.state_writers.iter_mut().filter(|writer| writer.is_due(now));
        let written = due.try_for_each(|writer| writer.step(simulation, known_from));
        self.timings.output += began.elapsed();
        written
    }

    /// Writes a row of the present state, or of an instant within the last step.
    fn write_row(&mut self, writers: &mut [&mut dyn Writer], due: Due) -> io::Result<()> {
        self.timings.pause();
        let began = Instant::now();
        let mut values = std::mem::take(&mut self.tally.values);
        values.clear();
        let time = match due {
            Due::End => {
                self.values(&mut values);
                self.take_stock();
                self.schedule.time()
            }
            Due::Within(time) => {
                self.simulation.state_within(time, &mut self.between);
                self.observed.values(&self.between, self.simulation.last_step(), &mut values);
                time
            }
        };
        if self.tally.histories.len() != values.len() {
            let of = |column: &Column| WindowedHistory::new(self.statistics_window.clone(), column.fatigue);
            self.tally.histories = self.columns.iter().map(of).collect();
        }
        for (history, value) in self.tally.histories.iter_mut().zip(&values) {
            history.add(time, *value);
        }
        self.tally.values = values;
        self.tally.records += 1;
        let written = writers.iter_mut().try_for_each(|writer| writer.row(time, &self.tally.values));
        self.timings.output += began.elapsed();
        written
    }

    /// Updates violations and energy at the recorded end of a step.
    fn take_stock(&mut self) {
        let state = self.simulation.state();
        let tally = &mut self.tally;
        self.simulation.system().violations(&state.kinematics, &mut tally.violations);
        tally.violation = tally.violations.iter().fold(tally.violation, |most, value| most.max(value.abs()));
        let now = self.simulation.system().energy_of(state);
        if tally.records == 0 {
            tally.energy.start = now;
        }
        tally.energy.end = now;
        let change = (now.total() - tally.energy.start.total()).abs();
        tally.energy.largest = tally.energy.largest.max(change);
    }
}
