//! Folders for the results of analyses, and their contents after the failure of an analysis without time steps.

use std::fmt::Display;
use std::io;
use std::path::Path;

use lissom::{Diagnose, FolderError, ResultFolder, RunError};
use lissom_model::output::{FigureError, Graphic, Summary};

use super::outcome::{Exit, Failure};

/// The folder for `found`, with earlier results removed. A failed analysis writes its `summary` to it, with the
/// reason.
pub(super) fn folder_for<T, E: Diagnose + Display>(
    path: &Path,
    found: Result<T, E>,
    summary: impl FnOnce() -> Summary,
) -> Result<(ResultFolder, T), Failure> {
    let folder = ResultFolder::create(path).map_err(unwritable)?;
    folder.clear().map_err(unwritable)?;
    match found {
        Ok(found) => Ok((folder, found)),
        Err(error) => {
            let mut summary = summary();
            lissom::summary::of_failure(&mut summary, &error);
            folder.write_summary(&summary).map_err(unwritable)?;
            Err(Failure::new(Exit::Failed, &error))
        }
    }
}

/// Draws a figure into a folder, as SVG and as PNG.
pub(super) fn draw(folder: &ResultFolder, figure: Result<Graphic, FigureError>) -> Result<(), Failure> {
    let drawn = figure.map_err(FolderError::from);
    drawn.and_then(|drawn| ResultFolder::write_graphic(folder.path(), &drawn)).map(drop).map_err(unwritable)
}

/// An error while results were written to an open file.
pub(super) fn writing_failed(error: io::Error) -> Failure {
    Failure::new(Exit::Failed, &RunError::Write(error))
}

/// Results that cannot be written.
pub(super) fn unwritable(error: impl Into<FolderError>) -> Failure {
    Failure::new(Exit::Failed, &error.into())
}
