//! Analyses without time steps: what each declares. Its command, its results folder and its function in Python are made from this.

use std::fmt::Display;
use std::path::Path;
use std::time::Duration;

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_model::output::{FigureError, Graphic, Summary};
use lissom_model::{Document, Report};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use toml::de::ValueDeserializer;

use crate::command_error::CommandError;
use crate::model_text::Model;
use crate::results::folder::ResultFolder;

/// The request of an analysis. With the feature `clap` its fields are the options of the command.
pub trait Analysis: DeserializeOwned {
    /// Name of the analysis: that of its command.
    const NAME: &'static str;
    /// Last word in the name of its folder of results.
    const FOLDER: &'static str = Self::NAME;
    /// Result of the analysis.
    type Report: AnalysisReport;
    /// Failure of the analysis.
    type Error: AnalysisError + 'static;

    /// Analyses `model`.
    ///
    /// # Errors
    /// If the model or the request is invalid, or there is no result.
    fn compute(&self, model: &Model) -> Result<Self::Report, Self::Error>;
}

/// The result of an analysis.
pub trait AnalysisReport {
    /// Names and texts of its tables.
    fn tables(&self) -> Vec<(String, String)>;

    /// Figure of the report, if it has one.
    fn figure(&self, _title: &str) -> Option<Result<Graphic, FigureError>> {
        None
    }

    /// Writes its other files.
    ///
    /// # Errors
    /// If a file cannot be written.
    fn write_more(&self, _folder: &ResultFolder, _document: &Document) -> Result<(), Diagnostic> {
        Ok(())
    }

    /// Inserts its contents into `summary.json`.
    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value));

    /// Warnings of the analysis.
    fn warnings(&self) -> Vec<Diagnostic>;

    /// The part of the request that has no result; the command then fails after it has written the others. Default: nothing is missing.
    fn missing(&self) -> Option<Diagnostic> {
        None
    }

    /// Lines of the report on the terminal, after the title of the model; the first one ends with the duration of the analysis.
    fn text(&self, time: &str) -> String;

    /// The last line, about the folder of results.
    fn ending(&self, folder: &Path) -> String {
        format!("results in {}", folder.display())
    }
}

/// The failure of an analysis.
pub trait AnalysisError: Diagnose + Display {
    /// What is invalid or failed.
    fn origin(&self) -> Origin<'_>;
}

/// Origin of a failure.
#[derive(Clone, Copy, Debug)]
pub enum Origin<'e> {
    /// The model is invalid.
    Model(&'e Report),
    /// The request is invalid for the model.
    Request,
    /// There is no result.
    Computation,
}

impl AnalysisError for CommandError {
    fn origin(&self) -> Origin<'_> {
        Origin::Request
    }
}

impl AnalysisError for Diagnostic {
    fn origin(&self) -> Origin<'_> {
        Origin::Computation
    }
}

impl AnalysisError for Report {
    fn origin(&self) -> Origin<'_> {
        Origin::Model(self)
    }
}

/// The request in a TOML value.
///
/// # Errors
/// If it is not a request of this analysis.
pub fn request<A: Analysis>(text: &str) -> Result<A, CommandError> {
    let read = ValueDeserializer::parse(text).and_then(A::deserialize);
    read.map_err(|error| CommandError::Request(error.message().to_owned()))
}

/// The contents of `summary.json`, with the duration of the analysis.
pub fn summary<A: Analysis>(
    report: &A::Report,
    wall: Duration,
    model: &Model,
    document: &Document,
) -> Summary {
    let mut summary = crate::results::summary::of_request(A::NAME, model, document);
    let mut insert = |name: &str, fact: Value| crate::results::summary::insert(&mut summary, name, fact);
    insert("stopped", json!("end"));
    report.add_facts(&mut insert);
    insert("wall_seconds", json!(wall.as_secs_f64()));
    crate::results::summary::add_warnings(&mut summary, &report.warnings());
    if let Some(missing) = report.missing() {
        crate::results::summary::insert(&mut summary, "stopped", json!("failed"));
        crate::results::summary::of_failure(&mut summary, &missing);
    }
    summary
}

/// Parser of an option that is a count in a range.
#[cfg(feature = "clap")]
pub(crate) fn counts(
    range: impl std::ops::RangeBounds<i64>,
) -> impl clap::builder::TypedValueParser<Value = usize> {
    use clap::builder::TypedValueParser;
    clap::value_parser!(u32).range(range).map(|count| count as usize)
}
