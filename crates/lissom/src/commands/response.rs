//! `lissom response`: harmonic response without time integration.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::response::{DEFAULT_POINTS, ResponseReport, ResponseRequest, response};
use lissom::summary;

use super::linearization::{StateArgument, answered};
use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{draw, folder_for, unwritable};
use crate::terminal;
use lissom_core::number::{Written, duration};

/// Compute the response of outputs to harmonic inputs, for the model linearised about a state.
///
/// The results go to a folder: `response.csv` (frequency, then magnitude, phase in degrees, real and imaginary part of each
/// output per unit of each input), `response.svg` and `response.png` (Bode plot) and `summary.json`.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom response examples/tip-crank.toml --input drive --output midspan.u3 --from 0.1 --to 100

An input is an entry of [inputs], a load (per unit of its size) or a prescribed motion (per m or rad), such as `motor`, or
`loads.motor` if several entries have the same name.
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about, or no response.")]
pub(super) struct Response {
    #[command(flatten)]
    model: ModelArguments,

    /// Inputs: entries of [inputs], loads or prescribed motions.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    input: Vec<String>,

    /// Outputs, or columns of them.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', required = true)]
    output: Vec<String>,

    /// First frequency [Hz].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    from: f64,

    /// Last frequency [Hz].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    to: f64,

    /// Number of frequencies, spaced logarithmically; more are added where a response changes rapidly.
    #[arg(long, value_name = "N", default_value_t = DEFAULT_POINTS as u32, value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    points: u32,

    #[command(flatten)]
    state: StateArgument,

    /// Folder for the results [default: out/<name of the model file>-response].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

impl Response {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let request = ResponseRequest {
            about: self.state.about,
            inputs: self.input,
            outputs: self.output,
            from: self.from,
            to: self.to,
            points: self.points as usize,
        };
        let found = answered(response(&model, &self.model.set, &request))?;
        let path = self.model.folder(self.out, "response");
        let (folder, found) = folder_for(&path, found, || {
            summary::of_request("response", model.name(), &self.model.set, &document)
        })?;
        let heading = document.title.as_deref().unwrap_or(model.name());
        folder.write_table("response.csv", &found.csv()).map_err(unwritable)?;
        draw(&folder, found.figure(heading).draw())?;
        let summary = found.summary(model.name(), &self.model.set, &document);
        folder.write_summary(&summary).map_err(unwritable)?;
        if !self.quiet {
            for warning in &found.warnings {
                warn(warning);
            }
            terminal::print(&render(heading, &found, &path));
        }
        Ok(Exit::Done)
    }
}

/// The summary for the terminal.
fn render(heading: &str, found: &ResponseReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    let [coordinates, multipliers] = found.unknowns;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  response about {} at {} frequencies, {coordinates} coordinates, {multipliers} multipliers, {}",
        found.about,
        found.frequencies.len(),
        duration(found.wall.as_secs_f64())
    );
    for transfer in &found.transfers {
        let (frequency, most) = found.peak(transfer);
        let unit = &transfer.output.unit;
        let _ = writeln!(
            text,
            "  {}: largest {} {unit} at {} Hz",
            transfer.name(),
            Written(most),
            Written(frequency)
        );
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
