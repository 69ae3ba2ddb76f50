//! The subcommands. A new one is a file here and a line in [`commands!`].

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
mod model_arguments;
mod new;
mod outcome;
mod parts;
mod path;
mod plot;
mod results;
mod run;
mod schema;
mod snapshot;
mod study;
mod sweep;
mod terminal;
mod tyre;
mod view;

use std::process::ExitCode;

use analysis::AnalysisCommand;
use clap::{Parser, Subcommand};
use lissom::analyses::buckling::BucklingRequest;
use lissom::analyses::campbell::CampbellRequest;
use lissom::analyses::gradient::GradientRequest;
use lissom::analyses::linearize::LinearizeRequest;
use lissom::analyses::modes::ModeRequest;
use lissom::analyses::reduce::ReduceRequest;
use lissom::analyses::response::ResponseRequest;

use self::outcome::{Exit, Failure};

/// Defines the commands, and lists them by topic in the help of the program.
macro_rules! commands {
    ($($topic:literal { $($name:ident($command:ty) $words:literal,)* })*) => {
        #[derive(Subcommand)]
        enum Command {
            $($($name($command),)*)*
        }

        impl Command {
            fn run(self) -> Result<Exit, Failure> {
                match self {
                    $($(Self::$name(command) => command.run(),)*)*
                }
            }
        }

        /// The help of the program: its commands by topic.
        fn help() -> String {
            let mut text = "{about-with-newline}\n{usage-heading} {usage}\n".to_owned();
            $(text += concat!("\n", $topic, ":\n");
            $(text += &format!("  {:<11}  {}\n", stringify!($name).to_lowercase(), $words);)*)*
            text + "  help         Print this message, or the help of a command\n\nOptions:\n{options}{after-help}"
        }
    };
}

commands! {
    "Models" {
        New(new::New) "Write a commented model to start from: a slider crank with a flexible rod",
        Check(check::Check) "Find errors, degrees of freedom and redundant constraints",
        Kinds(kinds::Kinds) "List kinds, keys, functions and schemes of model files",
        Parts(parts::Parts) "List ready-made parts, print one, or write it to a file",
        Schema(schema::Schema) "Print the JSON schema of model files, for completion in editors",
        Tyre(tyre::Tyre) "Show the forces of a tyre property file",
        Import(import::Import) "Convert a robot description (URDF, MJCF, SDF) to a model file",
    }
    "Simulation" {
        Run(run::Run) "Simulate a model as specified in its table `[analysis]`",
        Live(live::Live) "Show a model in the browser and simulate it again whenever it is saved",
        Sweep(sweep::SweepCommand) "Solve a model for many parameter values, on all processors",
        Gradient(AnalysisCommand<GradientRequest>) "Compute derivatives of an output with respect to numbers of the model",
        Study(study::Study) "Study the effects of scheme and step size",
        Fmu(fmu::Fmu) "Export a model as a functional mock-up unit (FMI 3.0, co-simulation)",
    }
    "Linearised models" {
        Modes(AnalysisCommand<ModeRequest>) "Compute natural frequencies, damping ratios and shapes",
        Campbell(AnalysisCommand<CampbellRequest>) "Compute natural frequencies over a parameter, such as the speed of a rotor",
        Buckling(AnalysisCommand<BucklingRequest>) "Estimate the load factors at which a model buckles",
        Response(AnalysisCommand<ResponseRequest>) "Compute the response of outputs to harmonic inputs",
        Linearize(AnalysisCommand<LinearizeRequest>) "Write the matrices of a model",
        Reduce(AnalysisCommand<ReduceRequest>) "Reduce flexible parts to a superelement",
    }
    "Results" {
        View(view::View) "Show results as an animation with plots, in one HTML file",
        Snapshot(snapshot::Snapshot) "Draw a mechanism at one or several instants, as SVG or PNG",
        Plot(plot::Plot) "Plot one or several folders of results",
        Export(export::Export) "Export results to ParaView, Blender, NumPy or pandas",
        Explain(explain::Explain) "Explain warnings and failures",
    }
    "Program" {
        Completions(completions::Completions) "Print the completion script for a shell",
        Man(completions::Man) "Print the manual page of the program or of a command",
    }
}

/// Flexible multibody dynamics: simulates mechanisms of rigid bodies, flexible beams, joints and springs,
/// described in a TOML file.
#[derive(Parser)]
#[command(
    name = "lissom",
    version,
    help_template = help(),
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

impl Line {
    /// Runs the command line.
    pub(crate) fn run(self) -> ExitCode {
        let cut = |exit| terminal::cut().map_or(Ok(exit), |error| Err(Failure::new(Exit::Failed, &error)));
        let result = self.command.run().and_then(cut);
        let exit = result.unwrap_or_else(|failure| {
            terminal::complain(&failure.words);
            failure.exit
        });
        ExitCode::from(exit.code())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/commands/mod.rs"]
mod tests;
