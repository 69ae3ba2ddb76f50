//! Heights over x and y, such as those of a road: expressions, tables over x, grids, random profiles, and sums of these.

use std::f64::consts::TAU;
use std::sync::Arc;

use lissom_mechanics::registry::{Force, ForceFunction};

use crate::expression::noise;
use crate::files::data_file::grid;
use crate::format::keys::{Key, Shape, choice, optional, table_keys, unitless};
use crate::functions::table::{Extrapolation, Interpolation, Table};
use crate::functions::table_family::TableFamily;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::reading::table_values::{interpolation_of, table_key_in};
use crate::text::{Node, Value};

/// Classes of roads in ISO 8608, from the smoothest; each is four times as rough as the one before.
const CLASSES: [&str; 8] = ["A", "B", "C", "D", "E", "F", "G", "H"];

/// Largest number of heights in a sum.
const MAX_HEIGHTS: usize = 16;
/// Length over which a random profile rises [m].
const RISE: f64 = 5.0;

/// Keys of a height field.
fn height_keys() -> Vec<Key> {
    let mut keys = table_keys();
    keys.extend([
        unitless("grid", Shape::Text, "a text file: the first line is `x` and the values of y, each further line x and the heights there"),
        unitless("class", choice(&CLASSES), "class of a random profile over x in ISO 8608"),
        unitless("seed", Shape::Count(0, 1 << 53), "which of the random profiles").or_count(1),
        optional("length", Shape::Positive, "m", "length after which the random profile repeats").or_number(500.0),
        optional("start", Shape::Number, "m", "x at which the random profile begins, after a plane; it rises over 5 m").or_number(0.0),
    ]);
    keys
}

/// A sum of heights.
#[derive(Debug)]
struct Sum(Vec<Force>);

impl ForceFunction for Sum {
    fn evaluate(&self, x: f64, y: f64) -> [f64; 3] {
        self.0.iter().fold([0.0; 3], |sum, field| {
            let own = field.evaluate(x, y);
            [0, 1, 2].map(|k| sum[k] + own[k])
        })
    }
}

/// A random profile, which is zero up to its start, rises, and repeats.
#[derive(Debug)]
struct RandomProfile {
    table: Table,
    start: f64,
}

impl ForceFunction for RandomProfile {
    fn evaluate(&self, x: f64, y: f64) -> [f64; 3] {
        let part = ((x - self.start) / RISE).clamp(0.0, 1.0);
        let [rise, slope] = [part * part * (3.0 - 2.0 * part), 6.0 * part * (1.0 - part) / RISE];
        let [height, by_x, _] = ForceFunction::evaluate(&self.table, x, y);
        [rise * height, rise * by_x + slope * height, 0.0]
    }
}

impl Context<'_> {
    /// A height over `x` and `y`.
    pub(crate) fn height_field(&self, node: &Node, what: &str) -> Option<Force> {
        match &node.value {
            Value::List(list) => {
                if list.len() > MAX_HEIGHTS || list.iter().any(|part| matches!(part.value, Value::List(_))) {
                    let message = format!("{what} is a list of more than {MAX_HEIGHTS} heights, or of lists");
                    return self.fail(node.span, message, "add heights in one expression, table or grid");
                }
                let parts: Vec<_> = list.iter().map(|part| self.height_field(part, what)).collect();
                Some(Arc::new(Sum(parts.into_iter().collect::<Option<_>>()?)))
            }
            Value::Table(_) => {
                let reader = Reader::open(self, node, (what.to_owned(), node.span), height_keys())?;
                let rows = table_key_in(&reader).filter(|word| *word != "interpolation");
                let forms = ["grid", "class"].into_iter().filter(|word| reader.has(word)).chain(rows);
                if let [first, second, ..] = forms.collect::<Vec<_>>().as_slice() {
                    let message = format!("{what} has both `{first}` and `{second}`");
                    return self.fail(
                        node.span,
                        message,
                        "remove one of them, or write a list of two tables, which are added",
                    );
                }
                let random = ["seed", "length", "start"].into_iter().find(|word| reader.has(word));
                if let Some(word) = random.filter(|_| !reader.has("class")) {
                    let message = format!("{what} has `{word}`, but no `class`");
                    return self.fail(node.span, message, "add `class = \"C\"`, or remove it");
                }
                if reader.has("class") {
                    return self.random_profile(&reader, node).map(|profile| Arc::new(profile) as Force);
                }
                match reader.node("grid") {
                    Some(file) => self.grid(&reader, file).map(|family| Arc::new(family) as Force),
                    None => Some(Arc::new(self.table_of(&reader, node, Extrapolation::Constant)?)),
                }
            }
            _ => self.force(node, what, &["x", "y"]),
        }
    }

    fn grid(&self, reader: &Reader<'_, '_>, file: &Node) -> Option<TableFamily> {
        let (what, name) = (&reader.what, reader.text("grid")?.value);
        let text = self.file_text(file, name, what)?;
        let problem = |message: String, help: &str| {
            self.fail::<TableFamily>(file.span, format!("{what}: `{name}`: {message}"), help)
        };
        let (across, rows) = match grid(&text) {
            Ok(read) => read,
            Err(error) => {
                return problem(
                    error.to_string(),
                    "write `x,-2,0,2` in the first line, and x and the heights at these y in the others",
                );
            }
        };
        let interpolation = interpolation_of(reader);
        let table = |(column, y): (usize, &f64)| {
            let rows: Vec<(f64, f64)> = rows.iter().map(|row| (row[0], row[column + 1])).collect();
            Some((*y, Table::new(&rows, interpolation, Extrapolation::Constant).ok()?))
        };
        let Some(tables) = across.iter().enumerate().map(table).collect::<Option<Vec<_>>>() else {
            return problem(
                "the values of x do not ascend strictly, or there are fewer than two".to_owned(),
                "sort its lines",
            );
        };
        TableFamily::new(tables).or_else(|| {
            problem("the values of y in its first line do not ascend strictly".to_owned(), "sort its columns")
        })
    }

    fn random_profile(&self, reader: &Reader<'_, '_>, node: &Node) -> Option<RandomProfile> {
        let class = reader.choice("class")?.value;
        let (length, start) = (reader.number("length")?.value, reader.number("start")?.value);
        let seed = reader.count("seed")?.value as f64;
        if !(20.0..=20e3).contains(&length) {
            let message = format!("{} has a random profile of {length} m", reader.what);
            return self.fail(node.span, message, "specify a `length` from 20 to 20000 m");
        }
        let grade = CLASSES.iter().position(|own| *own == class)?;
        random_profile(i32::try_from(grade).ok()?, seed, [start, length])
    }
}

/// A sum of waves with random phases, whose spectrum over the spatial frequency is that of a class. All of them have the period `length`:
/// the frequencies are rounded to multiples of its reciprocal, and waves longer than twice the length are omitted.
fn random_profile(grade: i32, seed: f64, [start, length]: [f64; 2]) -> Option<RandomProfile> {
    // G(n₀) [m³] at n₀ = 0.1/m; G(n) = G(n₀) (n₀/n)² from 0.01 to 5 waves per metre, at 400 frequencies in geometric progression.
    let roughness = 16e-6 * 4_f64.powi(grade);
    let growth = (5.0_f64 / 0.01).ln() / 400.0;
    let waves: Vec<[f64; 3]> = (0..400)
        .map(|k| {
            let frequency = 0.01 * (growth * (f64::from(k) + 0.5)).exp();
            let density = roughness * (0.1 / frequency).powi(2);
            let phase = TAU * noise::uniform(seed, f64::from(k));
            [(2.0 * density * growth * frequency).sqrt(), TAU * (frequency * length).round() / length, phase]
        })
        .filter(|[_, number, _]| *number > 0.0)
        .collect();
    // Ten points of the shortest wave.
    let count = (length / 0.02).ceil() as usize;
    let rows: Vec<(f64, f64)> = (0..=count)
        .map(|index| {
            // The last row is the first one of the next period.
            let x = if index == count { 0.0 } else { length * index as f64 / count as f64 };
            let height: f64 =
                waves.iter().map(|[size, number, phase]| size * (number * x + phase).cos()).sum();
            (start + length * index as f64 / count as f64, height)
        })
        .collect();
    let table = Table::new(&rows, Interpolation::Spline, Extrapolation::Periodic).ok()?;
    Some(RandomProfile { table, start })
}

#[cfg(test)]
#[path = "../../tests/unit/reading/height_fields.rs"]
mod tests;
