//! What can be wrong: why steps and initial values fail, and warnings about results.

mod initial_error;
mod reports;
pub(crate) mod step_error;
mod warning;

pub use initial_error::InitialError;
pub(crate) use reports::{report, report_since, warn};
pub use step_error::StepError;
pub use warning::Warning;

/// Maximum number of parts that a message names.
pub(crate) const MAX_LISTED: usize = 4;

#[cfg(test)]
#[path = "../../tests/unit/errors/mod.rs"]
mod tests;
