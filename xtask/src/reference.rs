//! `cargo xtask reference`: the reference of the model file in docs/, made of what the program itself reads.

use std::path::{Path, PathBuf};

use lissom::FileError;
use lissom_model::lower::registry::registry;
use lissom_model::{files, manual};

use crate::verify::root;

/// What stands above the reference.
const NOTE: &str = "<!-- Made by `cargo xtask reference` of the program's own tables: do not edit. -->\n\n";

fn path(root: &Path) -> PathBuf {
    root.join("docs/reference.md")
}

fn text() -> String {
    format!("{NOTE}{}", manual(&registry()))
}

/// Writes it; with `check` only tells whether it is what it would be.
///
/// # Errors
/// If the file cannot be read or written.
pub(crate) fn reference(check: bool) -> Result<bool, FileError> {
    let path = path(&root());
    if !check {
        return files::write(&path, text().as_bytes()).map(|()| true);
    }
    let is_fresh = files::read_text(&path)? == text();
    if !is_fresh {
        eprintln!("docs/reference.md is old: run `cargo xtask reference`");
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
        let (registry, text) = (registry(), text());
        for kind in registry.joints.iter().chain(&registry.springs).chain(&registry.loads) {
            assert!(text.contains(&format!("### `kind = \"{}\"`", kind.name)), "{}", kind.name);
            for parameter in kind.parameters {
                assert!(text.contains(parameter.summary), "{}.{}", kind.name, parameter.name);
            }
        }
        assert!(text.contains("### `[initial.…]`") && text.contains("### `kind = \"expression\"`"));
    }
}
