//! `cargo xtask reference`: the reference of the model file in docs/, and the types of its entries for models that are built
//! in Rust and in Python, generated from the program's own tables.

use std::path::{Path, PathBuf};

use lissom::core::diagnostics::{Entry, Severity};
use lissom::{FileError, catalogue};
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
    let warnings = root.join("docs/warnings.md");
    made.push((warnings.clone(), with_tables(&files::read_text(&warnings).unwrap_or_default())));
    let folder = root.join("crates/lissom/src/builder/entries");
    for (name, text) in typed_entries(&registry()) {
        made.push((folder.join(format!("{name}.rs")), format!("{RUST_NOTE}{}\n", text.trim_end())));
    }
    let folder = root.join("crates/lissom-python/python/lissom/entries");
    made.extend(python_entries(&registry()).into_iter().map(|(name, text)| (folder.join(name), text)));
    made
}

/// The chapter on warnings with the tables of the catalogue between its marks.
fn with_tables(chapter: &str) -> String {
    let mut chapter = chapter.to_owned();
    for (name, severity) in [("warnings", Severity::Warning), ("failures", Severity::Failure)] {
        let [begin, end] = ["begin", "end"]
            .map(|word| format!("<!-- {word} of {name}, made by `cargo xtask reference` -->\n"));
        let row = |entry: &Entry| format!("| `{}` | {} | {} |\n", entry.code, entry.meaning, entry.advice);
        let rows: String = catalogue().filter(|entry| entry.severity == severity).map(row).collect();
        let table = format!("{begin}\n| code | meaning | remedy |\n|---|---|---|\n{rows}\n{end}");
        chapter = match (chapter.find(&begin), chapter.find(&end)) {
            (Some(from), Some(to)) => format!("{}{table}{}", &chapter[..from], &chapter[to + end.len()..]),
            // A chapter without its marks is out of date.
            _ => chapter + &table,
        };
    }
    chapter
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
                assert!(text.contains(parameter.summary), "{}.{}", kind.name, parameter.name);
            }
        }
        assert!(text.contains("### `[initial.…]`") && text.contains("### `kind = \"expression\"`"));
    }
}
