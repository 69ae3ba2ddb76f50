//! Tests of `diagnostic`, a module of it.

use lissom_core::errors::StepError;

use super::*;
use crate::RunError;
use crate::analyses::campbell::CampbellError;
use crate::analyses::modes::ModesError;

#[test]
fn what_contains_a_failure_has_its_diagnostic() {
    let step = StepError::TurnsTooFar { time: 0.5, node: "a`; b = c".to_owned(), angle: 2.0 };
    assert_eq!(RunError::Step(step.clone()).diagnostic(), step.diagnostic());
    let error = CampbellError::Modes {
        path: "parameters.speed".to_owned(),
        value: 3.0,
        error: Box::new(ModesError::Step(step)),
    };
    let remedy = "use a smaller step, or set `relative_tolerance`";
    let values = json!({ "node": "a`; b = c", "angle": 2.0 });
    let expected = json!({
        "code": "rotation-per-step", "cause": error.diagnostic().cause, "time": 0.5, "part": "a`; b = c", "kind": "node", "values": values, "remedy": remedy,
    });
    assert_eq!(facts(&error), expected);
}

#[test]
fn failures_of_requests_have_codes_values_and_remedies() {
    let error = ModesError::Time { time: 0.5, reason: "a reason".to_owned() };
    let expected = json!({
        "code": "linearization-time", "cause": "the model cannot be linearised at t = 0.5 s: a reason", "time": 0.5, "part": null, "kind": null, "values": { "reason": "a reason" },
        "remedy": "choose a time of the analysis, `static` or `undeformed`",
    });
    assert_eq!(facts(&error), expected);
    let words = "the model cannot be linearised at t = 0.5 s: a reason; choose a time of the analysis, `static` or `undeformed`";
    assert_eq!(error.to_string(), words);
    let wrong = crate::Model::from_text("a.toml", "lissom = 1\ngravitiy = 1\n").document().unwrap_err();
    let diagnostic = wrong.diagnostic();
    assert_eq!((diagnostic.code, diagnostic.cause.as_str()), ("model-file", wrong.to_string().as_str()));
    assert!(!diagnostic.remedy.is_empty());
    let wrapped = crate::SessionError::Model(wrong);
    assert_eq!(wrapped.diagnostic(), diagnostic);
}
