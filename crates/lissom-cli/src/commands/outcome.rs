//! Exit codes, failures and warnings of a command.

use lissom::{CommandError, Diagnose, Diagnostic, Document, Report, with_code};

use super::terminal;

/// Exit code of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Success.
    Done,
    /// The model or the command line is invalid.
    BadModel,
    /// There is no solution, or it cannot be written.
    Failed,
    /// Ctrl-C.
    Interrupted,
}

impl Exit {
    /// The exit code.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::BadModel => 2,
            Self::Failed => 3,
            Self::Interrupted => 130,
        }
    }
}

/// The failure of a command: exit code and message.
pub(crate) struct Failure {
    pub(super) exit: Exit,
    pub(super) words: String,
}

impl Failure {
    /// A failure with its code.
    pub(super) fn new(exit: Exit, error: &impl Diagnose) -> Self {
        Self::with_details(exit, &error.diagnostic(), "")
    }

    /// Arguments that do not match each other or what they name.
    pub(super) fn request(reason: impl Into<String>) -> Self {
        Self::new(Exit::BadModel, &CommandError::Request(reason.into()))
    }

    /// A failure with its code. The lines `details` follow the message.
    pub(super) fn with_details(exit: Exit, diagnostic: &Diagnostic, details: &str) -> Self {
        let explained = explained(diagnostic.code);
        let remedy = diagnostic.remedy().map_or_else(String::new, |remedy| format!("  remedy: {remedy}\n"));
        Self { exit, words: format!("error: {}\n{remedy}{details}{explained}", diagnostic.cause) }
    }
}

impl From<Report> for Failure {
    fn from(report: Report) -> Self {
        let explained = explained(report.diagnostic().code);
        let words = report.render(terminal::in_colour()) + &format!("{report}\n{explained}");
        Self { exit: Exit::BadModel, words }
    }
}

/// The command that explains a code, as a line below a message.
fn explained(code: &str) -> String {
    format!("  `lissom explain {code}` explains it\n")
}

/// Shows a warning with its code on the terminal.
pub(super) fn warn(warning: &impl Diagnose) {
    terminal::complain(&format!("warning: {}\n", with_code(warning)));
}

/// The warnings of a model, on the terminal.
pub(super) fn show_warnings(document: &Document) {
    if !document.warnings.is_empty() {
        terminal::complain(&document.warnings.render(terminal::in_colour()));
    }
}
