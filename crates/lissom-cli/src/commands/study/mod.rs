//! `lissom study`: series of runs that show the effects of scheme and step size on a model. One study per file.

mod conditioning;
mod convergence;

use std::fmt::Write;
use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use lissom::analyses::study::{StudyError, Watch};
use lissom::core::interrupt::within;
use lissom::model::files;
use lissom::model::output::LogFigure;

use super::outcome::{Exit, Failure, warn};
use super::terminal::Interrupt;

/// Study the effects of scheme and step size on a model.
#[derive(Args)]
pub(super) struct Study {
    #[command(subcommand)]
    kind: Kind,
}

#[derive(Subcommand)]
enum Kind {
    Conditioning(conditioning::Conditioning),
    Convergence(convergence::Convergence),
}

impl Study {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        match self.kind {
            Kind::Conditioning(study) => study.run(),
            Kind::Convergence(study) => study.run(),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Model(report) => report.into(),
            StudyError::Interrupted => Self::new(Exit::Interrupted, &error),
            StudyError::NotDynamic
            | StudyError::SchemeWord { .. }
            | StudyError::Output { .. }
            | StudyError::Steps { .. }
            | StudyError::CoarseReference(_)
            | StudyError::NothingToCompare(_) => Self::new(Exit::BadModel, &error),
            other => Self::new(Exit::Failed, &other),
        }
    }
}

/// Path of the table: the given one, or `out/study-<name>/<model>.csv`. Results of earlier studies are not overwritten: by default
/// a number is added to the name.
///
/// # Errors
/// If the given file, or the plot beside it, exists.
fn table_path(out: Option<&PathBuf>, name: &str, model: &Path) -> Result<PathBuf, Failure> {
    let is_free =
        |path: &PathBuf| !["csv", "svg", "png"].iter().any(|ending| path.with_extension(ending).exists());
    if let Some(path) = out {
        if path.exists() || !is_free(path) {
            let message = format!(
                "`{}` has the results of another study, which are not overwritten: choose another name by `--out`",
                path.display()
            );
            return Err(Failure::request(message));
        }
        return Ok(path.clone());
    }
    let stem = model.file_stem().unwrap_or_default().to_string_lossy();
    let folder = Path::new("out").join(format!("study-{name}"));
    let first = folder.join(format!("{stem}.csv"));
    let numbered = (2..).map(|number| folder.join(format!("{stem}-{number}.csv")));
    Ok(std::iter::once(first.clone()).chain(numbered).find(is_free).unwrap_or(first))
}

/// Writes a file, with the folders above it.
fn write(path: &Path, contents: &[u8]) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder
        .map_or(Ok(()), files::create_folder)
        .and_then(|()| files::write(path, contents))
        .map_err(|error| Failure::new(Exit::Failed, &error))
}

/// Draws the plot beside the table. A failure to draw is a warning, because the table is written.
fn draw(figure: &LogFigure, table: &Path) -> Result<String, Failure> {
    let drawn = figure.draw().and_then(|drawn| Ok((drawn.svg()?, drawn.png()?)));
    let (svg, png) = match drawn {
        Ok(drawn) => drawn,
        Err(error) => {
            warn(&error);
            return Ok(String::new());
        }
    };
    write(&table.with_extension("svg"), svg.as_bytes())?;
    write(&table.with_extension("png"), &png)?;
    Ok(", plot beside it (svg, png)".to_owned())
}

/// Lines of right-aligned columns, the first `words` of them left-aligned.
fn aligned(lines: &[Vec<String>], words: usize) -> String {
    let columns = lines.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns)
        .map(|column| lines.iter().filter_map(|line| line.get(column)).map(|cell| cell.chars().count()).max())
        .map(Option::unwrap_or_default)
        .collect();
    let mut text = String::new();
    for line in lines {
        let mut row = String::new();
        for (column, (cell, &width)) in line.iter().zip(&widths).enumerate() {
            // Writing to a string cannot fail.
            let _ = if column < words {
                write!(row, "  {cell:<width$}")
            } else {
                write!(row, "  {cell:>width$}")
            };
        }
        text.push_str(row.trim_end());
        text.push('\n');
    }
    text
}

/// The outcome of `study`, with a progress bar on the terminal while it runs; Ctrl-C ends it.
fn watched<T>(
    interrupt: &Interrupt,
    study: impl FnOnce(Watch<'_>) -> Result<T, StudyError>,
) -> Result<T, Failure> {
    let bar = bar();
    let watch = |done, planned| {
        bar.set_length(planned as u64);
        bar.set_position(done as u64);
        if interrupt.is_noted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let outcome = within(interrupt.flag(), || study(&watch));
    bar.finish_and_clear();
    // Starts that were cancelled are no results.
    Ok(if interrupt.is_noted() { Err(StudyError::Interrupted) } else { outcome }?)
}

/// A progress bar of the steps of all runs; none in a pipe.
fn bar() -> ProgressBar {
    let bar = if stderr().is_terminal() { ProgressBar::new(0) } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template("{bar:30} {human_pos} of {human_len} steps  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("━╸ "));
    bar
}

#[cfg(test)]
#[path = "../../../tests/unit/commands/study/mod.rs"]
mod tests;
