//! Tables over expressions of a local load: rows, columns of a data file, polars of aerofoils, or turbulent wind.

use std::sync::Arc;

use crate::files::library::{Missing, joined};
use crate::files::polar_file::{Polar, polars};
use crate::files::wind_box::WindBox;
use crate::format::keys::table_keys;
use crate::format::keys::{Key, Shape, choice, required, unitless};
use crate::functions::table::{Extrapolation, Table};
use crate::functions::table_family::TableFamily;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::reading::table_values::{interpolation_of, table_key_in};
use crate::text::report::Problem;
use crate::text::{Node, Value};

/// Coefficients in files of polars.
const COEFFICIENTS: [&str; 3] = ["cl", "cd", "cm"];
/// Components of wind: along it, to its left and upwards.
const COMPONENTS: [&str; 3] = ["u", "v", "w"];

/// Keys of a table of a local load.
pub(crate) fn local_table_keys() -> Vec<Key> {
    let mut keys = table_keys();
    keys.extend([
        required("of", Shape::Formula, "", "the expression over which the table is, or two in a list"),
        unitless("tables", Shape::Table, "tables for ascending values `at` of the second expression"),
        unitless("polar", Shape::Text, "a file of AeroDyn or HAWC2 with polars of an aerofoil"),
        unitless("coefficient", choice(&COEFFICIENTS), "coefficient of the polars: lift, drag or moment"),
        unitless(
            "wind",
            Shape::Text,
            "a binary file of TurbSim with wind over y, z and time: three expressions in `of`",
        ),
        unitless("component", choice(&COMPONENTS), "component of the wind: along it, to its left, upwards"),
        unitless("set", Shape::Count(1, 9999), "set of polars in a file of HAWC2").or_count(1),
    ]);
    keys
}

impl Context<'_> {
    /// The tables over `count` expressions, one or two.
    pub(crate) fn local_table(
        &self,
        reader: &Reader<'_, '_>,
        node: &Node,
        count: usize,
    ) -> Option<TableFamily> {
        let what = &reader.what;
        let forms = ["tables", "polar"].into_iter().filter(|word| reader.has(word));
        let rows = table_key_in(reader).filter(|word| !(reader.has("polar") && *word == "interpolation"));
        let forms: Vec<&str> = forms.chain(rows).collect();
        if let [first, second, ..] = forms.as_slice() {
            let message = format!("{what} has both `{first}` and `{second}`");
            return self.fail(node.span, message, "remove one of them");
        }
        if let Some(file) = reader.node("polar") {
            return self.polar(reader, file, count);
        }
        match (reader.node("tables"), count) {
            (Some(tables), 2) => self.family(tables, what),
            (Some(tables), _) => {
                let message = format!("{what} has `tables` over one expression");
                self.fail(tables.span, message, "write two expressions, such as `of = [\"alpha\", \"re\"]`")
            }
            (None, 2) => {
                let message = format!("{what} is over two expressions, but lacks `tables`");
                let help =
                    "add `tables = [{ at = …, table = … }, …]`, one for each value of the second expression";
                self.fail(node.span, message, help)
            }
            (None, _) => Some(self.table_of(reader, node, Extrapolation::Constant)?.into()),
        }
    }

    /// The wind of a file with the index of a component, if there is one.
    pub(crate) fn wind_of(
        &self,
        reader: &Reader<'_, '_>,
        node: &Node,
        count: usize,
    ) -> Option<(Arc<WindBox>, usize)> {
        let (what, file, name) = (&reader.what, reader.node("wind")?, reader.text("wind")?.value);
        if ["tables", "polar"].iter().any(|word| reader.has(word)) || table_key_in(reader).is_some() {
            return self.fail(node.span, format!("{what} has both `wind` and a table"), "remove one of them");
        }
        if count != 3 {
            let message = format!("{what} has `wind` over {count} expressions");
            return self.fail(node.span, message, "write `of = [\"y\", \"z\", \"t\"]`");
        }
        let Some(component) = reader.choice("component") else {
            let help = "add `component = \"u\"`, \"v\" or \"w\"";
            return self.fail(file.span, format!("{what} lacks `component`"), help);
        };
        let missing = |error: Missing| {
            let problem = Problem::error(file.span, format!("{what}: {error}"));
            self.report(problem.label("named here").maybe_help(error.help));
        };
        let wind = self.library.wind(&joined(self.sources.file(file.span), name)).map_err(missing).ok()?;
        Some((wind, COMPONENTS.iter().position(|own| *own == component.value)?))
    }

    fn family(&self, node: &Node, what: &str) -> Option<TableFamily> {
        let Value::List(list) = &node.value else {
            return self.wrong_type(node, &format!("`tables` of {what}"), "a list of tables");
        };
        let mut keys = table_keys();
        keys.push(required("at", Shape::Number, "", "value of the second expression"));
        let read = |own: &Node| {
            let reader = Reader::open(self, own, (format!("each table of {what}"), own.span), keys.clone())?;
            Some((reader.number("at")?.value, self.table_of(&reader, own, Extrapolation::Constant)?))
        };
        let tables: Vec<Option<(f64, Table)>> = list.iter().map(read).collect();
        TableFamily::new(tables.into_iter().collect::<Option<_>>()?).or_else(|| {
            let message = format!("the values `at` of {what} do not ascend strictly");
            self.fail(node.span, message, "write the tables in ascending order")
        })
    }

    fn polar(&self, reader: &Reader<'_, '_>, file: &Node, count: usize) -> Option<TableFamily> {
        let (what, name) = (&reader.what, reader.text("polar")?.value);
        let Some(coefficient) = reader.choice("coefficient") else {
            let message = format!("{what} lacks `coefficient`");
            return self.fail(file.span, message, "add `coefficient = \"cl\"`, \"cd\" or \"cm\"");
        };
        let column = COEFFICIENTS.iter().position(|own| *own == coefficient.value)? + 1;
        let set = reader.count("set")?.value;
        let interpolation = interpolation_of(reader);
        let text = self.file_text(file, name, what)?;
        let problem = |message: String, help: &str| {
            self.fail::<TableFamily>(file.span, format!("{what}: `{name}`: {message}"), help)
        };
        let all = match polars(&text, set) {
            Ok(all) => all,
            Err(error) => {
                return problem(
                    error.to_string(),
                    "specify an airfoil file of AeroDyn, or a file of profile coefficients of HAWC2",
                );
            }
        };
        if count == 1 && all.len() > 1 {
            let message = format!("the file has {} polars", all.len());
            let help = "write two expressions in `of`: the angle of attack, and the Reynolds number or the relative thickness of the file";
            return problem(message, help);
        }
        let table = |polar: &Polar| {
            let rows: Vec<(f64, f64)> = polar.rows.iter().map(|row| (row[0], row[column])).collect();
            Some((polar.at, Table::new(&rows, interpolation, Extrapolation::Constant).ok()?))
        };
        let tables: Option<Vec<_>> = all.iter().map(table).collect();
        let Some(tables) = tables else {
            let message =
                "the angles of attack of a polar do not ascend strictly, or there are fewer than two";
            return problem(message.to_owned(), "sort its rows");
        };
        TableFamily::new(tables).map_or_else(
            || {
                let message =
                    "the Reynolds numbers or relative thicknesses of its polars do not ascend strictly";
                problem(message.to_owned(), "sort the polars")
            },
            Some,
        )
    }
}
