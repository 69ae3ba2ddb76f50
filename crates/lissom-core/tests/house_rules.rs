//! Rules of the house that a search can see.

use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Identifiers of a source without its comments and strings, with their line numbers.
fn identifiers(text: &str) -> Vec<(usize, String)> {
    let mut result = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or("");
        // Every second piece between quotation marks is a string.
        for piece in code.split('"').step_by(2) {
            for word in piece.split(|c: char| !(c.is_alphanumeric() || c == '_')) {
                result.push((number + 1, word.to_owned()));
            }
        }
    }
    result
}

fn offences(allowed: &[&str], words: &[&str]) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    assert!(files.len() > 20, "the search must see the sources");
    let mut found = Vec::new();
    for file in files {
        let name = file.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
        if allowed.iter().any(|prefix| name.starts_with(prefix)) {
            continue;
        }
        let text = fs::read_to_string(&file).expect("readable");
        for (line, word) in identifiers(&text) {
            if words.contains(&word.as_str()) {
                found.push(format!("{name}:{line}: `{word}`"));
            }
        }
    }
    found
}

/// The claim of the method as code structure: only the scaling and the analyses know the step size.
#[test]
fn only_scaling_and_analyses_know_the_step_size() {
    let found = offences(
        &["scaling.rs", "analysis/", "stepping/"],
        &["h", "dt", "step_size", "time_step", "penalty"],
    );
    assert!(
        found.is_empty(),
        "step size or penalty outside scaling.rs, analysis/ and stepping/:\n{}",
        found.join("\n")
    );
}

#[test]
fn the_search_finds_what_it_looks_for() {
    assert!(!offences(&["analysis/"], &["h"]).is_empty(), "scaling.rs holds `h`");
}

/// The core opens no file, prints nothing and reads no clock.
#[test]
fn the_core_has_no_contact_with_the_outside() {
    let words = ["fs", "File", "println", "eprintln", "print", "Instant", "SystemTime", "env", "stdin"];
    let found = offences(&[], &words);
    assert!(found.is_empty(), "contact with the outside:\n{}", found.join("\n"));
}
