//! What a failure says, taken apart for programs: the message, when and where the trouble is, what to try.

use std::fmt::Display;

use lissom_core::analysis::path::PathError;
use lissom_core::analysis::{InitialError, InputError, StepError, Whereabouts};
use lissom_core::linear::{BucklingError, LinearError, ModeError, ResponseError, SteadyError};
use serde_json::{Value, json};

use crate::buckling::BucklingRunError;
use crate::campbell::CampbellError;
use crate::gradient::GradientError;
use crate::modes::ModesError;
use crate::path::{PathRunError, PathSessionError};
use crate::report::RunError;
use crate::response::FrequencyError;
use crate::session::SessionError;

/// A failure, taken apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// The message, which says all of it.
    pub text: String,
    /// Time [s], where there is one.
    pub time: Option<f64>,
    /// Name of the entry, node or signal that is blamed first.
    pub part: Option<String>,
    /// What to try.
    pub remedy: Option<String>,
}

impl Diagnosis {
    /// What `error` says.
    pub fn of(error: &(impl Located + Display)) -> Self {
        let Whereabouts { time, part } = error.whereabouts();
        Self { time, part: part.map(str::to_owned), ..Self::of_text(&error.to_string()) }
    }

    /// What a message alone contains: a remedy stands behind its first semicolon.
    pub fn of_text(text: &str) -> Self {
        let remedy = text.split_once("; ").map(|(_, remedy)| remedy.trim_end_matches(')').to_owned());
        Self { text: text.to_owned(), time: None, part: None, remedy }
    }

    /// For `summary.json`, without the message.
    pub(crate) fn to_value(&self) -> Value {
        json!({ "time": self.time, "part": self.part, "remedy": self.remedy })
    }
}

/// An error that may know when and where the trouble is.
pub trait Located {
    /// When and where.
    fn whereabouts(&self) -> Whereabouts<'_>;
}

impl Located for StepError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        StepError::whereabouts(self)
    }
}

impl Located for InitialError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        InitialError::whereabouts(self)
    }
}

impl Located for InputError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Initial(error) => error.whereabouts(),
            Self::Signal(error) => Whereabouts { time: Some(error.time), part: Some(error.part()) },
            _ => Whereabouts::default(),
        }
    }
}

impl Located for LinearError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Rolls { joint } => Whereabouts { time: None, part: Some(joint) },
            Self::Latched { coordinate } => Whereabouts { time: None, part: Some(coordinate) },
            Self::Factor { time, unknown, .. } => {
                Whereabouts { time: Some(*time), part: unknown.split('`').nth(1) }
            }
            Self::Accelerations { time, error } => {
                Whereabouts { time: Some(*time), part: error.whereabouts().part }
            }
            _ => Whereabouts::default(),
        }
    }
}

impl Located for SteadyError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Linear(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for ModeError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Linear(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for BucklingError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Linear(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for PathError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Start(error) | Self::Lost { error, .. } => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

impl Located for SessionError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Initial(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for RunError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Step(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for ModesError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Initial(error) => error.whereabouts(),
            Self::Step(error) => error.whereabouts(),
            Self::Steady(error) => error.whereabouts(),
            Self::Linear(error) => error.whereabouts(),
            Self::Mode(error) => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

impl Located for FrequencyError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::State(error) => error.whereabouts(),
            Self::Response { error: ResponseError::Linear { error, .. }, .. } => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

impl Located for BucklingRunError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Path(error) => error.whereabouts(),
            Self::Linear(error) => error.whereabouts(),
            Self::Buckling(error) => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

impl Located for GradientError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Initial(error) => error.whereabouts(),
            Self::Step(error) => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

impl Located for CampbellError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Modes { error, .. } = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for PathRunError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        if let Self::Path(error) = self { error.whereabouts() } else { Whereabouts::default() }
    }
}

impl Located for PathSessionError {
    fn whereabouts(&self) -> Whereabouts<'_> {
        match self {
            Self::Start(error) | Self::NotLoaded { error, .. } => error.whereabouts(),
            _ => Whereabouts::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_taken_apart() {
        let step = StepError::TurnsTooFar { time: 0.5, node: "rotor".to_owned(), angle: 2.0 };
        let found = Diagnosis::of(&RunError::Step(step.clone()));
        assert_eq!((found.time, found.part.as_deref()), (Some(0.5), Some("rotor")));
        assert_eq!(found.remedy.as_deref(), Some("take a smaller step, or set `relative_tolerance`"));
        assert_eq!(found.text, step.to_string());
        let nested = CampbellError::Modes {
            path: "parameters.speed".to_owned(),
            value: 3.0,
            error: Box::new(ModesError::Step(step)),
        };
        assert_eq!(Diagnosis::of(&nested).part.as_deref(), Some("rotor"));
        assert_eq!(Diagnosis::of_text("no remedy").remedy, None);
    }
}
