//! The program `lissom`: one subcommand per file in `commands`.

mod commands;
mod terminal;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    commands::Line::parse().run()
}
