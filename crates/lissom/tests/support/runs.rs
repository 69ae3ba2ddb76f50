//! Runs of models written in tests of joints.

use lissom::{Model, Record, Session, SessionError};

/// All schemes of motion.
pub(crate) const SCHEMES: [&str; 5] =
    ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// An override.
pub(crate) fn set(path: &str, value: &str) -> (String, String) {
    (path.to_owned(), value.to_owned())
}

/// The rows of a model that reaches its end.
pub(crate) fn run(text: &str, overrides: &[(String, String)]) -> Record {
    let mut session = match Model::from_text("model.toml", text).session(overrides) {
        Ok(session) => session,
        Err(SessionError::Model(report)) => panic!("{}", report.render(false)),
        Err(error) => panic!("{error}"),
    };
    let (record, report) = session.record();
    assert!(report.is_complete(), "{:?}", report.error());
    record
}

/// One column.
pub(crate) fn column(record: &Record, output: &str, component: &str) -> Vec<f64> {
    record.column(output, component).unwrap_or_else(|| panic!("{output}.{component}")).to_vec()
}

/// Its last value.
pub(crate) fn last(record: &Record, output: &str, component: &str) -> f64 {
    *column(record, output, component).last().expect("steps")
}

/// The message about a wrong model.
pub(crate) fn reported(text: &str) -> String {
    match Model::from_text("wrong.toml", text).session(&[]) {
        Err(SessionError::Model(report)) => report.render(false),
        Err(error) => panic!("{error}"),
        Ok(_) => panic!("not rejected"),
    }
}

/// With every scheme a model restored in the middle goes on to the last bit: a snapshot at the first time [s], values at the
/// second.
pub(crate) fn goes_on_from_a_snapshot(text: &str, [middle, end]: [f64; 2]) {
    let model = Model::from_text("model.toml", text);
    for scheme in SCHEMES {
        let overrides = [set("analysis.scheme", scheme)];
        let mut session = model.session(&overrides).unwrap();
        session.step_to(middle).unwrap();
        let snapshot = session.snapshot().to_bytes();
        let go_on = |session: &mut Session| {
            session.step_to(end).unwrap();
            let mut values = Vec::new();
            session.values(&mut values);
            values
        };
        let straight = go_on(&mut session);
        let mut other = model.session(&overrides).unwrap();
        other.restore(&lissom::SessionSnapshot::from_bytes(&snapshot).unwrap()).unwrap();
        assert_eq!(go_on(&mut other), straight, "{scheme}");
    }
}
