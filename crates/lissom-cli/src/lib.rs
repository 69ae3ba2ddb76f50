//! The program `lissom`: one subcommand per file in `commands`.

mod commands;

use std::process::ExitCode;

use clap::Parser;
use lissom::units;

/// Executes the command of the process's arguments.
#[must_use]
pub fn main() -> ExitCode {
    // A file that reaches the limit of the shell (`ulimit -f`) is then an error of writing, which is reported, instead of the end of
    // the program without a word.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
    if std::env::args_os().nth(1).is_some_and(|argument| argument == units::COMMAND) {
        // For simulations only: no command for users.
        return units::serve().map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS);
    }
    if let Ok(program) = std::env::current_exe() {
        units::set_host(program, vec![units::COMMAND.to_owned()]);
    }
    commands::Line::parse().run()
}
