//! Sessions of models with overrides.

use lissom::{Model, Override, Record, Session, SessionError};

/// An override.
pub(crate) fn set(path: &str, value: &str) -> Override {
    (path.to_owned(), value.to_owned())
}

/// Overrides.
pub(crate) fn overrides(set: &[(&str, &str)]) -> Vec<Override> {
    set.iter().map(|(path, value)| self::set(path, value)).collect()
}

/// A session at its start.
pub(crate) fn session(text: &str, set: &[(&str, &str)]) -> Session {
    match Model::from_text("model.toml", text).with_overrides(&overrides(set)).session() {
        Ok(session) => session,
        Err(SessionError::Model(report)) => panic!("{}", report.render(false)),
        Err(error) => panic!("{error}"),
    }
}

/// The rows of a session that reaches its end.
pub(crate) fn record(session: &mut Session) -> Record {
    session.run().unwrap_or_else(|error| panic!("{error:?}")).into_record()
}
