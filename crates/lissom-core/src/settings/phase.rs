//! Phases of a step, reported to a stopwatch of the caller: no clock is read here.

use crate::interrupt;

/// A part of the work of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Motions at the stages, forces and violations.
    Evaluation,
    /// Derivatives of forces and violations.
    Linearisation,
    /// Assembly and factorisation of the tangent.
    Factorisation,
    /// Forward and backward substitution.
    Solve,
    /// Everything else: prediction, corrections and their size, the end of the step.
    Rest,
}

impl Phase {
    /// How many there are.
    pub const COUNT: usize = 5;
}

/// Called when a phase begins; the one before ends there.
pub trait Stopwatch {
    /// A phase begins.
    fn begin(&mut self, phase: Phase);

    /// Whether somebody wants the step to be given up; asked after every attempt that failed. Default: whether this thread
    /// is asked to.
    fn is_cancelled(&self) -> bool {
        interrupt::is_asked()
    }
}

/// A stopwatch that is not looked at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Stopwatch for Unwatched {
    fn begin(&mut self, _: Phase) {}
}
