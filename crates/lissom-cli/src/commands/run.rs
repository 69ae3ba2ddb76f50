//! `lissom run`: simulates a model and writes its results to a folder.

use std::fmt::Write;
use std::fs::File;
use std::io;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use lissom::analyses::buckling::BucklingRequest;
use lissom::analyses::modes::ModeRequest;
use lissom::core::errors::InitialError;
use lissom::core::number::{Written, duration, written};
use lissom::model::document::AnalysisKind;
use lissom::model::lower::check_run;
use lissom::model::output::{CurveRecord, drawn_outputs};
use lissom::model::scene::Scene;
use lissom::motion::MotionRecorder;
use lissom::start::{Assembly, Lowered, lower_with_units};
use lissom::{
    Checkpoint, CheckpointEvery, CheckpointFile, Diagnose, Document, FolderError, Model, Override, Progress,
    ResultFolder, RunReport, Session, Stopped, Summary, Writer, summary,
};

use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::unwritable;
use super::terminal::{self, Bar, Interrupt};

/// Simulate a model as specified in its table `[analysis]`.
///
/// The results go to a folder: `history.csv` (time and all outputs), `summary.json` (steps, iterations, times,
/// violations, energy), `motion.bin` and `scene.json` (for `lissom view`), and plots of up to 20 outputs as SVG and
/// PNG. They are also written for the time before a failure or Ctrl-C.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom run examples/tip-crank.toml
  lissom run examples/tip-crank.toml --out results/fine --set analysis.step=1e-4
  lissom run examples/four-bar.toml --unset analysis.step      adaptive steps
  lissom run examples/top.toml --set analysis.scheme=hht --set bodies.top.mass=20 --no-plots --quiet
  lissom run examples/tip-crank.toml --checkpoint-every 10s
  lissom run --resume out/tip-crank             resumes an interrupted run with checkpoints

Ctrl-C ends the run after the current step and keeps the results; a second Ctrl-C ends it at once.
Exit code: 0 success; 2 wrong model or command line; 3 no solution; 130 interrupted by Ctrl-C.")]
pub(super) struct Run {
    /// The model file.
    #[arg(value_name = "MODEL.toml", required_unless_present = "resume")]
    model: Option<PathBuf>,

    /// Override a value of the model, such as `analysis.step=1e-4`; may be repeated.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::model_arguments::parse_override)]
    set: Vec<Override>,

    /// Remove a value or an entry from the model, such as `analysis.step` or `springs.damper`; may be repeated.
    #[arg(long, value_name = "PATH")]
    unset: Vec<String>,

    /// Folder for the results [default: out/<name of the model file>].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Print neither progress nor a summary.
    #[arg(long, short)]
    quiet: bool,

    /// Draw no plots.
    #[arg(long)]
    no_plots: bool,

    /// Write a checkpoint at this interval of time or steps, such as `10s` or `1000steps`.
    #[arg(long, value_name = "TIME|STEPS", value_parser = |text: &str| text.parse::<CheckpointEvery>().map(|_| text.to_owned()))]
    checkpoint_every: Option<String>,

    /// Resume the run in this folder from its last checkpoint, as if it had not been interrupted.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["model", "set", "unset", "out", "checkpoint_every"])]
    resume: Option<PathBuf>,

    /// Threads for models of thousands of elements or joints; results do not depend on their number [default: all
    /// processors].
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
}

/// Outputs that are drawn after a run: pictures of hundreds of them would take longer than the run.
pub(super) const MAX_PLOTS: usize = 20;

/// A line about the outputs that are not drawn, and how they are; empty if all are.
pub(super) fn not_drawn(record: &CurveRecord, folder: &Path) -> String {
    let outputs = drawn_outputs(record.columns());
    let Some(omitted @ [first, ..]) = outputs.get(MAX_PLOTS..) else { return String::new() };
    let last =
        omitted.last().filter(|last| *last != first).map_or(String::new(), |last| format!(" … {last}"));
    let (count, folder) = (omitted.len(), folder.display());
    format!(
        "  {:<12}{MAX_PLOTS} of {} outputs; `lissom plot {folder}` also draws the other {count}: {first}{last}\n",
        "plots",
        outputs.len()
    )
}

/// The data of a new or resumed run.
struct Task {
    model: Model,
    folder: PathBuf,
    plots: bool,
    every: Option<String>,
    resumed: Option<Checkpoint>,
}

/// The failure of a model that cannot start, which the summary names unless the folder has earlier results.
fn failed_start<T>(folder: &ResultFolder, summary: &mut Summary, error: &InitialError) -> Result<T, Failure> {
    let kept = if folder.has_results() {
        format!("  the earlier results in `{}` are unchanged\n", folder.path().display())
    } else {
        summary::of_failed_start(summary, error);
        folder.write_summary(summary).map_err(unwritable)?;
        String::new()
    };
    Err(Failure::with_details(Exit::Failed, &error.diagnostic(), &kept))
}

impl Run {
    /// The run that `lissom run` would start for a model, with default threads and without checkpoints.
    pub(super) fn of_model(model: &Path, set: &[Override], out: &Path, quiet: bool) -> Self {
        Self {
            model: Some(model.to_owned()),
            set: set.to_owned(),
            unset: Vec::new(),
            out: Some(out.to_owned()),
            quiet,
            no_plots: false,
            checkpoint_every: None,
            resume: None,
            threads: None,
        }
    }

    pub(super) fn run(self) -> Result<Exit, Failure> {
        let interrupt = Interrupt::listen();
        interrupt.cancel(|| self.simulate(&interrupt))
    }

    fn simulate(&self, interrupt: &Interrupt) -> Result<Exit, Failure> {
        let began = Instant::now();
        let task = self.task()?;
        let document = task.model.document()?;
        let asked = (&task.model, &document);
        match document.analysis.kind {
            AnalysisKind::Modes { .. } => {
                let request = ModeRequest { no_plots: !task.plots, ..ModeRequest::default() };
                return super::analysis::report(asked, &request, &task.folder, self.quiet);
            }
            AnalysisKind::Buckling { .. } => {
                return super::analysis::report(asked, &BucklingRequest::default(), &task.folder, self.quiet);
            }
            AnalysisKind::Path { .. } => {
                let wanted =
                    super::path::Wanted { folder: &task.folder, plots: task.plots, quiet: self.quiet };
                return super::path::run(asked, &wanted, interrupt);
            }
            AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. } => {}
        }
        show_warnings(&document);
        let mut lowered = check_run(&document).and_then(|()| lower_with_units(&document))?;
        let processors = || std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
        lowered.settings.threads = self.threads.unwrap_or_else(processors).get();
        let (folder, mut record) = task.open().map_err(unwritable)?;
        let recorder = MotionRecorder::new(&lowered, document.analysis.records.frames_per_second, io::sink());
        let scene = Scene::of(&document, &lowered.placed());
        let assembly = lowered.assembly.as_ref().map(Assembly::words);
        let mut summary = task.summary(&document, &lowered);
        let ready = Instant::now();
        let mut session =
            Session::start(lowered).or_else(|error| failed_start(&folder, &mut summary, &error))?;
        if task.every.is_some() {
            session.simulation().check_snapshots().map_err(|error| Failure::new(Exit::BadModel, &error))?;
        }
        session.cancel_by(interrupt.flag());
        let mut history = match &task.resumed {
            None => {
                CheckpointFile::remove(&task.folder);
                folder.begin().map_err(unwritable)?
            }
            Some(checkpoint) => folder.resumed_history(checkpoint).map_err(unwritable)?,
        };
        if let Some(checkpoint) = &task.resumed {
            session.restore(&checkpoint.session).map_err(|error| Failure::new(Exit::Failed, &error))?;
            record.set_columns(session.columns());
        }
        session.write_states_to(Box::new(task.motion(&folder, recorder, &scene)?));
        // This summary remains if the program is killed.
        summary::of_beginning(&mut summary);
        folder.write_summary(&summary).map_err(unwritable)?;
        let mut bar = Bar::new(session.progress().planned, !self.quiet);
        let mut writers: Vec<&mut dyn Writer> = vec![&mut history];
        if task.plots {
            writers.push(&mut record);
        }
        let mut watch = |progress: &Progress| {
            bar.show(progress);
            if interrupt.is_noted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let report = match task.checkpoints(&folder) {
            Some(mut checkpoints) => {
                let goes_on = task.resumed.is_some();
                session.run_with_checkpoints(&mut writers, &mut watch, &mut checkpoints, goes_on)
            }
            None => session.run_with(&mut writers, &mut watch),
        };
        bar.clear();
        let title = document.title.as_deref().unwrap_or_default();
        summary::of_run(&mut summary, &session, &report);
        let noted = folder.write_telemetry(&session.telemetry().to_json());
        for warning in session.warnings() {
            warn(warning);
        }
        let ended = Instant::now();
        let kept = self.keep(&folder, (&summary, &session), (&record, task.plots), title);
        let [total, model, plots] =
            [began.elapsed(), ready - began, ended.elapsed()].map(|time| time.as_secs_f64());
        let spent = Spent { total, model, plots };
        if !self.quiet {
            let heading = if title.is_empty() { task.model.name() } else { title };
            terminal::print(&render((heading, assembly), &session, &report, &spent, folder.path()));
            if task.plots {
                terminal::print(&not_drawn(&record, folder.path()));
            }
        }
        kept?;
        noted.map_err(unwritable)?;
        if report.is_complete() {
            CheckpointFile::remove(&task.folder);
        }
        self.exit(&report, &folder)
    }

    fn task(&self) -> Result<Task, Failure> {
        if let Some(folder) = &self.resume {
            let checkpoint =
                Checkpoint::read(folder).map_err(|error| Failure::new(Exit::BadModel, &error))?;
            let model = Model::from_text(&checkpoint.model, &checkpoint.text)
                .with_included(checkpoint.included.clone())
                .with_overrides(&checkpoint.overrides);
            return Ok(Task {
                model: checkpoint.left_out.iter().fold(model, |model, path| model.without(path)),
                folder: folder.clone(),
                plots: checkpoint.plots && !self.no_plots,
                every: Some(checkpoint.every.clone()),
                resumed: Some(checkpoint),
            });
        }
        let path = self.model.as_deref().unwrap_or(Path::new(""));
        let model = super::model_arguments::read(path, &self.set, &self.unset)?;
        let stem = path.file_stem().unwrap_or_default();
        let folder = self.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
        let every = self.checkpoint_every.clone();
        Ok(Task { model, folder, plots: !self.no_plots, every, resumed: None })
    }

    fn keep(
        &self,
        folder: &ResultFolder,
        (summary, session): (&Summary, &Session),
        (record, plots): (&CurveRecord, bool),
        title: &str,
    ) -> Result<(), Failure> {
        folder.write_summary(summary).map_err(unwritable)?;
        if !session.simulation().system().signals().events().is_empty() {
            folder.write_events(session.events()).map_err(unwritable)?;
        }
        if !plots {
            return Ok(());
        }
        match folder.write_plots(record, title, MAX_PLOTS) {
            // Without plots or without the ability to draw, the tables are complete.
            Err(error @ FolderError::Figure(_)) => {
                if !self.quiet {
                    warn(&error);
                }
                Ok(())
            }
            other => other.map_err(unwritable),
        }
    }

    fn exit(&self, report: &RunReport, folder: &ResultFolder) -> Result<Exit, Failure> {
        let saved = format!(
            "results up to t = {} s ({} rows) are in `{}`",
            Written(report.time),
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
            Stopped::Failed(error) => {
                Err(Failure::with_details(Exit::Failed, &error.diagnostic(), &format!("  {saved}\n")))
            }
        }
    }
}

impl Task {
    /// The folder of the results, and the curves of the rows that it already contains.
    fn open(&self) -> Result<(ResultFolder, CurveRecord), FolderError> {
        Ok(match &self.resumed {
            None => (ResultFolder::create(&self.folder)?, CurveRecord::default()),
            Some(checkpoint) => {
                let (folder, record) = ResultFolder::resume(&self.folder, checkpoint)?;
                (folder, CurveRecord::from(&record))
            }
        })
    }

    /// Records the motion, from the start or from the point at which the run is resumed.
    fn motion(
        &self,
        folder: &ResultFolder,
        recorder: MotionRecorder<io::Sink>,
        scene: &Scene,
    ) -> Result<MotionRecorder<File>, Failure> {
        if let Some(checkpoint) = &self.resumed {
            let (file, last) = folder.resumed_motion(checkpoint).map_err(unwritable)?;
            let mut recorder = recorder.writing_to(file);
            if let Some(last) = last {
                recorder.resume_after(last);
            }
            return Ok(recorder);
        }
        folder.write_scene(scene).map_err(unwritable)?;
        Ok(recorder.writing_to(folder.motion().map_err(unwritable)?))
    }

    /// Summary data known before the first step.
    fn summary(&self, document: &Document, lowered: &Lowered) -> Summary {
        let mut summary = summary::of_model(&self.model, document, lowered);
        summary::of_left_out(&mut summary, &self.model);
        summary
    }

    /// Destination of checkpoints, if requested.
    fn checkpoints(&self, folder: &ResultFolder) -> Option<CheckpointFile> {
        let every = self.every.clone()?;
        let parsed = every.parse().ok()?;
        let (model, text) = (self.model.name().to_owned(), self.model.text().to_owned());
        let included = self.model.included();
        let (overrides, plots) = (self.model.overrides().to_vec(), self.plots);
        let left_out = self.model.left_out().to_vec();
        let frame = move |session, [history_length, motion_length]: [u64; 2]| Checkpoint {
            model: model.clone(),
            text: text.clone(),
            included: included.clone(),
            overrides: overrides.clone(),
            left_out: left_out.clone(),
            plots,
            every: every.clone(),
            history_length,
            motion_length,
            session,
        };
        let motion = Some(folder.motion_path());
        Some(CheckpointFile::new(&self.folder, &folder.history_path(), motion, parsed, frame))
    }
}

/// Time that the command has spent [s].
struct Spent {
    total: f64,
    /// Reading and building the model.
    model: f64,
    plots: f64,
}

/// The summary for the terminal.
fn render(
    (heading, assembly): (&str, Option<String>),
    session: &Session,
    report: &RunReport,
    spent: &Spent,
    folder: &Path,
) -> String {
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
    if let Some(assembly) = assembly {
        line("assembly", assembly);
    }
    let stopped = match session.stopped_by() {
        Some(event) => format!(", where event `{event}` happened,"),
        None if report.is_complete() => String::new(),
        None => format!(" of {} s", plan.end),
    };
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
        let _ = write!(effort, ", {} steps repeated", totals.rejected_steps);
    }
    if totals.stagnated_steps > 0 {
        let _ = write!(effort, ", {} steps ended at round-off", totals.stagnated_steps);
    }
    line("iterations", effort);
    if let Some((least, most)) = session.telemetry().condition_range() {
        let pivot = totals.smallest_relative_pivot;
        line("tangent", {
            let [least, most, pivot] = [least, most, pivot].map(Written);
            format!("condition {least:.1e} … {most:.1e} (1-norm), relative pivots from {pivot:.1e}")
        });
    }
    if let Some(row) = totals.fell_back_at {
        let unknown = simulation.system().layout().name_of(row);
        line("solver", format!("zero pivot at the {unknown}: continued with the pivoting solver"));
    }
    if let Some(row) = totals.regularized_at {
        let unknown = simulation.system().layout().name_of(row);
        let words =
            format!("are redundant, detected at the {unknown}: the multipliers are those of minimum norm");
        line("redundant", format!("constraints {words}"));
    }
    let speed = if solving > 0.0 { totals.steps as f64 / solving } else { 0.0 };
    let parts = [
        ("model", spent.model, String::new()),
        ("start", report.seconds.start, String::new()),
        ("steps", solving, format!(" ({} steps/s)", written(speed, 3))),
        ("records", report.seconds.output, String::new()),
        ("plots", spent.plots, String::new()),
    ];
    // Below a hundredth of the whole, only the steps are of interest.
    let parts = parts.iter().filter(|(name, seconds, _)| *name == "steps" || *seconds > 0.01 * spent.total);
    let parts = parts.map(|(name, seconds, more)| format!("{name} {}{more}", duration(*seconds)));
    let parts = parts.collect::<Vec<_>>();
    line("time", format!("{}: {}", duration(spent.total), parts.join(", ")));
    line("constraints", format!("violated by at most {:.1e} m or rad", Written(report.violation)));
    let energy = &report.energy;
    line(
        "energy",
        format!(
            "{} J at the start, {} J at the end, largest change {:.3e} J",
            Written(energy.start.total()),
            Written(energy.end.total()),
            Written(energy.largest)
        ),
    );
    let graph = simulation.system().signals();
    for event in graph.events() {
        let own = session.events().filter(|(name, _)| *name == event.name);
        let times: Vec<f64> = own.map(|(_, time)| time).collect();
        // A box has up to 24 of them.
        if times.is_empty() && graph.signals()[event.root].subject.kind == "contact" {
            continue;
        }
        let words = match times.as_slice() {
            [] => "did not happen".to_owned(),
            [time] => format!("happened at t = {} s", Written(*time)),
            [first, .., last] => {
                let [first, last] = [first, last].map(|time| Written(*time));
                format!("happened {} times, from t = {first} s to {last} s", times.len())
            }
        };
        line("event", format!("`{}` {words}", event.name));
    }
    line("results", folder.display().to_string());
    text
}
