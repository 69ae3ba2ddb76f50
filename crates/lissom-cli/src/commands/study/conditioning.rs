//! `lissom study conditioning`: condition numbers over the step size.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use lissom::analyses::study::conditioning::{Measured, Request, SCALINGS, Table, study};
use lissom::core::simulation::ConditionMethod;

use super::super::model_arguments::ModelArguments;
use super::super::outcome::{Exit, Failure, show_warnings};
use super::super::terminal::{self, Interrupt};

/// Show the conditioning of the equations over the step size, with and without scaling.
///
/// The model is simulated to its end for every step size and every value of --vary. The table has the condition
/// numbers of the last step's tangent at convergence: without scaling (none), with s = 1 (unit) and with
/// s = m + d h + k h² (physical). The augmented term is included if the model uses it.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom study conditioning examples/pendulum.toml --steps 1e-1,1e-2,1e-3,1e-4
  lissom study conditioning examples/pendulum.toml --steps 1e-2 \\
    --vary point_masses.bob.mass=1e-2,1,1e2,1e4
  lissom study conditioning examples/tip-crank.toml --steps 1e-3,1e-4 --set analysis.end=0.01

The condition number of small models is exact in the 2-norm, also far beyond 1e16; for large models it is estimated in the 1-norm. \
The table goes to a CSV file (columns step_size, the varied path, none, unit, physical, method, end), the \
plot beside it. A run of more than two million steps ends earlier; the table then has its end.
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
        let request = self.request();
        // The model without these values need not be consistent: its end may be before its own first step.
        let document = request.first(&model).document()?;
        show_warnings(&document);
        let path = super::table_path(self.out.as_ref(), "conditioning", &self.model.model)?;
        let table = super::watched(&interrupt, |watch| study(&model, &request, watch))?;
        super::write(&path, table.csv().as_bytes())?;
        let title = document.title.clone().unwrap_or_else(|| model.name().to_owned());
        terminal::print(&render(&title, &table));
        let drawn = super::draw(&table.figure(&title), &path)?;
        terminal::print(&format!("results in {}{drawn}\n", path.display()));
        let failed = table.rows.iter().any(|row| row.outcome.is_err());
        Ok(if failed { Exit::Failed } else { Exit::Done })
    }

    fn request(&self) -> Request {
        Request {
            steps: self.steps.iter().map(|step| step.trim().to_owned()).collect(),
            vary: self.vary.clone(),
        }
    }
}

fn render(title: &str, table: &Table) -> String {
    let measured: Vec<&Measured> = table.rows.iter().filter_map(|row| row.outcome.as_ref().ok()).collect();
    let mut text = format!("{title}\n");
    if let Some(first) = measured.first() {
        let method = match first.method {
            ConditionMethod::SingularValues => "condition number of the tangent, 2-norm",
            ConditionMethod::OneNormEstimate => "condition number of the tangent, estimated in the 1-norm",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{method}, {} unknowns, last step at convergence", first.unknowns);
    }
    let mut heading = vec!["step_size".to_owned()];
    heading.extend(table.path.clone());
    let words = heading.len();
    heading.extend(SCALINGS.map(|compared| compared.name.to_owned()));
    let mut lines = vec![heading];
    let mut notes = String::new();
    for row in &table.rows {
        let mut line = vec![row.step.clone()];
        line.extend(row.varied.clone());
        match &row.outcome {
            Ok(measured) => {
                line.extend(measured.conditions.map(super::short));
                if measured.is_shortened {
                    let _ = writeln!(
                        notes,
                        "step_size {}: ended at {:e} s, after {} steps",
                        row.step,
                        measured.end,
                        lissom::analyses::study::conditioning::MAX_STEPS
                    );
                }
            }
            Err(error) => {
                line.push("failed".to_owned());
                let _ = writeln!(notes, "step_size {}: {error}", row.step);
            }
        }
        lines.push(line);
    }
    text + &super::aligned(&lines, words) + &notes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variations_are_read() {
        let (path, values) = parse_variation(" point_masses.bob.mass = 1, 1e2").unwrap();
        assert_eq!((path.as_str(), values.len(), values[1].as_str()), ("point_masses.bob.mass", 2, "1e2"));
        for wrong in ["mass", "=1", "mass=", "mass=1,,2"] {
            assert!(parse_variation(wrong).is_err(), "{wrong}");
        }
    }
}
