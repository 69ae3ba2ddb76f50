//! Sessions of models that are good.

use lissom::Session;

use super::starts;

/// A session at its start.
pub(crate) fn session(text: &str) -> Session {
    starts::session(text, &[])
}

/// A session at its end.
pub(crate) fn finished(text: &str) -> Session {
    let mut session = session(text);
    starts::record(&mut session);
    session
}
