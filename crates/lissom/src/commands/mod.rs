//! The subcommands. A new one is a file here, a variant of [`Command`] and a line in [`Line::run`].

mod buckling;
mod campbell;
mod check;
mod completions;
mod explain;
mod export;
mod fmu;
mod gradient;
mod import;
mod initial_scene;
mod kinds;
mod linearization;
mod linearize;
mod live;
#[cfg(test)]
mod manual;
mod modes;
mod new;
mod path;
mod plot;
mod reduce;
mod response;
mod results;
mod run;
mod schema;
mod snapshot;
mod study;
mod sweep;
mod view;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use lissom::{CommandError, Diagnose, Diagnostic, Document, Model, Override, Report, with_code};

use crate::terminal;

/// Exit code of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Success.
    Done,
    /// The model or the command line is invalid.
    BadModel,
    /// There is no solution, or it cannot be written.
    Failed,
    /// Ctrl-C.
    Interrupted,
}

impl Exit {
    /// The exit code.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::BadModel => 2,
            Self::Failed => 3,
            Self::Interrupted => 130,
        }
    }
}

/// The failure of a command: exit code and message.
pub(crate) struct Failure {
    exit: Exit,
    words: String,
}

impl Failure {
    /// A failure with its code.
    fn new(exit: Exit, error: &impl Diagnose) -> Self {
        Self::with_details(exit, &error.diagnostic(), "")
    }

    /// Arguments that do not match each other or what they name.
    fn request(reason: impl Into<String>) -> Self {
        Self::new(Exit::BadModel, &CommandError::Request(reason.into()))
    }

    /// A failure with its code. The lines `details` follow the message.
    fn with_details(exit: Exit, diagnostic: &Diagnostic, details: &str) -> Self {
        let explained = explained(diagnostic.code);
        let remedy = diagnostic.remedy().map_or_else(String::new, |remedy| format!("  remedy: {remedy}\n"));
        Self { exit, words: format!("error: {}\n{remedy}{details}{explained}", diagnostic.cause) }
    }
}

impl From<Report> for Failure {
    fn from(report: Report) -> Self {
        let explained = explained(report.diagnostic().code);
        let words = report.render(terminal::in_colour()) + &format!("{report}\n{explained}");
        Self { exit: Exit::BadModel, words }
    }
}

/// The command that explains a code, as a line below a message.
fn explained(code: &str) -> String {
    format!("  `lissom explain {code}` explains it\n")
}

/// The help of the program: its commands by topic.
const HELP: &str = "\
{about-with-newline}
{usage-heading} {usage}

Models:
  new          Write a commented model to start from: a slider crank with a flexible rod
  check        Find errors, degrees of freedom and redundant constraints
  kinds        List kinds, keys, functions and schemes of model files
  schema       Print the JSON schema of model files, for completion in editors
  import       Convert a robot description (URDF, MJCF) to a model file

Simulation:
  run          Simulate a model as specified in its table `[analysis]`
  live         Show a model in the browser and simulate it again whenever it is saved
  sweep        Solve a model for many parameter values, on all processors
  gradient     Compute derivatives of an output with respect to numbers of the model
  study        Study the effects of scaling, scheme, step size and solver
  fmu          Export a model as a functional mock-up unit (FMI 3.0, co-simulation)

Linearised models:
  modes        Compute natural frequencies, damping ratios and shapes
  campbell     Compute natural frequencies over a parameter, such as the speed of a rotor
  buckling     Estimate the load factors at which a model buckles
  response     Compute the response of outputs to harmonic inputs
  linearize    Write the matrices of a model
  reduce       Reduce flexible parts to a superelement

Results:
  view         Show results as an animation with plots, in one HTML file
  snapshot     Draw a mechanism at one or several instants, as SVG or PNG
  plot         Plot one or several folders of results
  export       Export results to ParaView, Blender, NumPy or pandas
  explain      Explain warnings and failures

Program:
  completions  Print the completion script for a shell
  man          Print the manual page of the program or of a command
  help         Print this message, or the help of a command

Options:
{options}{after-help}";

/// Flexible multibody dynamics: simulates mechanisms of rigid bodies, flexible beams, joints and springs,
/// described in a TOML file.
#[derive(Parser)]
#[command(
    name = "lissom",
    version,
    help_template = HELP,
    after_help = "\
Examples:
  lissom run examples/pendulum.toml            simulate; results go to out/pendulum
  lissom view examples/four-bar.toml --open    simulate, and watch the motion in the browser
  lissom snapshot out/pendulum --strip 6       a picture at six instants, as SVG or PNG
  lissom check examples/four-bar.toml          find errors and redundant constraints
  lissom modes examples/four-bar.toml          natural frequencies and shapes
  lissom kinds                                 kinds and keys of a model file
  lissom schema > lissom.schema.json           schema for editors

Exit code: 0 success; 2 wrong model or command line; 3 no solution; 130 interrupted by Ctrl-C."
)]
pub(crate) struct Line {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(run::Run),
    Check(check::Check),
    Modes(modes::Modes),
    Buckling(buckling::Buckling),
    Gradient(gradient::Gradient),
    Campbell(campbell::Campbell),
    Response(response::Response),
    Linearize(linearize::Linearize),
    Reduce(reduce::Reduce),
    Fmu(fmu::Fmu),
    Kinds(kinds::Kinds),
    Schema(schema::Schema),
    Plot(plot::Plot),
    Snapshot(snapshot::Snapshot),
    Export(export::Export),
    Explain(explain::Explain),
    Study(study::Study),
    View(view::View),
    Sweep(sweep::SweepCommand),
    Live(live::Live),
    New(new::New),
    Import(import::Import),
    Completions(completions::Completions),
    Man(completions::Man),
}

impl Line {
    /// Runs the command line.
    pub(crate) fn run(self) -> ExitCode {
        let outcome = match self.command {
            Command::Run(command) => command.run(),
            Command::Check(command) => command.run(),
            Command::Modes(command) => command.run(),
            Command::Buckling(command) => command.run(),
            Command::Gradient(command) => command.run(),
            Command::Campbell(command) => command.run(),
            Command::Response(command) => command.run(),
            Command::Linearize(command) => command.run(),
            Command::Reduce(command) => command.run(),
            Command::Fmu(command) => command.run(),
            Command::Kinds(command) => command.run(),
            Command::Schema(command) => command.run(),
            Command::Plot(command) => command.run(),
            Command::Snapshot(command) => command.run(),
            Command::Export(command) => command.run(),
            Command::Explain(command) => command.run(),
            Command::Study(command) => command.run(),
            Command::View(command) => command.run(),
            Command::Sweep(command) => command.run(),
            Command::Live(command) => command.run(),
            Command::New(command) => command.run(),
            Command::Import(command) => command.run(),
            Command::Completions(command) => Ok(command.run()),
            Command::Man(command) => command.run(),
        };
        let exit = outcome.unwrap_or_else(|failure| {
            terminal::complain(&failure.words);
            failure.exit
        });
        ExitCode::from(exit.code())
    }
}

/// A model file and its overrides, for every command that reads a model.
#[derive(Args)]
struct ModelArguments {
    /// The model file.
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = parse_override)]
    set: Vec<Override>,

    /// Remove a value or an entry from the model, such as `analysis.step` or `springs.damper`; may be repeated.
    #[arg(long, value_name = "PATH")]
    unset: Vec<String>,
}

impl ModelArguments {
    /// The text and the checked document.
    fn read(&self) -> Result<(Model, Document), Failure> {
        let model = Model::read(&self.model).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        let model = model.without(self.unset.clone());
        let document = model.document(&self.set)?;
        Ok((model, document))
    }

    /// The folder for results: the given one, or out/<name of the model file>-`of`.
    fn folder(&self, given: Option<PathBuf>, of: &str) -> PathBuf {
        let stem = self.model.file_stem().unwrap_or_default().to_string_lossy();
        given.unwrap_or_else(|| Path::new("out").join(format!("{stem}-{of}")))
    }
}

fn parse_override(text: &str) -> Result<Override, String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => {
            Ok((path.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("it must be PATH=VALUE, such as `analysis.step=1e-4`".to_owned()),
    }
}

/// Shows a warning with its code on the terminal.
fn warn(warning: &impl Diagnose) {
    terminal::complain(&format!("warning: {}\n", with_code(warning)));
}

/// The warnings of a model, on the terminal.
fn show_warnings(document: &Document) {
    if !document.warnings.is_empty() {
        terminal::complain(&document.warnings.render(terminal::in_colour()));
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_help_lists_every_command_once_and_fits_a_terminal() {
        let line = Line::command();
        let listed = |name: &str| HELP.matches(&format!("\n  {name} ")).count();
        for command in line.get_subcommands() {
            assert_eq!(listed(command.get_name()), 1, "{}", command.get_name());
        }
        let rows = HELP.lines().filter(|row| row.starts_with("  "));
        assert_eq!(rows.clone().count(), line.get_subcommands().count() + 1, "with `help`");
        assert!(rows.into_iter().all(|row| row.len() <= 90));
    }
}
