use super::*;
use crate::simulation::joint_space::JointSpaceError;
use num_complex::Complex64;

use crate::assembly::{AssemblyError, Gap, Gaps};
use crate::errors::Warning;
use crate::errors::{InitialError, StepError};
use crate::kinematics::Subject;
use crate::linearized::{
    BucklingError, LinearError, ModeError, ReductionError, ResponseError, StateSpaceError, SteadyError,
};
use crate::path::PathError;
use crate::simulation::InputError;
use crate::simulation::SnapshotError;

/// A name with all characters that separate parts of sentences.
const NAME: &str = "a`; b` = c: d";

/// A value for any field.
pub(crate) trait Sample {
    fn sample() -> Self;
}

macro_rules! sample {
    ($($type:ty => $value:expr;)*) => {
        $(impl Sample for $type {
            fn sample() -> Self {
                $value
            }
        })*
    };
}

sample! {
    f64 => 0.25;
    Complex64 => Complex64::new(0.0, 2.0);
    StepError => StepError::TurnsTooFar { time: 0.25, node: NAME.to_owned(), angle: 2.0 };
    Gaps => Gaps(vec![Gap { joint: NAME.to_owned(), distance: Some(0.25), angle: None }]);
    usize => 3;
    u32 => 3;
    bool => true;
    String => NAME.to_owned();
    &'static str => "try this";
    Subject => Subject::new("node", NAME).component("translation 1");
    [String; 2] => [NAME.to_owned(), "other".to_owned()];
}

/// Diagnostics of assembly, paths and linear models.
fn of_analyses() -> impl Iterator<Item = Diagnostic> {
    fn of<E: Diagnose>(samples: &[E]) -> Vec<Diagnostic> {
        samples.iter().map(E::diagnostic).collect()
    }
    let parts = [
        of(&AssemblyError::samples()),
        of(&JointSpaceError::samples()),
        of(&PathError::samples()),
        of(&LinearError::samples()),
        of(&ModeError::samples()),
        of(&SteadyError::samples()),
        of(&BucklingError::samples()),
        of(&ReductionError::samples()),
        of(&ResponseError::samples()),
        of(&StateSpaceError::samples()),
        of(&SnapshotError::samples()),
    ];
    parts.into_iter().flatten()
}

/// All diagnostics that wrap no other one.
fn all() -> Vec<Diagnostic> {
    fn of<E: Diagnose>(samples: &[E]) -> impl Iterator<Item = Diagnostic> {
        samples.iter().map(E::diagnostic)
    }
    let signal = crate::signals::SignalError {
        signal: Subject::new("signal", NAME).called(format!("{NAME} = 1/t")),
        value: f64::INFINITY,
        time: 0.25,
    };
    of(&Warning::samples())
        .chain(of(&StepError::samples()))
        .chain(of(&InitialError::samples()))
        .chain(of(&InputError::samples()))
        .chain([signal.diagnostic()])
        .chain(of_analyses())
        .collect()
}

#[test]
fn every_code_has_an_entry_and_every_entry_a_code() {
    let codes: Vec<&str> = crate::catalogue::entries().map(|entry| entry.code).collect();
    let made: Vec<&str> = all().iter().map(|diagnostic| diagnostic.code).collect();
    assert_eq!(made, codes);
    let distinct: std::collections::BTreeSet<&str> = codes.iter().copied().collect();
    assert_eq!(distinct.len(), codes.len(), "{codes:?}");
    for entry in crate::catalogue::entries() {
        let is_word = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(entry.code.chars().all(is_word), "{}", entry.code);
        let [meaning, advice] = [entry.meaning, &entry.advice()];
        assert!(meaning.ends_with('.') && advice.ends_with('.'), "{}", entry.code);
        assert!(!meaning.contains(" | ") && !advice.contains(" | "), "{}", entry.code);
    }
}

#[test]
fn every_diagnostic_has_time_subject_and_remedy() {
    // Diagnostics of the whole model have no subject, those before a motion no time.
    let without_subject = [
        "energy-drift",
        "energy-surplus",
        "unstable-equilibrium",
        "relaxed-equilibrium",
        "jump",
        "unresolved-rates",
        "time-not-finite",
        "interrupted",
        "normal-forces",
    ];
    let without_time = [
        "velocity-replaced",
        "starts-with-jolt",
        "reactions-not-unique",
        "model",
        "time-not-finite",
        "never-finite",
    ];
    let without_remedy = ["interrupted"];
    let codes_of_starts: Vec<&str> =
        InitialError::ENTRIES.iter().chain(InputError::ENTRIES).map(|entry| entry.code).collect();
    let of_analyses: Vec<&str> = crate::catalogue::of_analyses().map(|entry| entry.code).collect();
    for diagnostic in all() {
        let code = diagnostic.code;
        let text = diagnostic.to_string();
        assert!(text.starts_with(&diagnostic.cause) && text.ends_with(&diagnostic.remedy), "{code}");
        // Many analyses concern the whole model, at no time.
        if of_analyses.contains(&code) {
            continue;
        }
        let part = (!without_subject.contains(&code)).then_some(NAME);
        assert_eq!(diagnostic.part(), part, "{code}");
        let has_time = !without_time.contains(&code) && !codes_of_starts.contains(&code);
        assert_eq!(diagnostic.time, has_time.then_some(0.25), "{code}");
        assert_eq!(diagnostic.remedy().is_some(), !without_remedy.contains(&code), "{code}");
        assert!(!diagnostic.values.iter().any(|(name, _)| *name == "time"), "{code}");
    }
}

#[test]
fn what_wraps_a_diagnostic_adds_to_it() {
    let step = StepError::TurnsTooFar { time: 0.5, node: NAME.to_owned(), angle: 2.0 };
    let initial = InitialError::Wrapped(Box::new(step.clone()));
    assert_eq!(initial.to_string(), format!("at the start: {step}"));
    let again = StepError::Velocities { time: 0.75, error: initial };
    let diagnostic = again.diagnostic();
    assert_eq!((again.code(), diagnostic.time), ("rotation-per-step", Some(0.75)));
    assert_eq!((diagnostic.part(), &diagnostic.remedy), (Some(NAME), &step.diagnostic().remedy));
    let never = StepError::Interrupted { time: f64::NAN };
    assert_eq!(never.diagnostic().time, None, "a time that is not finite is none");
}
