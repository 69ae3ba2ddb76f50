//! Tests of `analyses::study::scheme_words`, a module of it.

use super::*;

#[test]
fn parameters_reach_the_scheme() {
    let default = scheme_of("hht").unwrap();
    let given = scheme_of(" hht ( -0.3 ) ").unwrap();
    assert_ne!(default, given);
    assert_eq!(given.name, scheme_of("hht(-0.30)").unwrap().name);
    for word in ["generalized-alpha(0.8)", "energy-decaying(0.0)", "radau-iia"] {
        assert!(scheme_of(word).is_ok(), "{word}");
    }
    assert_eq!(scheme_of("generalized-alpha(0.8)").unwrap(), scheme_of("generalized-alpha").unwrap());
}

#[test]
fn wrong_words_report_what_is_right() {
    for (word, hint) in [
        ("newmark", "radau-iia"),
        ("hht(-0.3", "`hht(-0.3)`"),
        ("hht(x)", "`hht(-0.3)`"),
        ("hht(0.3)", "alpha"),
        ("radau-iia(3)", "no parameter"),
        ("", "radau-iia"),
    ] {
        let problem = scheme_of(word).unwrap_err().to_string();
        assert!(problem.contains(hint), "{word}: {problem}");
    }
}
