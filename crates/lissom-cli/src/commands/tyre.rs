//! `lissom tyre`: forces of a tyre property file.

use std::path::PathBuf;

use clap::Args;
use lissom::ResultFolder;
use lissom::analyses::tyre_curves::TyreCurves;
use lissom::model::files;
use lissom::model::files::tyre_file::tyre_file;

use super::outcome::{Exit, Failure};
use super::terminal;

/// Show the forces of a tyre property file.
///
/// Prints stiffnesses, friction and relaxation lengths, and writes `tyre.csv` and the figure `tyre` as SVG and PNG: the longitudinal force over slip,
/// the lateral force and the aligning moment over the slip angle, and both forces of combined slip under the middle load.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom tyre examples/parts/passenger-car.tir                    loads of half, once and one and a half times the nominal one
  lissom tyre car.tir --load 2000,4000 --camber 0.05 --out tyre   these loads [N], with a camber [rad], to the folder tyre

Exit code: 0 success; 2 no such file, or none of PAC2002 or MF-Tyre 5.2.")]
pub(super) struct Tyre {
    /// Tyre property file.
    #[arg(value_name = "FILE.tir")]
    file: PathBuf,
    /// Normal forces [N].
    #[arg(long, value_name = "LOAD", value_delimiter = ',')]
    load: Vec<f64>,
    /// Camber [rad].
    #[arg(long, value_name = "ANGLE", default_value_t = 0.0, allow_negative_numbers = true)]
    camber: f64,
    /// Folder for the results [default: out/NAME].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Tyre {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let failed =
            |error: &dyn std::fmt::Display| Failure::request(format!("`{}`: {error}", self.file.display()));
        let text =
            files::read_input_text(&self.file).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        let read = tyre_file(&text).map_err(|error| failed(&error))?;
        let stem = self.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let curves =
            TyreCurves::new(&stem, &read, &self.load, self.camber).map_err(|error| failed(&error))?;
        if !read.unused.is_empty() {
            let words = format!("warning: coefficients that are not used: {}\n", read.unused.join(", "));
            terminal::complain(&words);
        }
        if let Some(warning) = curves.warning() {
            terminal::complain(&format!("warning: {warning}\n"));
        }
        terminal::print(&curves.text());
        let folder = self.out.clone().unwrap_or_else(|| PathBuf::from("out").join(stem));
        files::create_folder(&folder).map_err(|error| Failure::new(Exit::Failed, &error))?;
        let table = folder.join("tyre.csv");
        files::write(&table, curves.csv().as_bytes()).map_err(|error| Failure::new(Exit::Failed, &error))?;
        let figure = curves.figure().map_err(|error| Failure::new(Exit::Failed, &error))?;
        let figures = ResultFolder::write_graphic(&folder, &figure)
            .map_err(|error| Failure::new(Exit::Failed, &error))?;
        for path in std::iter::once(table).chain(figures) {
            terminal::print(&format!("{}\n", path.display()));
        }
        Ok(Exit::Done)
    }
}
