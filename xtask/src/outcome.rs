//! Results of a verification: rows of the report. Independent of files.

use std::time::Duration;

use lissom_model::output::Figure;

/// How a row or a case ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Within its tolerance.
    Pass,
    /// Not within its tolerance, without a stated reason.
    Fail(String),
    /// Not verified yet, for this reason.
    Open(String),
    /// Passes although it is listed as open.
    PassesThoughOpen(String),
    /// Something it needs is not there.
    Skipped(String),
}

impl Verdict {
    /// The verdict of a comparison; `open` is the reason why it may fail.
    pub(crate) fn of(passed: bool, words: impl Into<String>, open: Option<&str>) -> Self {
        match (passed, open) {
            (true, None) => Self::Pass,
            (true, Some(reason)) => Self::PassesThoughOpen(reason.to_owned()),
            (false, None) => Self::Fail(words.into()),
            (false, Some(reason)) => {
                let words: String = words.into();
                Self::Open(if words.is_empty() {
                    reason.to_owned()
                } else {
                    format!("{reason} (now: {words})")
                })
            }
        }
    }

    /// One word.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Pass | Self::PassesThoughOpen(_) => "pass",
            Self::Fail(_) => "**FAIL**",
            Self::Open(_) => "open",
            Self::Skipped(_) => "skipped",
        }
    }
}

/// One comparison.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Compared quantity.
    pub(crate) quantity: String,
    /// With whom.
    pub(crate) against: String,
    /// The reference, in words.
    pub(crate) reference: String,
    /// Our value, in words.
    pub(crate) ours: String,
    /// Relative difference.
    pub(crate) difference: Option<f64>,
    /// Allowed relative difference.
    pub(crate) tolerance: String,
    /// How good the reference is, relative to the same scale.
    pub(crate) uncertainty: String,
    /// Mesh and step.
    pub(crate) grid: String,
    /// Time taken by the run.
    pub(crate) wall: Option<Duration>,
    /// How it ended.
    pub(crate) verdict: Verdict,
    /// Whether the digits count in the summary.
    pub(crate) is_comparison: bool,
}

impl Row {
    /// Digits that agree, at most 16.
    pub(crate) fn digits(&self) -> Option<f64> {
        self.difference.map(digits)
    }
}

/// Digits for a relative difference.
pub(crate) fn digits(difference: f64) -> f64 {
    (-difference.max(1e-16).log10()).max(0.0)
}

/// A whole case.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// Index among the cases.
    pub(crate) index: usize,
    /// Rows of the case.
    pub(crate) rows: Vec<Row>,
    /// Plots of the case.
    pub(crate) figures: Vec<Figure>,
    /// Time taken by all its runs.
    pub(crate) wall: Duration,
    /// Sentences about tolerances.
    pub(crate) because: Vec<String>,
}

impl Outcome {
    /// Whether any row failed without a reason.
    pub(crate) fn has_failed(&self) -> bool {
        self.rows.iter().any(|row| matches!(row.verdict, Verdict::Fail(_)))
    }
}
