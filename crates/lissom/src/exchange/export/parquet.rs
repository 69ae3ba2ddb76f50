//! Parquet: the table of a run for pandas, DuckDB, Polars and similar programs.

use serde_json::{Map, json};

use super::{ExportError, Format, Sink};
use crate::encodings::parquet::{Values, parquet};
use crate::motion::RecordedRun;

pub(super) const FORMAT: Format = Format {
    name: "parquet",
    summary: "The table of a run as one Parquet file, for pandas, DuckDB, Polars, Spark.",
    target: "history.parquet",
    is_folder: false,
    files: &[],
    write,
};

fn write(run: &RecordedRun, _: usize, sink: &mut Sink<'_>) -> Result<(), ExportError> {
    let record = &run.record;
    let mut columns = vec![("time".to_owned(), Values::Numbers(record.times.clone()))];
    let mut units = Map::from_iter([("time".to_owned(), json!("s"))]);
    for (column, values) in record.columns.iter().zip(&record.values) {
        units.insert(column.name(), json!(column.unit));
        columns.push((column.name(), Values::Numbers(values.clone())));
    }
    let facts = [("units", serde_json::Value::Object(units).to_string())];
    Ok(sink("", &parquet(&columns, &facts)?)?)
}
