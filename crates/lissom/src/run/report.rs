//! Report of a run.

use lissom_core::diagnostics::Diagnose;
use std::io;
use std::time::Duration;

use lissom_core::elements::Energy;
use lissom_core::errors::StepError;
use lissom_core::settings::Totals;

use serde::{Deserialize, Serialize};

use super::timings::Seconds;

/// Why a run ended early.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// A step has no solution.
    #[error(transparent)]
    Step(#[from] StepError),
    /// A writer failed.
    #[error("{}", self.diagnostic())]
    Write(#[from] io::Error),
}

/// End of a run.
#[derive(Debug)]
pub enum Stopped {
    /// At its planned end.
    End,
    /// Because it was interrupted.
    Interrupted,
    /// Because of a failure.
    Failed(RunError),
}

impl Stopped {
    /// The word in the summary.
    pub fn name(&self) -> &'static str {
        match self {
            Self::End => "end",
            Self::Interrupted => "interrupted",
            Self::Failed(_) => "failed",
        }
    }
}

/// Energies at the first and last recorded instant, and the largest change between.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyChange {
    /// At the first record [J].
    pub start: Energy,
    /// At the last record [J].
    pub end: Energy,
    /// Largest difference of the total from its start, over all records [J].
    pub largest: f64,
}

/// Result of a run.
#[derive(Debug)]
pub struct RunReport {
    /// How it ended.
    pub stopped: Stopped,
    /// Time reached [s].
    pub time: f64,
    /// Rows recorded.
    pub records: usize,
    /// Counts over all steps.
    pub totals: Totals,
    /// Time from before the initial values to the last record.
    pub wall: Duration,
    /// Time of steps only, without initial values, outputs and writing.
    pub solving: Duration,
    /// Time by kind of work.
    pub seconds: Seconds,
    /// Largest violation of a constraint, evaluated from absolute positions, over all records [m, rad].
    pub violation: f64,
    /// Energy over all records.
    pub energy: EnergyChange,
    /// Condition numbers of the tangents in use after the first step and at the end, estimated in the 1-norm; none
    /// after a step that failed.
    pub conditions: [Option<f64>; 2],
}

impl RunReport {
    /// Whether the planned end was reached.
    pub fn is_complete(&self) -> bool {
        matches!(self.stopped, Stopped::End)
    }

    /// Why it failed, if it did.
    pub fn error(&self) -> Option<&RunError> {
        match &self.stopped {
            Stopped::Failed(error) => Some(error),
            _ => None,
        }
    }
}
