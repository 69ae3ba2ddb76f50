//! Plots of results: one figure per output, with a panel for each unit. The drawing itself is done by kuva.

use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::render::figure::Figure as Panels;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use kuva::render::theme::Theme;

use super::{Column, Record, render};

/// Most points of a drawn curve.
const POINTS: usize = 2000;

/// Smallest amplitude that is drawn, relative to the largest.
const DECADES: f64 = 1e-8;

/// Curves of a panel that are drawn without dashes.
const SOLID: usize = 3;

/// Width of a figure.
const WIDTH: f64 = 760.0;
/// Height of a figure of one panel.
const HEIGHT: f64 = 460.0;
/// Height of each of several panels.
const PANEL_HEIGHT: f64 = 340.0;

/// Blue, vermilion, green, purple, orange, sky blue, black (after Okabe and Ito 2008): told apart also by
/// people who do not see all colours, and on paper.
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

/// A figure that could not be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the figure `{figure}` cannot be drawn: {reason}")]
pub struct FigureError {
    /// Name of the figure.
    pub figure: String,
    /// Why not.
    pub reason: String,
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

/// What curves are drawn over.
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
    /// Quantity in words.
    pub(super) quantity: String,
    /// Unit, empty for none.
    pub(super) unit: String,
    /// Columns that are in it.
    pub(super) names: Vec<String>,
    /// Its curves.
    pub(super) curves: Vec<Curve>,
}

/// A name and points (time, value).
type Curve = (String, Vec<(f64, f64)>);

/// A name that files can have.
pub(super) fn file_name(name: &str) -> String {
    name.replace(|c: char| !c.is_alphanumeric() && c != '-' && c != '.', "_")
}

/// What stands beside an axis: some kinds of output record several quantities, which their units tell apart.
pub(super) fn quantity_of(column: &Column) -> String {
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
        _ => quantity,
    };
    word.to_owned()
}

/// The figures of a record: one per output.
pub fn figures(record: &Record, title: &str) -> Vec<Figure> {
    let mut figures: Vec<(&str, Figure)> = Vec::new();
    for (column, values) in record.columns.iter().zip(&record.values) {
        let output = column.output.as_str();
        let known = figures.iter().position(|(known, _)| *known == output);
        let index = known.unwrap_or_else(|| {
            let name = output.replace(|c: char| !c.is_alphanumeric() && c != '-', "_");
            // Names that differ in characters which no file name takes get a number.
            let alike = |name: &str| figures.iter().any(|(_, figure)| figure.name == name);
            let name = std::iter::once(name.clone())
                .chain((2..figures.len() + 3).map(|number| format!("{name}_{number}")))
                .find(|name| !alike(name))
                .unwrap_or(name);
            let title = if title.is_empty() { output.to_owned() } else { format!("{title}: {output}") };
            figures.push((output, Figure { name, title, axis: Axis::time(), panels: Vec::new() }));
            figures.len() - 1
        });
        let panels = &mut figures[index].1.panels;
        let points = record.times.iter().copied().zip(values.iter().copied()).collect();
        let curve = (column.component.clone(), thinned(points));
        match panels.iter_mut().find(|panel| panel.unit == column.unit) {
            Some(panel) => panel.curves.push(curve),
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
    /// A figure of panels whose curves hold all their points.
    pub(super) fn of(name: &str, title: &str, axis: Axis, mut panels: Vec<Panel>) -> Self {
        for (_, points) in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
            let all = std::mem::take(points);
            *points = if axis.is_ordered { thinned(all) } else { thinned_path(all) };
        }
        Self { name: name.to_owned(), title: title.to_owned(), axis, panels }
    }

    /// The drawing as an SVG text.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        Ok(render::svg(&self.draw()?))
    }

    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    /// If there is nothing to draw, or the drawing library fails.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        render::png(self.draw()?).map_err(|reason| self.failure(reason))
    }

    fn failure(&self, reason: impl Into<String>) -> FigureError {
        FigureError { figure: self.name.clone(), reason: reason.into() }
    }

    fn draw(&self) -> Result<Scene, FigureError> {
        let mut panels: Vec<(Vec<Plot>, Layout)> =
            self.panels.iter().filter_map(|panel| panel.draw(&self.axis)).collect();
        if panels.len() > 1 {
            let (plots, layouts): (Vec<_>, Vec<_>) = panels.into_iter().unzip();
            let figure = Panels::new(plots.len(), 1)
                .with_title(self.title.as_str())
                .with_title_size(16)
                .with_cell_size(WIDTH, PANEL_HEIGHT)
                .with_plots(plots)
                .with_layouts(layouts);
            return Ok(figure.render());
        }
        let (plots, layout) = panels.pop().ok_or_else(|| self.failure("it has no finite values"))?;
        let layout = layout.with_height(HEIGHT).with_title(self.title.as_str()).with_title_size(16);
        Ok(render_multiple(plots, layout))
    }
}

impl Panel {
    /// Curves and axes, if there is anything to draw.
    fn draw(&self, axis: &Axis) -> Option<(Vec<Plot>, Layout)> {
        let all = || self.curves.iter().flat_map(|(_, points)| points);
        let largest = all().fold(0.0, |most: f64, point| point.1.abs().max(most));
        // Decades far below the largest value are round-off.
        let is_shown = |point: &&(f64, f64)| !axis.is_decadic || point.1 > DECADES * largest;
        let points = || all().filter(is_shown);
        points().next()?;
        let (factor, unit) = prefixed(largest, &self.unit);
        let curve = |(index, (name, points)): (usize, &Curve)| {
            let line = LinePlot::new()
                .with_data(points.iter().filter(is_shown).map(|(x, value)| (*x, value / factor)))
                .with_color(COLOURS[index % COLOURS.len()])
                .with_stroke_width(1.6);
            // From the fourth on dashes, through which a curve below still shows: a sum below its parts.
            let line = if index < SOLID { line } else { line.with_dashed() };
            Plot::Line(if name.is_empty() { line } else { line.with_legend(name.as_str()) })
        };
        let plots: Vec<Plot> = self.curves.iter().enumerate().map(curve).collect();
        let theme = Theme { grid_color: "#e4e4e4".into(), legend_border: "none".into(), ..Theme::light() };
        let mut layout = Layout::auto_from_plots(&plots)
            .with_width(WIDTH)
            .with_height(PANEL_HEIGHT)
            .with_theme(theme)
            .with_x_label(axis.label.as_str())
            .with_y_label(format!("{}{unit}", self.quantity))
            .with_legend_position(LegendPosition::OutsideRightTop);
        let bounds = |of: fn(&(f64, f64)) -> f64| {
            points()
                .map(of)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let (first, last) = bounds(|point| point.0);
        if axis.is_decadic {
            return Some((plots, layout.with_log_y()));
        }
        if last > first && axis.is_ordered {
            layout = layout.with_x_axis_min(first).with_x_axis_max(last + 1e-9 * (last - first));
        }
        // A constant would have an axis without extent.
        let room = |(low, high): (f64, f64)| {
            let is_constant = high - low <= 1e-12 * high.abs().max(low.abs());
            is_constant.then(|| if high == 0.0 { 1.0 } else { 0.1 * high.abs() })
        };
        let (low, high) = bounds(|point| point.1);
        let (low, high) = (low / factor, high / factor);
        if let Some(room) = room((low, high)) {
            layout = layout.with_y_axis_min(low - room).with_y_axis_max(high + room);
        }
        if let Some(room) = room((first, last)).filter(|_| !axis.is_ordered) {
            layout = layout.with_x_axis_min(first - room).with_x_axis_max(last + room);
        }
        Some((plots, layout))
    }
}

/// Powers of ten and their prefixes.
const PREFIXES: [(f64, &str); 8] =
    [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")];

/// A factor that leaves numbers of few digits on the axis, and the unit times this factor, in brackets.
fn prefixed(most: f64, unit: &str) -> (f64, String) {
    let takes_prefix = ["m", "N", "J", "W", "Pa", "rad"].iter().any(|known| unit.starts_with(known));
    let plain = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
    if !takes_prefix || (0.1..1e4).contains(&most) {
        return (1.0, plain);
    }
    let found = PREFIXES.iter().find(|(factor, _)| most >= *factor && most < 1e4 * factor);
    found.map_or((1.0, plain), |(factor, prefix)| (*factor, format!(" [{prefix}{unit}]")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Column, Writer};

    fn record(rows: u32, value: impl Fn(f64) -> Vec<f64>, columns: &[Column]) -> Record {
        let mut record = Record::default();
        record.begin(columns).unwrap();
        for i in 0..rows {
            let time = f64::from(i) * 1e-4;
            record.row(time, &value(time)).unwrap();
        }
        record
    }

    fn displacement() -> Vec<Column> {
        ["x", "y", "z"].map(|component| Column::new("mid span", component, "displacement", "m")).to_vec()
    }

    #[test]
    fn figures_have_titles_labels_and_curves() {
        let mut columns = displacement();
        columns.push(Column::new("root", "force", "reaction", "N"));
        columns.push(Column::new("root", "moment", "reaction", "N m"));
        let record = record(5000, |t| vec![t.sin(), t.cos(), 0.0, 1.0, t], &columns);
        let figures = figures(&record, "Tip crank");
        let names: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
        assert_eq!(names, ["mid_span", "root"]);
        let svg = figures[0].svg().unwrap();
        for words in ["Tip crank: mid span", "displacement [m]", "time [s]", ">x<", ">z<", COLOURS[2]] {
            assert!(svg.contains(words), "{words}");
        }
        let svg = figures[1].svg().unwrap();
        for words in ["Tip crank: root", "reaction [N]", "reaction [N m]"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(figures[1].png().unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn small_and_large_values_get_a_prefix() {
        assert_eq!(prefixed(7e-3, "m"), (1e-3, " [mm]".to_owned()));
        assert_eq!(prefixed(0.5, "m"), (1.0, " [m]".to_owned()));
        assert_eq!(prefixed(2e4, "N m"), (1e3, " [kN m]".to_owned()));
        assert_eq!(prefixed(9999.0, "N"), (1.0, " [N]".to_owned()));
        assert_eq!(prefixed(1e-5, ""), (1.0, String::new()));
        assert_eq!(prefixed(0.0, "m"), (1.0, " [m]".to_owned()));
        assert_eq!(prefixed(1e-30, "m"), (1.0, " [m]".to_owned()));
    }

    #[test]
    fn thinning_keeps_extremes_and_ends() {
        let value = |t: f64| vec![if (t - 1.2345).abs() < 1e-5 { 9.0 } else { (50.0 * t).sin() }; 3];
        let record = record(100_000, value, &displacement());
        let points = thinned(record.times.iter().copied().zip(record.values[0].iter().copied()).collect());
        assert!(points.len() <= POINTS && points.len() > POINTS / 2, "{}", points.len());
        assert!(points.iter().any(|point| point.1 == 9.0));
        assert_eq!(points.first().unwrap().0, 0.0);
        assert_eq!(points.last().unwrap().0, *record.times.last().unwrap());
        assert!(points.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }

    #[test]
    fn constants_gaps_and_nothing_are_drawn_or_refused() {
        let zero = record(10, |_| vec![0.0; 3], &displacement());
        assert!(figures(&zero, "").iter().all(|figure| figure.png().is_ok() && figure.svg().is_ok()));
        let huge = record(10, |t| vec![1e300 * t, -1e300, f64::NAN], &displacement());
        assert!(figures(&huge, "").iter().all(|figure| figure.png().is_ok()));
        let one = record(1, |_| vec![1.0; 3], &displacement());
        assert!(figures(&one, "").iter().all(|figure| figure.png().is_ok()));
        let nothing = record(10, |_| vec![f64::NAN; 3], &displacement());
        assert!(figures(&nothing, "")[0].svg().is_err());
    }
}
