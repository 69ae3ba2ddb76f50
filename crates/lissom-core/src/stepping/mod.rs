//! The one place that decides about steps: how long the next one is, whether an attempt is accepted, what is tried
//! after one that is not.
//!
//! A step of planned size that has no solution is taken in parts. With step-size control every step is as long as its
//! estimated error allows. What the scheme and Newton's method remember goes over to the new size.

mod arc;
pub(crate) mod breakpoints;
mod controller;
pub(crate) mod dense;
mod error_estimate;
mod event_detector;
mod events;
mod impacts;
mod integrator_history;
mod load_steps;
mod resolution;
mod samples;
mod snapshot;
mod step_bisection;
mod time_functions;

pub(crate) use arc::ArcControl;
pub(crate) use controller::Controller;
pub use controller::StepControl;
pub(crate) use event_detector::{EventDetector, EventState};
pub(crate) use impacts::Impacts;
pub(crate) use integrator_history::IntegratorHistory;
pub(crate) use load_steps::LoadControl;
pub(crate) use resolution::Resolution;
pub use snapshot::{Snapshot, SnapshotError};
pub(crate) use step_bisection::StepBisection;
pub(crate) use time_functions::TimeFunctions;

use crate::analysis::{Phase, Simulation, StepError, StepReport, Stopwatch, Unwatched, cause};
use crate::instants::SAME;
use crate::judge::{EnergyBalance, MAX_TURN};
use crate::kinematics::Quantity;
use crate::newton::{JacobianState, Outcome};
use crate::scaling::{ScaleBy, UnitStepState};
use crate::schemes::Stage;
use crate::solver_features::SolverFeature;
use crate::system::State;
use crate::tuning::TuningParameter;
use breakpoints::Breakpoint;
use error_estimate::{MIN_ERROR, MIN_REFERENCE, Order, driven, excursion, inertial_part};
use events::Checked;
use load_steps::Attempts;

/// Attempts at a step that are given up before the step is.
const MAX_REJECTED: usize = 60;
/// Where parts of a planned step as short as this have no solution either, a smaller step hardly helps [-].
const SHORT_PART: f64 = 1e-3;
/// Steps shorter than this part of the largest one are not tried [-].
const SHORTEST: f64 = 1e-12;

impl Simulation {
    /// Changes the size of the planned steps [s]. Has no effect on the size of controlled steps.
    pub fn set_step_size(&mut self, step_size: f64) {
        if step_size != self.settings.step_size {
            self.settings.step_size = step_size;
            self.step_bisection = StepBisection::whole();
        }
    }

    /// Takes one step. On failure the state stays where it was.
    ///
    /// # Errors
    /// If Newton's iterations do not converge or the tangent has no factorisation.
    pub fn step(&mut self) -> Result<StepReport, StepError> {
        self.step_watched(f64::INFINITY, &mut Unwatched)
    }

    /// Takes one step as [`step`](Self::step) does, with step-size control not beyond the time `limit` [s], which is met
    /// exactly where it is reached; a planned step that ends there up to round-off ends there exactly. Calls `watch` where a part of the work begins.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched(&mut self, limit: f64, watch: &mut dyn Stopwatch) -> Result<StepReport, StepError> {
        watch.begin(Phase::Rest);
        self.is_last_step_known = false;
        let before = self.work.effort;
        let mut report = StepReport::default();
        let result = match self.controller {
            None if self.load_control.is_some() => self.chosen_load_step(limit, watch, &mut report),
            Some(controller) => {
                let limit = self.next_sample().map_or(limit, |sample| sample.min(limit));
                self.controlled_step(controller, limit, watch, &mut report).and_then(|()| self.take_samples())
            }
            None => self.sampled_step(limit, watch, &mut report),
        };
        let effort = self.work.effort;
        report.iterations = effort.iterations - before.iterations;
        report.factorizations = effort.factorizations - before.factorizations;
        self.totals.newton_iterations += report.iterations;
        self.totals.factorizations += report.factorizations;
        self.totals.rejected_steps += report.rejected;
        result?;
        self.count(&report);
        Ok(report)
    }

    /// The state at `time` [s] within the last step, to the order of the scheme; `out` must be a state of this system.
    pub fn interpolate(&self, time: f64, out: &mut State) {
        dense::interpolate(&self.previous, &self.state, time, out);
    }

    /// Takes a step of planned size: as a whole, or in parts where that has no solution. What a step of a scheme
    /// promises holds for its parts, and so for the whole. Ends before its end where an event happens.
    fn planned_step(
        &mut self,
        whole: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let mut start: Option<(State, EnergyBalance)> = None;
        let mut first_error = None;
        self.step_bisection.restart();
        loop {
            let share = self.step_bisection.fraction();
            let size = share * whole;
            let attempt = self.attempt(size, watch);
            match attempt.and_then(|outcome| self.end_at_event((size, outcome), watch, report)) {
                Ok(Checked::SwitchedAtStart) => {}
                Ok(Checked::Accepted(outcome, located)) => {
                    if share < 1.0 && start.is_none() {
                        start = Some((self.state.clone(), self.energy_balance));
                    }
                    self.note_resolution(located.as_ref().map_or(share, |located| located.size / whole));
                    self.accept_step();
                    self.note_impacts();
                    note(report, &outcome);
                    report.parts += 1;
                    self.is_last_step_known = true;
                    self.note_stability();
                    self.is_last_step_known = share == 1.0;
                    self.after_events(located.as_ref(), whole)?;
                    if located.is_some_and(|located| located.size < size) {
                        self.step_bisection.restart();
                        return Ok(());
                    }
                    if self.step_bisection.accept(&self.settings.limits.tuning) {
                        return Ok(());
                    }
                }
                Err(error) => {
                    let may_help = error.may_need_a_smaller_step()
                        && report.rejected < MAX_REJECTED
                        && self.settings.limits.disabled.allows(SolverFeature::StepBisection);
                    let cause = cause::more_specific(first_error.take(), error);
                    first_error = Some(cause.clone());
                    if watch.is_cancelled() || !(may_help && self.step_bisection.halve()) {
                        let error = if watch.is_cancelled() {
                            StepError::Interrupted { time: self.state.kinematics.time }
                        } else {
                            self.with_cause(cause, share <= SHORT_PART)
                        };
                        if let Some(start) = start {
                            (self.state, self.energy_balance) = start;
                        }
                        self.step_bisection = StepBisection::whole();
                        if watch.is_cancelled() {
                            return Err(error);
                        }
                        self.relax_first_step(whole, &error)?;
                        report.rejected += 1;
                        report.parts = 1;
                        // The workspace holds no step that led there.
                        self.accept_step();
                        self.is_last_step_known = false;
                        self.note_stability();
                        return Ok(());
                    }
                    report.rejected += 1;
                }
            }
        }
    }

    /// Takes a load step that is as long as contraction and unexplained work allow.
    fn chosen_load_step(
        &mut self,
        limit: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let (Some(control), Some(mut choice)) = (self.settings.control, self.load_control) else {
            unreachable!("load steps of chosen size have their settings")
        };
        let now = self.state.kinematics.time + self.state.time_remainder;
        // A step across a kink of a load would not see what the load does between.
        let near = SAME * control.max_step;
        let ahead = |breakpoint: &&Breakpoint| breakpoint.time > now + near && breakpoint.time < limit - near;
        let limit =
            self.breakpoints.iter().find(ahead).map_or(limit, |breakpoint| breakpoint.time.next_down());
        let rest = limit - now;
        let mut attempts = Attempts::default();
        let (mut first_error, mut is_relaxed) = (None, false);
        let planned = choice;
        loop {
            let size = choice.propose(rest, control.max_step);
            let error = match self.attempt(size, watch) {
                Ok(outcome) => {
                    let missing = self.next_energy_balance.missing_work(&self.energy_balance);
                    if !choice.refuses(size, missing, control.relative_tolerance, &mut attempts) {
                        let missed = (missing, control.relative_tolerance);
                        choice.accept(size, outcome.iterations, missed, &self.settings.limits.tuning);
                        note(report, &outcome);
                        break;
                    }
                    None
                }
                Err(error) => Some(error),
            };
            report.rejected += 1;
            if watch.is_cancelled() {
                return Err(StepError::Interrupted { time: self.state.kinematics.time });
            }
            let Some(error) = error else { continue };
            attempts = Attempts::default();
            let may_help = error.may_need_a_smaller_step() && report.rejected < MAX_REJECTED;
            // The first failure is more specific than those of shorter steps.
            let first = first_error.get_or_insert(error);
            if !(may_help && choice.halve(size)) {
                let size = planned.propose(rest, control.max_step);
                self.relax_first_step(size, first)?;
                (choice, is_relaxed) = (planned, true);
                break;
            }
        }
        report.parts = 1;
        let is_last = self.scaled.step_size() == rest;
        self.load_control = Some(choice);
        self.accept_step();
        if is_last {
            (self.state.kinematics.time, self.state.time_remainder) = (limit, 0.0);
        }
        self.is_last_step_known = !is_relaxed;
        self.note_stability();
        Ok(())
    }

    /// Takes a step whose size follows from the estimated error.
    fn controlled_step(
        &mut self,
        mut controller: Controller,
        limit: f64,
        watch: &mut dyn Stopwatch,
        report: &mut StepReport,
    ) -> Result<(), StepError> {
        let Some(control) = self.settings.control else { unreachable!("a controller has its settings") };
        // A step across a kink of a load would see it late, and estimate its error from the wrong side of it. It ends as
        // close before it as numbers allow, so that its last stage does not see a jump either.
        let now = self.state.kinematics.time + self.state.time_remainder;
        if limit > now && self.is_at(limit, control.max_step.min(controller.size())) {
            (self.state.kinematics.time, self.state.time_remainder) = (limit, 0.0);
            return Ok(());
        }
        self.look_at_time_functions(now);
        // Where it must end anyway at a breakpoint, or has begun at one, nothing is to be gained by another tiny step.
        let stop_time = self.stop_time(now, limit, control.max_step);
        let limit = stop_time.map_or(limit, |stop_time| stop_time.end);
        let rest = limit - now;
        let resolved = self.resolved_by_its_ends(now, controller.size().min(control.max_step).min(rest));
        let located = loop {
            let size = controller.propose(rest).min(control.max_step).min(self.turning_limit());
            let size = size.min(resolved);
            // What would be left is round-off, over which velocities cannot be determined.
            let size = if (rest - size).abs() <= SAME * size { rest } else { size };
            let error = match self.attempt(size, watch) {
                Ok(outcome) => {
                    watch.begin(Phase::Rest);
                    let error = self.estimated_error(control);
                    if error <= 1.0 {
                        match self.end_at_event((size, outcome), watch, report) {
                            Ok(Checked::SwitchedAtStart) => continue,
                            Ok(Checked::Accepted(outcome, located)) => {
                                note(report, &outcome);
                                report.parts = 1;
                                report.error = Some(error);
                                break located;
                            }
                            Err(error) => {
                                controller.fail(size);
                                Some(error)
                            }
                        }
                    } else {
                        controller.reject(size, error, &self.settings.limits.tuning);
                        None
                    }
                }
                Err(error) => {
                    controller.fail(size);
                    Some(error)
                }
            };
            report.rejected += 1;
            if watch.is_cancelled() {
                self.controller = Some(controller);
                return Err(StepError::Interrupted { time: self.state.kinematics.time });
            }
            let is_hopeless = error.as_ref().is_some_and(|error| !error.may_need_a_smaller_step());
            if is_hopeless
                || report.rejected > MAX_REJECTED
                || controller.size() < SHORTEST * control.max_step
            {
                self.controller = Some(controller);
                let time = self.state.kinematics.time;
                let error = error.unwrap_or_else(|| StepError::TooInaccurate {
                    time,
                    size,
                    unknown: self.most_inaccurate(),
                });
                return Err(self.with_cause(error, true));
            }
        };
        let taken = self.scaled.step_size();
        let error = report.error.unwrap_or(1.0);
        controller.accept(taken, error, control.max_step, &self.settings.limits.tuning);
        self.accept_step();
        if self.scaled.step_size() == rest {
            (self.state.kinematics.time, self.state.time_remainder) = (limit, 0.0);
        }
        self.farthest = self.farthest.max(self.excursion_of(&self.state));
        self.controller = Some(controller);
        self.is_last_step_known = true;
        if let Some(stop_time) = stop_time.filter(|_| self.scaled.step_size() == rest) {
            self.cross_breakpoint(&stop_time, control.max_step)?;
        }
        self.after_events(located.as_ref(), control.max_step)?;
        if self.event_detector.known.has_switched {
            self.work.forget_predictions();
        }
        Ok(())
    }

    /// Solves a step of `size` [s] from the state.
    fn attempt(&mut self, size: f64, watch: &mut dyn Stopwatch) -> Result<Outcome, StepError> {
        if size != self.scaled.step_size() {
            self.resize(size)?;
        }
        let outcome = self.solve_step(watch)?;
        watch.begin(Phase::Rest);
        self.judge_step()?;
        Ok(outcome)
    }

    /// Goes over to steps of another size with all that is remembered.
    pub(crate) fn resize(&mut self, size: f64) -> Result<(), StepError> {
        let Self { system, settings, work, .. } = self;
        if let Some(memory) = &mut self.integrator_history {
            let time = self.state.kinematics.time;
            let states = (&self.previous, &mut self.state, &mut self.next);
            memory
                .change(system, settings.scheme.memory_delay, states, size)
                .map_err(|error| StepError::Velocities { time, error })?;
        }
        work.rescale_predictions(size / self.scaled.step_size());
        self.scaled = self.scaled.resized(&settings.scaling, size);
        // Scaled tangents of motions hardly depend on the step size, those of load steps and unscaled ones do.
        if !settings.scheme.dynamic || settings.scaling.by == ScaleBy::None {
            self.jacobian_state = JacobianState::default();
        }
        work.note_scales(system.layout(), &self.scaled);
        Ok(())
    }

    /// The largest step in which no node turns too far to be believed, with a margin [s].
    fn turning_limit(&self) -> f64 {
        let nodes = &self.state.kinematics.nodes;
        let fastest = nodes.iter().fold(0.0_f64, |most, node| most.max(node.twist.fixed_rows::<3>(3).norm()));
        let most = self.settings.limits.tuning.of(TuningParameter::Safety) * MAX_TURN;
        if fastest > 0.0 { most / fastest } else { f64::INFINITY }
    }

    fn excursion_of(&self, state: &State) -> f64 {
        excursion(&self.system, (&self.origin, &state.kinematics), self.representative.length)
    }

    /// Leaves the estimated error of the last attempt in the workspace, as it is and filtered.
    fn estimate_error(&mut self, order: Order) {
        self.miss_of_attempt(order);
        let work = &mut *self.work;
        let (motion, constraints) = work.filtered.split_at_mut(work.error.len());
        if self.event_detector.known.has_switched {
            // The filter would hide a motion that the switch has just woken: an impact on a stiff stop.
            motion.copy_from_slice(&work.error);
            self.system.layout().rate_rows().for_each(|row| motion[row] = 0.0);
        } else {
            inertial_part(&self.system, &self.next.kinematics, &work.error, motion);
            constraints.fill(0.0);
            if let Some(equilibration) = &work.equilibration {
                equilibration.scale(&mut work.filtered);
            }
            work.factorization.solve_inertial(&self.settings.scheme.coupling, &mut work.filtered);
            if let Some(equilibration) = &work.equilibration {
                equilibration.scale(&mut work.filtered);
            }
        }
    }

    /// The miss from which the error of the last attempt is estimated, by row: that of the position or of the velocity,
    /// whichever is larger, times the scheme's constant, or what it exceeds the miss of the step before.
    fn miss_of_attempt(&mut self, order: Order) {
        let scheme = &self.settings.scheme;
        let work = &mut *self.work;
        let Some((stage, predicted)) = scheme.stages.iter().zip(&mut work.predicted).last() else {
            unreachable!("every scheme has a stage")
        };
        work.unit.predict(&stage.prediction, predicted);
        let unit = &work.unit;
        let (Some(found), Some(predicted)) = (work.increments.last(), work.predicted.last()) else { return };
        let before = self.state.kinematics.time - self.previous.kinematics.time;
        let weight = 4.0 / (1.0 + 3.0 * before / self.scaled.step_size());
        // Behind a switch the motion is not smooth, and constants that assume so do not apply.
        let constant = if self.event_detector.known.has_switched { 1.0 } else { scheme.error_constant };
        let mut error = std::mem::take(&mut work.error);
        let quantities = self.system.layout().quantities();
        for ((row, error), last) in error.iter_mut().enumerate().zip(work.last_miss()) {
            let judge = |miss: f64| match order {
                Order::Third => constant * miss,
                Order::Fourth => weight * (miss - last),
            };
            *error = judge(found[row] - predicted[row]);
            // A state has no acceleration from which its rate could be predicted.
            if quantities[row] != Quantity::State {
                let velocity = judge(velocity_miss(stage, unit, &work.increments, row));
                if velocity.abs() > error.abs() {
                    *error = velocity;
                }
            }
        }
        work.error = error;
    }

    /// Estimated error of the last attempt over what is allowed, as the size of the step would have it: to the power of
    /// three over the order of the estimate.
    fn estimated_error(&mut self, control: StepControl) -> f64 {
        let StepControl { relative_tolerance: tolerance, max_step } = control;
        let mut reference = self.farthest.max(self.excursion_of(&self.next)).max(MIN_REFERENCE);
        if reference < 1.0 {
            let ahead = (self.origin.time, self.next.kinematics.time + max_step);
            reference = reference.max(driven(&self.system, ahead, self.representative.length));
        }
        let scheme_order = f64::from(self.settings.scheme.controlled_order);
        let is_third_order = scheme_order > 2.0;
        let order = if is_third_order && self.work.is_miss_known() { Order::Fourth } else { Order::Third };
        self.estimate_error(order);
        let work = &*self.work;
        let largest = work.filtered.iter().zip(&work.sizes).fold(0.0_f64, |most, (error, size)| {
            if (error * size).abs() <= most { most } else { (error * size).abs() }
        });
        let tuning = &self.settings.limits.tuning;
        let share = tuning.of(TuningParameter::ShareOfStep);
        let (allowed, power) = match order {
            Order::Third if is_third_order => (tuning.of(TuningParameter::ShareOfFirst) * tolerance, 1.0),
            Order::Third => (share * tolerance.powf(3.0 / 2.0), 1.0),
            Order::Fourth => (share * tolerance.powf(4.0 / scheme_order), 3.0 / 4.0),
        };
        let places = largest / (reference * allowed).max(MIN_ERROR);
        let states = self.error_of_states() / allowed;
        let error = if states <= places || places.is_nan() { places } else { states };
        error.powf(power)
    }

    /// Name of the unknown with the largest estimated error of the last attempt.
    fn most_inaccurate(&self) -> String {
        let errors =
            self.work.filtered.iter().zip(&self.work.sizes).map(|(error, size)| (error * size).abs());
        let most = errors.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        self.system.layout().name_of(most.map_or(0, |(row, _)| row))
    }

    /// The same of first-order states, each relative to its magnitude, unfiltered.
    fn error_of_states(&self) -> f64 {
        let of = |(row, coordinate, magnitude): (usize, usize, f64)| {
            let value = self.state.kinematics.coordinates[coordinate].value;
            (self.work.error[row] / magnitude.max(value.abs())).abs()
        };
        let errors = self.system.layout().states().map(of);
        // A NaN counts as the largest.
        errors.fold(0.0_f64, |most, error| if error <= most || most.is_nan() { most } else { error })
    }
}

/// What the velocity at the end of a step misses, as a length of the position's miss: equal to it where the acceleration
/// changes linearly.
///
/// ```text
/// v_end - v_start - a_start = a'/2,   z_end - a_start/2 = a'/6      (step of unit length)
/// ```
///
/// In two-stage Radau IIA the force of the last stage has no weight in the position at the end, (A²)₂₂ = 0: a force that
/// begins late in a step changes the velocity alone.
fn velocity_miss(stage: &Stage, unit: &UnitStepState, increments: &[Vec<f64>], row: usize) -> f64 {
    (unit.combine(&stage.rate, increments, row) - unit.curvature[row]) / 3.0
}

fn note(report: &mut StepReport, outcome: &Outcome) {
    report.correction = outcome.correction;
    report.stagnated |= outcome.stagnated;
}
