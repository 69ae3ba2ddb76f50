//! Analyses without time integration: each returns the texts of its command's files, so that Python reads identical values.

use std::time::Instant;

use lissom::analyses::linearize::{LinearizeRequest, linearize_session};
use lissom::analyses::path::{PathEnd, PathSession, PathSessionError, of_request};
use lissom::analyses::{ANALYSES, ResultFiles};
use lissom::{Document, Record, Session};
use pyo3::prelude::*;

use crate::errors::{SolutionError, of_analysis, of_report, question, refused, solution};
use crate::model::NativeModel;
use crate::results::{Parts, json, parts};
use crate::watch::{Watch, interruptible};

/// Names and texts of files, the summary as JSON, and warnings.
pub(crate) type Files = (Vec<(String, String)>, String, Vec<String>);

fn files(found: ResultFiles) -> Files {
    (found.tables, json(&found.summary), found.warnings)
}

/// The linear model at the state of `session`, as files.
pub(crate) fn linearize_here(
    session: &Session,
    model: &NativeModel,
    document: &Document,
    (inputs, outputs): (&[String], &[String]),
) -> PyResult<Files> {
    let began = Instant::now();
    let found = linearize_session(session, document, inputs, outputs).map_err(|error| of_analysis(&error))?;
    Ok(files(ResultFiles::of::<LinearizeRequest>(&found, began.elapsed(), &model.model, document)))
}

/// Results of the analysis called `name`, for its request as a TOML value.
#[pyfunction]
pub(crate) fn analyse(model: &NativeModel, py: Python<'_>, name: &str, request: String) -> PyResult<Files> {
    let known = ANALYSES.iter().find(|analysis| analysis.name == name);
    let analysis = known.ok_or_else(|| question(format!("there is no analysis `{name}`")))?;
    let model = model.clone();
    interruptible(py, move || {
        let found = (analysis.compute)(&model.model, &request);
        Ok(files(found.map_err(|error| of_analysis(&*error))?))
    })
}

/// Follows the path of a model with an analysis of kind `path`: the results, and why it ended early, if it did.
#[pyfunction]
pub(crate) fn path<'py>(
    model: &NativeModel,
    py: Python<'py>,
) -> PyResult<(Parts<'py>, Option<Bound<'py, PyAny>>)> {
    let own = model.clone();
    let (mut session, document) = interruptible(py, move || {
        let document = own.document()?;
        let session = PathSession::new(&own.model).map_err(|error| match error {
            PathSessionError::Model(report) => of_report(&report),
            other => refused(matches!(other, PathSessionError::NotAPath(_)), &other),
        })?;
        Ok((session, document))
    })?;
    let (record, summary, failure) = py.detach(|| {
        let mut record = Record::default();
        let mut watch = Watch::new(None);
        let report = session.run(&mut [&mut record], &mut || watch.ask(0.0, 0.0));
        watch.finish()?;
        let summary = session.summary(of_request(&model.model, &document), &report);
        let failure = match &report.end {
            PathEnd::Reached => None,
            PathEnd::Interrupted => Some(SolutionError::new_err("interrupted")),
            PathEnd::Failed(error) => Some(solution(error)),
        };
        Ok::<_, PyErr>((record, json(&summary), failure))
    })?;
    Ok((parts(py, record, summary), failure.map(|error| error.into_value(py).into_bound(py).into_any())))
}
