//! Studies: what a family of runs of one model shows. They return tables; the command line prints, writes and
//! draws them. No mechanics is done here.

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
    /// A run ended early.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A word that names no scheme.
    #[error("`{word}` is no scheme for a study: {reason}")]
    SchemeWord {
        /// The word.
        word: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The model has no such output.
    #[error("the model has no output `{name}`: its outputs are {known}")]
    Output {
        /// The name asked for.
        name: String,
        /// Those there are.
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
    /// The output is zero, and nothing is relative to it.
    #[error("the output `{0}` stays at zero: choose one that moves")]
    NothingToCompare(String),
    /// It was interrupted.
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
