//! The table of a sweep: one row per member, with identical bytes for every order of computation.

use std::fmt::Write;
use std::io;

use lissom_model::output::{SweepAxis, SweepPlot, number_text, quoted};
use lissom_model::sweep::Variation;

use super::{MemberOutcome, MemberState, Sweep, SweepValue};
use crate::encodings::parquet::{Values, parquet};

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

/// The cells of each outcome, under [`headings`]; empty if a value is missing.
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

/// The table as a Parquet file: columns as in [`headings`], NaN for missing numbers. A varied path whose values are not all
/// numbers has texts.
///
/// # Errors
/// If it exceeds the limits of the format.
pub fn write_parquet(sweep: &Sweep, outcomes: &[MemberOutcome]) -> io::Result<Vec<u8>> {
    let file = sweep.file();
    let numbers = |of: &dyn Fn(&MemberOutcome) -> Option<f64>| {
        Values::Numbers(outcomes.iter().map(|outcome| of(outcome).unwrap_or(f64::NAN)).collect())
    };
    let whole = |of: fn(&MemberOutcome) -> usize| {
        Values::Whole(outcomes.iter().map(|outcome| i64::try_from(of(outcome)).unwrap_or(i64::MAX)).collect())
    };
    let texts = |of: &dyn Fn(&MemberOutcome) -> String| Values::Texts(outcomes.iter().map(of).collect());
    let varied = |path: usize| {
        let number = |outcome: &MemberOutcome| match file.value(outcome.member, path) {
            SweepValue::Number(number) => Some(number),
            _ => None,
        };
        let all: Option<Vec<f64>> = outcomes.iter().map(number).collect();
        all.map_or_else(|| texts(&|outcome| file.value(outcome.member, path).to_cell()), Values::Numbers)
    };
    let mut values = vec![whole(|outcome| outcome.member)];
    values.extend((0..file.vary.len()).map(varied));
    values
        .extend((0..file.collect.len()).map(|index| numbers(&|outcome| outcome.values.get(index).copied())));
    values.extend([
        texts(&|outcome| outcome.state.name().to_owned()),
        numbers(&|outcome| outcome.time),
        whole(|outcome| outcome.steps),
        numbers(&|outcome| outcome.max_constraint_violation),
        texts(&|outcome| outcome.diagnosis.clone().unwrap_or_default()),
    ]);
    let columns: Vec<(String, Values)> = headings(sweep).into_iter().zip(values).collect();
    parquet(&columns, &[])
}

fn with_unit(name: &str, unit: Option<&str>) -> String {
    unit.filter(|unit| !unit.is_empty()).map_or_else(|| name.to_owned(), |unit| format!("{name} [{unit}]"))
}

/// The plot of the solved members.
pub fn plot(sweep: &Sweep, outcomes: &[MemberOutcome], title: &str) -> SweepPlot {
    let file = sweep.file();
    let solved: Vec<&MemberOutcome> =
        outcomes.iter().filter(|outcome| outcome.state == MemberState::Solved).collect();
    let varied = file.vary.iter().enumerate().map(|(path, varied)| {
        let values = || solved.iter().map(|outcome| file.value(outcome.member, path));
        let numbers: Option<Vec<f64>> = values()
            .map(|value| match value {
                SweepValue::Number(number) => Some(number),
                _ => None,
            })
            .collect();
        if let Some(values) = numbers {
            let is_logarithmic = matches!(varied.variation, Variation::Range { logarithmic: true, .. });
            return SweepAxis {
                name: with_unit(&varied.path, lissom_model::unit_of(&sweep.registry, &varied.path)),
                values,
                is_logarithmic,
            };
        }
        let words: Vec<String> = values().map(|value| value.to_cell()).collect();
        SweepAxis::of_words(&varied.path, &words)
    });
    let collected = file.collect.iter().enumerate().map(|(index, collected)| SweepAxis {
        name: with_unit(&collected.name, Some(&sweep.units[index])),
        values: solved.iter().map(|outcome| outcome.values[index]).collect(),
        is_logarithmic: false,
    });
    SweepPlot { title: title.to_owned(), varied: varied.collect(), collected: collected.collect() }
}

/// The table as comma-separated values. Numbers have the fewest digits that reproduce them exactly.
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
