//! The subcommands. A new one is a file here, a variant of [`Command`] and a line in [`Line::run`].

mod analysis;
mod check;
mod completions;
mod explain;
mod export;
mod fmu;
mod import;
mod initial_scene;
mod kinds;
mod live;
#[cfg(test)]
mod manual;
mod model_arguments;
mod new;
pub(crate) mod outcome;
mod path;
mod plot;
mod results;
mod run;
mod schema;
mod snapshot;
mod study;
mod sweep;
mod view;

use std::process::ExitCode;

use analysis::AnalysisCommand;
use clap::{Parser, Subcommand};
use lissom::buckling::BucklingRequest;
use lissom::campbell::CampbellRequest;
use lissom::gradient::GradientRequest;
use lissom::linearize::LinearizeRequest;
use lissom::modes::ModeRequest;
use lissom::reduce::ReduceRequest;
use lissom::response::ResponseRequest;

use crate::terminal;

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
    Modes(AnalysisCommand<ModeRequest>),
    Buckling(AnalysisCommand<BucklingRequest>),
    Gradient(AnalysisCommand<GradientRequest>),
    Campbell(AnalysisCommand<CampbellRequest>),
    Response(AnalysisCommand<ResponseRequest>),
    Linearize(AnalysisCommand<LinearizeRequest>),
    Reduce(AnalysisCommand<ReduceRequest>),
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
