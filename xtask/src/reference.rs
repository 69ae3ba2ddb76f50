//! `cargo xtask reference`: the reference of the model file in docs/, and the types of its entries for models that are built
//! in Rust and in Python, generated from the program's own tables.

use std::path::{Path, PathBuf};

use lissom::core::contact::forms::{FormKind, parts_between};
use lissom::core::diagnostics::{Entry, Severity};
use lissom::{FileError, catalogue};
use lissom_model::document::table_of_solutions;
use lissom_model::lower::registry::registry;
use lissom_model::{files, manual, python_entries, typed_entries};

use crate::verify::root;

/// Header of the reference.
const NOTE: &str = "<!-- Made by `cargo xtask reference` of the program's own tables: do not edit. -->\n\n";
/// Header of the types.
const RUST_NOTE: &str = "// Made by `cargo xtask reference` of the program's own tables: do not edit.\n";

/// All files with their contents.
fn files_made(root: &Path) -> Vec<(PathBuf, String)> {
    let mut made = vec![(root.join("docs/reference.md"), reference_text())];
    let chapters = [
        (
            "docs/warnings.md",
            vec![catalogued("warnings", Severity::Warning), catalogued("failures", Severity::Failure)],
        ),
        ("docs/contacts.md", vec![pairs_of_solids(), ("solutions of contacts", table_of_solutions())]),
    ];
    for (name, tables) in chapters {
        let path = root.join(name);
        let text = tables.iter().fold(files::read_text(&path).unwrap_or_default(), with_table);
        made.push((path, text));
    }
    let folder = root.join("crates/lissom/src/builder/entries");
    for (name, text) in typed_entries(&registry()) {
        made.push((folder.join(format!("{name}.rs")), format!("{RUST_NOTE}{}\n", text.trim_end())));
    }
    let folder = root.join("crates/lissom-python/python/lissom/entries");
    made.extend(python_entries(&registry()).into_iter().map(|(name, text)| (folder.join(name), text)));
    made
}

/// A table with its name in the marks around it.
type Table = (&'static str, String);

/// A chapter with a table between its marks.
fn with_table(chapter: String, (name, table): &Table) -> String {
    let [begin, end] =
        ["begin", "end"].map(|word| format!("<!-- {word} of {name}, made by `cargo xtask reference` -->\n"));
    let table = format!("{begin}\n{table}\n{end}");
    match (chapter.find(&begin), chapter.find(&end)) {
        (Some(from), Some(to)) => format!("{}{table}{}", &chapter[..from], &chapter[to + end.len()..]),
        // A chapter without its marks is out of date.
        _ => chapter + &table,
    }
}

/// The entries of the catalogue of a severity.
fn catalogued(name: &'static str, severity: Severity) -> Table {
    let row = |entry: &Entry| format!("| `{}` | {} | {} |\n", entry.code, entry.meaning, entry.advice());
    let rows: String = catalogue().filter(|entry| entry.severity == severity).map(row).collect();
    (name, format!("| code | meaning | remedy |\n|---|---|---|\n{rows}"))
}

/// Which solids touch each other, every two once.
fn pairs_of_solids() -> Table {
    let all = FormKind::ALL;
    let cell = |row: usize, column: usize| {
        let parts = parts_between([all[row], all[column]]);
        if column > row { String::new() } else { parts.unwrap_or_else(|| "no".to_owned()) }
    };
    let is_used = |column: &usize| (*column..all.len()).any(|row| cell(row, *column) != "no");
    let columns: Vec<usize> = (0..all.len()).filter(is_used).collect();
    let name = |k: &usize| all[*k].words().split_once(' ').map_or("", |(_, name)| name);
    let line = |first: &str, cells: Vec<String>| format!("| {first} | {} |\n", cells.join(" | "));
    let head = line("", columns.iter().map(|k| name(k).to_owned()).collect());
    let rule = format!("|{}\n", "---|".repeat(columns.len() + 1));
    let row = |k: usize| line(name(&k), columns.iter().map(|column| cell(k, *column)).collect());
    ("pairs of solids", head + &rule + &(1..all.len()).map(row).collect::<String>())
}

fn reference_text() -> String {
    format!("{NOTE}{}", manual(&registry()))
}

/// Writes them; with `check` only reports whether they are up to date.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn reference(check: bool) -> Result<bool, FileError> {
    let mut is_fresh = true;
    for (path, text) in files_made(&root()) {
        if !check {
            files::write(&path, text.as_bytes())?;
        } else if files::read_text(&path)? != text {
            eprintln!("{} is old: run `cargo xtask reference`", path.display());
            is_fresh = false;
        }
    }
    Ok(is_fresh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_is_what_the_program_reads() {
        assert!(reference(true).unwrap(), "run `cargo xtask reference`");
    }

    #[test]
    fn every_kind_is_in_the_reference() {
        let (registry, text) = (registry(), reference_text());
        for kind in registry.joints.iter().chain(&registry.springs).chain(&registry.loads) {
            assert!(text.contains(&format!("### `kind = \"{}\"`", kind.name)), "{}", kind.name);
            for parameter in kind.parameters {
                assert!(text.contains(&parameter.meaning()), "{}.{}", kind.name, parameter.name);
            }
        }
        assert!(text.contains("### `[initial.…]`") && text.contains("### `kind = \"expression\"`"));
    }
}
