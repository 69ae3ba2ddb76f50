//! Studies: what a family of runs of one model shows. They return tables; the command line prints, writes and
//! draws them. No mechanics is done here.

pub mod conditioning;
pub mod factorization;
mod members;

use lissom_core::analysis::{InitialError, StepError};
use lissom_model::Report;

pub use members::Watch;

/// A study that has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The model is wrong, or wrong with what the study puts into it.
    #[error(transparent)]
    Model(#[from] Report),
    /// There are no consistent initial values.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// A step has no solution.
    #[error(transparent)]
    Step(#[from] StepError),
    /// It needs time steps, and the analysis has load steps.
    #[error("this study needs time steps: the analysis of the model must be of kind `dynamics`")]
    NotDynamic,
    /// Its scheme has equations of its own.
    #[error(
        "this study does not know the equations of the scheme `{0}`: choose another with analysis.scheme"
    )]
    Scheme(String),
    /// It was told to stop.
    #[error("interrupted")]
    Interrupted,
}

/// One line of comma-separated texts; those that need it in quotes.
fn csv_line<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let quoted = |text: &str| {
        if text.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", text.replace('"', "\"\""))
        } else {
            text.to_owned()
        }
    };
    let mut line = texts.into_iter().map(quoted).collect::<Vec<_>>().join(",");
    line.push('\n');
    line
}
