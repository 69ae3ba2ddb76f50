//! `lissom completions` and `lissom man`: shell completions and manual pages.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::results::writing_failed;
use super::{Exit, Failure, Line};
use crate::terminal;

/// Print the completion script for a shell.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom completions bash > ~/.local/share/bash-completion/completions/lissom
  lissom completions fish > ~/.config/fish/completions/lissom.fish")]
pub(super) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(super) fn run(self) -> Exit {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Line::command(), "lissom", &mut script);
        terminal::print(&String::from_utf8_lossy(&script));
        Exit::Done
    }
}

/// Print the manual page of the program, or of one of its commands.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom man | man -l -
  lissom man run > lissom-run.1")]
pub(super) struct Man {
    /// A command, such as `run`.
    command: Option<String>,
}

impl Man {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let mut line = Line::command();
        line.build();
        let mut title = "lissom".to_owned();
        let command = match &self.command {
            None => line,
            Some(name) => match line.find_subcommand(name) {
                Some(found) => {
                    title = format!("lissom-{name}");
                    found.clone()
                }
                None => return Err(Failure::request(format!("there is no command `{name}`"))),
            },
        };
        let mut page = Vec::new();
        clap_mangen::Man::new(command).title(title).render(&mut page).map_err(writing_failed)?;
        terminal::print(&String::from_utf8_lossy(&page));
        Ok(Exit::Done)
    }
}
