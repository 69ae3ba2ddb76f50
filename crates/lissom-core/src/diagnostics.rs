//! Diagnostics: the contents of warnings and failures, and the table of their codes.
//!
//! An enumeration in `diagnostics!` is a part of the catalogue: each variant states, in one place, its values, code, time,
//! subject, cause, remedy and explanation. A new warning is a new variant.

pub use lissom_mechanics::diagnostics::{Diagnose, Diagnostic, Entry, Severity, Value, catalogued};

/// Defines an enumeration of warnings or failures with its entries of the catalogue.
///
/// After the values of a variant, by reference: its code, its time and subject if it has them, the message with its arguments,
/// the remedy, and for the catalogue its meaning, and a general remedy if it differs. A section `wraps` has variants that contain another
/// diagnostic.
macro_rules! diagnostics {
    (
        $(#[$meta:meta])*
        $severity:ident $name:ident {
            $(
                $(#[$doc:meta])*
                $variant:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* } => $code:literal {
                    $(time: $time:expr,)?
                    $(subject: $subject:expr,)?
                    cause: ($message:literal $(, $argument:expr)*),
                    remedy: $remedy:literal,
                    meaning: $meaning:literal,
                    $(advice: $advice:literal,)?
                }
            )*
        }
        $(wraps {
            $(
                $(#[$wrap_doc:meta])*
                $wrap:ident $wrapped:tt, $pattern:tt => $made:expr,
            )*
        })?
    ) => {
        $(#[$meta])*
        pub enum $name {
            $($(#[$doc])* $variant { $($(#[$field_doc])* $field: $type,)* },)*
            $($($(#[$wrap_doc])* $wrap $wrapped,)*)?
        }

        impl $name {
            /// Their entries of the catalogue.
            pub const ENTRIES: &'static [$crate::diagnostics::Entry] = &[
                $($crate::diagnostics::Entry {
                    code: $code,
                    variant: concat!(stringify!($name), "::", stringify!($variant)),
                    severity: $crate::diagnostics::Severity::$severity,
                    message: $message,
                    meaning: $meaning,
                    advice: [$($advice,)? $remedy][0],
                },)*
            ];

            /// A short name for scripts.
            pub fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $code,)*
                    $($(Self::$wrap { .. } => {
                        $crate::diagnostics::Diagnose::diagnostic(self).code
                    })*)?
                }
            }

            /// One of each variant that wraps no other diagnostic.
            #[cfg(test)]
            pub(crate) fn samples() -> Vec<Self> {
                vec![$(Self::$variant { $($field: $crate::diagnostics::tests::Sample::sample(),)* },)*]
            }
        }

        impl $crate::diagnostics::Diagnose for $name {
            fn diagnostic(&self) -> $crate::diagnostics::Diagnostic {
                match self {
                    $(Self::$variant { $($field),* } => {
                        let values = [$((stringify!($field), $crate::diagnostics::Value::from($field))),*];
                        let time = [$($time)?].into_iter().next().filter(|time: &f64| time.is_finite());
                        let subject = [$($crate::kinematics::Subject::from($subject))?].into_iter().next();
                        $crate::number::as_written!($($field),*);
                        $crate::diagnostics::Diagnostic {
                            code: $code,
                            severity: $crate::diagnostics::Severity::$severity,
                            time,
                            subject,
                            values: values.into_iter().filter(|(name, _)| *name != "time").collect(),
                            cause: format!($message $(, $argument)*),
                            remedy: format!($remedy),
                        }
                    })*
                    $($(Self::$wrap $pattern => $made,)*)?
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                std::fmt::Display::fmt(&$crate::diagnostics::Diagnose::diagnostic(self), f)
            }
        }

        impl std::error::Error for $name {}
    };
}

pub(crate) use diagnostics;

#[cfg(test)]
#[path = "../tests/unit/diagnostics.rs"]
pub(crate) mod tests;
