//! `lissom modes`: natural frequencies, damping and shapes about a state.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::core::kinematics::Kinematics;
use lissom::core::linear::Completeness;
use lissom::modes::{ModeReport, ModeRequest, ModesError, OperatingPoint, modes, of_request};
use lissom::motion::{Motion, MotionRecorder};
use lissom::picture::{Picture, PictureError};
use lissom::{Document, Model, Override, ResultFolder};
use lissom_core::number::{DIGITS, duration, written};
use lissom_model::lower::lower;
use lissom_model::scene::Scene;

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{folder_for, unwritable, writing_failed};
use crate::terminal;

/// Maximum number of nodes of models whose shapes are drawn: for larger ones drawing would take longer than the modes.
const MAX_DRAWN: usize = 2000;
/// Modes listed on the terminal; the tables contain all.
const LISTED: usize = 20;
/// Parts named for each of them.
const NAMED: usize = 3;

/// Compute natural modes: frequencies, damping ratios and shapes of the model linearised about a state.
///
/// The results go to a folder: `modes.csv` (number, frequency, damping ratio, kind), `shapes.csv` (displacement and rotation of
/// every node), `energy.csv` (share of each part in kinetic and strain energy), `participation.csv` (effective masses), `shapes.svg` (a
/// picture of the first shapes), `summary.json` (eigenvalues) and files for `lissom view`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom modes examples/tip-crank.toml --about undeformed
  lissom modes examples/tip-crank.toml --count 40 --shift 100   the modes nearest to 100 Hz
  lissom modes examples/top.toml --about 0.5      about the state at t = 0.5 s

Kinds: rigid (frequency 0), oscillation, decay (overdamped), divergence and flutter (growing).
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about, or modes were missed.")]
pub(super) struct Modes {
    #[command(flatten)]
    model: ModelArguments,

    /// Number of modes, the lowest first [default: 20].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    count: Option<u32>,

    /// State to linearise about: `static` (default), `undeformed`, `rotation` (steady, with the velocities of the file) or a time of the model's analysis [s].
    #[arg(long, value_name = "STATE|TIME", allow_negative_numbers = true)]
    about: Option<OperatingPoint>,

    /// Compute the modes nearest to this frequency [default: the lowest ones].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    shift: Option<f64>,

    /// Folder for the results [default: out/<name of the model file>-modes].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Do not draw the shapes.
    #[arg(long)]
    no_plots: bool,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Modes {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        let count = self.count.map(|count| count as usize);
        let request = ModeRequest { count, about: self.about, shift: self.shift };
        let folder = self.model.folder(self.out, "modes");
        report((&model, &self.model.set, &document), &request, &folder, (!self.no_plots, self.quiet))
    }
}

/// Computes the modes and writes them to a folder.
pub(super) fn report(
    (model, overrides, document): (&Model, &[Override], &Document),
    request: &ModeRequest,
    folder: &Path,
    (plots, quiet): (bool, bool),
) -> Result<Exit, Failure> {
    show_warnings(document);
    let found = match modes(model, overrides, request) {
        Err(ModesError::Model(report)) => return Err(report.into()),
        Err(error @ (ModesError::Time { .. } | ModesError::Shift(_))) => {
            return Err(Failure::new(Exit::BadModel, &error));
        }
        other => other,
    };
    let (folder, found) = folder_for(folder, found, || of_request(model.name(), overrides, document))?;
    folder.write_table("modes.csv", &found.csv()).map_err(unwritable)?;
    folder.write_table("energy.csv", &found.energy_csv()).map_err(unwritable)?;
    folder.write_table("participation.csv", &found.participation_csv()).map_err(unwritable)?;
    folder.write_table("shapes.csv", &found.shapes_csv()).map_err(unwritable)?;
    write_state(&folder, document, &found)?;
    if plots {
        draw_shapes(&folder, document, &found)?;
    }
    folder.write_summary(&found.summary(model.name(), overrides, document)).map_err(unwritable)?;
    if !quiet {
        for warning in &found.warnings {
            warn(warning);
        }
        terminal::print(&render(document.title.as_deref().unwrap_or(model.name()), &found, folder.path()));
    }
    Ok(Exit::Done)
}

/// Writes the state about which the model is linearised, as a motion of one frame, for the page that shows the modes.
fn write_state(folder: &ResultFolder, document: &Document, found: &ModeReport) -> Result<(), Failure> {
    let lowered = lower(document)?;
    folder.write_scene(&Scene::of(document, &lowered)).map_err(unwritable)?;
    let file = folder.motion().map_err(unwritable)?;
    let mut recorder = MotionRecorder::new(&lowered, None, file);
    recorder.write_still(&found.state).map_err(writing_failed)
}

/// Draws the first shapes on one sheet, `shapes.svg`.
fn draw_shapes(folder: &ResultFolder, document: &Document, found: &ModeReport) -> Result<(), Failure> {
    if found.moved.is_empty() || found.state.nodes.len() > MAX_DRAWN {
        return Ok(());
    }
    let lowered = lower(document)?;
    let mut bytes = Vec::new();
    // A frame for each shape, with its number as time.
    let frames: Vec<Kinematics> = (1_u32..)
        .zip(&found.moved)
        .map(|(number, moved)| Kinematics { time: f64::from(number), ..moved.clone() })
        .collect();
    MotionRecorder::new(&lowered, None, &mut bytes).write_frames(&frames).map_err(writing_failed)?;
    let motion = Motion::from_bytes(&bytes).map_err(|error| Failure::new(Exit::Failed, &error))?;
    let labels = found.modes.iter().take(frames.len()).enumerate();
    let labels = labels.map(|(index, mode)| format!("{}: {:.4} Hz", index + 1, mode.frequency));
    let picture = Picture {
        times: frames.iter().map(|at| at.time).collect(),
        labels: labels.collect(),
        ..Picture::default()
    };
    let title = document.title.as_deref().unwrap_or_default();
    let failed = |error: PictureError| Failure::new(Exit::Failed, &error);
    let drawing = picture.draw(&Scene::of(document, &lowered), &motion, title).map_err(failed)?;
    let text = drawing.svg().map_err(|error| failed(error.into()))?;
    folder.write_table("shapes.svg", &text).map_err(unwritable)
}

/// The parts with the largest shares in the kinetic energy of a mode, in words.
fn largest(shares: &BTreeMap<String, f64>) -> String {
    let mut parts: Vec<(&String, f64)> = shares.iter().map(|(part, share)| (part, *share)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let shown = parts.iter().take(NAMED).filter(|(_, share)| *share >= 0.01);
    shown.map(|(part, share)| format!("{part} {:.0} %", 100.0 * share)).collect::<Vec<_>>().join(", ")
}

/// The summary for the terminal.
fn render(heading: &str, found: &ModeReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    let [coordinates, multipliers] = found.unknowns;
    let number = found.modes.len();
    let fewer = if number < found.asked {
        let reason = match found.completeness {
            Completeness::Counted => "there are no more",
            _ => "no more were found",
        };
        format!(" (requested: {}; {reason})", found.asked)
    } else {
        String::new()
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  {number} modes{fewer} about {}, {coordinates} coordinates, {multipliers} multipliers, {}, {}",
        found.about,
        match found.completeness {
            Completeness::Counted => "none missed according to a count of pivots",
            _ => "not counted",
        },
        duration(found.wall.as_secs_f64())
    );
    let _ =
        writeln!(text, "  mode   frequency [Hz]   damping ratio   {:<13}largest kinetic energies", "kind");
    for (index, mode) in found.modes.iter().take(LISTED).enumerate() {
        let _ = writeln!(
            text,
            "  {:>4}   {:>14}   {:>13}   {:<13}{}",
            index + 1,
            written(mode.frequency, DIGITS),
            written(mode.damping, 4),
            mode.kind.name(),
            largest(&found.shares[index])
        );
    }
    if number > LISTED {
        let _ = writeln!(text, "  … {} more in modes.csv", number - LISTED);
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
