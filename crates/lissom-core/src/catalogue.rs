//! All codes of warnings and failures of the core, for the manual and `lissom explain`.

use crate::analysis::{InitialError, InputError, StepError, signal_failure};
use crate::diagnostics::Entry;
use crate::judge::Warning;

/// Their entries: warnings, then failures.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    let failures = StepError::ENTRIES.iter().chain(InitialError::ENTRIES).chain(InputError::ENTRIES);
    Warning::ENTRIES.iter().chain(failures).chain([&signal_failure::ENTRY])
}
