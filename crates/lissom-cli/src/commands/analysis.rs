//! Commands of analyses without time steps.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use lissom::analyses::{self, Analysis, AnalysisError, AnalysisReport, Origin};
use lissom::core::number::duration;
use lissom::{Document, FolderError, Model, ResultFolder, summary};

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::results::unwritable;
use super::terminal;

// The help of the command is that of the request: a comment of documentation here would replace it.
#[derive(Args)]
pub(super) struct AnalysisCommand<A: Analysis + Args> {
    #[command(flatten)]
    model: ModelArguments,

    #[command(flatten)]
    request: A,

    #[arg(long, short, value_name = "DIR", display_order = 900, help = format!("Folder for the results [default: out/<name of the model file>-{}]", A::FOLDER))]
    out: Option<PathBuf>,

    /// Print nothing.
    #[arg(long, short, display_order = 902)]
    quiet: bool,
}

impl<A: Analysis + Args> AnalysisCommand<A> {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        let folder = self.model.folder(self.out, A::FOLDER);
        report((&model, &document), &self.request, &folder, self.quiet)
    }
}

/// Computes an analysis and writes its results to a folder.
pub(super) fn report<A: Analysis>(
    (model, document): (&Model, &Document),
    request: &A,
    path: &Path,
    quiet: bool,
) -> Result<Exit, Failure> {
    show_warnings(document);
    let began = Instant::now();
    let found = request.compute(model);
    let wall = began.elapsed();
    match found.as_ref().map_err(|error| (error.origin(), error)) {
        Err((Origin::Model(report), _)) => return Err(report.clone().into()),
        Err((Origin::Request, error)) => return Err(Failure::new(Exit::BadModel, error)),
        Err((Origin::Computation, _)) | Ok(_) => {}
    }
    // Earlier results would be wrong beside new ones, also beside the reason of a failure.
    let folder = ResultFolder::create(path).map_err(unwritable)?;
    folder.clear().map_err(unwritable)?;
    let found = found.or_else(|error| {
        let mut summary = summary::of_request(A::NAME, model, document);
        summary::of_failure(&mut summary, &error);
        folder.write_summary(&summary).map_err(unwritable)?;
        Err(Failure::new(Exit::Failed, &error))
    })?;
    let heading = document.title.as_deref().unwrap_or(model.name());
    for (name, text) in found.tables() {
        folder.write_table(&name, &text).map_err(unwritable)?;
    }
    if let Some(figure) = found.figure(heading) {
        let drawn = figure.map_err(FolderError::from);
        drawn.and_then(|drawn| ResultFolder::write_graphic(path, &drawn)).map_err(unwritable)?;
    }
    found.write_more(&folder, document).map_err(|error| Failure::new(Exit::Failed, &error))?;
    let summary = analyses::summary::<A>(&found, wall, model, document);
    folder.write_summary(&summary).map_err(unwritable)?;
    if !quiet {
        for warning in found.warnings() {
            warn(&warning);
        }
        terminal::print(&format!(
            "{heading}\n{}  {}\n",
            found.text(&duration(wall.as_secs_f64())),
            found.ending(path)
        ));
    }
    found.missing().map_or(Ok(Exit::Done), |missing| Err(Failure::new(Exit::Failed, &missing)))
}
