//! Studies: comparisons of a family of runs of one model. They return tables; the command line prints, writes and
//! draws them.

pub mod conditioning;
pub mod convergence;
mod members;
mod observed;
mod scheme_words;

use lissom_core::diagnostics::Diagnose;
use lissom_core::errors::InitialError;
use lissom_model::Report;
use lissom_model::output::quoted;

use crate::run::report::RunError;

pub use members::Watch;

/// Why a study has no result.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.diagnostic())]
#[non_exhaustive]
pub enum StudyError {
    /// The model is invalid, or becomes invalid by the overrides of the study.
    Model(#[from] Report),
    /// There are no consistent initial values.
    Initial(#[from] InitialError),
    /// The study requires time steps, and the analysis has load steps.
    NotDynamic,
    /// A run ended early.
    Run(#[from] RunError),
    /// An unknown scheme.
    SchemeWord {
        /// The word.
        word: String,
        /// The reason.
        reason: String,
    },
    /// The model has no such output.
    Output {
        /// The given name.
        name: String,
        /// The existing outputs.
        known: String,
    },
    /// Runs have no common instants.
    Steps {
        /// Step size, as written [s].
        step: String,
        /// The largest step size [s].
        coarsest: f64,
    },
    /// The reference is too coarse for the error of finer runs.
    CoarseReference(String),
    /// The output is zero, so that relative errors are undefined.
    NothingToCompare(String),
    /// It was interrupted.
    Interrupted,
}

/// One line of comma-separated texts; quoted if necessary.
fn csv_line<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    let mut line = texts.into_iter().map(quoted).collect::<Vec<_>>().join(",");
    line.push('\n');
    line
}
