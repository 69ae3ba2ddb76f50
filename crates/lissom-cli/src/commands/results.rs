//! Results that cannot be written.

use std::io;

use lissom::{FolderError, RunError};

use super::outcome::{Exit, Failure};

/// An error while results were written to an open file.
pub(super) fn writing_failed(error: io::Error) -> Failure {
    Failure::new(Exit::Failed, &RunError::Write(error))
}

/// Results that cannot be written.
pub(super) fn unwritable(error: impl Into<FolderError>) -> Failure {
    Failure::new(Exit::Failed, &error.into())
}
