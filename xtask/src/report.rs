//! The report of a verification, as Markdown with plots beside it.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

use crate::case::Case;
use crate::outcome::{Outcome, Row, Verdict};
use crate::verify::VerifyError;

/// Groups in the order of the report.
const GROUPS: [(&str, &str); 4] = [
    ("statics", "Statics of beams"),
    ("rigid", "Rigid bodies"),
    ("dynamics", "Dynamics of beams"),
    ("invariants", "Invariants"),
];

/// File of the report.
pub(crate) const NAME: &str = "verification.md";
/// Folder of its plots, beside it: a book cannot show files outside of its own folder.
const PLOTS: &str = "generated/verification";

/// Writes report and plots: to docs/, as a chapter of the book, after a whole run, below out/verification/ otherwise.
pub(crate) fn write(
    root: &Path,
    cases: &[Case],
    outcomes: &[Outcome],
    elapsed: Duration,
    whole: bool,
) -> Result<(), VerifyError> {
    let folder = root.join(if whole { "docs" } else { "out/verification" });
    let plots = folder.join(PLOTS);
    if plots.exists() {
        std::fs::remove_dir_all(&plots).map_err(VerifyError::file(&plots))?;
    }
    std::fs::create_dir_all(&plots).map_err(VerifyError::file(&plots))?;
    for outcome in outcomes {
        for figure in &outcome.figures {
            let path = plots.join(format!("{}-{}.svg", cases[outcome.index].name, figure.name));
            let Ok(drawing) = figure.draw().and_then(|drawn| drawn.svg()) else { continue };
            std::fs::write(&path, drawing).map_err(VerifyError::file(&path))?;
        }
    }
    let path = folder.join(NAME);
    std::fs::write(&path, text(cases, outcomes, elapsed)).map_err(VerifyError::file(&path))
}

/// One line per case.
fn summary(cases: &[Case], outcomes: &[Outcome]) -> String {
    let mut text = String::from(
        "| case | problem | rows passed | digits agreed | time [s] | state |\n|---|---|---|---|---|---|\n",
    );
    for (group, _) in GROUPS {
        for outcome in outcomes.iter().filter(|outcome| cases[outcome.index].group == group) {
            let case = &cases[outcome.index];
            let passed = outcome.rows.iter().filter(|row| row.verdict.word() == "pass").count();
            let _ = writeln!(
                text,
                "| `{}` | {} | {passed}/{} | {} | {:.2} | {} |",
                case.name,
                case.title,
                outcome.rows.len(),
                digits_range(&outcome.rows),
                outcome.wall.as_secs_f64(),
                state(outcome)
            );
        }
    }
    text
}

/// Fewest and most digits of the compared rows.
fn digits_range(rows: &[Row]) -> String {
    let digits: Vec<f64> = rows.iter().filter(|row| row.is_comparison).filter_map(Row::digits).collect();
    let least = digits.iter().copied().fold(f64::INFINITY, f64::min);
    let most = digits.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    match digits.len() {
        0 => "–".to_owned(),
        1 => format!("{least:.1}"),
        _ => format!("{least:.1} – {most:.1}"),
    }
}

fn state(outcome: &Outcome) -> &'static str {
    let any = |test: fn(&Verdict) -> bool| outcome.rows.iter().any(|row| test(&row.verdict));
    if outcome.has_failed() {
        "**FAIL**"
    } else if any(|verdict| matches!(verdict, Verdict::Open(_))) {
        "open"
    } else if any(|verdict| matches!(verdict, Verdict::Skipped(_))) {
        "skipped"
    } else {
        "pass"
    }
}

fn text(cases: &[Case], outcomes: &[Outcome], elapsed: Duration) -> String {
    let mut text = String::from("# Verification\n\nMade by `cargo xtask verify`; do not edit.\n\n");
    let rows = || outcomes.iter().flat_map(|outcome| &outcome.rows);
    let count = |word: &str| rows().filter(|row| row.verdict.word() == word).count();
    let _ = writeln!(
        text,
        "{} cases, {} rows: {} pass, {} fail, {} open, {} skipped; {:.0} s.\n",
        outcomes.len(),
        rows().count(),
        count("pass"),
        count("**FAIL**"),
        count("open"),
        count("skipped"),
        elapsed.as_secs_f64()
    );
    text.push_str(
        "Digits are −log₁₀ of the difference relative to the reference, or to the largest reference value of a \
         curve or a group of values. \"Good to\" is the uncertainty of the reference, and \"tolerance\" the \
         permitted difference; both are relative to the same scale. Each tolerance that exceeds the uncertainty \
         is explained below its table. Orders are observed between successive levels of a refinement.\n\n",
    );
    text.push_str(&summary(cases, outcomes));
    text.push_str(&not_verified(cases, outcomes));
    for (group, heading) in GROUPS {
        let _ = writeln!(text, "\n## {heading}");
        for outcome in outcomes.iter().filter(|outcome| cases[outcome.index].group == group) {
            section(&mut text, &cases[outcome.index], outcome);
        }
    }
    text
}

/// Open, skipped and failed comparisons, with reasons.
fn not_verified(cases: &[Case], outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes {
        for row in &outcome.rows {
            let (Verdict::Fail(words) | Verdict::Open(words) | Verdict::Skipped(words)) = &row.verdict else {
                continue;
            };
            let words = words.replace('\n', " ");
            let _ = writeln!(
                text,
                "- {} `{}`, {}: {words}",
                row.verdict.word(),
                cases[outcome.index].name,
                row.quantity
            );
        }
    }
    if text.is_empty() { text } else { format!("\nNot verified:\n\n{text}") }
}

fn section(text: &mut String, case: &Case, outcome: &Outcome) {
    let _ = writeln!(
        text,
        "\n### {}\n\nSource: {}. Reproduce: `cargo xtask verify {}`\n",
        case.title, case.source, case.name
    );
    text.push_str("| quantity | against | reference | good to | Lissom | digits | tolerance | mesh and step | time [s] | state |\n");
    text.push_str("|---|---|---|---|---|---|---|---|---|---|\n");
    for row in &outcome.rows {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.quantity,
            if row.against == case.source { "source" } else { &row.against },
            row.reference,
            row.uncertainty,
            row.ours,
            row.digits().map_or(String::new(), |digits| format!("{digits:.1}")),
            row.tolerance,
            row.grid,
            row.wall.map_or(String::new(), |wall| format!("{:.2}", wall.as_secs_f64())),
            row.verdict.word()
        );
    }
    for words in case.findings.iter().chain(&outcome.because).chain(&case.times) {
        let _ = writeln!(text, "\n- {words}");
    }
    for figure in &outcome.figures {
        let _ = writeln!(text, "\n![{}]({PLOTS}/{}-{}.svg)", figure.name, case.name, figure.name);
    }
}
