//! Table of the failures of files and recorded results: code, cause, remedy and explanation of each.

use lissom_mechanics::catalogued;
use lissom_mechanics::diagnostics::{Diagnose, Diagnostic, Entry, Severity, Value};

use crate::files::{Action, FileError};
use crate::output::{CurveError, FigureError, RecordError};
use crate::scene::SceneError;
use crate::text::report::MODEL_FILE;

/// All entries of the catalogue of this crate.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [&MODEL_FILE, &FILE, &FIGURE].into_iter().chain(ENTRIES)
}

const FILE: Entry = Entry {
    code: "file",
    variant: "FileError",
    severity: Severity::Failure,
    message: "cannot read `{path}`: {reason}",
    meaning: "A file or folder cannot be read, written or created. The message has the reason of the operating system.",
    advice: "Check the path, the permissions of its folder and the free disk space.",
};

const FIGURE: Entry = Entry {
    code: "figure",
    variant: "FigureError",
    severity: Severity::Failure,
    message: "the figure `{figure}` cannot be drawn: {reason}",
    meaning: "A plot has nothing to show on its axes, such as no positive value on a logarithmic one.",
    advice: "Plot other columns, or leave plots out with `--no-plots`.",
};

impl Diagnose for FileError {
    fn diagnostic(&self) -> Diagnostic {
        let action = match self.action {
            Action::Read => "read",
            Action::Write => "write",
            Action::CreateFolder => "create the folder",
        };
        let path = self.path.display().to_string();
        let cause = format!("cannot {action} `{path}`: {}", self.reason);
        let values = vec![("path", Value::Text(path)), ("reason", Value::Text(self.reason.clone()))];
        Diagnostic { values, ..Diagnostic::of(&FILE, cause, self.help.clone().unwrap_or_default()) }
    }
}

impl Diagnose for FigureError {
    fn diagnostic(&self) -> Diagnostic {
        let Self { figure, reason } = self;
        let values = vec![("figure", Value::from(figure)), ("reason", Value::from(reason))];
        let cause = format!("the figure `{figure}` cannot be drawn: {reason}");
        Diagnostic { values, ..Diagnostic::of(&FIGURE, cause, "plot other columns") }
    }
}

catalogued! {
    Failure RecordError {
        NoHeading {} => "table-heading" {
            cause: "the table has no heading that begins with `time`",
            remedy: "run the model again",
            meaning: "The table of results, `history.csv`, has no heading: it was changed, or is another file.",
        }
        BadLine { 0 => line } => "table-line" {
            cause: "line {line} does not contain one number for each column",
            remedy: "run the model again, or correct the line",
            meaning: "A line of the table of results has too many or too few numbers, or a word.",
        }
    } wraps {}

    Failure SceneError {
        Version { 0 => version } => "scene-version" {
            cause: "the scene is of version {version}, which this program does not read",
            remedy: "run the model again",
            meaning: "The description of a model's parts for pictures, `scene.json`, was written by another version of the program.",
        }
        Damaged { 0 => reason } => "scene-damaged" {
            cause: "the file does not describe a scene: {reason}",
            remedy: "run the model again",
            meaning: "The description of a model's parts for pictures, `scene.json`, is damaged or another file.",
        }
    } wraps {}

    Failure CurveError {
        Unknown { name => name, source_name => source, known => known } => "plot-column" {
            cause: "`{source}` has no column or output `{name}`",
            remedy: "it has {known}",
            meaning: "A column or output requested for a plot does not exist in the results.",
            advice: "Specify a column of the table of results, or an entry of [outputs].",
        }
        Units { name => name, first => first, second => second } => "plot-units" {
            cause: "`{name}` is in {first} in one of the results, and in {second} in another one",
            remedy: "plot the results separately",
            meaning: "Results are drawn in one plot, and a column has different units in them.",
        }
        NothingShared {} => "plot-nothing-shared" {
            cause: "the results have no output in common",
            remedy: "plot the results separately, or record outputs of the same name",
            meaning: "Several results are drawn in one plot by columns of the same name, and there is none.",
        }
        NoSpectrum { 0 => name } => "plot-spectrum" {
            cause: "`{name}` has no spectrum",
            remedy: "it requires at least four rows of finite numbers over time",
            meaning: "A column has too few rows for a spectrum, or numbers that are not finite.",
            advice: "Record more rows, or choose another column.",
        }
    } wraps {}
}
