//! `lissom study conditioning`: condition numbers over the step size.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use lissom::Diagnose;
use lissom::analyses::study::conditioning::{Request, SCALINGS, Table, study};

use super::super::model_arguments::ModelArguments;
use super::super::outcome::{Exit, Failure, show_warnings, warn};
use super::super::terminal::{self, Interrupt};

/// Show the conditioning of the equations over the step size, with and without scaling.
///
/// The model is simulated to its end for every step size and every value of --vary. The table has the condition numbers of the last
/// step's tangent at convergence: without scaling (none), with s = 1 (unit), with s = m + d h + k h² (physical), and with rows and
/// columns of one size besides (equilibrated), as in runs. The augmented term is included if the model uses it.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom study conditioning examples/pendulum.toml --steps 1e-1,1e-2,1e-3,1e-4
  lissom study conditioning examples/pendulum.toml --steps 1e-2 --vary point_masses.bob.mass=1,1e2,1e4
  lissom study conditioning examples/tip-crank.toml --steps 1e-3,1e-4 --set analysis.end=0.01

Condition numbers are estimated in the 1-norm; first-order states count in units that balance their rows and columns. Below each series are the \
exponents of the step size, or of the varied value if there is one step size, between its first and its last value. The table goes to a \
CSV file (columns step_size, the varied path, none, unit, physical, equilibrated), the plot beside it.
Exit code: 0 success; 2 wrong model or command line; 3 a run has no solution; 130 interrupted by Ctrl-C.")]
pub(super) struct Conditioning {
    #[command(flatten)]
    model: ModelArguments,

    /// Step sizes [s], such as `1e-1,1e-2,1e-3`.
    #[arg(long, value_name = "LIST", value_delimiter = ',', required = true)]
    steps: Vec<String>,

    /// A value of the model that is also varied, such as `point_masses.bob.mass=1,10,100`.
    #[arg(long, value_name = "PATH=LIST", value_parser = parse_variation)]
    vary: Option<Variation>,

    /// File for the table; the plot is written to the same folder [default: out/study-conditioning/<model>.csv, or <model>-2.csv and so on if
    /// it exists].
    #[arg(long, short, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

/// A path and its values.
type Variation = (String, Vec<String>);

fn parse_variation(text: &str) -> Result<Variation, String> {
    let wrong = || "it must be PATH=LIST, such as `point_masses.bob.mass=1,10,100`".to_owned();
    let (path, list) = text.split_once('=').ok_or_else(wrong)?;
    let values: Vec<String> = list.split(',').map(|value| value.trim().to_owned()).collect();
    if path.trim().is_empty() || values.iter().any(String::is_empty) {
        return Err(wrong());
    }
    Ok((path.trim().to_owned(), values))
}

impl Conditioning {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        let model = self.model.text()?;
        let steps = self.steps.iter().map(|step| step.trim().to_owned()).collect();
        let request = Request { steps, vary: self.vary.clone() };
        let document = request.first(&model).document()?;
        show_warnings(&document);
        let path = super::table_path(self.out.as_ref(), "conditioning", &self.model.model)?;
        let table = super::watched(&interrupt, |watch| study(&model, &request, watch))?;
        super::write(&path, table.csv().as_bytes())?;
        let title = document.title.clone().unwrap_or_else(|| model.name().to_owned());
        terminal::print(&render(&title, &table));
        let mut exit = Exit::Done;
        for row in &table.rows {
            if let Err(error) = &row.outcome {
                warn(&error.diagnostic().within(&format!("step_size {}", row.step)));
                exit = Exit::Failed;
            }
        }
        let drawn = super::draw(&table.figure(&title), &path)?;
        terminal::print(&format!("results in {}{drawn}\n", path.display()));
        Ok(exit)
    }
}

fn render(title: &str, table: &Table) -> String {
    let mut heading = vec!["step_size".to_owned()];
    heading.extend(table.path.clone());
    let words = heading.len();
    heading.extend(SCALINGS.map(|(name, ..)| name.to_owned()));
    let mut lines = vec![heading];
    for row in &table.rows {
        let mut line = vec![row.step.clone()];
        line.extend(row.varied.clone());
        match &row.outcome {
            Ok(conditions) => line.extend(conditions.map(|value| format!("{value:.2e}"))),
            Err(_) => line.push("failed".to_owned()),
        }
        lines.push(line);
    }
    let mut text = format!("{title}\ncondition number of the tangent, last step at convergence\n");
    text += &super::aligned(&lines, words);
    for series in table.series() {
        let Some(exponents) = series.exponents() else { continue };
        let of = if series.of.is_empty() { String::new() } else { format!(" ({})", series.of) };
        let _ = write!(text, "exponent of the {}{of}:", table.parameter());
        for ((name, ..), exponent) in SCALINGS.iter().zip(exponents) {
            // Zero is added so that it has no sign.
            let _ = write!(text, "  {name} {:.2}", (100.0 * exponent).round() / 100.0 + 0.0);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
#[path = "../../../tests/unit/commands/study/conditioning.rs"]
mod tests;
