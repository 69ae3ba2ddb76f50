//! Columns of records by names such as `ball.x`.

use lissom::Record;

use super::runs;

pub(crate) fn series<'r>(record: &'r Record, name: &str) -> &'r [f64] {
    let (output, component) = name.split_once('.').expect("output.component");
    runs::column(record, output, component)
}

/// The last value of a column.
pub(crate) fn last(record: &Record, name: &str) -> f64 {
    *series(record, name).last().expect("a record")
}
