//! Receives whole states of a running session, as [`Writer`](crate::Writer) receives its recorded values.

use std::io;

use lissom_core::simulation::Simulation;

/// Receives states during a run.
pub trait StateWriter: Send {
    /// Writes the state before the first step. Not called for a session that is resumed from a checkpoint.
    ///
    /// # Errors
    /// If it cannot be written.
    fn begin(&mut self, simulation: &Simulation) -> io::Result<()>;

    /// Whether the state of a step that ended at `time` [s] is required.
    fn is_due(&self, time: f64) -> bool;

    /// Receives the last step. From `known_from` [s] on, states may be interpolated.
    ///
    /// # Errors
    /// If it cannot be written.
    fn step(&mut self, simulation: &Simulation, known_from: f64) -> io::Result<()>;

    /// Writes all buffered data.
    ///
    /// # Errors
    /// If it cannot be written.
    fn flush(&mut self) -> io::Result<()>;

    /// Writes the state of the last step.
    ///
    /// # Errors
    /// If it cannot be written.
    fn finish(&mut self, simulation: &Simulation) -> io::Result<()>;
}
