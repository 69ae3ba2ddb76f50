//! Words that comments, messages and the manual do not use, with the field's word for each.

use std::fs;
use std::path::Path;

use crate::house_rules::{pages, sources};

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

/// Comments and strings of a source, without code in braces or backticks; lines are kept.
fn prose(source: &str) -> String {
    let mut text = String::new();
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let raw_hashes =
            rest.strip_prefix('r').map(|after| after.len() - after.trim_start_matches('#').len());
        let (opening, length, is_prose) = if rest.starts_with("//") {
            (0, rest.find('\n').unwrap_or(rest.len()), true)
        } else if let Some(hashes) = raw_hashes.filter(|hashes| rest[1 + hashes..].starts_with('"')) {
            let end = format!("\"{}", "#".repeat(hashes));
            let opening = hashes + 2;
            (opening, opening + rest[opening..].find(&end).expect("an end"), true)
        } else if first == '"' {
            (1, end_of_string(rest), true)
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\") {
            (0, 2 + rest[2..].find('\'').expect("an end") + 1, false)
        } else if first.is_alphanumeric() || first == '_' {
            let is_word = |c: char| c.is_alphanumeric() || c == '_';
            (0, rest.find(|c| !is_word(c)).unwrap_or(rest.len()), false)
        } else {
            (0, first.len_utf8(), false)
        };
        // A string of one word is a name.
        if is_prose && rest[opening..length].contains(' ') {
            text.push_str(&without_code(&rest[opening..length]));
        } else {
            text.extend(rest[..length].chars().filter(|c| *c == '\n'));
        }
        let closing = if opening == 0 { 0 } else { opening - usize::from(rest.starts_with('r')) };
        rest = &rest[length + closing..];
    }
    text
}

/// Where the string that begins with a quotation mark ends.
fn end_of_string(text: &str) -> usize {
    let mut is_escaped = true;
    let end = text.find(|c: char| {
        let is_end = c == '"' && !is_escaped;
        is_escaped = c == '\\' && !is_escaped;
        is_end
    });
    end.expect("an end")
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

#[test]
fn worst_words_are_not_used() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = ["ARCHITECTURE.md", "CONTRIBUTING.md", "README.md"].map(|name| root.join(name)).to_vec();
    pages(&root.join("docs"), &mut files);
    for folder in ["crates", "xtask"] {
        sources(&root.join(folder), &mut files);
    }
    let mut found = Vec::new();
    for file in files {
        let name = file.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("readable");
        // This file has the words; others are generated from sources that are searched.
        if name.ends_with("tests/prose.rs") || name == "docs/reference.md" || text.starts_with("// Made by") {
            continue;
        }
        let text = if Path::new(&name).extension().is_some_and(|extension| extension == "rs") {
            prose(&text)
        } else {
            without_code(&text)
        };
        for (line, word, replacement) in offences(&text) {
            found.push(format!("{name}:{line}: `{word}`; write: {replacement}"));
        }
    }
    assert!(found.is_empty(), "words to replace:\n{}", found.join("\n"));
}

#[test]
fn the_search_sees_comments_and_strings_alone() {
    let source = "let tells = 'x'; // It tells.\nlet a = \"was told {told}\";\nlet b = r#\"\n tells \"#;\nlet c = '\"'; // `told`\n";
    let lines: Vec<usize> = offences(&prose(source)).iter().map(|(line, _, _)| *line).collect();
    assert_eq!(lines, [1, 2, 4]);
}
