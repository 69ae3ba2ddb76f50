//! The list of warnings: each kind once, kept up to date, and withdrawn where later steps show that there was no reason for it.

use super::Warning;

/// Adds a warning unless there is one of its kind.
pub(crate) fn warn(warnings: &mut Vec<Warning>, warning: Warning) {
    if warnings.iter().all(|known| known.code() != warning.code()) {
        warnings.push(warning);
    }
}

/// Adds, updates or withdraws the warning of which `is_known` recognises the kind: `reported` makes it, given the known one, or
/// nothing if there is no reason for it any more.
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
