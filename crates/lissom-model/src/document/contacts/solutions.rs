//! What contacts of each kind may have, for the manual: those of bodies with a stiffness are solved as elements or as a set.

use super::kinds::{COMPLIANT, KINDS};

/// Keys that contacts as a set do not have as elements do.
const OF_SET: [(&str, &str); 3] =
    [("deflection", "no effect"), ("rolling_friction", "no"), ("torsional_friction", "no")];
/// Analyses, for contacts as elements, as a set, rigid ones and those of flexible parts.
const ANALYSES: [(&str, [&str; 4]); 5] = [
    ("error control (`relative_tolerance`)", ["yes", "no", "yes", "yes"]),
    ("all schemes", ["yes", "`backward-euler`", "yes", "yes"]),
    ("statics, start from equilibrium", ["without friction", "no", "no", "without friction"]),
    ("modes and other linear models", ["yes", "of a state of the run", "no", "yes"]),
    ("events at impacts", ["with `restitution`", "no", "yes", "no"]),
];

/// The table: a row for each key and analysis, a column for each way to solve contacts.
pub fn table_of_solutions() -> String {
    let columns: Vec<(String, &str, bool)> = KINDS
        .iter()
        .flat_map(|kind| {
            let heading = format!("`{}`", kind.word);
            let set = (kind.word == COMPLIANT).then(|| (format!("{heading} as a set"), kind.word, true));
            std::iter::once((heading, kind.word, false)).chain(set)
        })
        .collect();
    let line = |first: &str, cells: Vec<String>| format!("| {first} | {} |\n", cells.join(" | "));
    let mut text = line("", columns.iter().map(|(heading, ..)| heading.clone()).collect());
    text = text + "|" + &"---|".repeat(columns.len() + 1) + "\n";
    let mut keys: Vec<&str> = Vec::new();
    for key in KINDS.iter().flat_map(|kind| (kind.own_keys)()).map(|key| key.name) {
        if !keys.contains(&key) && key != "rigid" {
            keys.push(key);
        }
    }
    for key in keys {
        let cell = |(_, word, is_set): &(String, &str, bool)| {
            let of_set = OF_SET.iter().find(|(own, _)| *is_set && *own == key).map(|(_, words)| *words);
            let kind = KINDS.iter().find(|kind| kind.word == *word);
            let has = kind.is_some_and(|kind| (kind.own_keys)().iter().any(|own| own.name == key));
            of_set.unwrap_or(if has { "yes" } else { "no" }).to_owned()
        };
        text += &line(&format!("`{key}`"), columns.iter().map(cell).collect());
    }
    for (analysis, cells) in ANALYSES {
        let cell = |column: usize| cells[column.min(cells.len() - 1)].to_owned();
        text += &line(analysis, (0..columns.len()).map(cell).collect());
    }
    text
}
