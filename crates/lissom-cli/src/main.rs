//! The program `lissom`: one subcommand per file in `commands`.

mod commands;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    commands::Line::parse().run()
}
