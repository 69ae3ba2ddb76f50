//! History of delayed signals. After each accepted step the course of their expressions over it is stored; before each step the part
//! that it needs is copied to the windows of the delayed signals, which are held values.
//!
//! ```text
//! |s - cubic| ≤ tolerance · (largest - smallest value of s so far),      at the middle of each piece
//! ```
//!
//! A step of a delayed signal ends at the latest where the window does: after the delay, because its own values are not yet known,
//! and at breaks of the past: instants at which values, slopes or curvatures jump. A delayed break is a break again, one derivative
//! higher if the delayed signal acts on the motion or a state, of the same derivative if it acts on the expression directly.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::stops::allowed_departure;
use crate::errors::StepError;
use crate::instants;
use crate::integrator::dense::DenseOutput;
use crate::kinematics::Kinematics;
use crate::round_off;
use crate::settings::{Problem, Settings};
use crate::signals::Graph;
use crate::signals::delay::{Delay, Piece, max_pieces};
use crate::simulation::Simulation;
use crate::system::{State, System};

/// Lowest derivative that jumps at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum Break {
    /// The value.
    Value,
    /// The slope.
    Slope,
    /// The curvature.
    Curvature,
    /// The third derivative.
    Third,
    /// A derivative that affects no scheme, or none.
    Smooth,
}

impl Break {
    /// The break of an integral.
    fn integrated(self) -> Self {
        match self {
            Self::Value => Self::Slope,
            Self::Slope => Self::Curvature,
            Self::Curvature => Self::Third,
            Self::Third | Self::Smooth => Self::Smooth,
        }
    }
}

/// A stored piece, and the break at its start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Stored {
    piece: Piece,
    begins: Break,
}

/// The past of one delayed signal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Course {
    /// Pieces one after the other, as long as the delay requires them.
    stored: VecDeque<Stored>,
    /// Break at the start of the next piece.
    next: Break,
    /// Smallest and largest value so far.
    range: [f64; 2],
}

impl Course {
    fn span(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    fn largest(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    fn push(&mut self, piece: Piece) {
        for value in piece.values {
            self.range = [self.range[0].min(value), self.range[1].max(value)];
        }
        let noise = round_off::FUNCTION * self.largest();
        let jumps = |last: &Stored| (last.piece.values[3] - piece.values[0]).abs() > noise;
        let begins = if self.stored.back().is_some_and(jumps) { Break::Value } else { self.next };
        self.stored.push_back(Stored { piece, begins });
        self.next = Break::Smooth;
    }

    /// Index of the piece that begins at or before `time` [s] and ends after it.
    fn index_at(&self, time: f64, near: f64) -> usize {
        self.stored.partition_point(|stored| stored.piece.ends[1] <= time + near)
    }
}

/// History of the delayed signals of a simulation.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SignalHistory {
    courses: Vec<Course>,
}

/// Storage for the pieces of one step.
pub(crate) struct Recorder {
    between: State,
    /// Values of all expressions at five instants of each piece: its ends, thirds and middle.
    pieces: Vec<([f64; 2], Vec<[f64; 5]>)>,
    /// Pieces that are not in use.
    spare: Vec<Vec<[f64; 5]>>,
    /// Smallest and largest value of each expression so far.
    ranges: Vec<[f64; 2]>,
}

impl Recorder {
    pub(crate) fn new(state: &State) -> Self {
        Self { between: state.clone(), pieces: Vec::new(), spare: Vec::new(), ranges: Vec::new() }
    }

    /// Evaluates the expressions between two step fractions.
    fn evaluate(&mut self, graph: &Graph, step: DenseOutput<'_>, ends: [f64; 2]) {
        let mut values = self.spare.pop().unwrap_or_default();
        values.clear();
        values.resize(graph.delays().len(), [0.0; 5]);
        for (k, share) in [0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0].into_iter().enumerate() {
            let at = match ends[0] + share * (ends[1] - ends[0]) {
                0.0 => &step.from.kinematics,
                1.0 => &step.to.kinematics,
                share => {
                    step.at(share, &mut self.between);
                    &self.between.kinematics
                }
            };
            sources(graph, at, |delay, value| values[delay][k] = value);
        }
        self.pieces.push((ends, values));
    }

    /// Divides the step into pieces until cubics represent all expressions, or a piece is as short as useful.
    fn record(&mut self, graph: &Graph, step: DenseOutput<'_>, courses: &[Course], tolerance: f64) {
        self.spare.extend(self.pieces.drain(..).map(|(_, values)| values));
        self.evaluate(graph, step, [0.0, 1.0]);
        self.ranges.clear();
        self.ranges.extend(courses.iter().zip(&self.pieces[0].1).map(|(course, values)| {
            values.iter().fold(course.range, |[low, high], value| [low.min(*value), high.max(*value)])
        }));
        // A window that covers a step has space for all pieces of a step.
        while self.pieces.len() < max_pieces() {
            let departures =
                self.pieces.iter().map(|(ends, values)| excess(*ends, values, &self.ranges, tolerance));
            let worst = departures.enumerate().max_by(|one, other| one.1.total_cmp(&other.1));
            let Some((index, _)) = worst.filter(|(_, excess)| *excess > 1.0) else { break };
            let ([from, to], values) = self.pieces.swap_remove(index);
            self.spare.push(values);
            let middle = 0.5 * (from + to);
            self.evaluate(graph, step, [from, middle]);
            self.evaluate(graph, step, [middle, to]);
        }
        self.pieces.sort_unstable_by(|one, other| one.0[0].total_cmp(&other.0[0]));
    }
}

/// Largest departure of the expressions from their cubics at the middle of a piece, over the allowed one.
fn excess(ends: [f64; 2], values: &[[f64; 5]], ranges: &[[f64; 2]], tolerance: f64) -> f64 {
    let of_one = |(values, [low, high]): (&[f64; 5], &[f64; 2])| {
        let [first, second, middle, third, last] = *values;
        let piece = Piece { ends, values: [first, second, third, last] };
        let allowed = tolerance * (high - low) + round_off::FUNCTION * low.abs().max(high.abs());
        let departure = (piece.at(0.5 * (ends[0] + ends[1])) - middle).abs();
        if allowed > 0.0 { departure / allowed } else { 0.0 }
    };
    values.iter().zip(ranges).map(of_one).fold(0.0, f64::max)
}

/// Passes the present value of the expression of each delayed signal to `take`.
fn sources(graph: &Graph, at: &Kinematics, mut take: impl FnMut(usize, f64)) {
    graph.evaluate(at, |values| {
        for (index, delay) in graph.delays().iter().enumerate() {
            take(index, delay.source.map_or(0.0, |source| values[source.index()]));
        }
    });
}

impl SignalHistory {
    /// History at the start: the windows contain the values before it.
    pub(crate) fn new(graph: &Graph, start: &Kinematics) -> Self {
        let of_one = |delay: &Delay| {
            let mut course = Course {
                stored: VecDeque::new(),
                next: Break::Smooth,
                range: [f64::INFINITY, f64::NEG_INFINITY],
            };
            if let Some(before) = delay.pieces(&start.held).next() {
                course.push(before);
            }
            course.next = Break::Slope;
            course
        };
        Self { courses: graph.delays().iter().map(of_one).collect() }
    }

    /// Whether it is of as many signals as another one.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.courses.len() == other.courses.len()
    }

    /// Records an accepted step.
    pub(crate) fn record(
        &mut self,
        (system, settings): (&System, &Settings),
        step: DenseOutput<'_>,
        recorder: &mut Recorder,
    ) {
        let tolerance =
            settings.control.map_or(settings.limits.tolerance, |own| 0.1 * own.relative_tolerance);
        recorder.record(system.signals(), step, &self.courses, tolerance);
        let (start, end) = (step.from.kinematics.time, step.to.kinematics.time);
        // Ends of neighbours are equal to the last bit.
        let time = |share: f64| if share == 1.0 { end } else { start + share * (end - start) };
        for (ends, values) in &recorder.pieces {
            for (course, &[first, second, _, third, last]) in self.courses.iter_mut().zip(values) {
                course.push(Piece { ends: ends.map(time), values: [first, second, third, last] });
            }
        }
    }

    /// Removes what was recorded after `now` [s].
    pub(crate) fn return_to(&mut self, now: f64, near: f64) {
        for course in &mut self.courses {
            while let Some(last) =
                course.stored.back().filter(|last| last.piece.ends[0] > now - near).copied()
            {
                course.next = last.begins;
                course.stored.pop_back();
            }
        }
    }

    /// Records that a derivative of the motion jumps at the present instant.
    pub(crate) fn add_break(&mut self, of_motion: Break) {
        for course in &mut self.courses {
            course.next = course.next.min(of_motion);
        }
    }

    /// Removes pieces that steps from `now` [s] on do not need.
    fn trim(&mut self, graph: &Graph, now: f64, near: f64) {
        for (course, delay) in self.courses.iter_mut().zip(graph.delays()) {
            let first = course.index_at(now - delay.time, near);
            course.stored.drain(..first);
        }
    }

    /// The piece with which the window of a delayed signal begins at `now` [s], and the break that the signal passes then.
    fn beginning(&self, (index, delay): (usize, &Delay), now: f64, near: f64) -> Option<(usize, Break)> {
        let (course, then) = (&self.courses[index], now - delay.time);
        let first = course.index_at(then, near);
        let stored = course.stored.get(first)?;
        let is_at_start = (stored.piece.ends[0] - then).abs() <= near;
        Some((first, if is_at_start { stored.begins } else { Break::Smooth }))
    }

    /// Whether a delayed signal passes a break at `now` [s].
    fn passes_break(&self, graph: &Graph, now: f64, near: f64) -> bool {
        let mut all = graph.delays().iter().enumerate();
        all.any(|own| self.beginning(own, now, near).is_some_and(|(_, begins)| begins != Break::Smooth))
    }

    /// Fills the windows of `held` from `now` [s] on. Breaks that the delayed signals pass now are those of the next pieces.
    fn fill(&mut self, graph: &Graph, now: f64, near: f64, held: &mut [f64]) {
        for (index, delay) in graph.delays().iter().enumerate() {
            let Some((first, begins)) = self.beginning((index, delay), now, near) else { continue };
            let stored = &self.courses[index].stored;
            let rest = stored.range(first + 1..).take_while(|stored| stored.begins == Break::Smooth);
            let pieces = stored.range(first..=first).chain(rest).map(|stored| stored.piece);
            delay.fill(pieces, held);
            self.add_delayed_break(graph, delay, begins);
        }
    }

    fn add_delayed_break(&mut self, graph: &Graph, delayed: &Delay, begins: Break) {
        if begins == Break::Smooth {
            return;
        }
        for (course, other) in self.courses.iter_mut().zip(graph.delays()) {
            let is_direct = other.source.is_some_and(|source| graph.passes(source, delayed.signal));
            course.next = course.next.min(if is_direct { begins } else { begins.integrated() });
        }
    }

    /// Longest step of `size` [s] or less from `now` [s] whose ends determine all delayed signals within it.
    fn longest_resolved(&self, graph: &Graph, (now, size): (f64, f64), part: f64, held: &[f64]) -> f64 {
        let mut longest = size;
        for (delay, course) in graph.delays().iter().zip(&self.courses) {
            let allowed = part * course.span() + round_off::FUNCTION * course.largest();
            let is_resolved = |size: f64| {
                let ends = [now, now + size];
                let values = std::array::from_fn(|k| delay.value(now + k as f64 / 3.0 * size, held));
                let whole = Piece { ends, values };
                delay.pieces(held).all(|piece| {
                    let knots = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
                    let [from, to] = piece.ends.map(|end| end + delay.time);
                    knots.into_iter().zip(piece.values).all(|(share, value)| {
                        let time = from + share * (to - from);
                        !(now..=now + size).contains(&time) || (whole.at(time) - value).abs() <= allowed
                    })
                })
            };
            // A single piece is resolved, so that halving ends.
            let single = delay.pieces(held).next().map_or(0.0, |piece| piece.ends[1] + delay.time - now);
            while longest > single && !is_resolved(longest) {
                longest = single.max(0.5 * longest);
            }
        }
        longest
    }
}

impl Simulation {
    /// Instants closer to each other [s] are equal in the history of signals.
    fn near(&self) -> f64 {
        instants::tolerance(self.now(), self.control.longest())
    }

    /// Records the course of expressions with delayed signals over the attempt that is being accepted.
    pub(super) fn record_signals(&mut self) {
        if self.system.signals().delays().is_empty() {
            return;
        }
        let problem = Problem { system: &self.system, settings: &self.settings };
        let step = self.integrator.dense(problem, (self.attempt.start(&self.state), &self.attempt.end));
        let recorder = self.stops.recorder.get_or_insert_with(|| Recorder::new(&self.state));
        self.stops.history.record((&self.system, &self.settings), step, recorder);
    }

    /// Forgets the past that steps from the present instant on do not need. Within a step it is kept, because the step may fail.
    pub(super) fn trim_signals(&mut self) {
        if self.system.signals().delays().is_empty() {
            return;
        }
        let (now, near) = (self.now(), self.near());
        self.stops.history.trim(self.system.signals(), now, near);
    }

    /// Forgets what was recorded after the state, to which a failed step has returned.
    pub(super) fn forget_signals(&mut self) {
        let (now, near) = (self.now(), self.near());
        self.stops.history.return_to(now, near);
    }

    /// Latest end of a step from `now` [s] such that no delayed signal needs its own values [s].
    pub(super) fn end_of_windows(&self) -> f64 {
        let delays = self.system.signals().delays().iter();
        delays.map(|delay| delay.end_of_window(&self.state.kinematics.held)).fold(f64::INFINITY, f64::min)
    }

    /// Moves the windows of delayed signals to the present instant. Where a delayed signal jumps, so do accelerations.
    ///
    /// # Errors
    /// If a delayed signal jumps, and there are no consistent accelerations.
    pub(super) fn move_windows(&mut self) -> Result<(), StepError> {
        if self.system.signals().delays().is_empty() {
            return Ok(());
        }
        let (now, near) = (self.now(), self.near());
        let system = std::sync::Arc::clone(&self.system);
        let graph = system.signals();
        let history = &mut self.stops.history;
        if !history.passes_break(graph, now, near) {
            history.fill(graph, now, near, &mut self.state.kinematics.held);
            return Ok(());
        }
        let mut at = self.state.kinematics.clone();
        history.fill(graph, now, near, &mut at.held);
        self.integrator.work.forget_predictions();
        let windows = [&*self.state.kinematics.held, &at.held];
        if !graph.delays().iter().any(|delay| delay.jumps(now, windows)) {
            self.state.kinematics.held = at.held;
            return Ok(());
        }
        let time = at.time;
        self.change_held_values(at).map_err(|error| StepError::Velocities { time, error })
    }

    /// The longest adaptive step of `size` [s] or less that resolves all delayed signals.
    pub(super) fn longest_resolved_delays(&self, now: f64, size: f64) -> f64 {
        let (graph, held) = (self.system.signals(), &self.state.kinematics.held);
        if graph.delays().is_empty() {
            return size;
        }
        self.stops.history.longest_resolved(graph, (now, size), allowed_departure(&self.settings), held)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/simulation/signal_history.rs"]
mod tests;
