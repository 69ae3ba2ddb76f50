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

/// Whom an expression belongs to: `push` of "`scale` of load `push` = t", `pull` of "pull = t".
fn owner(words: &str) -> Option<&str> {
    match words.split_once(" = ") {
        Some((name, _)) if !name.contains('`') => Some(name),
        Some((name, _)) => name.rsplit('`').nth(1),
        None if words.contains("` of ") => words.rsplit('`').nth(1),
        None => named(words),
    }
}

/// The first name in a sentence.
fn named(words: &str) -> Option<&str> {
    words.split('`').nth(1)
}

impl StepError {
    /// When and where.
    pub fn whereabouts(&self) -> Whereabouts<'_> {
        let (time, part) = match self {
            Self::NotConverged { time, worst: words, .. }
            | Self::NotFinite { time, worst: words, .. }
            | Self::TooInaccurate { time, unknown: words, .. }
            | Self::ZeroPivot { time, unknown: words, .. }
            | Self::Contradiction { time, violated: words }
            | Self::LoopIsSingular { time, joints: words, .. } => (*time, named(words)),
            Self::FunctionNotFinite { time, what, .. }
            | Self::Chatters { time, what }
            | Self::Switches { time, what } => (*time, owner(what)),
            Self::JointLosesHold { time, joint: part, .. }
            | Self::BeyondBeam { time, joint: part, .. }
            | Self::EnergyFromNowhere { time, node: part, .. }
            | Self::NegativeKineticEnergy { time, interface: part }
            | Self::TurnsTooFar { time, node: part, .. }
            | Self::ElementTurns { time, nodes: [part, _], .. } => (*time, Some(part.as_str())),
            Self::Interrupted { time } => (*time, None),
            Self::NoTime { .. } => return Whereabouts::default(),
            Self::Signal(error) => (error.time, Some(error.part())),
            Self::Velocities { time, error } => (*time, error.whereabouts().part),
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
            Self::StateInStatics(words) | Self::Free { free: words } => named(words),
            Self::VelocityImpossible { part, .. } => Some(part.as_str()),
            Self::RatesContradict { violated, .. } => named(violated),
            Self::NormalForces { .. } => None,
        };
        Whereabouts { time: None, part }
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
        let stopped = StepError::Interrupted { time: 0.25 };
        assert_eq!(stopped.whereabouts(), Whereabouts { time: Some(0.25), part: None });
        let unknown = "translation 1 of node `bar.3`".to_owned();
        let inaccurate = StepError::TooInaccurate { time: 0.25, size: 1e-9, unknown };
        assert_eq!(inaccurate.whereabouts().part, Some("bar.3"), "a key of the model file is no part");
    }
}
