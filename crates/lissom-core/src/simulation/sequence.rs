//! The sequence of a step: its latest end, attempts until one is accepted, and the actions at its end.

use crate::control::Review;
use crate::energy_balance::EnergyBalance;
use crate::errors::step_error::MORE_TOLERANT;
use crate::errors::{InitialError, StepError};
use crate::errors::{Warning, warn};
use crate::instants;
use crate::settings::{Phase, Problem, StepReport, Stopwatch, Unwatched};
use crate::simulation::breakpoints::StopTime;
use crate::simulation::event_detector::LocatedRoot;
use crate::simulation::events::Verdict;
use crate::simulation::signal_history::Break;
use crate::simulation::{EventState, Simulation, cause};
use crate::spin::MAX_TURN;
use crate::system::State;
use crate::tuning::{MAX_ITERATIONS, TuningParameter};

/// A step in progress.
struct Progress<'p> {
    watch: &'p mut dyn Stopwatch,
    report: &'p mut StepReport,
    /// Size of the first attempt [s].
    first: Option<f64>,
    /// Why attempts failed.
    failure: Option<StepError>,
    /// The start of the step, if a part of it was accepted.
    start: Option<Box<(State, State, EnergyBalance, EventState)>>,
}

/// Target of the next attempts.
struct Stop {
    /// Distance from the present time [s].
    distance: f64,
    /// Time to which the clock is set there [s]; none if it is not set.
    clock: Option<f64>,
    /// The breakpoint that is crossed there.
    crossing: Option<StopTime>,
    /// Whether the step ends there.
    is_last: bool,
}

impl Simulation {
    /// Changes the size of the planned steps [s]. Has no effect on the size of controlled steps.
    pub fn set_step_size(&mut self, step_size: f64) {
        self.settings.step_size = step_size;
        self.control.set_planned(step_size);
    }

    /// Takes one step. On failure the state remains unchanged.
    ///
    /// # Errors
    /// If Newton's iterations do not converge or the tangent cannot be factorised.
    pub fn step(&mut self) -> Result<StepReport, StepError> {
        self.step_watched(f64::INFINITY, &mut Unwatched)
    }

    /// Takes one step like [`step`](Self::step); with step-size control not beyond the time `limit` [s]. It ends exactly at `limit` if
    /// it reaches it, as does a planned step that ends there up to round-off. Calls `watch` at the beginning of each phase of the work.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched(&mut self, limit: f64, watch: &mut dyn Stopwatch) -> Result<StepReport, StepError> {
        watch.begin(Phase::Rest);
        self.integrator.has_last_step = false;
        let before = self.integrator.work.newton.effort;
        let mut report = StepReport::default();
        let mut progress = Progress { watch, report: &mut report, first: None, failure: None, start: None };
        let result = self.advance(limit, &mut progress);
        let result = result.or_else(|error| self.recover(error, progress));
        if let Some(step) = self.control.planned() {
            let unseen = self.stops.passed_unseen(&self.system, self.state.kinematics.time, step);
            if let Some(unseen) = unseen {
                warn(&mut self.report.warnings, unseen);
            }
        }
        let effort = self.integrator.work.newton.effort;
        report.iterations = effort.iterations - before.iterations;
        report.factorizations = effort.factorizations - before.factorizations;
        self.report.totals.newton_iterations += report.iterations;
        self.report.totals.factorizations += report.factorizations;
        self.report.totals.rejected_steps += report.rejected;
        result?;
        self.count(&report);
        Ok(report)
    }

    /// The state at `time` [s] within the last step, to the order of the scheme; `out` must be a state of this system.
    pub fn interpolate(&self, time: f64, out: &mut State) {
        let step = self.integrator.dense(self.problem(), (&self.previous, &self.state));
        step.known(self.integrator.has_last_step).interpolate(time, out);
    }

    /// The sequence of a step: a planned one is solved to its end, through all stops within it; an adaptive one ends with the first
    /// accepted attempt.
    fn advance(&mut self, limit: f64, progress: &mut Progress<'_>) -> Result<(), StepError> {
        let (planned, longest) = (self.control.planned(), self.control.longest());
        let now = self.now();
        self.check_units()?;
        self.trim_signals();
        let size = self.control.by_error().unwrap_or(longest).min(limit - now);
        self.stops.look_ahead(
            Problem { system: &self.system, settings: &self.settings },
            now,
            [size, longest],
        );
        let end = planned.map_or(limit, |size| self.now() + size);
        let same = instants::tolerance(self.now(), longest);
        let end = if (limit - end).abs() <= same { limit } else { end };
        // The size of the first part is exact.
        let mut rest = planned.unwrap_or(limit - self.now());
        loop {
            self.execute_unit_events()?;
            let mut stop = self.next_stop(rest, planned.is_none().then_some(limit));
            let touch = self.integrator.first_touch(&self.system, &self.state, stop.distance);
            if let Some(distance) = touch {
                stop = Stop { distance, clock: None, crossing: None, is_last: false };
            }
            let has_arrived = self.advance_to(&stop, progress)?;
            if let Some(crossing) = stop.crossing.filter(|_| has_arrived) {
                self.cross_breakpoint(&crossing, longest)?;
            }
            self.move_windows()?;
            self.take_samples()?;
            rest = end - self.now();
            let is_complete = has_arrived && stop.is_last || rest <= same;
            if planned.is_none() || is_complete || self.events.known.stopped_by.is_some() {
                break;
            }
        }
        // The integrator contains the last part only.
        self.integrator.has_last_step &= progress.report.parts == 1;
        // Sums of step sizes would drift away from the planned instants.
        if planned.is_some() && self.is_at(limit, longest) {
            (self.state.kinematics.time, self.state.time_remainder) = (limit, 0.0);
        }
        Ok(())
    }

    /// The next stop: a sample, the end of a window of a delayed signal, a breakpoint, or the end of the step, which is at the
    /// distance `rest` [s]. `limit` [s] is the end of an adaptive step.
    fn next_stop(&self, rest: f64, limit: Option<f64>) -> Stop {
        let (now, longest) = (self.now(), self.control.longest());
        let mut stop = Stop { distance: rest, clock: limit, crossing: None, is_last: true };
        let windows = Some(self.end_of_windows()).filter(|end| end.is_finite());
        let known = windows.into_iter().chain(self.next_unit_event());
        let nearest = self.next_sample().into_iter().chain(known).reduce(f64::min);
        let nearest = nearest.filter(|instant| instant - now < rest - instants::tolerance(now, longest));
        if let Some(instant) = nearest {
            (stop.distance, stop.clock, stop.is_last) = (instant - now, limit.and(Some(instant)), false);
        }
        let end = stop.clock.unwrap_or(now + stop.distance);
        if let Some(crossing) = self.stops.stop_time(self.problem(), [now, end], longest) {
            stop.is_last &= crossing.clock >= end;
            (stop.distance, stop.clock, stop.crossing) = (crossing.end - now, None, Some(crossing));
        }
        stop
    }

    /// Accepts attempts, one or as many as a planned step needs, up to a stop or to an event before it. Returns whether the stop has
    /// been reached.
    fn advance_to(&mut self, stop: &Stop, progress: &mut Progress<'_>) -> Result<bool, StepError> {
        let (now, planned) = (self.now(), self.control.planned());
        if let Some(clock) = stop.clock {
            let scale = self.control.by_error().unwrap_or_else(|| self.control.longest());
            if clock > now && self.is_at(clock, scale) {
                (self.state.kinematics.time, self.state.time_remainder) = (clock, 0.0);
                return Ok(true);
            }
        }
        let bound = self.longest_resolved(now, stop.distance);
        self.control.aim(stop.distance, bound);
        loop {
            let located = self.take_attempt(progress)?;
            let has_arrived = self.control.accept(&self.attempt, &self.settings.limits.tuning);
            if let Some(clock) = stop.clock.filter(|_| has_arrived) {
                let end = &mut self.attempt.end;
                (end.kinematics.time, end.time_remainder) = (clock, 0.0);
            }
            let is_whole = has_arrived && stop.is_last && stop.crossing.is_none() && self.events.is_empty();
            if planned.is_some() && !is_whole && progress.start.is_none() {
                let known = self.events.known.clone();
                let start = (self.previous.clone(), self.state.clone(), self.report.energy_balance, known);
                progress.start = Some(Box::new(start));
            }
            self.accept_attempt();
            let (report, outcome) = (&mut *progress.report, &self.attempt.outcome);
            report.parts += 1;
            report.correction = outcome.correction;
            report.stagnated |= outcome.stagnated;
            report.error = self.control.error();
            self.integrator.has_last_step = true;
            self.report_unresolved_laws();
            let is_event = located.is_some();
            self.complete_units()?;
            self.after_events(located.as_ref(), self.control.longest())?;
            if self.events.known.has_switched {
                self.integrator.work.forget_predictions();
            }
            if has_arrived || is_event || planned.is_none() {
                return Ok(has_arrived);
            }
        }
    }

    /// Makes attempts until one can be accepted, and stores it in `attempt`. Returns the root at which it ends, if any.
    fn take_attempt(&mut self, progress: &mut Progress<'_>) -> Result<Option<LocatedRoot>, StepError> {
        loop {
            let size = self.control.propose();
            progress.first.get_or_insert(size);
            let error = match self.try_size(size, progress) {
                Ok(Verdict::Accept(located)) => return Ok(located),
                Ok(Verdict::Repeat) => continue,
                Ok(Verdict::Shorten) => None,
                Err(error) => Some(error),
            };
            if let Some(fault) = error.is_some().then(|| self.unit_fault(false)).flatten() {
                return Err(fault);
            }
            if progress.watch.is_cancelled() {
                return Err(StepError::Interrupted { time: self.state.kinematics.time });
            }
            let has_solution = error.is_none();
            let may_help = error.as_ref().is_none_or(StepError::may_need_a_smaller_step)
                && progress.report.rejected < MAX_ITERATIONS;
            progress.failure = match error {
                Some(later) if self.control.prefers_first_failure() => {
                    Some(cause::more_specific(progress.failure.take(), later))
                }
                other => other,
            };
            if !(may_help && self.control.shorten(size, has_solution)) {
                let error = progress.failure.take().unwrap_or_else(|| self.too_inaccurate(size));
                let error = self.unit_fault(true).unwrap_or(error);
                return Err(self.with_cause(error, self.control.has_tried_shortest()));
            }
            progress.report.rejected += 1;
        }
    }

    /// Makes an attempt of `size` [s], and checks it by control, events and switches.
    fn try_size(&mut self, size: f64, progress: &mut Progress<'_>) -> Result<Verdict, StepError> {
        self.attempt(size, progress.watch)?;
        let review = Review {
            problem: Problem { system: &self.system, settings: &self.settings },
            integrator: &mut self.integrator,
            attempt: &self.attempt,
            origin: &self.origin.kinematics,
            start: self.attempt.start(&self.state),
            energy_balance: &self.report.energy_balance,
            has_switched: self.events.known.has_switched,
        };
        if !self.control.review(review) {
            return Ok(Verdict::Shorten);
        }
        let verdict = self.end_at_event(size, progress.watch, progress.report)?;
        if matches!(verdict, Verdict::Accept(_)) && self.settings.scheme.dynamic {
            self.check_divergence()?;
        }
        if let Verdict::Accept(_) = verdict
            && self.control.by_error().is_some()
        {
            let step = (self.attempt.start(&self.state), &self.attempt.end);
            let part = crate::simulation::stops::allowed_departure(&self.settings);
            let longest =
                self.stops.laws.longest_resolved(&self.system, step, part, self.events.known.has_switched);
            if longest < 1.0 {
                self.control.limit(longest * self.attempt.size);
                return Ok(Verdict::Shorten);
            }
        }
        Ok(verdict)
    }

    /// Returns to the start of a step that failed; a first load step may be solved by relaxation.
    fn recover(&mut self, error: StepError, progress: Progress<'_>) -> Result<(), StepError> {
        if let Some(start) = progress.start {
            (self.previous, self.state, self.report.energy_balance, self.events.known) = *start;
            self.forget_signals();
        }
        self.control.restart();
        let Some(size) = progress.first.filter(|_| !progress.watch.is_cancelled()) else { return Err(error) };
        self.relax_first_step(size, &error)?;
        progress.report.rejected += 1;
        progress.report.parts = 1;
        self.accept_attempt();
        // The integrator has no data of a step to this state.
        self.integrator.has_last_step = false;
        Ok(())
    }

    /// The longest adaptive step over which functions of time are determined by its ends, and in which no node rotates too far to be
    /// resolved, with a margin [s]. The stop is at a `distance` [s].
    fn longest_resolved(&mut self, now: f64, distance: f64) -> f64 {
        let Some(size) = self.control.by_error() else { return f64::INFINITY };
        let problem = Problem { system: &self.system, settings: &self.settings };
        let resolved = self.stops.longest_resolved(problem, (now, size.min(distance)));
        let resolved = self.longest_resolved_delays(now, resolved);
        let spins = &self.integrator.work.unit.spins;
        let turning = |node| spins.turning(node, &self.state.kinematics.nodes[node].twist);
        let fastest = self.system.layout().nodes().map(turning).fold(0.0_f64, f64::max).sqrt();
        let turn = self.settings.limits.tuning.of(TuningParameter::Safety) * MAX_TURN;
        if fastest > 0.0 { resolved.min(turn / fastest) } else { resolved }
    }

    /// Warns after a part of a planned step that does not resolve a law of the motion.
    fn report_unresolved_laws(&mut self) {
        let Some(step) = self.control.planned().filter(|_| self.settings.scheme.dynamic) else { return };
        if self.report.warnings.iter().any(|warning| matches!(warning, Warning::FunctionUnseen { .. })) {
            return;
        }
        let (from, to) = (&self.previous, &self.state);
        if let Some(index) = self.stops.laws.unresolved(&self.system, (from, to)) {
            let function = self.system.name_of_law(index, &to.kinematics);
            warn(
                &mut self.report.warnings,
                Warning::FunctionUnseen { time: from.kinematics.time, function, step },
            );
        }
    }

    /// Sets the initial accelerations to those after jumps of functions at the start.
    ///
    /// # Errors
    /// If there are no consistent accelerations there.
    pub(crate) fn begin_behind_jumps(&mut self) -> Result<(), InitialError> {
        let (now, longest) = (self.state.kinematics.time, self.control.longest());
        let behind = now + instants::TIME_TOLERANCE * longest;
        let problem = Problem { system: &self.system, settings: &self.settings };
        let jumps = self.settings.scheme.dynamic && self.stops.jumps(problem, [now, behind]);
        if jumps { self.jump_between(now, behind) } else { Ok(()) }
    }

    /// Sets the clock after a step that ended at a breakpoint, and recomputes accelerations across a jump.
    ///
    /// # Errors
    /// If there are no consistent accelerations before or after the jump.
    fn cross_breakpoint(&mut self, stop_time: &StopTime, longest: f64) -> Result<(), StepError> {
        if let Some(jump) = stop_time.jump {
            let aside = instants::TIME_TOLERANCE * longest;
            self.jump_between(jump - aside, jump + aside)
                .map_err(|error| StepError::Velocities { time: stop_time.clock, error })?;
            // The end of the step no longer determines the start of the next one.
            self.integrator.has_last_step &= self.integrator.history.is_none();
        }
        (self.state.kinematics.time, self.state.time_remainder) = (stop_time.clock, 0.0);
        self.stops.history.add_break(Break::Slope);
        self.integrator.work.forget_predictions();
        Ok(())
    }

    fn too_inaccurate(&self, size: f64) -> StepError {
        let time = self.state.kinematics.time;
        if let Some(row) = self.integrator.work.tangent.redundant() {
            return StepError::ConstraintsDependent {
                time,
                size,
                unknown: self.system.layout().subject_of(row),
            };
        }
        let unknown = self.integrator.most_inaccurate(&self.system, &self.state.kinematics);
        StepError::TooInaccurate { time, size, unknown, hint: self.hint(MORE_TOLERANT) }
    }
}
