//! The list of warnings: each kind once, updated, and withdrawn if later steps show that it was unjustified.

use super::Warning;

/// Adds a warning unless there is one of its kind.
pub(crate) fn warn(warnings: &mut Vec<Warning>, warning: Warning) {
    if warnings.iter().all(|known| known.code() != warning.code()) {
        warnings.push(warning);
    }
}

/// Reports a warning with the time of its first report, and withdraws it if it is not noteworthy.
macro_rules! report_since {
    ($warnings:expr, $now:expr, $is_noteworthy:expr, $kind:ident { $($values:tt)* }) => {
        $crate::errors::report(
            $warnings,
            |warning| matches!(warning, Warning::$kind { .. }),
            |known| {
                let time = match known {
                    Some(Warning::$kind { time, .. }) => *time,
                    _ => $now,
                };
                $is_noteworthy.then(|| Warning::$kind { time, $($values)* })
            },
        )
    };
}

pub(crate) use report_since;

/// Adds, updates or withdraws the warning whose kind `is_known` recognises. `reported` returns the new warning, given the known
/// one, or none if there is no longer a cause.
pub(crate) fn report(
    warnings: &mut Vec<Warning>,
    is_known: impl Fn(&Warning) -> bool,
    reported: impl FnOnce(Option<&Warning>) -> Option<Warning>,
) {
    let known = warnings.iter().position(is_known);
    match (known, reported(known.map(|known| &warnings[known]))) {
        (Some(known), Some(warning)) => warnings[known] = warning,
        (None, Some(warning)) => warnings.push(warning),
        (Some(known), None) => {
            warnings.remove(known);
        }
        (None, None) => {}
    }
}
