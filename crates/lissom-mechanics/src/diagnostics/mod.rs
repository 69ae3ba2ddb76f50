//! Diagnostics: the contents of warnings and failures.

pub mod catalogued;

use std::fmt::{self, Display};

use crate::kinematics::Subject;

/// Severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// A result may be inaccurate.
    Warning,
    /// There is no result.
    Failure,
}

/// A code with its explanation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Short name for scripts.
    pub code: &'static str,
    /// Name of the variant.
    pub variant: &'static str,
    /// Whether it is a warning.
    pub severity: Severity,
    /// Message of the diagnostic, with placeholders of values in braces.
    pub message: &'static str,
    /// Meaning of the diagnostic.
    pub meaning: &'static str,
    /// General remedy: a sentence, or that of its messages.
    pub advice: &'static str,
}

impl Entry {
    /// The general remedy as a sentence.
    pub fn advice(&self) -> String {
        let (first, rest) = self.advice.split_at(self.advice.chars().next().map_or(0, char::len_utf8));
        let end = if rest.ends_with('.') { "" } else { "." };
        format!("{}{rest}{end}", first.to_uppercase())
    }
}

/// A value of a diagnostic, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// An integer.
    Count(usize),
    /// A truth value.
    Flag(bool),
    /// Words or a name.
    Text(String),
}

/// A warning or failure, for programs. It is rendered as "cause; remedy".
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Code of the diagnostic in the catalogue.
    pub code: &'static str,
    /// Whether it is a warning.
    pub severity: Severity,
    /// Time [s], if there is one.
    pub time: Option<f64>,
    /// Subject of the diagnostic.
    pub subject: Option<Subject>,
    /// Values by name, without the time.
    pub values: Vec<(&'static str, Value)>,
    /// The event and its cause.
    pub cause: String,
    /// The remedy; may be empty.
    pub remedy: String,
}

/// A type of warning or failure.
pub trait Diagnose {
    /// Code, time, subject, values, cause and remedy.
    fn diagnostic(&self) -> Diagnostic;
}

impl Diagnose for Diagnostic {
    fn diagnostic(&self) -> Diagnostic {
        self.clone()
    }
}

impl Diagnostic {
    /// A diagnostic of an entry without values.
    pub fn of(entry: &Entry, cause: impl Into<String>, remedy: impl Into<String>) -> Self {
        crate::diagnostics::catalogued::diagnostic(entry, Vec::new(), cause.into(), remedy.into())
    }

    /// This diagnostic in a wider context: `context` precedes the cause.
    #[must_use]
    pub fn within(self, context: &str) -> Self {
        Self { cause: format!("{context}: {}", self.cause), ..self }
    }

    /// This diagnostic at a time [s].
    #[must_use]
    pub fn at(self, time: f64) -> Self {
        Self { time: Some(time), ..self }
    }

    /// Name of the entry that is its subject.
    pub fn part(&self) -> Option<&str> {
        self.subject.as_ref().and_then(Subject::entry)
    }

    /// The remedy, if there is one.
    pub fn remedy(&self) -> Option<&str> {
        Some(self.remedy.as_str()).filter(|remedy| !remedy.is_empty())
    }
}

impl Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.cause)?;
        self.remedy().map_or(Ok(()), |remedy| write!(f, "; {remedy}"))
    }
}

macro_rules! value_from {
    ($($type:ty, $own:ident => $value:expr;)*) => {
        $(impl From<&$type> for Value {
            fn from($own: &$type) -> Self {
                $value
            }
        })*
    };
}

value_from! {
    f64, own => Self::Number(*own);
    u32, own => Self::Count(*own as usize);
    usize, own => Self::Count(*own);
    bool, own => Self::Flag(*own);
    String, own => Self::Text(own.clone());
    &'static str, own => Self::Text((*own).to_owned());
    Subject, own => Self::Text(own.to_string());
    [String; 2], own => Self::Text(own.join(", "));
    std::io::Error, own => Self::Text(own.to_string());
    num_complex::Complex64, own => Self::Text(own.to_string());
    crate::registry::ParameterError, own => Self::Text(own.to_string());
}
