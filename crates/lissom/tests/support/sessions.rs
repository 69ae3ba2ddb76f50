//! Sessions of models that are good.

use lissom::Session;

use super::runs;

/// A session at its start.
pub(crate) fn session(text: &str) -> Session {
    runs::session(text, &[])
}

/// A session at its end.
pub(crate) fn finished(text: &str) -> Session {
    let mut session = session(text);
    runs::record(&mut session);
    session
}
