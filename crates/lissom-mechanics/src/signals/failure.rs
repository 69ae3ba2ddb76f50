//! The failure of a signal.

use crate::diagnostics::{Diagnose, Diagnostic, Entry, Severity, Value};
use crate::number::Written;
use crate::signals::SignalError;

/// Catalogue entry of a signal that is not finite.
pub const ENTRY: Entry = Entry {
    code: "signal-not-finite",
    variant: "SignalError",
    severity: Severity::Failure,
    message: "signal {signal} is {value} at t = {time} s: an argument is outside of what its functions allow",
    meaning: "A signal is not finite: a root of a negative number, a division by zero.",
    advice: "Restrict the argument, for example by `max(…, 0)` or `clamp`, or end the run before.",
};

impl Diagnose for SignalError {
    fn diagnostic(&self) -> Diagnostic {
        let Self { signal, value, time } = self;
        Diagnostic {
            code: ENTRY.code,
            severity: ENTRY.severity,
            time: Some(*time),
            subject: Some(signal.clone()),
            values: vec![("value", Value::Number(*value))],
            cause: format!(
                "signal {signal} is {value} at t = {} s: an argument is outside of what its functions allow",
                Written(*time)
            ),
            remedy: "restrict it, for example by `max(…, 0)` under a root or `clamp`, or end the run before"
                .to_owned(),
        }
    }
}
