//! One member of a sweep: its run and its outcome.

use std::ops::ControlFlow;

use lissom_model::sweep::SweepFile;
use lissom_model::{Document, Report, Severity};
use serde::{Deserialize, Serialize};

use super::collector::{Collector, History, windows};
use crate::run::report::Stopped;
use crate::session::{Progress, Session, SessionError};

/// State of a completed member.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MemberState {
    /// At its planned end, with all collected values.
    Solved,
    /// The values of the member result in an invalid model.
    WrongModel,
    /// It has no solution, or a collected value is not finite.
    Failed,
}

impl MemberState {
    /// The word in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::WrongModel => "wrong_model",
            Self::Failed => "failed",
        }
    }
}

/// Result of a member. Serialises with serde.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MemberOutcome {
    /// Number of the member.
    pub member: usize,
    /// State of the member.
    pub state: MemberState,
    /// The collected values, in the order of the sweep file; none for a member that is not solved.
    pub values: Vec<f64>,
    /// Time reached [s]; none if it could not start.
    pub time: Option<f64>,
    /// Steps taken.
    pub steps: usize,
    /// Largest violation of a constraint over all records [m, rad]; none if it could not start.
    pub max_constraint_violation: Option<f64>,
    /// Why it is not solved.
    pub diagnosis: Option<String>,
    /// Time of its simulation, from before the initial values to the last record [s]; not stored in a folder.
    #[serde(skip)]
    pub seconds: f64,
    /// Requested histories, up to the failure of a failed member; stored in files of their own.
    #[serde(skip)]
    pub history: Option<History>,
}

impl MemberOutcome {
    fn not_started(member: usize, state: MemberState, diagnosis: String) -> Self {
        Self {
            member,
            state,
            values: Vec::new(),
            time: None,
            steps: 0,
            max_constraint_violation: None,
            diagnosis: Some(diagnosis),
            seconds: 0.0,
            history: None,
        }
    }

    /// For a member whose values result in an invalid model.
    pub(super) fn wrong_model(member: usize, report: &Report) -> Self {
        let errors = report.problems().filter(|problem| problem.severity == Severity::Error);
        let words: Vec<String> = errors
            .map(|problem| match &problem.help {
                Some(help) => format!("{} ({help})", problem.message),
                None => problem.message.clone(),
            })
            .collect();
        Self::not_started(member, MemberState::WrongModel, words.join("; "))
    }

    /// For a member that revealed a defect of the program.
    pub(super) fn defect(member: usize, words: &str) -> Self {
        let diagnosis = format!("internal error, please report it: {words}");
        Self::not_started(member, MemberState::Failed, diagnosis)
    }
}

/// Runs a member to its end, unless interrupted.
pub(super) fn run(
    member: usize,
    document: &Document,
    file: &SweepFile,
    watch: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Option<MemberOutcome> {
    let mut session = match Session::new(document) {
        Ok(session) => session,
        Err(SessionError::Model(report)) => return Some(MemberOutcome::wrong_model(member, &report)),
        Err(error @ SessionError::NotInTime(_)) => {
            return Some(MemberOutcome::not_started(member, MemberState::WrongModel, error.to_string()));
        }
        Err(error) => {
            return Some(MemberOutcome::not_started(member, MemberState::Failed, error.to_string()));
        }
    };
    let windows = match windows(file, document) {
        Ok(windows) => windows,
        Err((collected, error)) => {
            let words = format!("window of `{}`: {}; {}", collected.name, error.message, error.remedy);
            return Some(MemberOutcome::not_started(member, MemberState::WrongModel, words));
        }
    };
    let mut collector = Collector::new(file, windows);
    let report = session.run_with(&mut [&mut collector], watch);
    collector.take_events(session.events());
    let collected = match report.stopped {
        Stopped::End => collector.values(&session.events().collect::<Vec<_>>()),
        Stopped::Interrupted => return None,
        Stopped::Failed(error) => Err(error.to_string()),
    };
    let (state, values, diagnosis) = match collected {
        Ok(values) => (MemberState::Solved, values, doubts(&session)),
        Err(diagnosis) => (MemberState::Failed, Vec::new(), Some(diagnosis)),
    };
    Some(MemberOutcome {
        member,
        state,
        values,
        time: Some(report.time).filter(|time| time.is_finite()),
        steps: report.totals.steps,
        max_constraint_violation: Some(report.violation).filter(|violation| violation.is_finite()),
        diagnosis,
        seconds: report.wall.as_secs_f64(),
        history: collector.history(),
    })
}

/// Warnings about a member that was solved.
fn doubts(session: &Session) -> Option<String> {
    let doubts: Vec<String> = session.warnings().map(|warning| format!("warning: {warning}")).collect();
    (!doubts.is_empty()).then(|| doubts.join("; "))
}
