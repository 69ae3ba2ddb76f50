//! Warnings of the runs of a case: none, or those that the case expects and gives a reason for.

use crate::case::Case;
use crate::outcome::{Row, Verdict};

/// A row where a run warns, or where an expected warning is missing; otherwise none.
pub(crate) fn row(case: &Case, reported: &[(String, String)]) -> Option<Row> {
    let unexpected = reported
        .iter()
        .filter(|(_, words)| !case.warns.iter().any(|expected| words.contains(&expected.says)))
        .map(|(run, words)| format!("{run} warns: {words}"));
    let missing = case
        .warns
        .iter()
        .filter(|expected| !reported.iter().any(|(_, words)| words.contains(&expected.says)))
        .map(|expected| format!("no run warns of `{}`", expected.says));
    let wrong: Vec<String> = unexpected.chain(missing).collect();
    if wrong.is_empty() && case.warns.is_empty() {
        return None;
    }
    let expected: Vec<&str> = case.warns.iter().map(|expected| expected.says.as_str()).collect();
    Some(Row {
        quantity: "warnings".to_owned(),
        against: "the case".to_owned(),
        reference: if expected.is_empty() { "none".to_owned() } else { expected.join("; ") },
        ours: format!("{} of {} run(s)", reported.len(), case.runs.len()),
        difference: None,
        tolerance: String::new(),
        uncertainty: String::new(),
        grid: String::new(),
        wall: None,
        verdict: Verdict::of(wrong.is_empty(), wrong.join("; "), None),
        is_comparison: false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(further: &str) -> Case {
        toml::from_str(&format!("title = \"t\"\ngroup = \"rigid\"\nsource = \"s\"\n{further}")).unwrap()
    }

    #[test]
    fn a_warning_fails_unless_the_case_says_why() {
        let reported = [("main".to_owned(), "the equilibrium is unstable".to_owned())];
        let failed = |case: &Case, reported: &[(String, String)]| {
            row(case, reported).is_some_and(|row| matches!(row.verdict, Verdict::Fail(_)))
        };
        assert!(failed(&case(""), &reported));
        assert!(row(&case(""), &[]).is_none());
        let expecting =
            case("[[warns]]\nsays = \"is unstable\"\nbecause = \"it is beyond the buckling load\"");
        assert!(!failed(&expecting, &reported));
        assert!(failed(&expecting, &[]));
    }
}
