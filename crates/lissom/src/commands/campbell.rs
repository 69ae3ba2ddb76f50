//! `lissom campbell`: natural frequencies over a parameter.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::campbell::{CampbellError, CampbellReport, CampbellRequest, campbell};
use lissom::summary;

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::{draw, folder_for, unwritable};
use crate::terminal;
use lissom_core::number::{Written, duration};

/// Compute natural frequencies and damping ratios over a parameter, such as the speed of a rotor.
///
/// At each value the model is linearised about the steady rotation specified by the velocities in the file, or about static
/// equilibrium if nothing rotates. Modes are tracked by their shapes. The results go to a folder: `campbell.csv`,
/// `campbell.svg` and `campbell.png` (diagram with the multiples of the rotor speed) and `summary.json` (critical speeds).
/// `lissom view` shows the folder as a page.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom campbell rotor.toml --vary parameters.speed=0:200:41
  lissom campbell blade.toml --vary parameters.speed=0:2:21 --count 6 --rays 1,3,6

Exit code: 0 success; 2 wrong model or command line; 3 no steady rotation, no modes, or coefficients that are not constant.")]
pub(super) struct Campbell {
    #[command(flatten)]
    model: ModelArguments,

    /// Path of a number in the model file, its first and last value, and the number of values.
    #[arg(long, value_name = "PATH=FROM:TO:VALUES", value_parser = parse_variation)]
    vary: (String, f64, f64, usize),

    /// Number of modes, the lowest first.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    count: u32,

    /// Multiples of the rotor speed whose crossings with the frequencies are critical speeds.
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1,2,3", value_parser = clap::value_parser!(u32).range(1..))]
    rays: Vec<u32>,

    /// Folder for the results [default: out/<name of the model file>-campbell].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short)]
    quiet: bool,
}

fn parse_variation(text: &str) -> Result<(String, f64, f64, usize), String> {
    let wrong = || "it must be PATH=FROM:TO:VALUES, such as `parameters.speed=0:20:41`".to_owned();
    let (path, range) = text.split_once('=').ok_or_else(wrong)?;
    let parts: Vec<&str> = range.split(':').collect();
    let [from, to, values] = parts[..] else { return Err(wrong()) };
    let number =
        |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
    let values = values.trim().parse::<usize>().map_err(|_| wrong())?;
    if !(2..=100_000).contains(&values) {
        return Err("the number of values must be from 2 to 100000".to_owned());
    }
    Ok((path.trim().to_owned(), number(from)?, number(to)?, values))
}

impl Campbell {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let (path, from, to, values) = self.vary;
        let request = CampbellRequest { path, from, to, values, count: self.count as usize, rays: self.rays };
        let found = match campbell(&model, &self.model.set, &request) {
            Err(CampbellError::Model(report)) => return Err(report.into()),
            Err(error @ (CampbellError::Range { .. } | CampbellError::Unlike(_))) => {
                return Err(Failure::new(Exit::BadModel, &error));
            }
            other => other,
        };
        let path = self.model.folder(self.out, "campbell");
        let (folder, found) = folder_for(&path, found, || {
            summary::of_request("campbell", model.name(), &self.model.set, &document)
        })?;
        let heading = document.title.as_deref().unwrap_or(model.name());
        folder.write_table("campbell.csv", &found.csv()).map_err(unwritable)?;
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
fn render(heading: &str, found: &CampbellReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  {} lines over {} values of {}, {}",
        found.lines,
        found.points.len(),
        found.path,
        duration(found.wall.as_secs_f64())
    );
    for crossing in &found.crossings {
        let _ = writeln!(
            text,
            "  line {} crosses {}P at {} = {}, {} rpm, {} Hz, whirl {}",
            crossing.line + 1,
            crossing.ray,
            found.path,
            Written(crossing.value),
            Written(60.0 * crossing.spin),
            Written(f64::from(crossing.ray) * crossing.spin),
            crossing.whirl
        );
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
