//! Start of a simulation, attempts at steps and their acceptance; `control` determines their length.

use crate::kinematics::Subject;
use std::collections::BTreeSet;
use std::sync::Arc;

use lissom_solver::FactorError;

use super::accumulated::Accumulation;
use super::equilibrium;
use super::held_values::settle;
use crate::consistent::initial_conditions::ConsistentInitialConditions;
use crate::consistent::mobility::mobility;
use crate::consistent::redundancy::{OutOfLine, Redundancy};
use crate::control;
use crate::elements::Load;
use crate::energy_balance::{EnergyBalance, StepWork};
use crate::errors::InitialError;
use crate::errors::StepError;
use crate::errors::Warning;
use crate::errors::step_error::describe;
use crate::errors::warn;
use crate::integrator::workspace::Workspace;
use crate::integrator::{Attempt, Integrator, Start, pivoting_unless_augmented};
use crate::judge::{self, Judge};
use crate::monitors::{self, Accepted, Beginning, Monitors};
use crate::newton::Failure;
use crate::saddle_point::TangentValues;
use crate::scaling::{Representative, Scaled, state_rows};
use crate::schemes::StageSystem;
use crate::settings::Problem;
use crate::settings::Settings;
use crate::settings::{Phase, Stopwatch};
use crate::settings::{StepReport, Totals};
use crate::simulation::{EventDetector, Stops};
use crate::simulation::{Origin, RunReport, Simulation};
use crate::system::{State, System};

impl Simulation {
    /// Prepares a simulation: representative values, consistent initial velocities, accelerations and
    /// multipliers.
    ///
    /// # Errors
    /// If consistent initial values do not exist.
    pub fn new(
        system: impl Into<Arc<System>>,
        state: State,
        settings: Settings,
    ) -> Result<Self, InitialError> {
        let mut simulation = Self::start(system.into(), state, settings, None)?;
        simulation.begin_contacts()?;
        simulation.begin_behind_jumps()?;
        Ok(simulation)
    }

    /// Starts like [`new`](Self::new), optionally with `known` representative values instead of those of `state`. In this case the
    /// multipliers of `state` are kept.
    pub(crate) fn start(
        system: Arc<System>,
        state: State,
        settings: Settings,
        known: Option<&Representative>,
    ) -> Result<Self, InitialError> {
        let mut warnings = Vec::new();
        let (system, mut state) = equilibrium::start_at_rest(system, state, &settings, &mut warnings)?;
        if !settings.scheme.dynamic {
            refuse_rates(&system)?;
        }
        let representative = known.copied().unwrap_or_else(|| {
            let at_start = system.linearization_at(&state.kinematics);
            Representative::of(&system, &state.kinematics, &at_start)
        });
        let redundancy = if settings.solver.is_strict {
            Redundancy::unexamined(representative.length)
        } else {
            Redundancy::new(&system, &state.kinematics, representative.length)
        };
        warnings.extend(out_of_line(&system, &state, &redundancy)?);
        let mut velocity_correction = 0.0;
        let mut held_values = None;
        let mut released = 0.0;
        if settings.scheme.dynamic {
            (velocity_correction, held_values) =
                begin_motion(&system, &mut state, &representative, &settings, &mut warnings)?;
        } else if known.is_none() {
            released = equilibrium::hold_start(&system, &mut state, &representative, settings.solver);
        }
        state.violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&state.kinematics, &mut state.violations);
        let problem = Problem { system: &system, settings: &settings };
        let beginning = Beginning { problem, state: &state, representative: &representative, released };
        let monitors = Monitors::new(&beginning);
        let mut integrator = Integrator::new(problem, &state, (representative, redundancy));
        integrator.note_touches(&system, &mut state, settings.step_size);
        judge::relative_turns(&system, &state.kinematics)
            .map_err(|error| InitialError::Wrapped(Box::new(error)))?;
        let interval = settings.scheme.dynamic.then_some(settings.step_size);
        let energy_balance = EnergyBalance::new(&system, &state, &representative, interval);
        let events = event_detector(&system, &state, &settings);
        events.freeze_switches(&system, &mut state.kinematics);
        Ok(Self {
            integrator,
            monitors,
            stops: Stops::new(&system, &settings, &state),
            control: control::of(&settings),
            origin: Origin { kinematics: state.kinematics.clone(), velocity_correction, may_relax: true },
            previous: state.clone(),
            attempt: Attempt::new(&state, energy_balance),
            system,
            state,
            settings,
            held_values,
            report: RunReport {
                energy_balance,
                warnings,
                totals: Totals { smallest_relative_pivot: f64::INFINITY, ..Totals::default() },
            },
            events,
            accumulation: Accumulation::default(),
            units: Vec::new(),
        })
    }

    /// The tangent at the solution of the last step; none before the first step and after a failure.
    pub(crate) fn last_tangent(&mut self, scaled: Scaled, of: &StageSystem) -> Option<TangentValues> {
        let Self { system, settings, integrator, previous, .. } = self;
        let problem = Problem { system, settings };
        integrator.has_last_step.then(|| integrator.tangent_at_solution(problem, previous, scaled, of))
    }

    /// Condition number of the tangent factored last, estimated in the 1-norm from a few solves; none if it is no longer in use.
    pub fn condition_estimate(&mut self) -> Option<f64> {
        let (pattern, states) = (&self.system.structure().pattern, state_rows(self.system.layout()));
        let Integrator { jacobian_state, work, .. } = &mut self.integrator;
        let matrices = &mut work.tangent.matrices;
        let value = jacobian_state.has_tangent.then(|| matrices.condition_estimate(pattern, &states));
        value.map(|value| value.max(1.0))
    }

    /// Error of a failed factorisation, with names.
    pub(crate) fn describe_factor(&self, error: &FactorError, time: f64) -> StepError {
        describe(&Failure::Factor(*error), self.system.layout(), time, &self.settings, &Subject::nameless(""))
    }

    /// Solves a step of `size` [s] from the state, and checks the result.
    ///
    /// # Errors
    /// If it has no solution, or an invalid one.
    pub(crate) fn attempt(&mut self, size: f64, watch: &mut dyn Stopwatch) -> Result<(), StepError> {
        let problem = Problem { system: &self.system, settings: &self.settings };
        let from = Start { previous: &self.previous, state: &self.state };
        self.integrator.attempt(problem, from, size, watch, &mut self.attempt)?;
        watch.begin(Phase::Rest);
        self.judge_attempt()
    }

    /// Checks the result of the last attempt.
    ///
    /// # Errors
    /// If it is invalid.
    pub(crate) fn judge_attempt(&mut self) -> Result<(), StepError> {
        let Integrator { representative, work, .. } = &self.integrator;
        let judge = Judge::new(self.problem(), representative, (&work.redundancy, &work.unit.spins));
        let start = self.attempt.start(&self.state);
        let (scheme, end) = (&self.settings.scheme, &self.attempt.end);
        let Workspace { motions, multipliers, .. } = &*self.integrator.work;
        let size = end.kinematics.time - start.kinematics.time;
        let work = match scheme.quadrature[..] {
            [] => StepWork::between(&self.system, start, end),
            ref weights => StepWork::of_stages(&self.system, (weights, size), motions, multipliers),
        };
        let work = work.with_loads(size * end.touch_power());
        let (after, violation) = judge.examine((start, end), work, &self.report.energy_balance)?;
        (self.attempt.energy_balance, self.attempt.violation) = (after, violation);
        Ok(())
    }

    /// Accepts the last attempt: monitors are updated, and its end becomes the state.
    pub(crate) fn accept_attempt(&mut self) {
        let mut step = Accepted {
            problem: Problem { system: &self.system, settings: &self.settings },
            integrator: &mut self.integrator,
            origin: &self.origin.kinematics,
            start: self.attempt.start(&self.state),
            end: &self.attempt.end,
            energy_balance: [&self.report.energy_balance, &self.attempt.energy_balance],
            violation: self.attempt.violation,
            prediction_error: self.attempt.outcome.first_correction,
            fraction: self.control.fraction(&self.attempt),
            has_switched: self.events.known.has_switched,
        };
        self.monitors.accept(&mut step, &mut self.report.warnings);
        self.record_signals();
        self.commit_attempt();
    }

    /// Makes the end of the last attempt the state.
    pub(crate) fn commit_attempt(&mut self) {
        let problem = Problem { system: &self.system, settings: &self.settings };
        self.accumulation.follow(
            problem,
            &self.integrator,
            &mut self.attempt,
            &self.state,
            &mut self.report.warnings,
        );
        self.report.energy_balance = self.attempt.energy_balance;
        let multipliers = &self.attempt.start(&self.state).multipliers;
        self.integrator.learn(&self.settings, multipliers);
        self.attempt.accept(&mut self.previous, &mut self.state);
    }

    /// Adds a completed step to the totals.
    pub(crate) fn count(&mut self, report: &StepReport) {
        let (totals, work) = (&mut self.report.totals, &self.integrator.work);
        totals.steps += report.parts;
        totals.stagnated_steps += usize::from(report.stagnated);
        totals.fell_back_at = work.tangent.fell_back().map(|(unknown, _)| unknown);
        totals.regularized_at = work.tangent.redundant();
        if let Some(factor) = work.tangent.report() {
            totals.smallest_relative_pivot = totals.smallest_relative_pivot.min(factor.relative_pivot());
        }
        for violation in &self.state.violations {
            totals.max_constraint_violation = totals.max_constraint_violation.max(violation.abs());
        }
    }
}

/// Reports joints that are nearly redundant, and rejects them if nothing can move.
fn out_of_line(
    system: &System,
    state: &State,
    redundancy: &Redundancy,
) -> Result<Option<Warning>, InitialError> {
    let Some(OutOfLine { joint, others, angle }) = redundancy.out_of_line().cloned() else { return Ok(None) };
    if mobility(system, state).freedoms == 0 {
        return Err(InitialError::NoFreedom { joint, others: others.to_string(), angle });
    }
    Ok(Some(Warning::JointsOutOfLine { time: state.kinematics.time, joint, others, angle }))
}

/// Detector of events in motions, with adaptive steps also of switches of forces.
fn event_detector(system: &System, state: &State, settings: &Settings) -> EventDetector {
    if settings.scheme.dynamic {
        EventDetector::new(system, state, settings.control.is_some())
    } else {
        EventDetector::of_nothing(state)
    }
}

/// Rejects equations that contain rates, which statics does not support.
fn refuse_rates(system: &System) -> Result<(), InitialError> {
    let layout = system.layout();
    let at_rest: BTreeSet<_> = system.elements_with(|own| own.load).flat_map(Load::states_at_rest).collect();
    let states = layout.states().filter(|(_, state, _)| !at_rest.contains(state));
    let count = layout.coordinate_count();
    let is_latch = |row: &usize| system.latches().iter().any(|latch| count + latch.multiplier == *row);
    // A latch keeps its coordinate in load steps too.
    let mut rows = states.map(|(row, ..)| row).chain(layout.velocity_rows().filter(|row| !is_latch(row)));
    let of_row = rows.next().map(|row| layout.subject_of(row));
    if let Some(signal) = system.signals().delayed() {
        return Err(InitialError::DelayInStatics { signal });
    }
    let of_creep = || system.sees_multipliers().then(|| Subject::nameless("the creep of a wheel on a rail"));
    of_row.or_else(of_creep).map_or(Ok(()), |state| Err(InitialError::StateInStatics { state }))
}

/// Makes velocities, accelerations and multipliers of a motion's start consistent. Returns the largest change of a velocity, and the
/// solver for jumps of accelerations.
fn begin_motion(
    system: &System,
    state: &mut State,
    representative: &Representative,
    settings: &Settings,
    warnings: &mut Vec<Warning>,
) -> Result<(f64, Option<ConsistentInitialConditions>), InitialError> {
    let mut initial =
        ConsistentInitialConditions::new(system, state, representative, pivoting_unless_augmented(settings));
    let given = state.clone();
    let mut velocity_correction = initial.given_velocities(system, state)?;
    let deformation = |of: &State| {
        judge::start::sudden_deformation(system, representative, [&given, of].map(|at| &at.kinematics))
    };
    if settings.follow_drives
        && let Some((rate, _)) = deformation(state)
        && let Some(driven) = initial.least_deforming(system, &given)
        && deformation(&driven).is_none_or(|(own, _)| own < rate)
    {
        *state = driven;
        let changes = given.kinematics.nodes.iter().zip(&state.kinematics.nodes);
        velocity_correction =
            changes.map(|(given, used)| (used.twist - given.twist).amax()).fold(0.0, f64::max);
    }
    let given = given.kinematics;
    let rates = initial.constraint_rates(system, state);
    // If nothing of the given velocities remains, the rest is their round-off.
    let [specified, used] = [&given, &state.kinematics].map(|at| representative.largest_speed(system, at));
    let negligible = judge::start::negligible(representative, settings.step_size);
    judge::start::rates(system, representative, (&rates, specified.max(used), negligible))?;
    warnings.extend(judge::start::velocities(system, representative, &given, &state.kinematics, negligible)?);
    let at = &state.kinematics;
    monitors::limits::at_start(system, at)
        .chain(monitors::overlap(system, at))
        .for_each(|warning| warn(warnings, warning));
    if settings.control.is_none() {
        for bristle in system.elements_with(|own| own.bristle) {
            if let Some((deflection, steady)) = bristle.steady_at_start(&state.kinematics, settings.step_size)
            {
                state.kinematics.coordinates[deflection].value = steady;
            }
        }
    }
    settle(system, state, &mut initial, settings)?;
    let held_values = may_jump(system, state).then_some(initial);
    Ok((velocity_correction, held_values))
}

/// Whether accelerations may jump: with held values or with breakpoints of functions of time.
fn may_jump(system: &System, state: &State) -> bool {
    let changes = system.functions.iter().any(|(_, function)| !function.is_constant());
    let has_units = !system.signals().units.is_empty();
    changes || has_units || !state.kinematics.held.is_empty() || !system.breakpoints().is_empty()
}
