//! Plots of results: one figure per output, or for several that are drawn together, with a panel for each unit. The drawing itself is done by `lissom-drawing`.

use lissom_drawing::{Axis as ChartAxis, Chart, Curve as ChartCurve, Drawing, Panel as ChartPanel, palette};
use lissom_mechanics::diagnostics::Diagnose;

use super::{Column, CurveRecord, Record};

/// Most points of a drawn curve.
const POINTS: usize = 2000;

/// Smallest amplitude that is drawn, relative to the largest.
const DECADES: f64 = 1e-8;

/// Position of a contact: beside it gaps, which are in metres as well, would be a straight line.
const CENTRE: &str = "centre of contact";

/// Curves of a panel that are drawn without dashes.
const SOLID: usize = 3;

/// A figure that could not be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.diagnostic())]
pub struct FigureError {
    /// Name of the figure.
    pub figure: String,
    /// Why not.
    pub reason: String,
}

impl FigureError {
    /// The figure of this name, and why it cannot be drawn.
    pub fn new(figure: &str, reason: &str) -> Self {
        Self { figure: figure.to_owned(), reason: reason.to_owned() }
    }
}

/// A drawn figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Graphic(Drawing);

impl From<Drawing> for Graphic {
    fn from(drawing: Drawing) -> Self {
        Self(drawing)
    }
}

impl Graphic {
    /// Name, fit for a file.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// The text of an SVG file.
    ///
    /// # Errors
    /// If it is empty.
    pub fn svg(&self) -> Result<String, FigureError> {
        self.0.svg().map_err(|error| FigureError::new(self.name(), &error.to_string()))
    }

    /// The bytes of a PNG file.
    ///
    /// # Errors
    /// If it is empty or too large.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.0.png().map_err(|error| FigureError::new(self.name(), &error.to_string()))
    }
}

/// One drawing: curves over time, those of a common unit in one panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name, fit for a file.
    pub name: String,
    title: String,
    axis: Axis,
    panels: Vec<Panel>,
}

/// Abscissa of curves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    label: String,
    /// Whether values are drawn over decades.
    is_decadic: bool,
    /// Whether points follow each other along the axis.
    is_ordered: bool,
}

impl Axis {
    /// Time.
    pub(super) fn time() -> Self {
        Self { label: "time [s]".to_owned(), is_decadic: false, is_ordered: true }
    }

    /// Frequency, with amplitudes over decades.
    pub(super) fn frequency() -> Self {
        Self { label: "frequency [Hz]".to_owned(), is_decadic: true, is_ordered: true }
    }

    /// Another column.
    pub(super) fn column(label: &str) -> Self {
        Self { label: label.to_owned(), is_decadic: false, is_ordered: false }
    }
}

/// Curves with a common unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panel {
    /// Quantities in words.
    pub(super) quantity: String,
    /// Unit, empty for none.
    pub(super) unit: String,
    /// Columns that are in it.
    pub(super) names: Vec<String>,
    /// Curves of the panel.
    pub(super) curves: Vec<Curve>,
}

/// A name and points (time, value).
type Curve = (String, Vec<(f64, f64)>);

/// A name that files can have.
pub(super) fn file_name(name: &str) -> String {
    name.replace(|c: char| !c.is_alphanumeric() && c != '-' && c != '.', "_")
}

/// Label of an axis: some kinds of output record several quantities, which are distinguished by their units.
pub fn quantity_of(column: &Column) -> String {
    let quantity = column.quantity.as_str();
    let word = match (quantity, column.unit.as_str()) {
        ("relative" | "relative motion", "rad") => "relative rotation",
        ("relative" | "relative motion", "m") => "relative displacement",
        ("relative", "rad/s") => "relative angular velocity",
        ("relative", "m/s") => "relative velocity",
        ("momentum", "N m s") => "angular momentum",
        ("spring", "N") => "force of spring",
        ("spring", "N m") => "moment of spring",
        ("spring", "m") => "elongation",
        ("spring", "rad") => "rotation",
        ("spring", "m/s") => "rate of elongation",
        ("spring", "rad/s") => "rate of rotation",
        ("contact force", "m") if column.component.starts_with('x') => CENTRE,
        ("contact force", "m") => "gap",
        ("contact force", "m/s") => "sliding velocity",
        _ => quantity,
    };
    word.to_owned()
}

/// The figures of a record: one per output. Round-off is drawn as zero.
pub fn figures(record: &Record, title: &str) -> Vec<Figure> {
    let is_round_off = record.round_off();
    let points = |column: usize| record.drawn(column, is_round_off[column]);
    figures_of(&record.columns, points, (title, usize::MAX))
}

/// Names of the outputs that have figures, in their order.
pub fn drawn_outputs(columns: &[Column]) -> Vec<&str> {
    let mut known = std::collections::BTreeSet::new();
    columns.iter().map(|column| column.plot.as_str()).filter(|plot| known.insert(*plot)).collect()
}

/// The figures of curves: one per output, of the first `count` outputs. Round-off is drawn as zero.
pub fn figures_of_curves(record: &CurveRecord, title: &str, count: usize) -> Vec<Figure> {
    let is_round_off = record.round_off();
    let points = |column: usize| {
        let factor = if is_round_off[column] { 0.0 } else { 1.0 };
        record.points(column).into_iter().map(|(time, value)| (time, factor * value)).collect()
    };
    figures_of(record.columns(), points, (title, count))
}

fn figures_of(
    columns: &[Column],
    points: impl Fn(usize) -> Vec<(f64, f64)>,
    (title, count): (&str, usize),
) -> Vec<Figure> {
    let mut figures: Vec<(&str, Figure)> = Vec::new();
    for (which, column) in columns.iter().enumerate() {
        let plot = column.plot.as_str();
        let known = figures.iter().position(|(known, _)| *known == plot);
        if known.is_none() && figures.len() == count {
            continue;
        }
        let index = known.unwrap_or_else(|| {
            let name = plot.replace(|c: char| !c.is_alphanumeric() && c != '-', "_");
            // Names that differ only in characters that file names cannot contain get a number.
            let alike = |name: &str| figures.iter().any(|(_, figure)| figure.name == name);
            let name = std::iter::once(name.clone())
                .chain((2..figures.len() + 3).map(|number| format!("{name}_{number}")))
                .find(|name| !alike(name))
                .unwrap_or(name);
            let title = if title.is_empty() { plot.to_owned() } else { format!("{title}: {plot}") };
            figures.push((plot, Figure { name, title, axis: Axis::time(), panels: Vec::new() }));
            figures.len() - 1
        });
        let panels = &mut figures[index].1.panels;
        let curve = (column.label(columns), thinned(points(which)));
        match panels.iter_mut().find(|panel| panel.takes(column)) {
            Some(panel) => {
                panel.add_quantity(&quantity_of(column));
                panel.curves.push(curve);
            }
            None => panels.push(Panel {
                quantity: quantity_of(column),
                unit: column.unit.clone(),
                names: vec![column.name()],
                curves: vec![curve],
            }),
        }
    }
    figures.into_iter().map(|(_, figure)| figure).collect()
}

/// At most [`POINTS`] points of a curve: both extremes of every stretch of time, and both ends.
fn thinned(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.retain(|point| point.0.is_finite() && point.1.is_finite());
    if points.len() <= POINTS {
        return points;
    }
    let size = points.len().div_ceil(POINTS / 2 - 1);
    let mut kept = Vec::with_capacity(POINTS);
    kept.extend(points.first());
    for stretch in points.chunks(size) {
        let by_value = |a: &(usize, &(f64, f64)), b: &(usize, &(f64, f64))| a.1.1.total_cmp(&b.1.1);
        let least = stretch.iter().enumerate().min_by(by_value).map_or(0, |(index, _)| index);
        let most = stretch.iter().enumerate().max_by(by_value).map_or(0, |(index, _)| index);
        kept.push(stretch[least.min(most)]);
        if least != most {
            kept.push(stretch[least.max(most)]);
        }
    }
    kept.extend(points.last());
    kept
}

/// The points of a path at which it has moved by a fifth of a percent of its extent since the last, and both ends.
fn thinned_path(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.retain(|point| point.0.is_finite() && point.1.is_finite());
    let extent = |of: fn(&(f64, f64)) -> f64| {
        let all = || points.iter().map(of);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let least = [extent(|point| point.0), extent(|point| point.1)].map(|extent| 0.002 * extent);
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let is_far = kept.last().is_none_or(|last: &(f64, f64)| {
            (point.0 - last.0).abs() > least[0] || (point.1 - last.1).abs() > least[1]
        });
        if is_far || index + 1 == points.len() {
            kept.push(*point);
        }
    }
    kept
}

impl Figure {
    /// A figure of panels whose curves contain all their points.
    pub(super) fn of(name: &str, title: &str, axis: Axis, mut panels: Vec<Panel>) -> Self {
        for (_, points) in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
            let all = std::mem::take(points);
            *points = if axis.is_ordered { thinned(all) } else { thinned_path(all) };
        }
        Self { name: name.to_owned(), title: title.to_owned(), axis, panels }
    }

    /// Draws it.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn draw(&self) -> Result<Graphic, FigureError> {
        let panels: Vec<ChartPanel> = self.panels.iter().filter_map(|panel| panel.draw(&self.axis)).collect();
        if panels.is_empty() {
            return Err(FigureError::new(&self.name, "it has no finite values"));
        }
        Ok(Chart { title: self.title.clone(), ..Chart::new(&self.name, panels) }.draw().into())
    }
}

impl Panel {
    /// Whether a column of a figure is drawn in it: columns of one unit, of which the positions of contacts are in a panel of their own.
    pub(super) fn takes(&self, column: &Column) -> bool {
        self.unit == column.unit && (self.quantity == CENTRE) == (quantity_of(column) == CENTRE)
    }

    /// Adds a quantity to those on its axis.
    pub(super) fn add_quantity(&mut self, quantity: &str) {
        if !self.quantity.split(", ").any(|known| known == quantity) {
            self.quantity = format!("{}, {quantity}", self.quantity);
        }
    }

    /// Curves and axes, if there is anything to draw.
    fn draw(&self, axis: &Axis) -> Option<ChartPanel> {
        let all = || self.curves.iter().flat_map(|(_, points)| points);
        let largest = all().fold(0.0, |most: f64, point| point.1.abs().max(most));
        // Decades far below the largest value are round-off.
        let is_shown = |point: &&(f64, f64)| !axis.is_decadic || point.1 > DECADES * largest;
        all().find(is_shown)?;
        let (factor, unit) = prefixed(largest, &self.unit);
        let curve = |(index, (name, points)): (usize, &Curve)| ChartCurve {
            name: name.clone(),
            points: points.iter().filter(is_shown).map(|(x, value)| (*x, value / factor)).collect(),
            // From the fourth on dashes, through which a curve below still shows: a sum below its parts.
            is_dashed: index >= SOLID,
            ..ChartCurve::new(palette(index))
        };
        let label = format!("{}{unit}", self.quantity);
        let y = if axis.is_decadic { ChartAxis::logarithmic(&label) } else { ChartAxis::new(&label) };
        let mut x = ChartAxis::new(&axis.label);
        if axis.is_ordered {
            let least = |low: f64, point: &(f64, f64)| low.min(point.0);
            let most = |high: f64, point: &(f64, f64)| high.max(point.0);
            x.range = Some([all().fold(f64::INFINITY, least), all().fold(f64::NEG_INFINITY, most)]);
        }
        Some(ChartPanel { x, y, curves: self.curves.iter().enumerate().map(curve).collect() })
    }
}

/// Powers of ten and their prefixes.
const PREFIXES: [(f64, &str); 8] =
    [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")];

/// A factor that leaves numbers of few digits on the axis, and the unit times this factor, in brackets.
fn prefixed(most: f64, unit: &str) -> (f64, String) {
    // Units that a model gives may have a prefix already.
    let first = unit.split([' ', '/']).next().unwrap_or_default();
    let takes_prefix = ["m", "N", "J", "W", "Pa", "rad"].contains(&first);
    let plain = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
    if !takes_prefix || (0.1..1e4).contains(&most) {
        return (1.0, plain);
    }
    let found = PREFIXES.iter().find(|(factor, _)| most >= *factor && most < 1e4 * factor);
    found.map_or((1.0, plain), |(factor, prefix)| (*factor, format!(" [{prefix}{unit}]")))
}

#[cfg(test)]
#[path = "../../tests/unit/output/plot.rs"]
mod tests;
