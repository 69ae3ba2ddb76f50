//! `lissom study roundoff`: round-off of an output at tiny steps.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use lissom::Diagnose;
use lissom::analyses::study::roundoff::{FINER, NOISY_STEPS, Request, STEPS, Table, study};

use super::super::model_arguments::ModelArguments;
use super::super::outcome::{Exit, Failure, show_warnings, warn};
use super::super::terminal::{self, Interrupt};

/// Show the round-off of an output, such as a reaction, at tiny steps.
///
/// For every step size h, 50 steps are taken from the start with the scheme of the model, regardless of its end time. The
/// error is the difference between the output at their end and that at the same time with steps of h/8, relative to
/// the size of the output there; it contains both the error of the scheme and round-off. The noise is the largest second
/// difference of the output over the last 20 steps, relative to the size of the output. For a smooth output it decreases
/// as h²; at tiny steps only round-off remains.
#[derive(Args)]
#[command(after_help = "\
Example:
  lissom study roundoff examples/pendulum.toml --steps 1e-3,1e-5,1e-7 --output force

An error with ~ is not resolved: runs with steps of h/4 and h/8 differ by more than half of it. Error and noise are \
norms over all components of the output, relative to its size at the start: choose an output of one unit that is not near \
zero there. Oscillations excited by the initial state, such as waves in beams, count as noise until steps resolve \
them. Newton's tolerance is 1e-12, or the model's if smaller; \
--set analysis.tolerance=… sets another.
The table goes to a CSV file (columns step_size, error, noise), the plot beside it.
Exit code: 0 success; 2 wrong model or command line; 3 a run has no solution; 130 interrupted by Ctrl-C.")]
pub(super) struct Roundoff {
    #[command(flatten)]
    model: ModelArguments,

    /// Step sizes [s], such as `1e-3,1e-5,1e-7`.
    #[arg(long, value_name = "LIST", value_delimiter = ',', required = true)]
    steps: Vec<String>,

    /// The output to observe, or one component of it, such as `tip.u2`.
    #[arg(long, value_name = "NAME")]
    output: String,

    /// File for the table; the plot is written to the same folder [default: out/study-roundoff/<model>.csv, or <model>-2.csv and so on if
    /// it exists].
    #[arg(long, short, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Roundoff {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        let model = self.model.text()?;
        let request = Request {
            steps: self.steps.iter().map(|step| step.trim().to_owned()).collect(),
            output: self.output,
        };
        let document = request.first(&model).document()?;
        show_warnings(&document);
        let path = super::table_path(self.out.as_ref(), "roundoff", &self.model.model)?;
        let table = super::watched(&interrupt, |watch| study(&model, &request, watch))?;
        super::write(&path, table.csv().as_bytes())?;
        let title = document.title.clone().unwrap_or_else(|| model.name().to_owned());
        terminal::print(&render(&title, &request, &table));
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

fn render(title: &str, request: &Request, table: &Table) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "`{}` after {STEPS} steps, {}: error against steps of h/{}, noise of the last {NOISY_STEPS} steps",
        request.output, table.scheme, FINER[0]
    );
    let mut lines = vec![["step_size", "error", "noise"].map(str::to_owned).to_vec()];
    for row in &table.rows {
        let mut line = vec![row.step.clone()];
        match &row.outcome {
            Ok(measured) => {
                let doubt = if measured.is_doubtful() { "~" } else { "" };
                line.extend([
                    format!("{doubt}{}", super::short(measured.error)),
                    super::short(measured.noise),
                ]);
            }
            Err(_) => line.push("failed".to_owned()),
        }
        lines.push(line);
    }
    text + &super::aligned(&lines, 1)
}
