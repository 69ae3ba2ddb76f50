//! `lissom linearize`: the matrices of the linear model.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::linearize::{LinearizeReport, LinearizeRequest, linearize};
use lissom::summary;

use super::linearization::{StateArgument, answered};
use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{folder_for, unwritable};
use crate::terminal;
use lissom_core::number::duration;

/// Write the matrices of the model linearised about a state.
///
/// The results go to a folder, in the Matrix Market format: mass `M.mtx`, damping `D.mtx`, stiffness `K.mtx`, gradient of the
/// constraints `G.mtx`, `inputs.mtx`, `outputs-*.mtx`, `unknowns.csv` (names of the rows). For models with up to 600
/// coordinates also `state-space-A.mtx` … `state-space-D.mtx` with `states.csv`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom linearize examples/tip-crank.toml
  lissom linearize examples/tip-crank.toml --input drive --output midspan

An input is an entry of [inputs], a load (per unit of its size) or a prescribed motion (per m or rad), such as `motor`, or
`loads.motor` if several entries have the same name.
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about.")]
pub(super) struct Linearize {
    #[command(flatten)]
    model: ModelArguments,

    /// Inputs: entries of [inputs], loads or prescribed motions.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    input: Vec<String>,

    /// Outputs, or columns of them.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    output: Vec<String>,

    #[command(flatten)]
    state: StateArgument,

    /// Folder for the results [default: out/<name of the model file>-linear].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Linearize {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let request = LinearizeRequest { about: self.state.about, inputs: self.input, outputs: self.output };
        let found = answered(linearize(&model, &self.model.set, &request))?;
        let path = self.model.folder(self.out, "linear");
        let (folder, found) = folder_for(&path, found, || {
            summary::of_request("linearize", model.name(), &self.model.set, &document)
        })?;
        for (name, text) in &found.files {
            folder.write_table(name, text).map_err(unwritable)?;
        }
        let summary = found.summary(model.name(), &self.model.set, &document);
        folder.write_summary(&summary).map_err(unwritable)?;
        if !self.quiet {
            for warning in &found.warnings {
                warn(warning);
            }
            terminal::print(&render(document.title.as_deref().unwrap_or(model.name()), &found, &path));
        }
        Ok(Exit::Done)
    }
}

/// The summary for the terminal.
fn render(heading: &str, found: &LinearizeReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    let [coordinates, multipliers] = found.unknowns;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  linear model about {}: {coordinates} coordinates, {multipliers} multipliers, {} inputs, {} outputs, {}",
        found.about,
        found.inputs.len(),
        found.outputs.len(),
        duration(found.wall.as_secs_f64())
    );
    let _ = match &found.state_space {
        Ok(matrices) => writeln!(text, "  first-order equations in {} states", matrices.states.len()),
        Err(reason) => writeln!(text, "  no first-order equations: {reason}"),
    };
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
