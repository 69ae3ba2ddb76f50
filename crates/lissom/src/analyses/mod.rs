//! The analyses of a model other than its own over time: a file or folder for each, and their table; studies of its steps.

pub mod buckling;
pub mod campbell;
pub mod gradient;
mod interface;
pub mod linearize;
pub mod modes;
mod operating_point;
pub mod path;
pub(crate) mod ports;
pub mod reduce;
mod registry;
pub mod response;
pub mod study;
pub mod tyre_curves;

pub use interface::{Analysis, AnalysisError, AnalysisReport, Origin, request, summary};
pub use registry::{ANALYSES, Outcome, Registered, ResultFiles};
