//! `lissom explain`: what warnings and failures mean, and what to do. The words are those of the manual.

use std::path::Path;

use clap::Args;
use serde_json::Value;

use super::{Exit, Failure};
use crate::terminal;

/// The chapter of the manual; a test keeps it the same as `docs/warnings.md`.
const CHAPTER: &str = include_str!("explain.md");

/// Explain warnings and failures: a code, words of a message, or all that a run has reported.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom explain                      all codes of warnings, and messages of failures
  lissom explain energy-surplus
  lissom explain did not converge     words of a message
  lissom explain out/tip-crank        what this run has told

Exit code: 0 there is an explanation; 2 there is none.")]
pub(super) struct Explain {
    /// A code, words of a message, or a folder of results.
    #[arg(value_name = "CODE|WORDS|RESULT")]
    what: Vec<String>,
}

/// A row of the chapter's tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry<'a> {
    /// Code of a warning, or words of a failure's message with `…` where others stand.
    name: &'a str,
    /// What it means; empty for failures.
    means: &'a str,
    /// What to do, or the likely cause.
    remedy: &'a str,
}

impl Entry<'_> {
    /// Whether a message says this: all words between the dots, in their order.
    fn is_said_by(&self, message: &str) -> bool {
        let mut rest = message;
        self.name.split('…').flat_map(|part| part.split(", in statics")).map(str::trim).all(|part| match rest
            .find(part)
        {
            Some(at) => {
                rest = &rest[at + part.len()..];
                true
            }
            None => false,
        })
    }

    /// Whether words that somebody remembers are in its name.
    fn has(&self, words: &str) -> bool {
        self.name.to_lowercase().contains(&words.to_lowercase())
    }

    fn render(&self) -> String {
        let Self { name, means, remedy } = self;
        if means.is_empty() {
            format!("{name}\n  {remedy}\n")
        } else {
            format!("{name}\n  {means}\n  {remedy}\n")
        }
    }
}

/// Rows of the table below a heading, without backquotes about their names.
fn table(heading: &str) -> Vec<Entry<'static>> {
    let section = CHAPTER.split("\n## ").find(|section| section.starts_with(heading)).unwrap_or_default();
    let row = |line: &'static str| {
        let cells: Vec<&str> = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect();
        match *cells {
            [name, means, remedy] => Some(Entry { name: name.trim_matches('`'), means, remedy }),
            [name, remedy] => Some(Entry { name: name.trim_matches('`'), means: "", remedy }),
            _ => None,
        }
    };
    // The first row names the columns.
    section.lines().filter_map(row).skip(1).collect()
}

impl Explain {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (warnings, failures) = (table("Warnings"), table("Failures"));
        let words = self.what.join(" ");
        if words.is_empty() {
            let all: String = warnings.iter().chain(&failures).map(Entry::render).collect();
            terminal::print(&all);
            return Ok(Exit::Done);
        }
        if Path::new(&words).is_dir() {
            terminal::print(&of_run(Path::new(&words), &warnings, &failures)?);
            return Ok(Exit::Done);
        }
        let mut found: Vec<Entry<'_>> =
            warnings.iter().copied().filter(|entry| entry.name == words).collect();
        if found.is_empty() {
            found = warnings.iter().chain(&failures).copied().filter(|entry| entry.has(&words)).collect();
            found.extend(failures.iter().filter(|entry| !entry.has(&words) && entry.is_said_by(&words)));
        }
        if found.is_empty() {
            let codes: Vec<&str> = warnings.iter().map(|entry| entry.name).collect();
            let message =
                format!("nothing is known of `{words}`; codes of warnings are {}", codes.join(", "));
            return Err(Failure::new(Exit::BadModel, format!("{message}; `lissom explain` prints all")));
        }
        terminal::print(&found.iter().map(Entry::render).collect::<String>());
        Ok(Exit::Done)
    }
}

/// What a run has reported in its summary, each with its explanation.
fn of_run(folder: &Path, warnings: &[Entry<'_>], failures: &[Entry<'_>]) -> Result<String, Failure> {
    let path = folder.join("summary.json");
    let text =
        lissom_model::files::read_text(&path).map_err(|error| Failure::file(Exit::BadModel, &error))?;
    let summary: Value = serde_json::from_str(&text)
        .map_err(|error| Failure::new(Exit::BadModel, format!("`{}`: {error}", path.display())))?;
    let mut lines: Vec<String> = Vec::new();
    for warning in summary["warnings"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        let code = warning.split(':').next().unwrap_or_default();
        lines.push(format!("warning: {warning}"));
        if let Some(entry) = warnings.iter().find(|entry| entry.name == code) {
            lines.extend([format!("  {}", entry.means), format!("  {}", entry.remedy)]);
        }
    }
    if let Some(error) = summary["error"].as_str() {
        lines.push(format!("error: {error}"));
        let causes = failures.iter().filter(|entry| entry.is_said_by(error));
        lines.extend(causes.map(|entry| format!("  likely cause: {}", entry.remedy)));
    }
    if lines.is_empty() {
        lines.push("this run has no warnings".to_owned());
    }
    Ok(lines.join("\n") + "\n")
}

#[cfg(test)]
mod tests {
    use std::fs::read_to_string;

    use super::*;

    #[test]
    fn the_words_are_those_of_the_manual() {
        let manual = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/warnings.md");
        let same = read_to_string(manual).unwrap() == CHAPTER;
        assert!(same, "copy docs/warnings.md to crates/lissom/src/commands/explain.md");
    }

    #[test]
    fn every_code_is_explained() {
        let source = concat!(env!("CARGO_MANIFEST_DIR"), "/../lissom-core/src/judge/warning.rs");
        let text = read_to_string(source).unwrap();
        let (_, codes) = text.split_once("fn code").unwrap();
        let codes: Vec<&str> = codes.split('"').skip(1).step_by(2).collect();
        assert!(codes.len() >= 6 && codes.contains(&"jump"), "{codes:?}");
        let known = table("Warnings");
        for code in codes {
            let entry = known.iter().find(|entry| entry.name == code);
            let entry = entry.unwrap_or_else(|| panic!("`{code}` is not in docs/warnings.md"));
            assert!(!entry.means.is_empty() && !entry.remedy.is_empty(), "{code}");
        }
    }

    #[test]
    fn messages_of_failures_are_found() {
        let failures = table("Failures");
        assert!(failures.len() >= 7, "{failures:?}");
        let of = |message: &str| failures.iter().filter(|entry| entry.is_said_by(message)).count();
        assert_eq!(of("at t = 1 s `wheel` turns by 1.9 rad in it: the step is too long"), 1);
        assert_eq!(of("the beam element `bar` 3 turns by 2.9 rad between its nodes"), 1);
        assert_eq!(of("all is well"), 0);
    }
}
