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
mod tests {
    use super::*;

    /// Every step returns one of them: a large error is copied although nothing has failed.
    #[test]
    fn errors_are_small() {
        for size in [size_of::<StepError>(), size_of::<InitialError>()] {
            assert!(size < 128, "{size} bytes: give a message instead of further parts");
        }
    }
}
