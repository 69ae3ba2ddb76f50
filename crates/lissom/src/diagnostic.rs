//! Contents of the diagnostics of analyses and runs.

use lissom_core::diagnostics::{Diagnose, Value};
use serde_json::json;

/// A warning with its code, as in `summary.json` and on the terminal.
pub fn with_code(warning: &impl Diagnose) -> String {
    let diagnostic = warning.diagnostic();
    format!("{}: {diagnostic}", diagnostic.code)
}

/// A warning or failure, for `summary.json` and the page.
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
        "cause": diagnostic.cause,
        "time": diagnostic.time,
        "part": diagnostic.part(),
        "kind": diagnostic.subject.as_ref().map(|subject| &subject.kind).filter(|kind| !kind.is_empty()),
        "values": values,
        "remedy": diagnostic.remedy(),
    })
}

#[cfg(test)]
#[path = "../tests/unit/diagnostic.rs"]
mod tests;
