//! Diagnostics of analyses and runs: their contents, and the catalogue of all codes.

use lissom_core::diagnostics::{Diagnose, Diagnostic, Entry, Value};
use serde_json::json;

use crate::buckling::BucklingRunError;
use crate::campbell::CampbellError;
use crate::gradient::{self, GradientError};
use crate::modes::ModesError;
use crate::path::{PathRunError, PathSessionError};
use crate::report::RunError;
use crate::response::FrequencyError;
use crate::session::SessionError;

/// All codes of warnings and failures, with their meaning.
pub fn catalogue() -> impl Iterator<Item = &'static Entry> {
    lissom_core::catalogue::entries().chain(gradient::ENTRIES)
}

/// A failure for `summary.json`, without the message.
pub(crate) fn facts(error: &impl Diagnose) -> serde_json::Value {
    let diagnostic = error.diagnostic();
    let value = |(name, value): &(&str, Value)| {
        let value = match value {
            Value::Number(number) => json!(number),
            Value::Count(count) => json!(count),
            Value::Flag(flag) => json!(flag),
            Value::Text(text) => json!(text),
        };
        ((*name).to_owned(), value)
    };
    let values: serde_json::Map<_, _> = diagnostic.values.iter().map(value).collect();
    json!({
        "code": diagnostic.code,
        "time": diagnostic.time,
        "part": diagnostic.part(),
        "kind": diagnostic.subject.as_ref().map(|subject| &subject.kind).filter(|kind| !kind.is_empty()),
        "values": values,
        "remedy": diagnostic.remedy(),
    })
}

impl Diagnose for SessionError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Initial(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for RunError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Step(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for ModesError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Initial(error) => error.diagnostic(),
            Self::Step(error) => error.diagnostic(),
            Self::Steady(error) => error.diagnostic(),
            Self::Linear(error) => error.diagnostic(),
            Self::Mode(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for FrequencyError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::State(error) => error.diagnostic(),
            Self::Response { error, .. } => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for BucklingRunError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Path(error) => error.diagnostic(),
            Self::Linear(error) => error.diagnostic(),
            Self::Buckling(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for GradientError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Initial(error) => error.diagnostic(),
            Self::Step(error) => error.diagnostic(),
            Self::Denied { .. } => {
                Diagnostic { code: Some(gradient::REFUTED), ..Diagnostic::uncatalogued(self) }
            }
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for CampbellError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Modes { error, .. } => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for PathRunError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Path(error) => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

impl Diagnose for PathSessionError {
    fn diagnostic(&self) -> Diagnostic {
        match self {
            Self::Start(error) | Self::NotLoaded { error, .. } => error.diagnostic(),
            _ => Diagnostic::uncatalogued(self),
        }
    }
}

#[cfg(test)]
mod tests {
    use lissom_core::analysis::StepError;

    use super::*;

    #[test]
    fn what_contains_a_failure_has_its_diagnostic() {
        let step = StepError::TurnsTooFar { time: 0.5, node: "a`; b = c".to_owned(), angle: 2.0 };
        assert_eq!(RunError::Step(step.clone()).diagnostic(), step.diagnostic());
        let facts = facts(&CampbellError::Modes {
            path: "parameters.speed".to_owned(),
            value: 3.0,
            error: Box::new(ModesError::Step(step)),
        });
        let remedy = "take a smaller step, or set `relative_tolerance`";
        let values = json!({ "node": "a`; b = c", "angle": 2.0 });
        let expected = json!({
            "code": "rotation-per-step", "time": 0.5, "part": "a`; b = c", "kind": "node", "values": values, "remedy": remedy,
        });
        assert_eq!(facts, expected);
    }

    #[test]
    fn codes_are_distinct() {
        let codes: std::collections::BTreeSet<&str> = catalogue().map(|entry| entry.code).collect();
        assert_eq!(codes.len(), catalogue().count());
    }
}
