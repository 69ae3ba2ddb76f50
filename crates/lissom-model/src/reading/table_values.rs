//! Tables as they are written in a model file: rows of numbers, or columns of a data file.

use std::sync::Arc;

use crate::files::data_file::{DataError, two_columns};
use crate::files::library::{Missing, joined};
use crate::format::keys::table_keys;
use crate::format::suggest;
use crate::functions::table::{Extrapolation, Interpolation, Table, TableError};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::Problem;
use crate::text::{Node, Value};

/// The word among the keys of a table that the reader has.
pub(crate) fn table_key_in(reader: &Reader<'_, '_>) -> Option<&'static str> {
    table_keys().iter().map(|key| key.name).find(|word| reader.has(word))
}

/// How the table is read between its rows.
pub(crate) fn interpolation_of(reader: &Reader<'_, '_>) -> Interpolation {
    match reader.choice("interpolation").map_or("", |word| word.value) {
        "spline" => Interpolation::Spline,
        "monotone" => Interpolation::Monotone,
        _ => Interpolation::Linear,
    }
}

impl Context<'_> {
    /// A table of rows, or of columns of a file.
    pub(crate) fn read_table(&self, node: &Node, what: &str, beyond: Extrapolation) -> Option<Table> {
        let reader = Reader::open(self, node, (what.to_owned(), node.span), table_keys())?;
        self.table_of(&reader, node, beyond)
    }

    /// A table of rows or columns that has further keys.
    pub(crate) fn table_of(
        &self,
        reader: &Reader<'_, '_>,
        node: &Node,
        beyond: Extrapolation,
    ) -> Option<Table> {
        let what = reader.what.as_str();
        let interpolation = interpolation_of(reader);
        let extrapolation = match reader.choice("extrapolation").map(|word| word.value) {
            Some("constant") => Extrapolation::Constant,
            Some("linear") => Extrapolation::Linear,
            _ => beyond,
        };
        let period = match (reader.number("period"), reader.node("extrapolation")) {
            (Some(period), Some(_)) => {
                let message = format!("{what} has both `period` and `extrapolation`");
                return self.fail(period.span, message, "remove one of them");
            }
            (Some(period), None) if period.value <= 0.0 || interpolation == Interpolation::Linear => {
                let message =
                    format!("{what} has a `period`, but is not smooth, or the period is not positive");
                let help = "specify `interpolation = \"spline\"` or \"monotone\", and a positive period";
                return self.fail(period.span, message, help);
            }
            (period, _) => period.map(|period| period.value),
        };
        let of_rows = |rows: &[(f64, f64)]| match period {
            Some(period) => Table::periodic(rows, interpolation, period),
            None => Table::new(rows, interpolation, extrapolation),
        };
        match (reader.node("table"), reader.node("file")) {
            (Some(table), None) => {
                if let Some(columns) = reader.node("columns") {
                    let message = format!("{what} names columns, but no file");
                    return self.fail(columns.span, message, "remove `columns`, or specify `file`");
                }
                let Value::List(rows) = &table.value else {
                    return self.wrong_type(table, what, "a list of rows [argument, value]");
                };
                let row =
                    |row: &Node| self.numbers::<2>(row, &format!("each row of {what}")).map(|[t, v]| (t, v));
                let read: Vec<Option<(f64, f64)>> = rows.iter().map(row).collect();
                let read: Vec<(f64, f64)> = read.into_iter().collect::<Option<_>>()?;
                of_rows(&read).map_or_else(
                    |error| {
                        let place = match error {
                            TableError::NotAscending(row) | TableError::Repeated(row) => rows.get(row + 1),
                            TableError::NotFinite(row) => rows.get(row),
                            TableError::TooShort | TableError::NotClosed | TableError::TooLong => None,
                        };
                        let message = format!("{what} is not a function: {error}");
                        let span = place.map_or(table.span, |row| row.span);
                        self.fail(span, message, error.remedy())
                    },
                    Some,
                )
            }
            (None, Some(file)) => self.data_file(file, reader, of_rows),
            (Some(_), Some(file)) => {
                self.fail(file.span, format!("{what} has both `table` and `file`"), "remove one of them")
            }
            (None, None) => self.fail(node.span, format!("{what} has no rows"), "specify `table` or `file`"),
        }
    }

    fn data_file(
        &self,
        file: &Node,
        reader: &Reader<'_, '_>,
        of_rows: impl Fn(&[(f64, f64)]) -> Result<Table, TableError>,
    ) -> Option<Table> {
        let name = reader.text("file")?.value;
        let columns = match reader.node("columns") {
            None => None,
            Some(node) => Some(self.two_words(node, &reader.words("columns"))?),
        };
        let what = &reader.what;
        let text = self.file_text(file, name, what)?;
        let rows = match two_columns(&text, columns) {
            Ok(read) => read,
            Err(error) => {
                let help = match &error {
                    DataError::NoColumn { name, known, .. } => {
                        suggest::help(name, known.iter().map(String::as_str))
                    }
                    DataError::NotANumber { .. } => {
                        Some("write numbers as 1.5 or 1e-3, with a point".to_owned())
                    }
                    _ => Some("write for example `time,force` in the first line".to_owned()),
                };
                let problem = Problem::error(file.span, format!("{what}: `{name}`: {error}"));
                self.report(problem.label("named here").maybe_help(help));
                return None;
            }
        };
        of_rows(&rows.values).map_or_else(
            |error| {
                let words = match error {
                    TableError::NotAscending(row) => {
                        format!("line {}: the first column must ascend", rows.lines[row + 1])
                    }
                    TableError::Repeated(row) => {
                        let lines = [rows.lines[row], rows.lines[row + 1]];
                        format!("lines {} and {} have the same argument", lines[0], lines[1])
                    }
                    _ => error.to_string(),
                };
                self.fail(file.span, format!("{what}: `{name}`: {words}"), error.remedy())
            },
            Some,
        )
    }

    /// The text of a file.
    pub(crate) fn file_text(&self, file: &Node, name: &str, what: &str) -> Option<Arc<str>> {
        let found = self.library.text(&joined(self.sources.file(file.span), name));
        let missing = |error: Missing| {
            let problem = Problem::error(file.span, format!("{what} {error}"));
            self.report(problem.label("named here").maybe_help(error.help));
        };
        found.map_err(missing).ok()
    }

    fn two_words<'n>(&self, node: &'n Node, what: &str) -> Option<[&'n str; 2]> {
        if let Value::List(list) = &node.value
            && let [Node { value: Value::Text(first), .. }, Node { value: Value::Text(second), .. }] =
                list.as_slice()
        {
            return Some([first, second]);
        }
        self.fail(node.span, format!("{what} must be two texts"), "write [\"first\", \"second\"]")
    }
}
