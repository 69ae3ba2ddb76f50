//! The registry of the analyses without time steps.

use std::time::{Duration, Instant};

use lissom_model::Document;
use lissom_model::output::Summary;

use crate::analyses::buckling::BucklingRequest;
use crate::analyses::campbell::CampbellRequest;
use crate::analyses::gradient::GradientRequest;
use crate::analyses::interface::{self, Analysis, AnalysisError, AnalysisReport};
use crate::analyses::linearize::LinearizeRequest;
use crate::analyses::modes::ModeRequest;
use crate::analyses::reduce::ReduceRequest;
use crate::analyses::response::ResponseRequest;
use crate::diagnostic::with_code;
use crate::model_text::Model;

/// All analyses. On the command line each is also a line of `commands`.
pub const ANALYSES: &[Registered] = &[
    Registered::of::<BucklingRequest>(),
    Registered::of::<CampbellRequest>(),
    Registered::of::<ModeRequest>(),
    Registered::of::<ReduceRequest>(),
    Registered::of::<ResponseRequest>(),
    Registered::of::<LinearizeRequest>(),
    Registered::of::<GradientRequest>(),
];

/// Files of a result, or the reason for their absence.
pub type Outcome = Result<ResultFiles, Box<dyn AnalysisError>>;

/// An analysis in the registry.
#[derive(Clone, Copy, Debug)]
pub struct Registered {
    /// Name of the analysis.
    pub name: &'static str,
    /// Computes it for a request as a TOML value.
    pub compute: fn(&Model, &str) -> Outcome,
}

/// The files of a result, as texts.
#[derive(Clone, Debug)]
pub struct ResultFiles {
    /// Names and texts of the tables.
    pub tables: Vec<(String, String)>,
    /// The contents of `summary.json`.
    pub summary: Summary,
    /// Warnings with their codes.
    pub warnings: Vec<String>,
}

impl ResultFiles {
    /// The files of a report on a model.
    pub fn of<A: Analysis>(report: &A::Report, wall: Duration, model: &Model, document: &Document) -> Self {
        Self {
            tables: report.tables(),
            summary: interface::summary::<A>(report, wall, model, document),
            warnings: report.warnings().iter().map(with_code).collect(),
        }
    }
}

impl Registered {
    const fn of<A: Analysis>() -> Self {
        Self { name: A::NAME, compute: compute::<A> }
    }
}

fn boxed(error: impl AnalysisError + 'static) -> Box<dyn AnalysisError> {
    Box::new(error)
}

fn compute<A: Analysis>(model: &Model, request: &str) -> Outcome {
    let request: A = interface::request(request).map_err(boxed)?;
    let began = Instant::now();
    let report = request.compute(model).map_err(boxed)?;
    if let Some(missing) = report.missing() {
        return Err(boxed(missing));
    }
    let document = model.document().map_err(boxed)?;
    Ok(ResultFiles::of::<A>(&report, began.elapsed(), model, &document))
}
