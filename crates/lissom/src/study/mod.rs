//! Studies: comparisons of a family of runs of one model. They return tables; the command line prints, writes and
//! draws them.

pub mod conditioning;
pub mod convergence;
pub mod factorization;
mod members;
mod observed;
pub mod roundoff;
mod scheme_words;

use lissom_core::analysis::{InitialError, StepError};
use lissom_model::Report;

use crate::report::RunError;

pub use members::Watch;

/// Why a study has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The model is invalid, or becomes invalid by the overrides of the study.
    #[error(transparent)]
    Model(#[from] Report),
    /// There are no consistent initial values.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// A step has no solution.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The study requires time steps, and the analysis has load steps.
    #[error("this study needs time steps: the analysis of the model must be of kind `dynamics`")]
    NotDynamic,
    /// A run ended early.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An unknown scheme.
    #[error("`{word}` is no scheme for a study: {reason}")]
    SchemeWord {
        /// The word.
        word: String,
        /// The reason.
        reason: String,
    },
    /// The model has no such output.
    #[error("the model has no output `{name}`: its outputs are {known}")]
    Output {
        /// The given name.
        name: String,
        /// The existing outputs.
        known: String,
    },
    /// Runs have no common instants.
    #[error(
        "the step size {step} s does not divide the largest, {coarsest} s: choose steps that are whole fractions \
         of the largest, as 1e-2,5e-3,2.5e-3"
    )]
    Steps {
        /// Step size, as written [s].
        step: String,
        /// The largest step size [s].
        coarsest: f64,
    },
    /// The reference is too coarse for the error of finer runs.
    #[error("the reference's step size {0} s is larger than a step of the study: choose a smaller one")]
    CoarseReference(String),
    /// The output is zero, so that relative errors are undefined.
    #[error("the output `{0}` stays at zero: choose one that moves")]
    NothingToCompare(String),
    /// It was interrupted.
    #[error("interrupted")]
    Interrupted,
}

/// One line of comma-separated texts; quoted if necessary.
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
