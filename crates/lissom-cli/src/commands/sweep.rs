//! `lissom sweep`: solves a model for many parameter values and writes one table.

use std::fmt::Write;
use std::io::{IsTerminal, stderr};
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use lissom::core::number::duration;
use lissom::model::files;
use lissom::sweep::{
    MemberOutcome, MemberState, Sweep, SweepError, SweepFile, SweepFolder, SweepFolderError,
};
use lissom::{CommandError, Diagnose, FileError, Model, Override, Summary};
use serde_json::json;

use super::outcome::{Exit, Failure};
use super::terminal::{self, Interrupt};

/// Maximum number of unsolved members listed in the message.
const NAMED: usize = 5;

/// Solve a model for many parameter values, on all processors.
///
/// The sweep file specifies the model, the paths that are varied, their sampling, and the scalars to be collected. The results
/// go to a folder: `sweep.csv` and `sweep.parquet` (one row per member), plots of this table, histories if requested,
/// `sweep.json` (counts and times), and `members.jsonl` (one line per finished member), from which the same command resumes
/// an interrupted sweep.
#[derive(Args)]
#[command(after_help = "\
A sweep file:
  lissom_sweep = 1
  model = \"pendulum.toml\"
  sampling = \"sobol\"        # grid (default), list, latin-hypercube, sobol, monte-carlo
  members = 64
  [vary]
  \"point_masses.bob.mass\" = { from = 1, to = 4 }
  \"springs.spring.stiffness\" = { mean = 10, standard_deviation = 1 }
  [collect]
  swing = \"max(bob.x)\"      # max min max_abs time_of_max time_of_min mean rms initial final
  latched = \"time_of_event(latch)\"
  late = \"max(bob.x, after=0.5)\"   # also before=2, last=0.2, after=event

Exit code: 0 all members are solved; 2 wrong model, sweep file or command line; 3 a member has no solution (the table is
still written), or results cannot be written; 130 interrupted by Ctrl-C: run it again to resume.")]
pub(super) struct SweepCommand {
    /// The sweep file.
    #[arg(value_name = "SWEEP.toml")]
    file: PathBuf,

    /// Override a value in all members, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// Folder for the results [default: out/<name of the sweep file>].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Number of members solved in parallel; results do not depend on it [default: all processors].
    #[arg(long, value_name = "N")]
    workers: Option<NonZero<usize>>,

    /// Discard the results of an earlier sweep in the folder.
    #[arg(long)]
    restart: bool,

    /// Draw no plots of the table.
    #[arg(long)]
    no_plots: bool,

    /// Print neither progress nor a summary.
    #[arg(long, short)]
    quiet: bool,
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Model(report) => report.into(),
            other => Self::new(Exit::BadModel, &other),
        }
    }
}

impl From<SweepFolderError> for Failure {
    fn from(error: SweepFolderError) -> Self {
        match error {
            SweepFolderError::File(error) => Self::new(Exit::Failed, &error),
            other => Self::new(Exit::BadModel, &other),
        }
    }
}

impl SweepCommand {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        let began = Instant::now();
        let sweep = self.sweep()?;
        if !sweep.warnings().is_empty() {
            terminal::complain(&sweep.warnings().render(terminal::in_colour()));
        }
        let stem = self.file.file_stem().unwrap_or_default();
        let path = self.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
        let (mut folder, mut outcomes) = SweepFolder::open(&path, &sweep, self.restart)?;
        let mut is_there = vec![false; sweep.len()];
        for outcome in &outcomes {
            is_there[outcome.member] = true;
        }
        let missing: Vec<usize> = (0..sweep.len()).filter(|member| !is_there[*member]).collect();
        let found = outcomes.len();
        let processors = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        let workers = self.workers.unwrap_or_else(processors);
        let bar = self.bar(sweep.len(), found);
        let mut keep = |outcome: MemberOutcome| {
            folder.append(&outcome)?;
            // Histories are already in their files.
            outcomes.push(MemberOutcome { history: None, ..outcome });
            Ok(())
        };
        let mut watch = |done: usize| {
            bar.set_position((found + done) as u64);
            if interrupt.is_noted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let ended = sweep.run(&missing, workers, &mut keep, &mut watch);
        bar.finish_and_clear();
        let ended = ended.map_err(|error: FileError| Failure::new(Exit::Failed, &error))?;
        if ended.is_break() {
            if !self.quiet {
                let (done, all) = (outcomes.len(), sweep.len());
                terminal::complain(&format!(
                    "interrupted: {done} of {all} members are in `{}`; the same command resumes from there\n",
                    path.display()
                ));
            }
            return Ok(Exit::Interrupted);
        }
        outcomes.sort_by_key(|outcome| outcome.member);
        let seconds = began.elapsed().as_secs_f64();
        let summary = summary(&sweep, &outcomes, (found, workers, seconds));
        let table =
            folder.finish(&sweep, &outcomes, &summary).map_err(|error| Failure::new(Exit::Failed, &error))?;
        if !self.no_plots && outcomes.iter().any(|outcome| outcome.state == MemberState::Solved) {
            let plot = lissom::sweep::plot(&sweep, &outcomes, sweep.model_name());
            folder.write_plots(&plot).map_err(|error| Failure::new(Exit::Failed, &error))?;
        }
        if !self.quiet {
            terminal::print(&render(&sweep, &outcomes, (found, workers, seconds), &table));
        }
        exit(&outcomes, &table)
    }

    fn sweep(&self) -> Result<Sweep, Failure> {
        let unreadable = |error| Failure::new(Exit::BadModel, &error);
        let text = files::read_input_text(&self.file).map_err(unreadable)?;
        let file = SweepFile::parse(&text, &self.file.display().to_string())?;
        let Some(model) = &file.model else {
            let message = format!("`{}` specifies no model: add `model = \"….toml\"`", self.file.display());
            return Err(Failure::request(message));
        };
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let model = Model::read(&folder.join(model)).map_err(unreadable)?;
        Ok(Sweep::new(&model.with_overrides(&self.set), file)?)
    }

    /// A progress bar of members with the remaining time; none in a pipe.
    fn bar(&self, members: usize, found: usize) -> ProgressBar {
        let bar = if !self.quiet && stderr().is_terminal() {
            ProgressBar::new(members as u64)
        } else {
            ProgressBar::hidden()
        };
        let style = ProgressStyle::with_template(
            "{bar:30} {human_pos} of {human_len} members, {per_sec}, {eta} left",
        );
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("━╸ "));
        bar.with_position(found as u64)
    }
}

/// The exit code; members that are not solved are named.
fn exit(outcomes: &[MemberOutcome], table: &Path) -> Result<Exit, Failure> {
    let failed: Vec<&MemberOutcome> =
        outcomes.iter().filter(|outcome| outcome.state != MemberState::Solved).collect();
    if failed.is_empty() {
        return Ok(Exit::Done);
    }
    let error = CommandError::Members { failed: failed.len(), count: outcomes.len() };
    let mut words = String::new();
    for outcome in failed.iter().take(NAMED) {
        let diagnosis = outcome.diagnosis.as_deref().unwrap_or_default();
        // Writing to a string cannot fail.
        let _ = writeln!(words, "  member {}: {diagnosis}", outcome.member);
    }
    if failed.len() > NAMED {
        let _ = writeln!(words, "  and {} more", failed.len() - NAMED);
    }
    let _ = writeln!(words, "  all members, with the causes of failures, are in `{}`", table.display());
    Err(Failure::with_details(Exit::Failed, &error.diagnostic(), &words))
}

fn count(outcomes: &[MemberOutcome], state: MemberState) -> usize {
    outcomes.iter().filter(|outcome| outcome.state == state).count()
}

/// Total time of all simulations of this process [s].
fn simulating(outcomes: &[MemberOutcome]) -> f64 {
    outcomes.iter().map(|outcome| outcome.seconds).sum()
}

/// The contents of `sweep.json`.
fn summary(
    sweep: &Sweep,
    outcomes: &[MemberOutcome],
    (found, workers, seconds): (usize, NonZero<usize>, f64),
) -> Summary {
    let mut summary = Summary::new();
    let facts = [
        ("model", json!(sweep.model_name())),
        ("version", json!(lissom::VERSION)),
        ("set", sweep.overrides().iter().map(|(path, value)| (path.clone(), json!(value))).collect()),
        ("sweep", json!(sweep.file())),
        ("members", json!(outcomes.len())),
        ("solved", json!(count(outcomes, MemberState::Solved))),
        ("failed", json!(count(outcomes, MemberState::Failed))),
        ("wrong_model", json!(count(outcomes, MemberState::WrongModel))),
        ("members_found", json!(found)),
        ("workers", json!(workers)),
        ("wall_seconds", json!(seconds)),
        ("simulation_seconds", json!(simulating(outcomes))),
    ];
    for (name, fact) in facts {
        // A JSON value is valid JSON.
        let _ = summary.insert(name, fact);
    }
    summary
}

/// The summary for the terminal.
fn render(
    sweep: &Sweep,
    outcomes: &[MemberOutcome],
    (found, workers, seconds): (usize, NonZero<usize>, f64),
    table: &Path,
) -> String {
    let solved = count(outcomes, MemberState::Solved);
    let mut text = format!("{}\n", sweep.model_name());
    let there = if found > 0 { format!(", {found} of them by an earlier run") } else { String::new() };
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  members     {} by {}, {solved} solved{there}",
        outcomes.len(),
        sweep.file().sampling
    );
    let computed = outcomes.len() - found;
    if computed > 0 {
        let per_member = |seconds: f64| duration(seconds / computed as f64);
        let (whole, simulating) = (seconds * workers.get() as f64, simulating(outcomes));
        let _ = writeln!(
            text,
            "  time        {} on {workers} workers; {} of a worker per member, {} of it simulation and {} beyond it",
            duration(seconds),
            per_member(whole),
            per_member(simulating),
            per_member(whole - simulating)
        );
    }
    let _ = writeln!(text, "  table       {}", table.display());
    text
}
