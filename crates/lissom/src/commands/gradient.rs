//! `lissom gradient`: derivatives of an output with respect to numbers of the model file.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::gradient::{Confirmation, GradientError, GradientReport, Target, gradient};
use lissom::{FolderError, ResultFolder, summary};

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use crate::terminal;
use lissom_core::number::{Written, duration};

/// Compute derivatives of an output with respect to numbers of the model file.
///
/// The results go to a folder: `gradient.csv` (path, number, derivative) and `summary.json`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom gradient examples/pendulum.toml --of bob.x@0.5 --by point_masses.bob.mass,springs.spring.stiffness
  lissom gradient examples/tip-crank.toml --of midspan.u3@max --by materials.steel.E

Exit code: 0 success; 2 wrong model or command line; 3 no solution.")]
pub(super) struct Gradient {
    #[command(flatten)]
    model: ModelArguments,

    /// Output column, and a scalar derived from it: `tip.u3` (at the end), `tip.u3@0.5` (at a time), `tip.u3@max`, `tip.u3@rms`.
    #[arg(long, value_name = "OUTPUT[@TIME|max|rms]")]
    of: String,

    /// Paths of numbers in the model file, such as `bodies.top.mass,springs.s.stiffness`.
    #[arg(long, value_name = "PATH,…", value_delimiter = ',', required = true)]
    by: Vec<String>,

    /// Folder for the results [default: out/<name of the model file>-gradient].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Skip the run with perturbed numbers that verifies the derivatives.
    #[arg(long)]
    unconfirmed: bool,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Gradient {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let target: Target = self.of.parse().map_err(|words: String| Failure::request(words))?;
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let found = match gradient(&model, &self.model.set, &target, &self.by, !self.unconfirmed) {
            Err(GradientError::Model(report)) => return Err(report.into()),
            Err(error) if error.is_of_question() => return Err(Failure::new(Exit::BadModel, &error)),
            other => other,
        };
        let path = self.model.folder(self.out, "gradient");
        let unwritable = |error: lissom::FileError| Failure::new(Exit::Failed, &FolderError::from(error));
        let folder = ResultFolder::create(&path).map_err(unwritable)?;
        folder.clear().map_err(unwritable)?;
        let found = match found {
            Ok(found) => found,
            Err(error) => {
                let mut summary = summary::of_request("gradient", model.name(), &self.model.set, &document);
                summary::of_failure(&mut summary, &error);
                folder.write_summary(&summary).map_err(unwritable)?;
                return Err(Failure::new(Exit::Failed, &error));
            }
        };
        folder.write_table("gradient.csv", &found.csv()).map_err(unwritable)?;
        let summary = found.summary(model.name(), &self.model.set, &document, &self.of);
        folder.write_summary(&summary).map_err(unwritable)?;
        if !self.quiet {
            let heading = document.title.as_deref().unwrap_or(model.name());
            terminal::print(&render(heading, &self.of, &found, &path));
        }
        if let Some(doubt) = found.doubt() {
            warn(&doubt);
        }
        Ok(Exit::Done)
    }
}

/// The summary for the terminal.
fn render(heading: &str, of: &str, found: &GradientReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    let time = found.time.map_or_else(String::new, |time| format!(" at t = {} s", Written(time)));
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  {of} = {:.9e}{time}, {} steps, {} corrections, {}",
        Written(found.value),
        found.steps,
        found.corrections,
        duration(found.wall.as_secs_f64())
    );
    for derivative in &found.derivatives {
        let _ = writeln!(
            text,
            "  by {} = {}: {:.9e}",
            derivative.path,
            Written(derivative.number),
            Written(derivative.value)
        );
    }
    if let Some(Confirmation::Confirmed { missed, runs }) = &found.confirmation {
        let _ = writeln!(
            text,
            "  verified to {:.1e} by {runs} run(s) with all numbers perturbed",
            Written(*missed)
        );
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
