//! The catalogue of all codes of warnings and failures.

use lissom_core::diagnostics::Entry;

use crate::analyses::{buckling, campbell, gradient, modes, reduce, response};
use crate::{analysis_warning, failures};

/// All codes of warnings and failures, with their meaning.
pub fn catalogue() -> impl Iterator<Item = &'static Entry> {
    let of_core = lissom_core::catalogue::entries();
    let of_model = lissom_model::failures::entries();
    of_core
        .chain(modes::ENTRIES)
        .chain(response::ENTRIES)
        .chain(buckling::ENTRIES)
        .chain(campbell::ENTRIES)
        .chain(reduce::ENTRIES)
        .chain(gradient::ENTRIES)
        .chain(analysis_warning::ENTRIES)
        .chain(of_model)
        .chain(failures::entries())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_distinct() {
        let codes: std::collections::BTreeSet<&str> = catalogue().map(|entry| entry.code).collect();
        assert_eq!(codes.len(), catalogue().count());
    }

    #[test]
    fn entries_are_sentences() {
        for entry in catalogue() {
            let [meaning, advice] = [entry.meaning, &entry.advice()];
            assert!(meaning.ends_with('.') && advice.ends_with('.'), "{}", entry.code);
            assert!(
                !meaning.contains(" | ") && !meaning.contains("  ") && !advice.contains("  "),
                "{}",
                entry.code
            );
            assert!(!entry.message.contains("  ") && !entry.message.contains('\n'), "{}", entry.code);
        }
    }
}
