//! Messages about wrong models.

use lissom::{Model, SessionError};

/// Why a model is rejected.
pub(crate) fn refused(text: &str) -> String {
    match Model::from_text("model.toml", text).session() {
        Ok(_) => panic!("{text} is no good model"),
        Err(SessionError::Model(report)) => report.render(false),
        Err(error) => error.to_string(),
    }
}
