//! Tests of `catalogue`, a module of it.

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
