//! Follows the equilibrium paths of models.

use lissom::analyses::path::{PathReport, PathSession, PathSessionError};
use lissom::{Model, Record};

use super::starts;

pub(crate) fn start(text: &str, overrides: &[(&str, &str)]) -> Result<PathSession, String> {
    let model = Model::from_text("model.toml", text).with_overrides(&starts::overrides(overrides));
    PathSession::new(&model).map_err(|error| match error {
        PathSessionError::Model(report) => report.render(false),
        other => other.to_string(),
    })
}

pub(crate) fn follow(text: &str, overrides: &[(&str, &str)]) -> (Record, PathReport) {
    start(text, overrides).unwrap_or_else(|error| panic!("{error}")).record()
}

/// A relative error within the tolerance.
pub(crate) fn near(found: f64, exact: f64, tolerance: f64) {
    let missed = (found - exact).abs();
    assert!(missed <= tolerance * exact.abs(), "{found} for {exact}: {:e}", found / exact - 1.0);
}
