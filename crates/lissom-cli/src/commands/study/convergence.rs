//! `lissom study convergence`: errors and orders of schemes over the step size.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use lissom::analyses::study::convergence::{Request, Table, study};
use lissom::{AnalysisWarning, Diagnose};

use super::super::model_arguments::ModelArguments;
use super::super::outcome::{Exit, Failure, show_warnings, warn};
use super::super::terminal::{self, Interrupt};

/// Show the convergence of schemes: relative error and observed order over the step size.
///
/// The model is simulated with every scheme and step size, and one output is compared with a reference run at the
/// instants of the largest step. The error is the root mean square of the difference over all components of the output
/// and all instants, divided by that of the reference. The order is log(e1/e2) / log(h1/h2) for successive steps of a
/// scheme. Choose an output whose components have one unit, such as a position or a force.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom study convergence examples/pendulum.toml --schemes 'generalized-alpha(0.8),hht(-0.3),radau-iia' \\
    --steps 2e-2,1e-2,5e-3 --reference radau-iia:1e-4 --output bob
  lissom study convergence examples/tip-crank.toml --schemes 'radau-iia,hht(-0.3),energy-decaying(0.0)' \\
    --steps 1e-3,5e-4,2.5e-4 --reference radau-iia:5e-5 --output midspan.u2 --set analysis.end=0.1

A scheme is a word of the model file, with its parameter in parentheses (alpha of hht, spectral radius of \
generalized-alpha and energy-decaying); without it the default is used. Quote the list for the shell. The scheme and its \
parameter in the model have no effect. All steps, also that of the reference, must divide the largest step; the runs \
end at its last whole multiple. Newton's tolerance is 1e-10, or the model's if smaller; --set \
analysis.tolerance=… sets another.
The table goes to a CSV file (columns scheme, step_size, error, order), the plot of errors over 1/h beside it. \
The order is empty for the first step of a scheme; error and order are empty for a run that failed.
Exit code: 0 success; 2 wrong model or command line; 3 a run has no solution; 130 interrupted by Ctrl-C.")]
pub(super) struct Convergence {
    #[command(flatten)]
    model: ModelArguments,

    /// Schemes, such as `radau-iia,hht(-0.3)`.
    #[arg(long, value_name = "LIST", value_delimiter = ',', required = true)]
    schemes: Vec<String>,

    /// Step sizes [s], from large to small, such as `1e-2,5e-3,2.5e-3`.
    #[arg(long, value_name = "LIST", value_delimiter = ',', required = true)]
    steps: Vec<String>,

    /// Scheme and step size [s] of the reference run, such as `radau-iia:1e-4`.
    #[arg(long, value_name = "SCHEME:STEP", value_parser = parse_reference)]
    reference: Reference,

    /// The output to compare, or one component of it, such as `tip.u2`.
    #[arg(long, value_name = "NAME")]
    output: String,

    /// File for the table; the plot is written to the same folder [default: out/study-convergence/<model>.csv, or <model>-2.csv and so on if
    /// it exists].
    #[arg(long, short, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

/// A scheme and a step size, as written.
type Reference = (String, String);

fn parse_reference(text: &str) -> Result<Reference, String> {
    match text.rsplit_once(':') {
        Some((scheme, step)) if !scheme.trim().is_empty() && !step.trim().is_empty() => {
            Ok((scheme.trim().to_owned(), step.trim().to_owned()))
        }
        _ => Err("it must be SCHEME:STEP, such as `radau-iia:1e-4`".to_owned()),
    }
}

impl Convergence {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        let model = self.model.text()?;
        let request = self.request();
        let document = request.first(&model).document()?;
        show_warnings(&document);
        let path = super::table_path(self.out.as_ref(), "convergence", &self.model.model)?;
        let table = super::watched(&interrupt, |watch| study(&model, &request, watch))?;
        super::write(&path, table.csv().as_bytes())?;
        let title = document.title.clone().unwrap_or_else(|| model.name().to_owned());
        terminal::print(&render(&title, &request, &table));
        let mut exit = Exit::Done;
        for row in &table.rows {
            if let Err(error) = &row.outcome {
                let member = format!("{}, step_size {}", row.scheme, row.step);
                warn(&error.diagnostic().within(&member));
                exit = Exit::Failed;
            }
        }
        if table.is_far_from_reference() {
            warn(&AnalysisWarning::FarFromReference);
        }
        let drawn = super::draw(&table.figure(&title), &path)?;
        terminal::print(&format!("results in {}{drawn}\n", path.display()));
        Ok(exit)
    }

    fn request(&self) -> Request {
        let trimmed = |texts: &[String]| texts.iter().map(|text| text.trim().to_owned()).collect();
        Request {
            schemes: trimmed(&self.schemes),
            steps: trimmed(&self.steps),
            reference: self.reference.clone(),
            output: self.output.clone(),
        }
    }
}

fn render(title: &str, request: &Request, table: &Table) -> String {
    let mut text = format!("{title}\n");
    let (scheme, step) = &request.reference;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "relative error of `{}` at {} instants up to {} s, reference {scheme} with steps of {step} s",
        request.output, table.instants, table.end
    );
    let mut lines = vec![["scheme", "step_size", "error", "order"].map(str::to_owned).to_vec()];
    for row in &table.rows {
        let error = row.outcome.as_ref().map_or_else(|_| "failed".to_owned(), |error| format!("{error:.2e}"));
        let order = row.order.map_or_else(String::new, |order| format!("{order:.2}"));
        lines.push(vec![row.scheme.clone(), row.step.clone(), error, order]);
    }
    text + &super::aligned(&lines, 2)
}

#[cfg(test)]
#[path = "../../../tests/unit/commands/study/convergence.rs"]
mod tests;
