//! Runs of models that are written in tests.

use lissom::{Model, Record, Session};

pub(crate) use super::starts::{overrides, record, session, set};

/// All schemes of motion.
pub(crate) const SCHEMES: [&str; 5] =
    ["radau-iia", "radau-iia-5", "generalized-alpha", "hht", "energy-decaying"];

/// The rows of a model that reaches its end.
pub(crate) fn run(text: &str, set: &[(&str, &str)]) -> Record {
    record(&mut session(text, set))
}

/// The same without any warning.
pub(crate) fn run_without_warnings(text: &str, set: &[(&str, &str)]) -> Record {
    let mut session = session(text, set);
    let record = record(&mut session);
    let warnings: Vec<_> = session.warnings().map(ToString::to_string).collect();
    assert!(warnings.is_empty(), "{warnings:?}");
    record
}

/// One column.
pub(crate) fn column<'r>(record: &'r Record, output: &str, component: &str) -> &'r [f64] {
    record.column(output, component).unwrap_or_else(|| panic!("{output}.{component}"))
}

/// Its last value.
pub(crate) fn last(record: &Record, output: &str, component: &str) -> f64 {
    *column(record, output, component).last().expect("steps")
}

/// With every scheme a model restored in the middle goes on to the last bit: a snapshot at the first time [s], values at the
/// second.
pub(crate) fn goes_on_from_a_snapshot(text: &str, [middle, end]: [f64; 2]) {
    let model = Model::from_text("model.toml", text);
    for scheme in SCHEMES {
        let overrides = [set("analysis.scheme", scheme)];
        let mut session = model.with_overrides(&overrides).session().unwrap();
        session.step_to(middle).unwrap();
        let snapshot = session.snapshot().to_bytes();
        let go_on = |session: &mut Session| {
            session.step_to(end).unwrap();
            let mut values = Vec::new();
            session.values(&mut values);
            values
        };
        let straight = go_on(&mut session);
        let mut other = model.with_overrides(&overrides).session().unwrap();
        other.restore(&lissom::SessionSnapshot::from_bytes(&snapshot).unwrap()).unwrap();
        assert_eq!(go_on(&mut other), straight, "{scheme}");
    }
}
