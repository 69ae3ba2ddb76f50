//! The table of an existing enumeration of warnings or failures: code, values, cause, remedy and explanation of each variant.

use crate::diagnostics::{Diagnostic, Entry, Value};

/// A diagnostic of an entry with these values; a value `time` is its time.
pub fn diagnostic(
    entry: &Entry,
    values: Vec<(&'static str, Value)>,
    cause: String,
    remedy: String,
) -> Diagnostic {
    let time = values.iter().find_map(|(name, value)| match value {
        Value::Number(time) if *name == "time" => Some(*time),
        _ => None,
    });
    Diagnostic {
        code: entry.code,
        severity: entry.severity,
        time: time.filter(|time| time.is_finite()),
        subject: None,
        values: values.into_iter().filter(|(name, _)| *name != "time").collect(),
        cause,
        remedy,
    }
}

/// Entries of the catalogue, `ENTRIES`, and diagnostics of enumerations that are defined elsewhere. Each field of a variant is
/// followed by its name in the message and among the values. `wraps` has the variants that contain another diagnostic.
#[macro_export]
macro_rules! catalogued {
    ($($severity:ident $type:ident {
        $($variant:ident { $($field:tt => $name:ident),* } => $code:literal {
            cause: $cause:literal,
            remedy: $remedy:literal,
            meaning: $meaning:literal,
            $(advice: $advice:literal,)?
        })*
    } wraps {
        $($wrap:ident { $($wrapped:tt => $inner:ident),* } => $made:expr,)*
    })*) => {
        /// Entries of the catalogue.
        pub const ENTRIES: &[$crate::diagnostics::Entry] = &[$($($crate::diagnostics::Entry {
            code: $code,
            variant: concat!(stringify!($type), "::", stringify!($variant)),
            severity: $crate::diagnostics::Severity::$severity,
            message: $cause,
            meaning: $meaning,
            advice: [$($advice,)? $remedy][0],
        },)*)*];

        $(impl $crate::diagnostics::Diagnose for $type {
            fn diagnostic(&self) -> $crate::diagnostics::Diagnostic {
                match self {
                    $(Self::$variant { $($field: $name),* } => {
                        const ENTRY: $crate::diagnostics::Entry = $crate::diagnostics::Entry {
                            code: $code,
                            variant: concat!(stringify!($type), "::", stringify!($variant)),
                            severity: $crate::diagnostics::Severity::$severity,
                            message: $cause,
                            meaning: $meaning,
                            advice: [$($advice,)? $remedy][0],
                        };
                        let values = vec![$((stringify!($name), $crate::diagnostics::Value::from($name))),*];
                        $crate::number::as_written!($($name),*);
                        $crate::diagnostics::catalogued::diagnostic(&ENTRY, values, format!($cause), format!($remedy))
                    })*
                    $(Self::$wrap { $($wrapped: $inner),* } => $made,)*
                }
            }
        })*
    };
}
