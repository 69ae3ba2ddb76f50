//! `lissom completions` and `lissom man`: shell completions and manual pages.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::Line;
use super::outcome::{Exit, Failure};
use super::results::writing_failed;
use super::terminal;

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
    #[expect(clippy::unnecessary_wraps, reason = "all commands return this type")]
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Line::command(), "lissom", &mut script);
        terminal::print(&String::from_utf8_lossy(&script));
        Ok(Exit::Done)
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
        terminal::print(&with_sections(&String::from_utf8_lossy(&page)));
        Ok(Exit::Done)
    }
}

/// A manual page whose examples and exit codes, which help texts have below the options, are sections of their own.
fn with_sections(page: &str) -> String {
    let Some((before, extra)) = page.split_once(".SH EXTRA\n") else { return page.to_owned() };
    let (text, rest) = extra.split_once("\n.SH").unwrap_or((extra, ""));
    let (above, codes) = text.split_once("Exit code: ").unwrap_or((text, ""));
    let mut sections = vec![before.to_owned()];
    let notes = match above.strip_prefix("Examples:\n") {
        Some(examples) => {
            let (lines, notes) = examples.split_once("\n\n").unwrap_or((examples, ""));
            sections.push(format!(".SH EXAMPLES\n.nf\n{}\n.fi\n", lines.trim_end()));
            notes.trim()
        }
        None => above.trim(),
    };
    if !notes.is_empty() {
        sections.push(format!(".SH NOTES\n{notes}\n"));
    }
    if !codes.is_empty() {
        sections.push(".SH \"EXIT STATUS\"\n".to_owned());
        sections.extend(codes.trim().trim_end_matches('.').split("; ").map(|code| {
            let (number, meaning) = code.split_once(' ').unwrap_or((code, ""));
            format!(".TP\n\\fB{number}\\fR\n{meaning}\n")
        }));
    }
    if !rest.is_empty() {
        sections.push(format!(".SH{rest}"));
    }
    sections.concat()
}

#[cfg(test)]
#[path = "../../tests/unit/commands/completions.rs"]
mod tests;
