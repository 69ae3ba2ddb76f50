//! Sessions of models that are good.

use lissom::{Model, Session};

/// A session at its start.
pub(crate) fn session(text: &str) -> Session {
    match Model::from_text("model.toml", text).session(&[]) {
        Ok(session) => session,
        Err(error) => panic!("{text}\n{error}"),
    }
}

/// A session at its end.
pub(crate) fn finished(text: &str) -> Session {
    let mut session = session(text);
    let (_, report) = session.record();
    assert!(report.is_complete(), "{text}\n{report:?}");
    session
}
