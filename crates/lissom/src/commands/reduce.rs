//! `lissom reduce`: a flexible assembly as a superelement.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::modes::{ModesError, OperatingPoint};
use lissom::reduce::{ReduceError, ReduceReport, ReduceRequest, reduce};
use lissom::summary;

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{folder_for, unwritable};
use crate::terminal;
use lissom_core::number::duration;

/// Maximum number of frequencies printed on the terminal.
const LISTED: usize = 6;

/// Reduce flexible parts to a superelement with a few interface nodes and modes.
///
/// The results go to a folder: the matrices in the Matrix Market format and as a NumPy archive, and NAME.toml with the table
/// `[superelements.NAME]` that uses them. The stiffness includes the effect of the stresses in the state `--about`, by default static
/// equilibrium without gravity. Joints, springs and loads between an interface and the rest of the model are omitted.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom reduce examples/tip-crank.toml --interfaces beam.start,beam.end --modes 6
  lissom reduce turbine.toml --part blade1 --interfaces blade1.beam.start --modes 10 --name blade

Exit code: 0 success; 2 wrong model or command line; 3 no such state, or parts that are not one elastic assembly.")]
pub(super) struct Reduce {
    #[command(flatten)]
    model: ModelArguments,

    /// Parts to be reduced: bodies, point masses, beams, superelements, entries of [parts] [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    part: Vec<String>,

    /// Interface nodes for joints, such as beam.start,beam.end; the floating frame is attached to the first one.
    #[arg(long, value_name = "NODE,…", value_delimiter = ',', required = true)]
    interfaces: Vec<String>,

    /// Number of modes with fixed interfaces.
    #[arg(long, value_name = "NUMBER", default_value_t = 10)]
    modes: usize,

    /// Omit correction shapes, which compensate for truncated modes where loads and rotation change the stiffness.
    #[arg(long)]
    modes_alone: bool,

    /// State about which the model is reduced: `static`, `undeformed` or a time of the model's analysis [s].
    #[arg(long, value_name = "STATE|TIME", default_value = "static", allow_negative_numbers = true)]
    about: OperatingPoint,

    /// Name of the superelement [default: that of the only part, or of the model file].
    #[arg(long, value_name = "NAME")]
    name: Option<String>,

    /// Folder for the results [default: out/<name of the model file>-reduced].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Reduce {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let stem = self.model.model.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let given = self.name.unwrap_or(match self.part.as_slice() {
            [part] => part.clone(),
            _ => stem,
        });
        let name: String = given
            .chars()
            .map(|c| if c.is_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' })
            .collect();
        let request = ReduceRequest {
            parts: self.part,
            interfaces: self.interfaces,
            modes: self.modes,
            corrections: !self.modes_alone,
            about: self.about,
            name,
        };
        let found = match reduce(&model, &self.model.set, &request) {
            Err(ReduceError::State(ModesError::Model(report))) => return Err(report.into()),
            Err(error) if error.is_of_question() => return Err(Failure::new(Exit::BadModel, &error)),
            other => other,
        };
        let path = self.model.folder(self.out, "reduced");
        let (folder, found) = folder_for(&path, found, || {
            summary::of_request("reduce", model.name(), &self.model.set, &document)
        })?;
        for (name, text) in &found.files {
            folder.write_table(name, text).map_err(unwritable)?;
        }
        folder.write_archive(&format!("{}.npz", request.name), &found.archive).map_err(unwritable)?;
        let summary = found.summary(model.name(), &self.model.set, &document);
        folder.write_summary(&summary).map_err(unwritable)?;
        if !self.quiet {
            for warning in &found.warnings {
                warn(warning);
            }
            let heading = document.title.as_deref().unwrap_or(model.name());
            terminal::print(&render(heading, &request.name, &found, &path));
        }
        Ok(Exit::Done)
    }
}

/// The summary for the terminal.
fn render(heading: &str, name: &str, found: &ReduceReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    let [before, after] = found.unknowns;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  superelement `{name}`: {before} coordinates to {after}, {} interfaces, {} modes and {} corrections, {} kg{}, {}",
        found.interfaces.len(),
        found.frequencies.len(),
        found.corrections,
        found.mass,
        if found.is_preloaded { ", preloaded" } else { "" },
        duration(found.wall.as_secs_f64())
    );
    if !found.frequencies.is_empty() {
        let listed: Vec<String> =
            found.frequencies.iter().take(LISTED).map(|frequency| format!("{frequency:.4}")).collect();
        let more = if found.frequencies.len() > LISTED { ", …" } else { "" };
        let _ = writeln!(text, "  frequencies with fixed interfaces [Hz]: {}{more}", listed.join(", "));
    }
    let _ = writeln!(text, "  to use it, include {}", folder.join(format!("{name}.toml")).display());
    text
}
