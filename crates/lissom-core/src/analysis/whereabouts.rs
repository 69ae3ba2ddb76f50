//! When and where an error says that the trouble is, for programs that take it apart.

use super::{InitialError, StepError};

/// Where the trouble is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Whereabouts<'e> {
    /// Time [s], where there is one.
    pub time: Option<f64>,
    /// Name of the entry, node or signal that the message blames first.
    pub part: Option<&'e str>,
}

/// The first name in a sentence.
fn named(words: &str) -> Option<&str> {
    words.split('`').nth(1)
}

impl StepError {
    /// When and where.
    pub fn whereabouts(&self) -> Whereabouts<'_> {
        let (time, part) = match self {
            Self::NotConverged { time, worst, .. } | Self::NotFinite { time, worst, .. } => {
                (*time, named(worst))
            }
            Self::TooInaccurate { time, .. }
            | Self::EnergyFromNowhere { time, .. }
            | Self::Interrupted { time } => (*time, None),
            Self::Chatters { time, what } => (*time, named(what)),
            Self::NoTime { .. } => return Whereabouts::default(),
            Self::Signal(error) => (error.time, Some(error.part())),
            Self::Contradiction { time, violated } => (*time, named(violated)),
            Self::TurnsTooFar { time, node, .. } => (*time, Some(node.as_str())),
            Self::ElementTurns { time, nodes, .. } => (*time, Some(nodes[0].as_str())),
            Self::Velocities { time, error } => (*time, error.whereabouts().part),
            Self::ZeroPivot { time, unknown, .. } => (*time, named(unknown)),
        };
        Whereabouts { time: Some(time).filter(|time| time.is_finite()), part }
    }
}

impl InitialError {
    /// Where, and when where that is known.
    pub fn whereabouts(&self) -> Whereabouts<'_> {
        let part = match self {
            Self::NoEquilibrium(error) | Self::Wrapped(error) => return error.whereabouts(),
            Self::Signal(error) => {
                return Whereabouts { time: Some(error.time), part: Some(error.part()) };
            }
            Self::ZeroPivot { unknown, .. } | Self::NotFinite { unknown } => named(unknown),
            Self::StateInStatics(words) => named(words),
            Self::VelocityImpossible { part, .. } => Some(part.as_str()),
            Self::RatesContradict { violated } => named(violated),
        };
        Whereabouts { time: None, part }
    }
}

impl crate::signals::SignalError {
    /// Name of the signal without the marks around it.
    fn part(&self) -> &str {
        self.name.trim_matches('`')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_that_is_blamed_stands_in_marks() {
        let error = StepError::NotConverged {
            time: 0.5,
            iterations: 3,
            correction: 1.0,
            worst: "translation 1 of node `bar.2`".to_owned(),
            hint: "",
        };
        assert_eq!(error.whereabouts(), Whereabouts { time: Some(0.5), part: Some("bar.2") });
        let initial = InitialError::NoEquilibrium(Box::new(error));
        assert_eq!(initial.whereabouts().part, Some("bar.2"));
        let inaccurate = StepError::TooInaccurate { time: 0.25, size: 1e-9 };
        assert_eq!(inaccurate.whereabouts(), Whereabouts { time: Some(0.25), part: None });
        assert!(inaccurate.to_string().contains('`'), "a key of the model file is no part");
    }
}
