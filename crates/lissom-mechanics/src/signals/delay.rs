//! Delayed signals: the value of an expression at an earlier instant, d(t) = s(t - τ).
//!
//! A delayed signal is a function of time and of held values alone, so it has no derivative by the motion. The held values are its
//! window: pieces of the past of the expression, cubics through four values each. Steps end before the window does, so that no step
//! needs its own values.
//!
//! Legend: a, b ends of a piece; s₀ … s₃ values at a, (2a + b)/3, (a + 2b)/3, b; u = 3 (t - τ - a)/(b - a).
//!
//! ```text
//! d = s₀ + u Δ₁ + u (u - 1) Δ₂/2 + u (u - 1)(u - 2) Δ₃/6,      Δ forward differences of s₀ … s₃
//! ```

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::{DiscreteValueId, Graph, MAX_ARGUMENTS, SignalFunction, SignalId};
use crate::kinematics::{Kinematics, Subject};
use crate::round_off;

/// A part of the past of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Ends of the piece [s].
    pub ends: [f64; 2],
    /// Values at the ends and at one and two thirds between them.
    pub values: [f64; 4],
}

impl Piece {
    /// A constant.
    pub fn constant(ends: [f64; 2], value: f64) -> Self {
        Self { ends, values: [value; 4] }
    }

    /// Value at `time` [s]; beyond the ends, the cubic is continued.
    pub fn at(&self, time: f64) -> f64 {
        let [from, to] = self.ends;
        let u = 3.0 * (time - from) / (to - from);
        let [first, second, third, fourth] = self.values;
        let by_one = second - first;
        let by_two = third - 2.0 * second + first;
        let by_three = fourth - 3.0 * third + 3.0 * second - first;
        first + u * (by_one + (u - 1.0) * (by_two / 2.0 + (u - 2.0) * by_three / 6.0))
    }

    /// Number of values that store it.
    const fn size() -> usize {
        size_of::<Self>() / size_of::<f64>()
    }

    /// The values that store it.
    pub fn to_values(self) -> [f64; 6] {
        let ([from, to], [first, second, third, fourth]) = (self.ends, self.values);
        [from, to, first, second, third, fourth]
    }

    fn of_values(values: &[f64]) -> Option<Self> {
        let &[from, to, first, second, third, fourth] = values else { return None };
        Some(Self { ends: [from, to], values: [first, second, third, fourth] })
    }
}

/// Maximum number of pieces of a window: each of their values is an argument of the signal.
pub const fn max_pieces() -> usize {
    MAX_ARGUMENTS / Piece::size()
}

/// Number of held values of a window.
pub const fn window_size() -> usize {
    max_pieces() * Piece::size()
}

/// A delayed signal of a graph.
#[derive(Clone, Debug)]
pub struct Delay {
    /// The signal.
    pub signal: SignalId,
    /// The signal of which it is the past; none until it is added.
    pub source: Option<SignalId>,
    /// First held value of its window.
    pub(crate) window: DiscreteValueId,
    /// The delay τ [s].
    pub time: f64,
    /// Value before the start; none for the value of the expression at the start.
    pub start: Option<f64>,
}

impl Delay {
    /// A delay without source.
    pub fn new(signal: SignalId, window: DiscreteValueId, time: f64, start: Option<f64>) -> Self {
        Self { signal, source: None, window, time, start }
    }

    fn range(&self) -> Range<usize> {
        let first = self.window.index();
        first..first + window_size()
    }

    /// Pieces of its window. The last one is repeated where there are fewer than the maximum.
    pub fn pieces<'k>(&self, held: &'k [f64]) -> impl Iterator<Item = Piece> + 'k {
        held.get(self.range()).unwrap_or_default().chunks_exact(Piece::size()).filter_map(Piece::of_values)
    }

    /// End of its window as a time of the signal [s].
    pub fn end_of_window(&self, held: &[f64]) -> f64 {
        self.pieces(held).last().map_or(f64::INFINITY, |last| last.ends[1] + self.time)
    }

    /// Stores pieces in its window, as many as there is space for. There must be at least one.
    pub fn fill(&self, pieces: impl Iterator<Item = Piece>, held: &mut [f64]) {
        let mut pieces = pieces.fuse();
        let mut last = None;
        let Some(window) = held.get_mut(self.range()) else { return };
        for chunk in window.chunks_exact_mut(Piece::size()) {
            last = pieces.next().or(last);
            if let Some(piece) = last {
                chunk.copy_from_slice(&piece.to_values());
            }
        }
    }

    /// Whether the signal jumps at `time` [s] from one window to another.
    pub fn jumps(&self, time: f64, [before, after]: [&[f64]; 2]) -> bool {
        let [before, after] = [before, after].map(|held| self.value(time, held));
        (after - before).abs() > round_off::FUNCTION * before.abs().max(after.abs())
    }

    /// Value of the signal at `time` [s] with a window.
    pub fn value(&self, time: f64, held: &[f64]) -> f64 {
        held.get(self.range()).map_or(f64::NAN, |window| Past { delay: self.time }.value(time, window, &[]))
    }
}

/// The function of a delayed signal: its arguments are the window.
#[derive(Clone, Copy, Debug)]
pub struct Past {
    /// The delay [s].
    pub delay: f64,
}

impl SignalFunction for Past {
    fn value(&self, time: f64, arguments: &[f64], _: &[f64]) -> f64 {
        let then = time - self.delay;
        let mut pieces = arguments.chunks_exact(Piece::size());
        let chunk =
            pieces.find(|piece| then <= piece[1]).or_else(|| arguments.chunks_exact(Piece::size()).last());
        chunk.and_then(Piece::of_values).map_or(f64::NAN, |piece| piece.at(then))
    }

    fn gradient(&self, _: f64, _: &[f64], _: &[f64], out: &mut [f64]) {
        // The window is no input of the model.
        out.fill(0.0);
    }

    fn is_polynomial(&self) -> bool {
        true
    }
}

impl Graph {
    /// The delayed signals.
    pub fn delays(&self) -> &[Delay] {
        &self.delays
    }

    /// Description of the first delayed signal.
    pub fn delayed(&self) -> Option<Subject> {
        let signal = self.delays.first()?.signal;
        Some(Subject::new("signal", &*self.signals[signal].subject.name))
    }

    /// Whether a held value belongs to the window of a delayed signal.
    pub fn is_of_window(&self, held: usize) -> bool {
        self.delays.iter().any(|delay| delay.range().contains(&held))
    }

    /// Sets the windows of all delayed signals to their values before the start.
    pub fn fill_windows_before_start(&self, at: &mut Kinematics) {
        // Each pass determines at least one more of those that depend on each other.
        for delay in self.delays.iter().cycle().take(self.delays.len() * self.delays.len()) {
            let of_source = || delay.source.map_or(0.0, |source| self.value(source, at));
            let value = delay.start.unwrap_or_else(of_source);
            let before = Piece::constant([at.time - delay.time, at.time], value);
            delay.fill(std::iter::once(before), &mut at.held);
        }
    }

    /// Whether a signal depends on another one between samples, not by the motion or a state.
    pub fn passes(&self, root: SignalId, other: SignalId) -> bool {
        self.reached_from(std::iter::once(root)).contains(&other)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/signals/delay.rs"]
mod tests;
