//! Ends of steps that are known in advance: breakpoints of functions of time, both those that the functions report and those that are
//! found by sampling.

use std::sync::Arc;

use super::breakpoints::{self, Breakpoint, StopTime};
use super::laws::{Course, DEPARTURE, Found, Laws, MAX_INTERVALS, OfTime};
use super::signal_history::{Recorder, SignalHistory};
use crate::errors::Warning;
use crate::instants::TIME_TOLERANCE;
use crate::registry::Function;
use crate::settings::{Problem, Settings};
use crate::system::{State, System};

/// Functions are sampled beyond the end of the step by this fraction of it, so that a jump at the end is within the samples.
const LOOK_AHEAD: f64 = 0.01;
/// Bisections of a planned step in which jumps close to fast variations are searched for.
const FURTHER: i32 = 6;

/// Instants that end steps, known in advance, and the resolution of scalar laws within steps.
pub(crate) struct Stops {
    /// Breakpoints of functions of time and jumps found within the present step. Steps of motions, and adaptive load steps, do not
    /// cross them.
    pub(crate) breakpoints: Vec<Breakpoint>,
    /// Breakpoints that are jumps found by sampling.
    found: Vec<f64>,
    /// Centre of an interval of the present step that is not determined by its ends [s], with the function's index.
    hidden: Option<(f64, usize)>,
    /// Laws, and their magnitudes.
    pub(crate) laws: Laws,
    /// The past of delayed signals.
    pub(crate) history: SignalHistory,
    pub(super) recorder: Option<Recorder>,
}

impl Stops {
    /// Stops of a simulation that starts at `start`.
    pub(crate) fn new(system: &System, settings: &Settings, start: &State) -> Self {
        let is_bound = settings.control.is_some() || settings.scheme.dynamic;
        let breakpoints = if is_bound { breakpoints::of(system, settings.step_size) } else { Vec::new() };
        let longest = settings.control.map_or(settings.step_size, |control| control.max_step);
        let laws = Laws::new(system, start, longest);
        let history = SignalHistory::new(system.signals(), &start.kinematics);
        Self { breakpoints, found: Vec::new(), hidden: None, laws, history, recorder: None }
    }

    /// Samples functions of time over a step of at most `size` [s] from the time `now` [s]: jumps that are found end steps. No step is
    /// longer than `longest` [s].
    pub(crate) fn look_ahead(&mut self, problem: Problem<'_>, now: f64, [size, longest]: [f64; 2]) {
        let system = problem.system;
        if !self.found.is_empty() {
            self.breakpoints.retain(|breakpoint| !self.found.contains(&breakpoint.time));
            self.found.clear();
        }
        self.hidden = None;
        if system.functions.is_empty() || !problem.settings.scheme.dynamic {
            return;
        }
        let step = [now + TIME_TOLERANCE * longest, now + (1.0 + LOOK_AHEAD) * size];
        let mut jumps = Vec::new();
        for (index, (_, function)) in system.functions.iter().enumerate() {
            if function.is_constant() || self.laws.is_straight(index, function, [now, step[1]], DEPARTURE) {
                continue;
            }
            let magnitude = self.laws.magnitude_of_function(index, function, step);
            let mut scan = Scan::default();
            scan.function(function, &self.breakpoints, step, magnitude);
            let sooner = |time: &f64| self.hidden.is_none_or(|(known, _)| *time < known);
            self.hidden = scan.hidden.filter(sooner).map(|time| (time, index)).or(self.hidden);
            // A drive that jumps is reported, see `judge::drives`, and not treated here.
            if !system.drives().iter().any(|drive| Arc::ptr_eq(&drive.prescribed.value, function)) {
                jumps.append(&mut scan.jumps);
            }
        }
        for time in jumps {
            let next = self.breakpoints.partition_point(|breakpoint| breakpoint.time < time);
            let near = |breakpoint: &Breakpoint| (breakpoint.time - time).abs() <= TIME_TOLERANCE * longest;
            if !self.breakpoints[next.saturating_sub(1)..].iter().take(2).any(near) {
                self.breakpoints.insert(next, Breakpoint::jump(time));
                self.found.push(time);
            }
        }
    }

    /// The stop of a step from the time `now` [s] before `limit` [s].
    pub(crate) fn stop_time(
        &self,
        problem: Problem<'_>,
        [now, limit]: [f64; 2],
        longest: f64,
    ) -> Option<StopTime> {
        breakpoints::stop_time(&self.breakpoints, [now, limit], longest, problem.settings.scheme.dynamic)
    }

    /// Whether a function of time jumps at `now` [s], so that it has another value at `behind` [s].
    pub(crate) fn jumps(&mut self, problem: Problem<'_>, [now, behind]: [f64; 2]) -> bool {
        let functions = problem.system.functions.iter().enumerate();
        functions.into_iter().any(|(index, (_, function))| {
            let magnitude = self.laws.magnitude_of_function(index, function, [now, behind]);
            (function.value(behind) - function.value(now)).abs() > DEPARTURE * magnitude
        })
    }

    /// The longest step of `size` [s] or less whose ends determine all functions of time within it.
    pub(crate) fn longest_resolved(&mut self, problem: Problem<'_>, (now, size): (f64, f64)) -> f64 {
        let part = allowed_departure(problem.settings);
        let mut longest = size;
        for (index, (_, function)) in problem.system.functions.iter().enumerate() {
            let is_straight = |laws: &mut Laws| laws.is_straight(index, function, [now, now + longest], part);
            if !(function.is_constant() || is_straight(&mut self.laws)) {
                let magnitude = self.laws.magnitude_of_function(index, function, [now, now + size]);
                let of_time = OfTime(&**function);
                longest = Course::of_time(&of_time).longest([now, longest], magnitude, part);
            }
        }
        longest
    }

    /// Warns, at the time `now` [s] after a step of planned size, of a function within it that is not determined by its ends.
    pub(crate) fn passed_unseen(&self, system: &System, now: f64, step: f64) -> Option<Warning> {
        let (time, index) = self.hidden?;
        let function = || system.functions[index].0.clone();
        (time < now).then(|| Warning::FunctionUnseen { time, function: function(), step })
    }
}

/// Allowed deviation of a law from the interpolation of a step's ends, relative to its magnitude: the square root of the allowed error of
/// a third-order step.
pub(crate) fn allowed_departure(settings: &Settings) -> f64 {
    let tolerance = settings.control.map_or(1.0, |control| control.relative_tolerance);
    tolerance.powf(2.0 / 3.0).min(DEPARTURE)
}

/// Features of a function of time within a step.
#[derive(Debug, Default)]
struct Scan {
    looks: usize,
    hidden: Option<f64>,
    jumps: Vec<f64>,
}

impl Scan {
    /// Samples a step, between the known breakpoints of all functions.
    fn function(
        &mut self,
        function: &Function,
        breakpoints: &[Breakpoint],
        [from, to]: [f64; 2],
        magnitude: f64,
    ) {
        let first = breakpoints.partition_point(|breakpoint| breakpoint.time <= from);
        let inside =
            breakpoints[first..].iter().map(|breakpoint| breakpoint.time).take_while(|time| *time < to);
        let of_time = OfTime(&**function);
        let course = Course::of_time(&of_time);
        let mut begin = from;
        for end in inside.chain([to]) {
            self.look(&course, [begin, end], to - from, magnitude);
            begin = end;
        }
    }

    fn look(&mut self, course: &Course<'_>, [from, to]: [f64; 2], step: f64, magnitude: f64) {
        self.looks += 1;
        let length = to - from;
        if self.looks > MAX_INTERVALS || length <= TIME_TOLERANCE * step {
            return;
        }
        let mut middle = 0.5 * (from + to);
        match course.found([from, to], magnitude, DEPARTURE) {
            Found::Nothing => return,
            Found::Hidden => {
                // Between two breakpoints a step is shorter, and its error is less significant.
                let part = DEPARTURE * (step / length).max(1.0);
                if course.found([from, to], magnitude, part) == Found::Hidden {
                    self.hidden = Some(self.hidden.map_or(middle, |known| known.min(middle)));
                }
                if length < step * 0.5_f64.powi(FURTHER) {
                    return;
                }
            }
            Found::Jump(time) => {
                // A jump at an end of the interval is already known.
                if (time - from).min(to - time) <= TIME_TOLERANCE * step {
                    return;
                }
                self.jumps.push(time);
                middle = time;
            }
        }
        self.look(course, [from, middle], step, magnitude);
        self.look(course, [middle, to], step, magnitude);
    }
}
