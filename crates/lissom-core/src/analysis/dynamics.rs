//! Starts a simulation, solves its steps and accepts them: `stepping` decides about their length.

use std::sync::Arc;

use lissom_solver::{FactorError, SolverKind};

use super::accumulated::Accumulation;
use super::equations::StepEquations;
use super::equilibrium;
use super::held_values::settle;
use super::initial_conditions::{ConsistentInitialConditions, InitialError};
use super::phase::{Stopwatch, Unwatched};
use super::projection::Projection;
use super::regularization::Regularization;
use super::settings::Settings;
use super::simulation::{Simulation, warn};
use super::step_error::{StepError, describe};
use super::tangent_values::TangentValues;
use super::totals::{StepReport, Totals};
use super::workspace::Workspace;
use crate::judge::rates::ConstraintRates;
use crate::judge::singular::SingularPositions;
use crate::judge::{self, EnergyBalance, Judge, Warning};
use crate::kinematics::{Kinematics, MotionChange};
use crate::newton::{self, Equations, Failure, JacobianState, Outcome};
use crate::scaling::{Representative, Scaled};
use crate::schemes::StageSystem;
use crate::stepping::breakpoints;
use crate::stepping::{
    Controller, EventDetector, Impacts, IntegratorHistory, LoadControl, Resolution, StepBisection,
    TimeFunctions,
};
use crate::system::{State, System, Threads};

/// Where round-off keeps such a scheme from that, a last correction below this is a solution all the same: what it does
/// to the energy is seen by the energy balance.
const SUFFICIENT: f64 = 1e-9;

/// Part of the work of a load step that must be missing for it to be reported as a jump: a path of equilibria that the
/// trapezoidal rule follows badly, as with all of a load at once, misses up to a third.
const JUMP: f64 = 0.6;

/// Energy that the first load step may release, over what a linear model says of it.
const RELEASED: f64 = 4.0;

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
        simulation.begin_behind_jumps()?;
        Ok(simulation)
    }

    /// As [`new`](Self::new); with `known` representative values, where they are not those of `state`. The multipliers of `state` stay
    /// then.
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
        let mut velocity_correction = 0.0;
        let mut held_values = None;
        let mut released = 0.0;
        if settings.scheme.dynamic {
            (velocity_correction, held_values) =
                begin_motion(&system, &mut state, &representative, &settings, &mut warnings)?;
        } else if known.is_none() {
            released = equilibrium::hold_start(&system, &mut state, settings.solver);
        }
        state.violations = vec![0.0; system.layout().multiplier_count];
        system.violations(&state.kinematics, &mut state.violations);
        let scaled = Scaled::new(&settings.scaling, &representative, settings.step_size);
        let equilibrated = settings.scaling.equilibrates();
        let mut work =
            Workspace::new(&system, &state, &settings.scheme, &representative, settings.solver, equilibrated);
        (work.disabled, work.tuning) = (settings.limits.disabled, settings.limits.tuning);
        work.threads = Threads::new(system.starts_of_batches(), settings.threads);
        work.factorization.set_threads(settings.threads);
        let singular = SingularPositions::new(&system, &state.kinematics, representative.length);
        work.regularization = regularization(&system, &singular);
        work.fall_back = lissom_solver::kind("pivoting").filter(|kind| kind.name != settings.solver.name);
        let projection = settings
            .scheme
            .tableau
            .filter(|tableau| !tableau.is_stiffly_accurate() && layout_has_constraints(&system))
            .map(|tableau| Projection::new(&system, &state, &representative, settings.solver, tableau));
        let remembers = settings.scheme.dynamic && settings.scheme.stages.len() == 1;
        let integrator_history = remembers.then(|| {
            let solver = pivoting_unless(&settings);
            IntegratorHistory::new(&system, &state, &representative, solver, settings.step_size)
        });
        judge::relative_turns(&system, &state.kinematics)
            .map_err(|error| InitialError::Wrapped(Box::new(error)))?;
        let interval = settings.scheme.dynamic.then_some(settings.step_size);
        let energy_balance = EnergyBalance::new(&system, &state.kinematics, &representative, interval);
        let is_chosen = settings.control.is_some();
        let controller = (is_chosen && settings.scheme.dynamic).then(|| Controller::new(settings.step_size));
        let load_control =
            (is_chosen && !settings.scheme.dynamic).then(|| LoadControl::new(settings.step_size));
        let is_bound = is_chosen || settings.scheme.dynamic;
        let breakpoints = if is_bound { breakpoints::of(&system, settings.step_size) } else { Vec::new() };
        let event_detector = event_detector(&system, &state, &settings);
        event_detector.freeze_switches(&system, &mut state.kinematics);
        let is_planned = settings.scheme.dynamic && controller.is_none();
        Ok(Self {
            released,
            impacts: if is_planned { Impacts::new(&system, &state.kinematics) } else { Impacts::default() },
            resolution: Resolution::new(if is_planned { system.layout().coordinate_count() } else { 0 }),
            constraint_rates: ConstraintRates::new(&system, &state.kinematics),
            time_functions: TimeFunctions::default(),
            origin: state.kinematics.clone(),
            previous: state.clone(),
            next: state.clone(),
            system,
            state,
            settings,
            representative,
            scaled,
            work: Box::new(work),
            projection,
            held_values,
            jacobian_state: JacobianState::default(),
            integrator_history,
            step_bisection: StepBisection::whole(),
            breakpoints,
            controller,
            load_control,
            farthest: 0.0,
            totals: Totals { smallest_relative_pivot: f64::INFINITY, ..Totals::default() },
            velocity_correction,
            energy_balance,
            next_energy_balance: energy_balance,
            next_violation: 0.0,
            warnings,
            singular,
            stable_at: None,
            stability: Vec::new(),
            event_detector,
            accumulation: Accumulation::default(),
            is_last_step_known: false,
            may_relax: true,
        })
    }

    /// The tangent at the solution of the last step; none before the first step and after one that failed.
    pub(super) fn last_tangent(&mut self, scaled: Scaled, of: &StageSystem) -> Option<TangentValues> {
        if !self.is_last_step_known {
            return None;
        }
        self.system.begin_step(&self.previous.kinematics, &mut self.work.joint_starts);
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled,
            scaling: (&self.settings.scaling, &self.representative),
            start: &self.previous,
            work: &mut self.work,
            watch: &mut Unwatched,
        };
        let mut values = TangentValues::zeros(of, self.system.structure().pattern.entries());
        equations.assemble_tangent(&mut values.receiver(&scaled, of, &mut []));
        Some(values)
    }

    /// Estimates the condition number of the tangent factored last, in the 1-norm, if it is still in use.
    pub(super) fn factored_condition(&mut self) -> Option<f64> {
        let pattern = &self.system.structure().pattern;
        let value =
            self.jacobian_state.has_tangent.then(|| self.work.factorization.condition_estimate(pattern));
        value.map(|value| value.max(1.0))
    }

    /// Solves the equations of a step of the present size from the state, and leaves what it comes to in `next`.
    pub(crate) fn solve_step(&mut self, watch: &mut dyn Stopwatch) -> Result<Outcome, StepError> {
        let work = &mut *self.work;
        self.scaled.to_unit_step(self.system.layout(), &self.settings.scheme, &self.state, &mut work.unit);
        self.system.begin_step(&self.state.kinematics, &mut work.joint_starts);
        work.extrapolates = self.settings.scheme.dynamic;
        let mut equations = StepEquations {
            system: &self.system,
            scheme: &self.settings.scheme,
            scaled: self.scaled,
            scaling: (&self.settings.scaling, &self.representative),
            start: &self.state,
            work,
            watch,
        };
        equations.restart();
        let is_exact = equations.scheme.tableau.is_some();
        let sufficient = |result: Result<Outcome, Failure>| match result {
            Err(Failure::NotConverged { iterations, correction }) if is_exact && correction <= SUFFICIENT => {
                Ok(Outcome { iterations, factorizations: 0, correction, stagnated: true })
            }
            other => other,
        };
        let result =
            sufficient(newton::solve(&mut equations, &self.settings.limits, &mut self.jacobian_state));
        self.scaled = equations.scaled;
        let outcome = result.map_err(|failure| {
            self.jacobian_state = JacobianState::default();
            if matches!(failure, Failure::NotFinite { .. } | Failure::Factor(FactorError::NotFinite { .. }))
                && let Some(error) = equations.signal_error()
            {
                return StepError::Signal(error);
            }
            if matches!(failure, Failure::NotFinite { .. } | Failure::Factor(FactorError::NotFinite { .. })) {
                let at = equations.work.motions.iter().map(|motion| motion.at.time);
                let found = at.filter_map(|at| {
                    let (what, value) = self.system.function_without_value(at)?;
                    let time = self.state.kinematics.time + self.scaled.step_size();
                    Some(StepError::FunctionNotFinite { time, what: what.to_owned(), value, at })
                });
                if let Some(error) = found.take(1).next() {
                    return error;
                }
            }
            // With a pivoting solver a smaller step may do what this one could not.
            let pivoted = !matches!(failure, Failure::Factor(_));
            let failure = equations.unforgiven(failure);
            let time = self.state.kinematics.time + self.scaled.step_size();
            let mut error =
                describe(&failure, self.system.layout(), time, &self.settings, &equations.worst_unknown());
            if let StepError::ZeroPivot { after_pivoting, .. } = &mut error {
                *after_pivoting = pivoted;
            }
            error
        })?;
        equations.final_violations(&mut self.next.violations);
        self.finish_attempt()?;
        Ok(outcome)
    }

    /// Leaves what the increments and multipliers of an attempt come to in `next`.
    pub(super) fn finish_attempt(&mut self) -> Result<(), StepError> {
        let work = &*self.work;
        let last = self.settings.scheme.stages.len() - 1;
        let Some(end) = work.motions.last() else { unreachable!("every scheme has a stage") };
        copy_motion(&end.at, &mut self.next.kinematics);
        self.next.multipliers.copy_from_slice(&work.multipliers[last]);
        self.next.kinematics.show_multipliers(&self.next.multipliers);
        let memory = &mut self.next.algorithmic;
        self.scaled.memory_from_unit_step(
            &self.settings.scheme.algorithmic,
            &work.unit,
            &work.increments,
            memory,
        );
        compensate(&self.state, &end.changes, &mut self.next);
        if let Some(projection) = &mut self.projection {
            projection
                .apply(&self.system, &mut self.next)
                .map_err(|error| StepError::Velocities { time: self.next.kinematics.time, error })?;
        }
        self.system.signals().check(&self.next.kinematics).map_err(StepError::Signal)?;
        Ok(())
    }

    /// A failed factorisation, with names.
    pub(super) fn describe_factor(&self, error: &FactorError, time: f64) -> StepError {
        describe(&Failure::Factor(*error), self.system.layout(), time, &self.settings, "")
    }

    fn judge(&self) -> Judge<'_> {
        Judge {
            system: &self.system,
            representative: &self.representative,
            is_motion: self.settings.scheme.dynamic,
            checks_energy: self.settings.energy_check,
        }
    }

    /// Judges what the last attempt came to.
    pub(crate) fn judge_step(&mut self) -> Result<(), StepError> {
        (self.next_energy_balance, self.next_violation) =
            self.judge().examine(&self.state, &self.next, &self.energy_balance)?;
        Ok(())
    }

    /// Takes note of reasons to doubt the step that is being accepted.
    fn collect_warnings(&mut self) {
        judge::contact::check(&self.system, &self.next, &mut self.warnings);
        judge::linear_range::check(&self.system, &self.next, &mut self.warnings);
        if let Some(warning) = self.judge().regularized(&self.next, self.next_violation) {
            warn(&mut self.warnings, warning);
        }
        let (before, after) = (&self.energy_balance, &self.next_energy_balance);
        let time = self.next.kinematics.time;
        if self.settings.scheme.dynamic {
            let step = (&self.state.kinematics, &self.next.kinematics);
            if let Some(warning) = judge::drives::jump(&self.system, &self.representative, step) {
                warn(&mut self.warnings, warning);
            }
            let (surplus, turned_over) = (after.surplus, after.turned_over);
            let known =
                self.warnings.iter().position(|warning| matches!(warning, Warning::EnergySurplus { .. }));
            match (known, after.is_noteworthy()) {
                // What looked large at the start may turn out small beside what follows.
                (Some(known), false) => {
                    self.warnings.remove(known);
                }
                (Some(known), true) => {
                    if let Warning::EnergySurplus { surplus: most, turned_over: all, .. } =
                        &mut self.warnings[known]
                    {
                        (*most, *all) = (surplus, turned_over);
                    }
                }
                (None, true) => self.warnings.push(Warning::EnergySurplus { time, surplus, turned_over }),
                (None, false) => {}
            }
            return;
        }
        let missing = after.missing_work(before);
        // A start that is no equilibrium, as one with prestress, releases energy that no load has put in.
        let is_release =
            self.totals.steps == 0 && after.unexplained_work(before).abs() <= RELEASED * self.released;
        // Relaxation leaves the path, and has a warning of its own.
        let is_relaxed = self.warnings.iter().any(
            |warning| matches!(warning, Warning::Relaxed { time, .. } if *time == self.next.kinematics.time),
        );
        if missing > JUMP && !is_release && !is_relaxed {
            let start = self.state.kinematics.time;
            let work = after.loads + after.drives - before.loads - before.drives;
            warn(&mut self.warnings, Warning::Jump { start, time, work: missing * work.abs() });
        }
    }

    /// Makes what the last attempt came to the state.
    pub(crate) fn accept_step(&mut self) {
        self.collect_warnings();
        self.accumulate_step();
        self.energy_balance = self.next_energy_balance;
        let work = &mut *self.work;
        if self.settings.scheme.dynamic {
            work.learn(&self.settings.scheme, &self.state.multipliers);
        }
        std::mem::swap(&mut self.previous, &mut self.state);
        std::mem::swap(&mut self.state, &mut self.next);
        if let Some(memory) = &mut self.integrator_history {
            memory.renew(self.scaled.step_size());
        }
        self.note_singular_positions();
    }

    /// Counts a step that was completed.
    pub(crate) fn count(&mut self, report: &StepReport) {
        let totals = &mut self.totals;
        totals.steps += report.parts;
        totals.stagnated_steps += usize::from(report.stagnated);
        totals.fell_back_at = self.work.fell_back.map(|(unknown, _)| unknown);
        totals.regularized_at = self.work.regularization.as_ref().map(|(_, unknown)| *unknown);
        if let Some(factor) = self.work.report.as_ref() {
            totals.smallest_relative_pivot = totals.smallest_relative_pivot.min(factor.relative_pivot());
        }
        for violation in &self.state.violations {
            totals.max_constraint_violation = totals.max_constraint_violation.max(violation.abs());
        }
    }
}

/// Motions watch events; where steps are chosen, also switches of forces.
fn event_detector(system: &System, state: &State, settings: &Settings) -> EventDetector {
    if settings.scheme.dynamic {
        EventDetector::new(system, state, settings.control.is_some())
    } else {
        EventDetector::of_nothing(state)
    }
}

/// Without the augmented term massless coordinates need pivots.
pub(super) fn pivoting_unless(settings: &Settings) -> &'static SolverKind {
    let pivoting = lissom_solver::kind("pivoting").unwrap_or(settings.solver);
    if settings.scaling.augmented { settings.solver } else { pivoting }
}

/// Fails where equations hold rates, of which statics know nothing.
fn refuse_rates(system: &System) -> Result<(), InitialError> {
    let of_row = system.layout().rate_rows().next().map(|row| system.layout().name_of(row));
    let of_creep = || system.sees_multipliers().then(|| "the creep of a wheel on a rail".to_owned());
    of_row.or_else(of_creep).map_or(Ok(()), |name| Err(InitialError::StateInStatics(name)))
}

fn copy_motion(from: &Kinematics, to: &mut Kinematics) {
    to.elapsed = from.elapsed;
    to.nodes.copy_from_slice(&from.nodes);
    to.coordinates.copy_from_slice(&from.coordinates);
    to.held.copy_from_slice(&from.held);
}

/// Adds each node's displacement to its position, and the step to the time, with the remainders of earlier
/// roundings, so that many small steps do not lose digits [Kahan 1965].
fn compensate(start: &State, changes: &[MotionChange], next: &mut State) {
    let step = std::mem::take(&mut next.kinematics.elapsed) + start.time_remainder;
    let time = start.kinematics.time + step;
    next.time_remainder = step - (time - start.kinematics.time);
    next.kinematics.time = time;
    for (node, change) in changes.iter().enumerate() {
        let from = &start.kinematics.nodes[node].frame;
        let shift = from.rotation.apply(&change.shift) + start.position_remainders[node];
        let position = from.position + shift;
        next.position_remainders[node] = shift - (position - from.position);
        let frame = &mut next.kinematics.nodes[node].frame;
        frame.position = position;
        frame.rotation = frame.rotation.normalized();
    }
}

/// What lets constraints yield that repeat each other from the start, with the first unknown that does.
fn regularization(system: &System, singular: &SingularPositions) -> Option<(Regularization, usize)> {
    let multiplier = singular.first_repeating()?;
    let count = system.layout().coordinate_count();
    Some((Regularization::new(&system.structure().pattern, count), count + multiplier))
}

/// Makes velocities, accelerations and multipliers of a motion's start consistent. Gives the largest change of a velocity, and what finds
/// accelerations where they may jump.
fn begin_motion(
    system: &System,
    state: &mut State,
    representative: &Representative,
    settings: &Settings,
    warnings: &mut Vec<Warning>,
) -> Result<(f64, Option<ConsistentInitialConditions>), InitialError> {
    let mut initial =
        ConsistentInitialConditions::new(system, state, representative, pivoting_unless(settings));
    let given = state.kinematics.clone();
    let velocity_correction = initial.given_velocities(system, state)?;
    let rates = initial.constraint_rates(system, state);
    // Beside given velocities of which nothing remains, what remains is round-off of theirs.
    let [specified, used] = [&given, &state.kinematics].map(|at| representative.largest_speed(system, at));
    let negligible = judge::start::negligible(representative, settings.step_size);
    judge::start::rates(system, representative, (&rates, specified.max(used), negligible))?;
    warnings.extend(judge::start::velocities(system, representative, &given, &state.kinematics, negligible)?);
    settle(system, state, &mut initial, settings)?;
    let held_values = may_jump(system, state).then_some(initial);
    Ok((velocity_correction, held_values))
}

/// Whether accelerations may jump: with values that are held, and where functions of time do.
fn may_jump(system: &System, state: &State) -> bool {
    let changes = system.functions.iter().any(|(_, function)| !function.is_constant());
    changes || !state.kinematics.held.is_empty() || !system.breakpoints().is_empty()
}

fn layout_has_constraints(system: &System) -> bool {
    !system.layout().multiplier_rows().is_empty()
}
