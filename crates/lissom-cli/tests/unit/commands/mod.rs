//! Tests of `commands`, a module of it.

use std::fs;
use std::path::{Path, PathBuf};

use clap::CommandFactory;

use super::*;

#[test]
fn every_analysis_has_a_command() {
    let line = Line::command();
    for analysis in lissom::analyses::ANALYSES {
        assert!(line.find_subcommand(analysis.name).is_some(), "{}", analysis.name);
    }
}

#[test]
fn the_help_lists_every_command_once_and_fits_a_terminal() {
    let line = Line::command();
    let help = help();
    let listed = |name: &str| help.matches(&format!("\n  {name} ")).count();
    for command in line.get_subcommands() {
        assert_eq!(listed(command.get_name()), 1, "{}", command.get_name());
    }
    let rows = help.lines().filter(|row| row.starts_with("  "));
    assert_eq!(rows.clone().count(), line.get_subcommands().count() + 1, "with `help`");
    assert!(rows.into_iter().all(|row| row.len() <= 90));
}

/// Pages of the manual.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            found.push(path);
        }
    }
}

/// Words of a command as a shell separates them, without a comment.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut word, mut quote) = (Vec::new(), String::new(), None);
    let mut is_open = false;
    for letter in line.chars() {
        match (letter, quote) {
            (letter, Some(mark)) if letter == mark => quote = None,
            ('\'' | '"', None) => (quote, is_open) = (Some(letter), true),
            ('#', None) if !is_open => break,
            (' ', None) => {
                if is_open {
                    words.push(std::mem::take(&mut word));
                }
                is_open = false;
            }
            (letter, _) => {
                word.push(letter);
                is_open = true;
            }
        }
    }
    if is_open {
        words.push(word);
    }
    words
}

#[test]
fn commands_of_the_manual_are_understood() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut found = vec![root.join("README.md")];
    pages(&root.join("docs"), &mut found);
    let mut count = 0;
    for page in found {
        let text = fs::read_to_string(&page).unwrap();
        let mut is_shell = false;
        for line in text.lines() {
            if line.starts_with("```") {
                is_shell = line == "```sh";
            } else if is_shell && let Some(command) = line.strip_prefix("lissom ") {
                let command = command.split(['|', '>']).next().unwrap_or_default();
                let given = std::iter::once("lissom".to_owned()).chain(words(command));
                if let Err(error) = Line::try_parse_from(given) {
                    panic!("{}: `{line}`: {error}", page.display());
                }
                count += 1;
            }
        }
    }
    assert!(count > 40, "{count} commands were found");
}

#[test]
fn words_are_those_of_a_shell() {
    let found = words("run a.toml --set 'points.C=[1, 0]'   --out b  # a comment");
    assert_eq!(found, ["run", "a.toml", "--set", "points.C=[1, 0]", "--out", "b"]);
}
