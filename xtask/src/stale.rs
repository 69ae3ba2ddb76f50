//! Whether `docs/verification.md` still agrees with the runs.

use std::collections::HashMap;

use crate::case::Case;
use crate::outcome::Outcome;

/// Digits that may differ between two processors: those of truncation errors do not.
const APART: f64 = 0.5;
/// From so many digits on, what is left is Newton's tolerance and round-off.
const EXACT: f64 = 8.5;

/// Rows by the case's heading and the quantity, with their digits, where there are any.
type Rows<'a> = HashMap<(&'a str, &'a str), Option<f64>>;

/// Rows in which the report differs from the outcomes, in words.
pub(crate) fn differences(report: &str, cases: &[Case], outcomes: &[Outcome]) -> Vec<String> {
    let kept = rows(report);
    let mut words = Vec::new();
    for outcome in outcomes {
        let case = &cases[outcome.index];
        for row in outcome.rows.iter().filter(|row| row.verdict.word() == "pass") {
            let row_name = format!("{}, `{}`", case.name, row.quantity);
            // The report's cells hold no bars.
            match kept.get(&(case.title.as_str(), row.quantity.trim())) {
                None => words.push(format!("{row_name}: the report has no such row")),
                Some(kept) => {
                    if let (Some(now), Some(then)) = (row.digits(), *kept)
                        && (now - then).abs() > APART
                        && now.min(then) < EXACT
                    {
                        words.push(format!("{row_name}: {now:.1} digits, {then:.1} in the report"));
                    }
                }
            }
        }
    }
    words
}

fn rows(report: &str) -> Rows<'_> {
    let mut rows = Rows::new();
    let mut title = "";
    for line in report.lines() {
        if let Some(heading) = line.strip_prefix("### ") {
            title = heading.trim();
        } else if line.starts_with("## ") {
            title = "";
        } else if let Some(cells) = line.strip_prefix("| ").filter(|_| !title.is_empty()) {
            let cells: Vec<&str> = cells.split(" | ").map(str::trim).collect();
            if let [quantity, _, _, _, _, digits, ..] = cells[..] {
                rows.insert((title, quantity), digits.parse().ok());
            }
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_by_heading_and_quantity() {
        let report = "## Statics\n\n### A beam\n\nSource: s.\n\n| quantity | against | reference | good to | Lissom | digits | tolerance | mesh | time | state |\n\
                      |---|---|---|---|---|---|---|---|---|---|\n| load | source | 1 | 1e-9 | 1.1 | 6.3 | 1e-6 | g | 0.1 | pass |\n\
                      | warnings |  | none |  | none |  |  |  |  | pass |\n";
        let rows = rows(report);
        assert_eq!(rows.get(&("A beam", "load")), Some(&Some(6.3)));
        assert_eq!(rows.get(&("A beam", "warnings")), Some(&None));
        assert_eq!(rows.get(&("A beam", "other")), None);
    }
}
