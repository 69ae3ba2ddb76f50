//! Options and results common to all commands that linearise a model about a state.

use clap::Args;
use lissom::analysis::{AnalysisError, Origin};
use lissom::modes::OperatingPoint;
use lissom::response::FrequencyError;

use super::outcome::{Exit, Failure};

/// State about which the model is linearised.
#[derive(Args)]
pub(super) struct StateArgument {
    /// State to linearise about: `static` (default), `undeformed`, `rotation` or a time of the model's analysis [s].
    #[arg(
        long,
        value_name = "STATE|TIME",
        default_value = "static",
        hide_default_value = true,
        allow_negative_numbers = true
    )]
    pub(super) about: OperatingPoint,
}

/// A result, or the reason why there is none. An error of the model or of the request ends the command immediately.
pub(super) fn answered<T>(found: Result<T, FrequencyError>) -> Result<Result<T, FrequencyError>, Failure> {
    match found {
        Err(FrequencyError::Model(report)) => Err(report.into()),
        Err(error) if matches!(error.origin(), Origin::Request) => Err(Failure::new(Exit::BadModel, &error)),
        other => Ok(other),
    }
}
