//! `lissom run`: simulates a model and leaves its results in a folder.

use std::fmt::Write;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::Args;
use lissom::{FolderError, Record, ResultFolder, RunReport, Session, Stopped, Summary, Writer, summary};
use lissom_model::lower::lower;

use super::{Exit, Failure, ModelArguments, show_warnings};
use crate::terminal::{self, Bar, Interrupt};

/// Simulate a model as its table `[analysis]` asks.
///
/// The results go to a folder: `history.csv` (time and all outputs), `summary.json` (steps, iterations, times,
/// violations, energy), and a plot of every output as SVG and PNG. What was computed before a failure or Ctrl-C is
/// kept there, too.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom run examples/tip-crank.toml
  lissom run examples/tip-crank.toml --out results/fine --set analysis.step=1e-4
  lissom run examples/top.toml --set analysis.scheme=hht --set bodies.top.mass=20 --no-plots --quiet

Ctrl-C ends the run after the current step and keeps the results; a second Ctrl-C ends it at once.
Exit code: 0 all is done; 2 wrong model or command line; 3 no solution; 130 interrupted by Ctrl-C.")]
pub(super) struct Run {
    #[command(flatten)]
    model: ModelArguments,

    /// Folder for the results [default: out/<name of the model file>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// No progress, no summary on the terminal.
    #[arg(long, short)]
    quiet: bool,

    /// Draw no plots.
    #[arg(long)]
    no_plots: bool,

    /// Threads for models of thousands of elements or joints; results do not depend on their number [default: all
    /// processors].
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

impl Run {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        let (model, document) = self.model.read()?;
        if !self.quiet {
            show_warnings(&document);
        }
        let mut lowered = lower(&document)?;
        let processors = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        lowered.settings.threads = self.threads.unwrap_or_else(processors).get();
        let folder = ResultFolder::create(&self.folder()).map_err(unwritable)?;
        let mut history = folder.history().map_err(unwritable)?;
        let mut summary = summary::of_model(model.name(), &self.model.set, &document, &lowered);
        let mut session = match Session::start(lowered) {
            Ok(session) => session,
            Err(error) => {
                summary::of_failed_start(&mut summary, &error);
                folder.write_summary(&summary).map_err(unwritable)?;
                return Err(Failure::new(Exit::Failed, error));
            }
        };
        let mut bar = Bar::new(session.progress().planned, !self.quiet);
        let mut record = Record::default();
        let mut writers: Vec<&mut dyn Writer> = vec![&mut history];
        if !self.no_plots {
            writers.push(&mut record);
        }
        let report = session.run(&mut writers, &mut |progress| {
            bar.show(progress);
            if interrupt.is_noted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        bar.clear();
        let title = document.title.as_deref().unwrap_or_default();
        summary::of_run(&mut summary, &session, &report);
        let kept = self.keep(&folder, &summary, &record, title);
        if !self.quiet {
            let heading = if title.is_empty() { model.name() } else { title };
            terminal::print(&told(heading, &session, &report, folder.path()));
        }
        kept?;
        self.exit(&report, &folder)
    }

    fn folder(&self) -> PathBuf {
        let stem = self.model.model.file_stem().unwrap_or_default();
        self.out.clone().unwrap_or_else(|| Path::new("out").join(stem))
    }

    fn keep(
        &self,
        folder: &ResultFolder,
        summary: &Summary,
        record: &Record,
        title: &str,
    ) -> Result<(), Failure> {
        folder.write_summary(summary).map_err(unwritable)?;
        if self.no_plots {
            return Ok(());
        }
        match folder.write_plots(record, title) {
            // Nothing to draw, or no way to draw it: the numbers are there.
            Err(error @ FolderError::Figure(_)) => {
                if !self.quiet {
                    terminal::complain(&format!("warning: {error}\n"));
                }
                Ok(())
            }
            other => other.map_err(unwritable),
        }
    }

    fn exit(&self, report: &RunReport, folder: &ResultFolder) -> Result<Exit, Failure> {
        let saved = format!(
            "results up to t = {:.6e} s ({} rows) are in `{}`",
            report.time,
            report.records,
            folder.path().display()
        );
        match &report.stopped {
            Stopped::End => Ok(Exit::Done),
            Stopped::Interrupted => {
                if !self.quiet {
                    terminal::complain(&format!("interrupted: {saved}\n"));
                }
                Ok(Exit::Interrupted)
            }
            Stopped::Failed(error) => Err(Failure::new(Exit::Failed, format!("{error}\n  {saved}"))),
        }
    }
}

/// Results that cannot be left where they belong.
fn unwritable(error: impl Into<FolderError>) -> Failure {
    Failure::folder(Exit::Failed, &error.into())
}

/// A few lines for a person.
fn told(heading: &str, session: &Session, report: &RunReport, folder: &Path) -> String {
    let simulation = session.simulation();
    let settings = simulation.settings();
    let (plan, totals) = (session.plan(), &report.totals);
    let per_step = totals.newton_iterations as f64 / totals.steps.max(1) as f64;
    let solving = report.solving.as_secs_f64();
    let mut text = format!("{heading}\n");
    let mut line = |name: &str, words: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<12}{words}");
    };
    let stopped = if report.is_complete() { String::new() } else { format!(" of {} s", plan.end) };
    line(
        if report.is_complete() { "done" } else { "reached" },
        format!(
            "{} … {} s{stopped} in {} steps, {}, {} unknowns",
            plan.start,
            report.time,
            totals.steps,
            settings.scheme.name,
            simulation.system().layout().size()
        ),
    );
    let mut effort = format!("{per_step:.2} per step, {} tangents", totals.factorizations);
    if totals.rejected_steps > 0 {
        let _ = write!(effort, ", {} steps tried again", totals.rejected_steps);
    }
    if totals.stagnated_steps > 0 {
        let _ = write!(effort, ", {} steps ended at round-off", totals.stagnated_steps);
    }
    line("iterations", effort);
    if let Some((least, most)) = session.telemetry().condition_range() {
        let pivot = totals.smallest_relative_pivot;
        line(
            "tangent",
            format!("condition {least:.1e} … {most:.1e} (1-norm), relative pivots from {pivot:.1e}"),
        );
    }
    if let Some(row) = totals.fell_back_at {
        let unknown = simulation.system().layout().name_of(row);
        line("solver", format!("a pivot vanished for the {unknown}: went on with the pivoting solver"));
    }
    if let Some(row) = totals.yielded_at {
        let unknown = simulation.system().layout().name_of(row);
        let words = format!("repeat each other, seen at the {unknown}: least forces are given");
        line("redundant", format!("constraints {words}"));
    }
    let speed = if solving > 0.0 { totals.steps as f64 / solving } else { 0.0 };
    line(
        "time",
        format!("{:.3} s, {solving:.3} s of it in steps ({speed:.0} steps/s)", report.wall.as_secs_f64()),
    );
    line("constraints", format!("violated by at most {:.1e} m or rad", report.violation));
    let energy = &report.energy;
    line(
        "energy",
        format!(
            "{:.6e} J at the start, {:.6e} J at the end, largest change {:.3e} J",
            energy.start.total(),
            energy.end.total(),
            energy.largest
        ),
    );
    line("results", folder.display().to_string());
    text
}
