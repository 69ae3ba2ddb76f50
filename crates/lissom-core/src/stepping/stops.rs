//! Instants at which steps end that are known before the step: breakpoints of functions of time, both those that the functions
//! report and those that are found by sampling them.

use super::breakpoints::{self, Breakpoint, StopTime};
use super::time_functions::{BLOCK, DEPARTURE, TimeFunctions, WINDOW};
use crate::analysis::{Problem, Settings};
use crate::instants::SAME;
use crate::judge::Warning;
use crate::system::System;

/// Instants that end steps, known in advance.
pub(crate) struct Stops {
    /// Breakpoints of functions of time: steps of motions, and adaptive load steps, do not cross them.
    pub(super) breakpoints: Vec<Breakpoint>,
    /// Properties of functions of time.
    functions: TimeFunctions,
    /// When the motion began [s].
    origin: f64,
}

impl Stops {
    /// Of a simulation that begins at the time `origin` [s].
    pub(crate) fn new(system: &System, settings: &Settings, origin: f64) -> Self {
        let is_bound = settings.control.is_some() || settings.scheme.dynamic;
        let breakpoints = if is_bound { breakpoints::of(system, settings.step_size) } else { Vec::new() };
        Self { breakpoints, functions: TimeFunctions::default(), origin }
    }

    /// Samples functions of time before a step from the time `now` [s]: jumps that are found end steps. Steps are `longest` [s]
    /// or shorter.
    pub(super) fn look_ahead(&mut self, problem: Problem<'_>, now: f64, longest: f64) {
        if problem.system.functions.is_empty() || !problem.settings.scheme.dynamic {
            return;
        }
        let sizes = [longest, block(problem.settings, longest)];
        for time in self.functions.look_ahead(problem.system, self.origin, now, sizes) {
            let next = self.breakpoints.partition_point(|breakpoint| breakpoint.time < time);
            let near = |breakpoint: &Breakpoint| (breakpoint.time - time).abs() <= SAME * longest;
            if !self.breakpoints[next.saturating_sub(1)..].iter().take(2).any(near) {
                self.breakpoints.insert(next, Breakpoint::jump(time));
            }
        }
    }

    /// The stop of a step from the time `now` [s] before `limit` [s].
    pub(super) fn stop_time(
        &self,
        problem: Problem<'_>,
        [now, limit]: [f64; 2],
        longest: f64,
    ) -> Option<StopTime> {
        breakpoints::stop_time(&self.breakpoints, [now, limit], longest, problem.settings.scheme.dynamic)
    }

    /// Whether a function of time jumps at `now` [s], so that it has another value at `behind` [s].
    pub(super) fn jumps(&mut self, problem: Problem<'_>, [now, behind]: [f64; 2], longest: f64) -> bool {
        let window = WINDOW * block(problem.settings, longest);
        let sizes = self.functions.sizes(problem.system, now, now, window);
        problem.system.functions.iter().zip(sizes).any(|((_, function), size)| {
            (function.value(behind) - function.value(now)).abs() > DEPARTURE * size
        })
    }

    /// The longest step of `size` [s] or less whose ends determine all functions of time within it.
    pub(super) fn longest_resolved(
        &mut self,
        problem: Problem<'_>,
        (now, size): (f64, f64),
        longest: f64,
    ) -> f64 {
        let window = WINDOW * block(problem.settings, longest);
        // The square root of the allowed error of a third-order step.
        let tolerance = problem.settings.control.map_or(1.0, |control| control.relative_tolerance);
        let part = tolerance.powf(2.0 / 3.0).min(DEPARTURE);
        self.functions.longest_resolved(problem.system, self.origin, (now, size), part, window)
    }

    /// Reports, at the time `now` [s] after a step of planned size, that a function within steps is not determined by their
    /// ends.
    pub(super) fn passed_unseen(&self, system: &System, now: f64, step: f64) -> Option<Warning> {
        let (time, index) = self.functions.hidden?;
        let function = || system.functions[index].0.clone();
        (time < now).then(|| Warning::FunctionUnseen { time, function: function(), step })
    }

    /// Restarts at the beginning of another motion.
    pub(super) fn restart(&mut self, origin: f64) {
        self.origin = origin;
    }
}

/// Duration of the intervals in which functions are sampled together [s].
fn block(settings: &Settings, longest: f64) -> f64 {
    BLOCK[usize::from(settings.control.is_some())] * longest
}
