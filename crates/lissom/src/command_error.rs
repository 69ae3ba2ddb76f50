//! Failures of the command line that are not failures of the library.

use lissom_core::diagnostics::Diagnose;

/// Why a command fails before or after the library has done its part.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum CommandError {
    /// The arguments contradict each other or what they name.
    Request(String),
    /// Members of a sweep have no solution.
    Members {
        /// Their number.
        failed: usize,
        /// Number of all members.
        count: usize,
    },
    /// The port of a page is not available.
    Port {
        /// The port.
        port: u32,
        /// The reason of the system.
        reason: String,
    },
    /// Results could not be written to the standard output, for the reason of the system.
    Output(String),
    /// No browser could be started.
    Browser(String),
}
