//! Results that are incomplete or cannot be written.

use std::io;
use std::path::Path;

use lissom::{FolderError, ResultFolder, RunError};

use super::outcome::{Exit, Failure};
use super::terminal;

/// An error while results were written to an open file.
pub(super) fn writing_failed(error: io::Error) -> Failure {
    Failure::new(Exit::Failed, &RunError::Write(error))
}

/// Results that cannot be written.
pub(super) fn unwritable(error: impl Into<FolderError>) -> Failure {
    Failure::new(Exit::Failed, &error.into())
}

/// Warns of results of a run that did not reach its end.
pub(super) fn warn_of_incomplete(folder: &Path) {
    if let Some(words) = ResultFolder::incomplete(folder) {
        terminal::complain(&format!("warning: `{}`: {words}\n", folder.display()));
    }
}
