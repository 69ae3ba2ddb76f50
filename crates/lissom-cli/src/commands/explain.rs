//! `lissom explain`: entries of the catalogue of warnings and failures.

use std::path::Path;

use clap::Args;
use lissom::catalogue;
use lissom::core::diagnostics::Entry;
use lissom::model::meant;
use serde_json::Value;

use super::outcome::{Exit, Failure};
use super::terminal;

/// Explain warnings and failures, by code, by words of the message, or all that a run has reported.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom explain                      all codes of warnings and failures
  lissom explain energy-surplus
  lissom explain did not converge     words of a message
  lissom explain out/tip-crank        the warnings of this run

Exit code: 0 success; 2 no such entry.")]
pub(super) struct Explain {
    /// A code, words of a message, or a folder of results [default: list all codes].
    #[arg(value_name = "CODE|WORDS|RESULT")]
    what: Vec<String>,
}

/// Whether an entry contains these words.
fn has(entry: &Entry, words: &str) -> bool {
    let texts = [entry.code, entry.message, entry.meaning, &entry.advice()];
    texts.iter().any(|text| text.to_lowercase().contains(&words.to_lowercase()))
}

fn render(entry: &Entry) -> String {
    format!("{}\n  {}\n  {}\n", entry.code, entry.meaning, entry.advice())
}

fn find(code: &str) -> Option<&'static Entry> {
    catalogue().find(|entry| entry.code == code)
}

impl Explain {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let words = self.what.join(" ");
        if Path::new(&words).is_dir() {
            terminal::print(&of_run(Path::new(&words))?);
            return Ok(Exit::Done);
        }
        let found: Vec<&Entry> = match find(&words) {
            Some(entry) => vec![entry],
            None => catalogue().filter(|entry| has(entry, &words)).collect(),
        };
        if found.is_empty() {
            let codes: Vec<&str> = catalogue().map(|entry| entry.code).collect();
            if let Some(code) = meant(&words, &codes).first() {
                return Err(Failure::request(format!("there is no code `{words}`; did you mean `{code}`?")));
            }
            return Err(Failure::request(format!(
                "no warning or failure contains `{words}`; `lissom explain` prints all, and `lissom kinds {words}` explains the words of \
                 model files"
            )));
        }
        terminal::print(&found.into_iter().map(render).collect::<String>());
        Ok(Exit::Done)
    }
}

/// The reports in the summary of a run, each with its explanation.
fn of_run(folder: &Path) -> Result<String, Failure> {
    let path = folder.join("summary.json");
    let text =
        lissom::model::files::read_text(&path).map_err(|error| Failure::new(Exit::BadModel, &error))?;
    let summary: Value = serde_json::from_str(&text)
        .map_err(|error| Failure::request(format!("`{}`: {error}", path.display())))?;
    let mut lines: Vec<String> = Vec::new();
    let mut report = |what: &str, message: &str, code: &str| {
        lines.push(format!("{what}: {message}"));
        if let Some(entry) = find(code) {
            lines.extend([format!("  {}", entry.meaning), format!("  {}", entry.advice())]);
        }
    };
    for warning in summary["warnings"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        // A warning in the summary begins with its code.
        report("warning", warning, warning.split(':').next().unwrap_or_default());
    }
    if let Some(error) = summary["error"].as_str() {
        report("error", error, summary["failure"]["code"].as_str().unwrap_or_default());
    }
    if lines.is_empty() {
        lines.push("this run has no warnings".to_owned());
    }
    Ok(lines.join("\n") + "\n")
}

#[cfg(test)]
#[path = "../../tests/unit/commands/explain.rs"]
mod tests;
