//! `lissom buckling`: load factors at which a model buckles, by a linear estimate.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::buckling::{BucklingReport, BucklingRunError, buckling, of_request};
use lissom::{Document, Model, Override};

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{folder_for, unwritable};
use crate::terminal;
use lissom_core::number::{Written, duration};

/// Estimate the load factors at which a model buckles, from its stiffness with and without the loads.
///
/// The results go to a folder: `buckling.csv` (number, load factor), `shapes.csv` and `summary.json`. The loads of the model must be
/// smaller than the critical ones.
#[derive(Args)]
#[command(after_help = "\
Example:
  lissom buckling column.toml --count 3

Exit code: 0 success; 2 wrong model or command line; 3 no equilibrium, loads that already exceed the critical ones, or \
load factors missed.")]
pub(super) struct Buckling {
    #[command(flatten)]
    model: ModelArguments,

    /// Number of load factors, the lowest first [default: 5].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    count: Option<u32>,

    /// Folder for the results [default: out/<name of the model file>-buckling].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Buckling {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        let folder = self.model.folder(self.out, "buckling");
        let count = self.count.map(|count| count as usize);
        report((&model, &self.model.set, &document), count, &folder, self.quiet)
    }
}

/// Computes the load factors and writes them to a folder.
pub(super) fn report(
    (model, overrides, document): (&Model, &[Override], &Document),
    count: Option<usize>,
    folder: &Path,
    quiet: bool,
) -> Result<Exit, Failure> {
    show_warnings(document);
    let found = match buckling(model, overrides, count) {
        Err(BucklingRunError::Model(report)) => return Err(report.into()),
        other => other,
    };
    let (folder, found) = folder_for(folder, found, || of_request(model.name(), overrides, document))?;
    folder.write_table("buckling.csv", &found.csv()).map_err(unwritable)?;
    folder.write_table("shapes.csv", &found.shapes_csv()).map_err(unwritable)?;
    folder.write_summary(&found.summary(model.name(), overrides, document)).map_err(unwritable)?;
    if !quiet {
        for warning in &found.warnings {
            warn(warning);
        }
        terminal::print(&render(document.title.as_deref().unwrap_or(model.name()), &found, folder.path()));
    }
    Ok(Exit::Done)
}

/// The summary for the terminal.
fn render(heading: &str, found: &BucklingReport, folder: &Path) -> String {
    let modes = &found.buckling.modes;
    let mut text = format!("{heading}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  {} load factors ({} requested), {}, {}",
        modes.len(),
        found.asked,
        match found.buckling.completeness.name() {
            "counted" => "none missed according to a count of pivots",
            _ => "not counted",
        },
        duration(found.wall.as_secs_f64())
    );
    for (index, mode) in modes.iter().enumerate() {
        let _ = writeln!(text, "  {:>4}   {:.9e}", index + 1, Written(mode.load_factor));
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
