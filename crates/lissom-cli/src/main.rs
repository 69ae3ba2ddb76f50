//! The program `lissom`: one subcommand per file in `commands`.

mod commands;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    // A file that reaches the limit of the shell (`ulimit -f`) is then an error of writing, which is reported, instead of the end of
    // the program without a word.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
    commands::Line::parse().run()
}
