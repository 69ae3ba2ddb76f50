//! Words that comments, messages and the manual do not use, with the field's word for each.

use std::fs;
use std::path::{Path, PathBuf};

/// Words that a reader of the field has to read twice, each with its replacement.
const REPLACEMENTS: [(&str, &str); 53] = [
    ("a little later", "shortly after"),
    ("asks for more", "requires more"),
    ("astray", "to a wrong result"),
    ("but for", "except for"),
    ("came to", "reached, or the noun: result"),
    ("come apart", "decouple"),
    ("come to", "reach, or the noun: result"),
    ("comes apart", "decouples"),
    ("comes to", "is, reaches, or the noun: result"),
    ("dear", "expensive"),
    ("dearer", "more expensive"),
    ("eight to a block", "in blocks of eight"),
    ("freedoms", "degrees of freedom"),
    ("from nowhere", "spurious"),
    ("front door", "public interface"),
    ("gives back", "returns, or reproduces"),
    ("go by", "depend on"),
    ("goes by", "depends on, or moves by"),
    ("goes further", "moves by more"),
    ("goes straight on", "is extrapolated"),
    ("in vain", "without success"),
    ("learns", "stores, or updates"),
    ("least and largest", "smallest and largest"),
    ("makes no sense", "is invalid"),
    ("makes sense", "is valid"),
    ("nothing to tell", "no warning"),
    ("one who looks", "viewer"),
    ("outright", "absolute"),
    ("promised", "guaranteed"),
    ("promises", "guarantees, or the noun: properties"),
    ("puts in", "supplies"),
    ("reason to doubt", "warning"),
    ("reasons to doubt", "warnings"),
    ("refuse", "reject"),
    ("refused", "rejected"),
    ("refuses", "rejects"),
    ("run round", "travel"),
    ("runs round", "travels"),
    ("stand in place of", "replace"),
    ("stands in place of", "replaces"),
    ("swing arm", "revolute-spherical link"),
    ("take note of", "record"),
    ("takes note of", "records"),
    ("tell", "report, determine"),
    ("telling", "reporting"),
    ("tells", "reports, determines"),
    ("told", "reported"),
    ("unbelievable", "invalid"),
    ("what is asked for", "request"),
    ("what was asked for", "request"),
    ("worth a warning", "significant"),
    ("worth telling", "significant"),
    ("worth while", "efficient"),
];

/// Start and end of a comment or string of a language.
struct Delimiters {
    start: &'static str,
    end: &'static str,
    /// Whether a backslash in between hides the next character.
    has_escapes: bool,
    /// Whether newlines may be in between.
    has_lines: bool,
}

const fn verbatim(start: &'static str, end: &'static str) -> Delimiters {
    Delimiters { start, end, has_escapes: false, has_lines: true }
}

const fn quoted(start: &'static str, has_lines: bool) -> Delimiters {
    Delimiters { start, end: start, has_escapes: true, has_lines }
}

/// Comments, strings and characters of Rust.
const RUST: [Delimiters; 8] = [
    verbatim("//", "\n"),
    verbatim("r##\"", "\"##"),
    verbatim("r#\"", "\"#"),
    verbatim("r\"", "\""),
    quoted("\"", true),
    verbatim("'\"", "'"),
    verbatim("'\\'", "'"),
    verbatim("'\\", "'"),
];

/// Comments and strings of JavaScript.
const SCRIPT: [Delimiters; 5] =
    [verbatim("//", "\n"), verbatim("/*", "*/"), quoted("`", true), quoted("\"", false), quoted("'", false)];

/// Comments and strings of Python and TOML.
const PYTHON: [Delimiters; 5] = [
    verbatim("#", "\n"),
    verbatim("\"\"\"", "\"\"\""),
    verbatim("'''", "'''"),
    quoted("\"", false),
    quoted("'", false),
];

/// The prose of a file by its ending: comments and strings of the languages above, otherwise the whole text.
fn prose_of(path: &Path, text: &str) -> String {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("rs") => prose(text, &RUST),
        Some("js") => prose(text, &SCRIPT),
        Some("py" | "pyi" | "toml") => prose(text, &PYTHON),
        _ => without_code(text),
    }
}

/// Comments and strings of a source, without code in braces or backticks; lines are kept.
fn prose(source: &str, language: &[Delimiters]) -> String {
    let mut text = String::new();
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let found = language.iter().find_map(|delimiters| {
            let content = rest.strip_prefix(delimiters.start)?;
            Some((delimiters, &content[..end(content, delimiters)?]))
        });
        let length = if let Some((delimiters, content)) = found {
            // A string of one word is a name.
            if content.contains(' ') {
                text.push_str(&without_code(content));
            } else {
                text.extend(content.chars().filter(|c| *c == '\n'));
            }
            let end = if delimiters.end == "\n" { 0 } else { delimiters.end.len() };
            delimiters.start.len() + content.len() + end
        } else if first.is_alphanumeric() || first == '_' {
            rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())
        } else {
            text.extend((first == '\n').then_some(first));
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    text
}

/// Where a comment or string ends, if it does.
fn end(content: &str, delimiters: &Delimiters) -> Option<usize> {
    let mut is_escaped = false;
    for (index, c) in content.char_indices() {
        if !is_escaped && content[index..].starts_with(delimiters.end) {
            return Some(index);
        }
        if c == '\n' && !delimiters.has_lines {
            return None;
        }
        is_escaped = delimiters.has_escapes && c == '\\' && !is_escaped;
    }
    (delimiters.end == "\n").then_some(content.len())
}

/// The text with what is in braces or between backticks left blank, lines kept.
fn without_code(text: &str) -> String {
    let (mut is_code, mut result) = (false, String::new());
    for c in text.chars() {
        match c {
            '`' => is_code = !is_code,
            '{' => is_code = true,
            '}' => is_code = false,
            '\n' => {
                is_code = false;
                result.push(c);
            }
            _ if !is_code => result.push(c),
            _ => {}
        }
    }
    result
}

/// The words of the table in a text, each with its line.
fn offences(text: &str) -> Vec<(usize, &'static str, &'static str)> {
    let patterns = REPLACEMENTS.map(|(word, _)| format!(" {word} "));
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let mut spaced = String::from(" ");
        let is_letter = |c: char| c.is_alphanumeric() || c == '_';
        for word in line.split(|c| !is_letter(c)).filter(|word| !word.is_empty()) {
            spaced += &word.to_lowercase();
            spaced.push(' ');
        }
        for ((word, replacement), pattern) in REPLACEMENTS.into_iter().zip(&patterns) {
            if spaced.contains(pattern) {
                found.push((number + 1, word, replacement));
            }
        }
    }
    found
}

/// Files with prose below a folder: sources, tests, scripts, models and pages.
fn files_with_prose(folder: &Path, found: &mut Vec<PathBuf>) {
    const ENDINGS: [&str; 10] = ["css", "html", "js", "md", "py", "pyi", "rs", "sh", "toml", "yml"];
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            let is_hidden = name.starts_with('.') && name != ".ci" && name != ".github";
            if !is_hidden && !["node_modules", "out", "target", "venv"].contains(&name.as_ref()) {
                files_with_prose(&path, found);
            }
        } else if folder.file_name().is_some_and(|own| own == ".ci")
            || ENDINGS.iter().any(|ending| path.extension() == Some(ending.as_ref()))
        {
            found.push(path);
        }
    }
}

/// Generated from sources that are searched, or with the words for a reason.
const EXEMPT: [&str; 4] = [
    "crates/lissom/src/pictures/view/viewer.html",
    "docs/reference.md",
    "tests/prose.rs",
    // A drive that comes to rest.
    "silent/drive-comes-to-rest.toml",
];

#[test]
fn worst_words_are_not_used() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    files_with_prose(&root, &mut files);
    for seen in [".ci/run", "viewer/index.html", "examples/pendulum.toml", "xtask/src/main.rs"] {
        assert!(files.contains(&root.join(seen)), "the search must see {seen}");
    }
    let mut found = Vec::new();
    for file in files {
        let name = file.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("readable");
        if text.starts_with("// Made by") || EXEMPT.iter().any(|exempt| name.ends_with(exempt)) {
            continue;
        }
        for (line, word, replacement) in offences(&prose_of(&file, &text)) {
            found.push(format!("{name}:{line}: `{word}`; write: {replacement}"));
        }
    }
    assert!(found.is_empty(), "words to replace:\n{}", found.join("\n"));
}

/// Words at the start of a comment that refer to something outside of it.
const FRAGMENTS: [&str; 4] = ["The same", "Those", "Of", "Its"];

/// Lines at which a doc comment of a source begins with such words.
fn fragments(source: &str) -> Vec<usize> {
    let (mut found, mut is_continued) = (Vec::new(), false);
    for (number, line) in source.lines().enumerate() {
        let line = line.trim_start();
        let comment = ["///", "//!"].iter().find_map(|start| line.strip_prefix(start));
        let begins = |words: &str| {
            let rest = comment.and_then(|comment| comment.trim_start().strip_prefix(words));
            rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
        };
        if !is_continued && FRAGMENTS.into_iter().any(begins) {
            found.push(number + 1);
        }
        is_continued = comment.is_some();
    }
    found
}

#[test]
fn doc_comments_are_complete_by_themselves() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for package in fs::read_dir(root.join("crates")).expect("readable") {
        files_with_prose(&package.expect("readable").path().join("src"), &mut files);
    }
    files_with_prose(&root.join("xtask/src"), &mut files);
    files.retain(|file| file.extension().is_some_and(|extension| extension == "rs"));
    assert!(files.len() > 500, "the search must see all crates");
    let mut found = Vec::new();
    for file in files {
        let name = file.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
        let lines = fragments(&fs::read_to_string(&file).expect("readable"));
        found.extend(lines.into_iter().map(|line| format!("{name}:{line}")));
    }
    assert!(found.is_empty(), "comments to begin with the noun or verb of their item:\n{}", found.join("\n"));
}

#[test]
fn fragments_are_found_at_the_start_of_comments() {
    let source = "//! The same, but faster.\n\n/// Its name.\nfn a() {}\n    /// Sum.\n    /// Of all.\n/// Often.\n\n/// Of";
    assert_eq!(fragments(source), [1, 3, 9]);
}

/// Lines of the offences in a text of a file.
fn lines(file: &str, text: &str) -> Vec<usize> {
    offences(&prose_of(Path::new(file), text)).iter().map(|(line, _, _)| *line).collect()
}

#[test]
fn the_search_sees_comments_and_strings_alone() {
    let source = "let tells = 'x'; // It tells.\nlet a = \"was told {told}\";\nlet b = r#\"\n tells \"#;\nlet c = '\"'; // `told`\n";
    assert_eq!(lines("a.rs", source), [1, 2, 4]);
    let source = "tell(1); // It's told.\n/** It\n tells */\nlet a = `was ${told}\n told`, b = \"told\";\n";
    assert_eq!(lines("a.js", source), [1, 3, 5]);
    let source = "told = 'x' # It tells.\n\"\"\"Is\n told.\"\"\"\na = 'was told' + \"told\"\n";
    assert_eq!(lines("a.py", source), [1, 3, 4]);
    assert_eq!(lines("run", "# what it tells\n"), [1]);
}
