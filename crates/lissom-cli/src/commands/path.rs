//! Analyses of kind `path` for `lissom run`.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::Path;

use lissom::analyses::path::{PathEnd, PathReport, PathSession, PathSessionError, of_request};
use lissom::model::output::CurveRecord;
use lissom::{Diagnose, Document, FolderError, Model, ResultFolder, Writer};

use super::outcome::{Exit, Failure, show_warnings, warn};
use super::run::{MAX_PLOTS, not_drawn};
use super::terminal::{self, Interrupt};
use lissom::core::number::{Written, duration};

/// Options for the results.
pub(super) struct Wanted<'a> {
    pub(super) folder: &'a Path,
    pub(super) plots: bool,
    pub(super) quiet: bool,
}

/// Computes an equilibrium path and writes its results to a folder.
pub(super) fn run(
    (model, document): (&Model, &Document),
    wanted: &Wanted<'_>,
    interrupt: &Interrupt,
) -> Result<Exit, Failure> {
    show_warnings(document);
    let unwritable = |error: FolderError| Failure::new(Exit::Failed, &error);
    let mut summary = of_request(model, document);
    let started = match PathSession::new(model) {
        Err(PathSessionError::Model(report)) => return Err(report.into()),
        other => other,
    };
    let folder = ResultFolder::create(wanted.folder).map_err(|error| unwritable(error.into()))?;
    let session = match started {
        Ok(session) => session,
        Err(error) => {
            if !folder.has_results() {
                lissom::summary::of_failure(&mut summary, &error);
                folder.write_summary(&summary).map_err(|error| unwritable(error.into()))?;
            }
            return Err(Failure::new(Exit::Failed, &error));
        }
    };
    for warning in session.warnings() {
        warn(warning);
    }
    let mut history = folder.begin().map_err(|error| unwritable(error.into()))?;
    // With both files the path can be displayed even after the program was killed.
    folder.write_scene(&session.scene()).map_err(|error| unwritable(error.into()))?;
    let motion = folder.motion().map_err(|error| unwritable(error.into()))?;
    let mut session = session.with_motion(Box::new(motion));
    let mut record = CurveRecord::default();
    let mut writers: Vec<&mut dyn Writer> = vec![&mut history];
    if wanted.plots {
        writers.push(&mut record);
    }
    let mut watch = || if interrupt.is_noted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let report = session.run(&mut writers, &mut watch);
    folder.write_scene(&session.scene()).map_err(|error| unwritable(error.into()))?;
    folder.write_summary(&session.summary(summary, &report)).map_err(|error| unwritable(error.into()))?;
    let title = document.title.as_deref().unwrap_or(model.name());
    if !wanted.quiet {
        terminal::print(&render(title, &report, folder.path()));
    }
    if wanted.plots {
        let not_drawn = not_drawn(&record, folder.path());
        if !wanted.quiet {
            terminal::print(&not_drawn);
        }
        match folder.write_plots(&record, title, MAX_PLOTS) {
            Err(error @ FolderError::Figure(_)) => warn(&error),
            other => other.map_err(unwritable)?,
        }
    }
    match report.end {
        PathEnd::Reached => Ok(Exit::Done),
        PathEnd::Interrupted => Ok(Exit::Interrupted),
        PathEnd::Failed(error) => {
            let details = format!("  {} equilibria are in `{}`\n", report.records, folder.path().display());
            Err(Failure::with_details(Exit::Failed, &error.diagnostic(), &details))
        }
    }
}

/// The summary for the terminal.
fn render(heading: &str, report: &PathReport, folder: &Path) -> String {
    let mut text = format!("{heading}\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "  path to {} {}, length {:.3e}, in {} steps ({} repeated), {} iterations, {}",
        report.name,
        Written(report.load_factor),
        Written(report.arc),
        report.steps[0],
        report.steps[1],
        report.iterations,
        duration(report.wall.as_secs_f64())
    );
    for point in &report.critical {
        let [before, after] = point.unstable;
        let _ = writeln!(
            text,
            "  {:<12} {} {:.9e}, unstable directions {before} → {after}{}",
            point.kind.name(),
            report.name,
            Written(point.load_factor),
            if point.is_located { "" } else { ", not located accurately" }
        );
    }
    let _ = writeln!(text, "  results in {}", folder.display());
    text
}
