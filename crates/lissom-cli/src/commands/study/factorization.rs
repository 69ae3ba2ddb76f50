//! `lissom study factorization`: effects of scaling, augmented term and pivoting on the first step.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use lissom::analyses::study::factorization::{Table, scaling_name, study};
use lissom::core::studies::factorization::{Case, ITERATIONS};

use super::super::model_arguments::ModelArguments;
use super::super::outcome::{Exit, Failure, show_warnings};
use super::super::terminal;

/// Show whether the equations can be factored without pivoting, and how accurately they are solved.
///
/// The tangent of the first step is factored under every combination of scaling (none, unit, physical), augmented
/// term (without, with) and solver (skyline and sparse do not pivot). A system with known solution, the same in SI
/// for every combination, is solved, and Newton's method makes 15 iterations, each with a new tangent.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom study factorization examples/tip-crank.toml
  lissom study factorization examples/tip-crank.toml --set analysis.step=1e-6 --out pivots.csv

Columns: ratio of the smallest to the largest pivot (estimated by the solver that pivots); growth factor of the \
factorisation; errors of the corrections of coordinates and multipliers, relative to the largest one, determined by \
refinement with 32 digits (~ if that does not converge); after 15 iterations the last update relative \
to the increment of the step, the largest residual of an equation of motion [N, N m], and the largest \
violation |C| of a constraint [m, rad].
Exit code: 0 success; 2 wrong model or command line; 3 no consistent initial values.")]
pub(super) struct Factorization {
    #[command(flatten)]
    model: ModelArguments,

    /// File for the table [default: out/study-factorization/<model>.csv, or <model>-2.csv and so on if
    /// it exists].
    #[arg(long, short, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Factorization {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let path = super::table_path(self.out.as_ref(), "factorization", &self.model.model)?;
        let table = study(&model)?;
        super::write(&path, table.csv().as_bytes())?;
        let title = document.title.as_deref().unwrap_or(model.name());
        terminal::print(&render(title, &table));
        terminal::print(&format!("results in {}\n", path.display()));
        Ok(Exit::Done)
    }
}

fn render(title: &str, table: &Table) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "first step of {} s, {}, {} unknowns, {ITERATIONS} iterations",
        table.step_size, table.scheme, table.unknowns
    );
    let heading = [
        "scaling",
        "augmented",
        "solver",
        "factors",
        "pivots",
        "growth",
        "coordinates",
        "multipliers",
        "update",
        "residual",
        "|C|",
    ];
    let mut lines = vec![heading.map(str::to_owned).to_vec()];
    lines.extend(table.cases.iter().map(line));
    text += &super::aligned(&lines, 4);
    for case in &table.cases {
        let combination =
            format!("{}, {}, {}", scaling_name(case), with_or_without(case.augmented), case.solver);
        let _ = match &case.outcome {
            Err(stopped) => writeln!(text, "{combination}: elimination stops at the {}", stopped.unknown),
            Ok(factored) => match &factored.newton.stopped_at {
                Some(unknown) => writeln!(text, "{combination}: a later tangent stops at the {unknown}"),
                None => Ok(()),
            },
        };
    }
    text
}

fn with_or_without(augmented: bool) -> &'static str {
    if augmented { "augmented" } else { "not augmented" }
}

fn line(case: &Case) -> Vec<String> {
    let yes_or_no = |yes: bool| if yes { "yes" } else { "no" }.to_owned();
    let mut cells = vec![
        scaling_name(case).to_owned(),
        yes_or_no(case.augmented),
        case.solver.to_owned(),
        yes_or_no(case.outcome.is_ok()),
    ];
    let Ok(factored) = &case.outcome else { return cells };
    let report = &factored.report;
    let growth = if report.growth.is_nan() { "-".to_owned() } else { super::short(report.growth) };
    let doubt = if factored.errors_known { "" } else { "~" };
    let error = |value: f64| format!("{doubt}{}", super::short(value));
    cells.extend([
        super::short(report.relative_pivot()),
        growth,
        error(factored.coordinate_error),
        error(factored.multiplier_error),
    ]);
    let newton = &factored.newton;
    cells.extend([newton.update, newton.residual, newton.violation].map(super::short));
    cells
}
