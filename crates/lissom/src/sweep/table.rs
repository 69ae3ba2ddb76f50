//! The table of a sweep: one row per member, the same bytes however it was computed.

use std::fmt::Write;

use lissom_model::output::{number_text, quoted};

use super::{MemberOutcome, Sweep};

/// The headings: `member`, the varied paths, what is collected, `state`, `time`, `steps`, `max_constraint_violation`,
/// `diagnosis`.
pub fn headings(sweep: &Sweep) -> Vec<String> {
    let file = sweep.file();
    let mut all = vec!["member".to_owned()];
    all.extend(file.vary.iter().map(|varied| varied.path.clone()));
    all.extend(file.collect.iter().map(|collected| collected.name.clone()));
    all.extend(["state", "time", "steps", "max_constraint_violation", "diagnosis"].map(str::to_owned));
    all
}

/// The cells of each outcome, under [`headings`]; empty where there is nothing.
pub fn rows<'a>(sweep: &'a Sweep, outcomes: &'a [MemberOutcome]) -> impl Iterator<Item = Vec<String>> + 'a {
    outcomes.iter().map(move |outcome| {
        let file = sweep.file();
        let number = |value: Option<f64>| value.map(number_text).unwrap_or_default();
        let mut cells = vec![outcome.member.to_string()];
        cells.extend((0..file.vary.len()).map(|path| file.value(outcome.member, path).to_cell()));
        cells.extend((0..file.collect.len()).map(|index| number(outcome.values.get(index).copied())));
        cells.extend([
            outcome.state.name().to_owned(),
            number(outcome.time),
            outcome.steps.to_string(),
            number(outcome.max_constraint_violation),
            outcome.diagnosis.clone().unwrap_or_default(),
        ]);
        cells
    })
}

/// The table as comma-separated values. Numbers have the fewest digits that give them back exactly.
pub fn write_table(sweep: &Sweep, outcomes: &[MemberOutcome]) -> String {
    let mut text = String::new();
    for cells in std::iter::once(headings(sweep)).chain(rows(sweep, outcomes)) {
        for (index, cell) in cells.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{}{}", if index == 0 { "" } else { "," }, quoted(cell));
        }
        text.push('\n');
    }
    text
}
