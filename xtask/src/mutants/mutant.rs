//! A place in the code and what stands there instead.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;

use super::MutantsError;

/// What is broken: elements, joints, schemes, lowering, outputs, sections.
const FILES: [&str; 8] = [
    "crates/lissom-core/src/elements/**",
    "crates/lissom-core/src/joints/**",
    "crates/lissom-core/src/schemes/**",
    "crates/lissom-model/src/lower/**",
    "crates/lissom-model/src/output/**",
    "crates/lissom-model/src/sections/**",
    "crates/lissom-model/src/channels.rs",
    "crates/lissom-model/src/output_channels.rs",
];

/// One change of the code.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mutant {
    /// File, line, column and what is done there.
    pub(super) name: String,
    /// The file, from the project's folder on.
    pub(super) file: String,
    /// Start and end of what is replaced, each with line and column from 1 on; the end is behind it.
    span: [(usize, usize); 2],
    replacement: String,
    /// Tells whether the file has changed.
    pub(super) mark: u64,
}

/// As cargo-mutants lists it.
#[derive(Deserialize)]
struct Listed {
    name: String,
    file: String,
    span: Span,
    replacement: String,
}

#[derive(Deserialize)]
struct Span {
    start: Place,
    end: Place,
}

#[derive(Deserialize)]
struct Place {
    line: usize,
    column: usize,
}

/// All mutants of the files.
///
/// # Errors
/// If cargo-mutants is not there.
pub(super) fn list(root: &Path) -> Result<Vec<Mutant>, MutantsError> {
    let mut command = Command::new("cargo");
    command.args(["mutants", "--workspace", "--list", "--json", "--colors", "never"]).current_dir(root);
    command.args(FILES.iter().flat_map(|file| ["--file", file]));
    let listed = command.output().map_err(MutantsError::about("cargo mutants"))?;
    if !listed.status.success() {
        return Err(MutantsError::List(String::from_utf8_lossy(&listed.stderr).into_owned()));
    }
    let listed: Vec<Listed> = serde_json::from_slice(&listed.stdout)
        .map_err(|error| MutantsError::Json { what: "the list of mutants".to_owned(), error })?;
    if listed.is_empty() {
        return Err(MutantsError::List("it lists none".to_owned()));
    }
    let mut marks = std::collections::BTreeMap::new();
    let mut mutants = Vec::with_capacity(listed.len());
    for Listed { name, file, span: Span { start, end }, replacement } in listed {
        if !marks.contains_key(&file) {
            let text = std::fs::read(root.join(&file)).map_err(MutantsError::about(&file))?;
            marks.insert(file.clone(), mark(&text));
        }
        let span = [(start.line, start.column), (end.line, end.column)];
        mutants.push(Mutant { mark: marks[&file], name, file, span, replacement });
    }
    mutants.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(mutants)
}

/// FNV-1a of a text.
fn mark(text: &[u8]) -> u64 {
    text.iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

impl Mutant {
    /// Line of the file.
    pub(super) fn line(&self) -> usize {
        self.span[0].0
    }

    /// What is done, without the place.
    pub(super) fn what(&self) -> &str {
        self.name.splitn(4, ':').nth(3).unwrap_or(&self.name).trim_start()
    }

    /// Breaks the copy in `tree`, does something, and heals it again.
    ///
    /// # Errors
    /// If the file cannot be read or written.
    pub(super) fn broken<T>(&self, tree: &Path, then: impl FnOnce() -> T) -> Result<T, MutantsError> {
        let path = tree.join(&self.file);
        let text = std::fs::read_to_string(&path).map_err(MutantsError::about(path.display()))?;
        let write = |text: &str| std::fs::write(&path, text).map_err(MutantsError::about(path.display()));
        write(&self.apply(&text))?;
        let result = then();
        write(&text)?;
        Ok(result)
    }

    /// The text with the change.
    fn apply(&self, text: &str) -> String {
        let [start, end] = self.span.map(|place| offset(text, place));
        format!("{}{}{}", &text[..start], self.replacement, &text[end..])
    }

    #[cfg(test)]
    pub(super) fn named(name: &str) -> Self {
        let (name, file) = (name.to_owned(), "file.rs".to_owned());
        Self { name, file, span: [(1, 1), (1, 1)], replacement: String::new(), mark: 0 }
    }
}

/// Bytes before a line and column, both counted from 1 on, the latter in characters.
fn offset(text: &str, (line, column): (usize, usize)) -> usize {
    let before: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let rest = &text[before..];
    before + rest.char_indices().nth(column - 1).map_or(rest.len(), |(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_between_two_places_is_replaced() {
        let mutant = Mutant {
            span: [(2, 5), (2, 6)],
            replacement: "-".to_owned(),
            ..Mutant::named("crates/a.rs:2:5: replace + with - in f")
        };
        assert_eq!(mutant.apply("é\na é + b\nc"), "é\na é - b\nc");
        assert_eq!((mutant.line(), mutant.what()), (2, "replace + with - in f"));
        let lines = Mutant { span: [(1, 2), (3, 1)], ..mutant };
        assert_eq!(lines.apply("é\na é + b\nc"), "é-c");
    }
}
