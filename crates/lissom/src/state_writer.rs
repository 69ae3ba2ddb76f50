//! Takes whole states of a running session, as [`Writer`](crate::Writer) takes its recorded values.

use std::io;

use lissom_core::analysis::Simulation;

/// Takes states on the way of a session.
pub trait StateWriter: Send {
    /// Starts with the state before the first step. Not called for a session that goes on from a checkpoint.
    ///
    /// # Errors
    /// If it cannot be written.
    fn begin(&mut self, simulation: &Simulation) -> io::Result<()>;

    /// Whether the state of a step that ended at `time` [s] is wanted.
    fn is_due(&self, time: f64) -> bool;

    /// Takes the step that has just ended. From `known_from` [s] on, states may be interpolated.
    ///
    /// # Errors
    /// If it cannot be written.
    fn step(&mut self, simulation: &Simulation, known_from: f64) -> io::Result<()>;

    /// Leaves nothing in a buffer.
    ///
    /// # Errors
    /// If it cannot be written.
    fn flush(&mut self) -> io::Result<()>;

    /// Ends with the state of the last step taken.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(&mut self, simulation: &Simulation) -> io::Result<()>;
}
