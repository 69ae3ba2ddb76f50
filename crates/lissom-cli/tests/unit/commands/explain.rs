//! Tests of `commands::explain`, a module of it.

use super::*;

#[test]
fn entries_are_found_by_code_and_by_words() {
    assert!(find("jump").is_some() && find("rotation-per-step").is_some() && find("all is well").is_none());
    let of = |words: &str| {
        catalogue().filter(|entry| has(entry, words)).map(|entry| entry.code).collect::<Vec<_>>()
    };
    assert!(of("did not converge").contains(&"not-converged"));
    assert_eq!(of("all is well"), [""; 0]);
}
