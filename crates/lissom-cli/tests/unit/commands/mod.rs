//! Tests of `commands`, a module of it.

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
