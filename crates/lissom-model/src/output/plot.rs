//! Plots of results: one figure per output, or for several that are drawn together, with a panel for each unit. The drawing itself is done by `lissom-drawing`.

use lissom_drawing::{Axis as ChartAxis, Chart, Curve as ChartCurve, Drawing, Panel as ChartPanel, palette};
use lissom_mechanics::diagnostics::Diagnose;

use super::{Column, CurveRecord, Record};

/// Most points of a drawn curve.
const POINTS: usize = 2000;

/// Smallest amplitude that is drawn, relative to the largest.
const DECADES: f64 = 1e-8;

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
    let points =
        |column: usize| record.times.iter().copied().zip(record.values[column].iter().copied()).collect();
    figures_of(&record.columns, points, title)
}

/// The figures of curves: one per output.
pub fn figures_of_curves(record: &CurveRecord, title: &str) -> Vec<Figure> {
    figures_of(record.columns(), |column| record.points(column), title)
}

fn figures_of(columns: &[Column], points: impl Fn(usize) -> Vec<(f64, f64)>, title: &str) -> Vec<Figure> {
    let mut figures: Vec<(&str, Figure)> = Vec::new();
    for (which, column) in columns.iter().enumerate() {
        let plot = column.plot.as_str();
        let known = figures.iter().position(|(known, _)| *known == plot);
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
        match panels.iter_mut().find(|panel| panel.unit == column.unit) {
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
        let svg = figures[0].draw().unwrap().svg().unwrap();
        for words in ["Tip crank: mid span", "displacement [m]", "time [s]", ">x<", ">z<", "#009e73"] {
            assert!(svg.contains(words), "{words}");
        }
        let svg = figures[1].draw().unwrap().svg().unwrap();
        for words in ["Tip crank: root", "reaction [N]", "reaction [N m]"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(figures[1].draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn units_distinguish_the_quantities_of_one_output() {
        for (quantity, unit, words) in [
            ("relative", "rad", "relative rotation"),
            ("relative motion", "rad", "relative rotation"),
            ("relative", "m", "relative displacement"),
            ("relative motion", "m", "relative displacement"),
            ("relative", "rad/s", "relative angular velocity"),
            ("relative", "m/s", "relative velocity"),
            ("momentum", "N s", "momentum"),
            ("momentum", "N m s", "angular momentum"),
            ("spring", "N", "force of spring"),
            ("spring", "N m", "moment of spring"),
            ("spring", "m", "elongation"),
            ("spring", "rad", "rotation"),
            ("spring", "m/s", "rate of elongation"),
            ("spring", "rad/s", "rate of rotation"),
            ("velocity", "m/s", "velocity"),
        ] {
            assert_eq!(quantity_of(&Column::new("a", "x", quantity, unit)), words, "{quantity} [{unit}]");
        }
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
        assert!(
            figures(&zero, "")
                .iter()
                .all(|figure| figure.draw().unwrap().png().is_ok() && figure.draw().unwrap().svg().is_ok())
        );
        let huge = record(10, |t| vec![1e300 * t, -1e300, f64::NAN], &displacement());
        assert!(figures(&huge, "").iter().all(|figure| figure.draw().unwrap().png().is_ok()));
        let one = record(1, |_| vec![1.0; 3], &displacement());
        assert!(figures(&one, "").iter().all(|figure| figure.draw().unwrap().png().is_ok()));
        let nothing = record(10, |_| vec![f64::NAN; 3], &displacement());
        assert!(figures(&nothing, "")[0].draw().is_err());
    }

    /// Two outputs in one plot, one of them an expression: one figure, whose legend has their names.
    #[test]
    fn outputs_of_one_plot_are_drawn_together() {
        let columns = [
            Column::new("left", "f3", "spring force", "N").in_plot(Some("forces".to_owned())),
            Column::new("sum", "value", "sum", "N").in_plot(Some("forces".to_owned())),
            Column::new("left", "m1", "spring force", "N m").in_plot(Some("forces".to_owned())),
            Column::new("alone", "value", "alone", "kN"),
            Column::new("tip", "u1", "displacement", "m"),
        ];
        let of = figures(&record(5, |t| vec![t; 5], &columns), "press");
        let titles: Vec<&str> = of.iter().map(|own| own.title.as_str()).collect();
        assert_eq!(titles, ["press: forces", "press: alone", "press: tip"]);
        let panel = |figure: usize, index: usize| {
            let own: &Panel = &of[figure].panels[index];
            let names: Vec<&str> = own.curves.iter().map(|(name, _)| name.as_str()).collect();
            format!("{} [{}]: {}", own.quantity, own.unit, names.join(" "))
        };
        assert_eq!(panel(0, 0), "spring force, sum [N]: left.f3 sum");
        assert_eq!(panel(0, 1), "spring force [N m]: left.m1");
        assert_eq!(panel(1, 0), "alone [kN]: alone");
        assert_eq!(panel(2, 0), "displacement [m]: u1");
    }

    #[test]
    fn figures_have_different_names_and_panels_by_unit() {
        let outputs = ["a b", "a_b", "a.b", "a-b"];
        let mut columns = outputs.map(|output| Column::new(output, "x", "displacement", "m")).to_vec();
        columns.push(Column::new("a_b", "f", "spring", "N"));
        columns.push(Column::new("a_b", "y", "displacement", "m"));
        let of = figures(&record(5, |t| vec![t; 6], &columns), "");
        let names: Vec<(&str, &str)> = of.iter().map(|own| (own.name.as_str(), own.title.as_str())).collect();
        assert_eq!(names, [("a_b", "a b"), ("a_b_2", "a_b"), ("a_b_3", "a.b"), ("a-b", "a-b")]);
        let panels: Vec<(&str, &str, usize)> = of[1]
            .panels
            .iter()
            .map(|own| (own.quantity.as_str(), own.unit.as_str(), own.curves.len()))
            .collect();
        assert_eq!(panels, [("displacement", "m", 2), ("force of spring", "N", 1)]);
        assert_eq!(of[1].panels[1].names, ["a_b.f"]);
        assert_eq!(file_name("a b.c-d/ä1"), "a_b.c-d_ä1");
    }

    /// Both extremes of each stretch, in the order of time.
    #[test]
    fn thinned_curves_are_made_of_the_extremes_of_equal_stretches() {
        for rows in [POINTS, POINTS + 1, 3 * POINTS - 7] {
            let wave = |k: usize| ((7 * k) % 11) as f64;
            let all: Vec<(f64, f64)> = (0..rows).map(|k| (k as f64, wave(k))).collect();
            let kept = thinned(all.clone());
            assert!(kept.len() <= POINTS && (rows > POINTS || kept == all), "{rows}: {}", kept.len());
            assert_eq!([kept.first(), kept.last()], [all.first(), all.last()]);
            assert!(kept.iter().all(|point| all[point.0 as usize] == *point));
            if rows > POINTS {
                let size = rows.div_ceil(POINTS / 2 - 1);
                for stretch in all.chunks(size) {
                    let within: Vec<f64> = kept
                        .iter()
                        .filter(|point| stretch[0].0 <= point.0 && point.0 <= stretch[stretch.len() - 1].0)
                        .map(|point| point.1)
                        .collect();
                    let most = stretch.iter().map(|point| point.1).fold(f64::MIN, f64::max);
                    let least = stretch.iter().map(|point| point.1).fold(f64::MAX, f64::min);
                    assert!(within.contains(&most) && within.contains(&least), "{rows}: {stretch:?}");
                }
            }
        }
        let gaps = thinned(vec![(0.0, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0), (2.0, 3.0)]);
        assert_eq!(gaps, [(0.0, 1.0), (2.0, 3.0)]);
    }

    #[test]
    fn points_of_a_path_are_a_fifth_of_a_percent_of_its_extent_apart() {
        // An ellipse away from the origin, with extents of 20 and 4.
        let at = |k: u32| {
            let angle = f64::from(k) * std::f64::consts::TAU / 1e5;
            (100.0 + 10.0 * angle.cos(), -50.0 + 2.0 * angle.sin())
        };
        let mut all: Vec<(f64, f64)> = (0..=100_000).map(at).collect();
        all.insert(5, (f64::NAN, 0.0));
        all.insert(9, (0.0, f64::INFINITY));
        let kept = thinned_path(all);
        assert_eq!(kept.first(), Some(&at(0)));
        assert_eq!(kept.last(), Some(&at(100_000)));
        assert!(kept.len() < 2000);
        for pair in kept.windows(2).take(kept.len() - 2) {
            let apart = ((pair[1].0 - pair[0].0).abs() / 20.0).max((pair[1].1 - pair[0].1).abs() / 4.0);
            assert!(apart > 0.002 && apart < 0.00205, "{pair:?}: {apart}");
        }
        // Along one axis alone.
        let line: Vec<(f64, f64)> = (0..=10_000).map(|k| (3.0, f64::from(k))).collect();
        for kept in [thinned_path(line.clone()), thinned_path(line.iter().map(|&(x, y)| (y, x)).collect())] {
            assert!((450..=501).contains(&kept.len()), "{}", kept.len());
        }
    }

    #[test]
    fn panels_are_drawn_with_prefixes_dashes_and_ranges() {
        let curve =
            |scale: f64| ("c".to_owned(), vec![(1.0, scale), (2.0, -3.0 * scale), (4.0, 1e-9 * scale)]);
        let panel = Panel {
            quantity: "force".to_owned(),
            unit: "N".to_owned(),
            names: Vec::new(),
            curves: [1e4, 2e3, 3e3, 5.0].map(curve).to_vec(),
        };
        let time = panel.draw(&Axis::time()).unwrap();
        assert_eq!((time.x.label.as_str(), time.y.label.as_str()), ("time [s]", "force [kN]"));
        assert_eq!(time.x.range, Some([1.0, 4.0]));
        assert_eq!(time.curves[0].points, [(1.0, 10.0), (2.0, -30.0), (4.0, 1e-9 * 1e4 / 1e3)]);
        let dashes: Vec<bool> = time.curves.iter().map(|own| own.is_dashed).collect();
        assert_eq!(dashes, [false, false, false, true]);
        let path = panel.draw(&Axis::column("x [m]")).unwrap();
        assert_eq!((path.x.label.as_str(), path.x.range), ("x [m]", None));
        // Over decades neither negative values are drawn nor those far below the largest one.
        let decades = panel.draw(&Axis::frequency()).unwrap();
        assert_eq!(decades.x.label, "frequency [Hz]");
        assert_eq!(decades.curves[0].points, [(1.0, 10.0)]);
        assert_eq!(decades.curves[3].points, [(1.0, 5e-3)]);
        let low = Panel { curves: vec![("c".to_owned(), vec![(1.0, -1.0)])], ..panel.clone() };
        assert!(low.draw(&Axis::frequency()).is_none() && low.draw(&Axis::time()).is_some());
        // Prefixes at their limits.
        for (most, unit, wanted) in [
            (0.1, "J", (1.0, " [J]")),
            (0.0999, "J", (1e-3, " [mJ]")),
            (1e4, "W", (1e3, " [kW]")),
            (1e7, "Pa", (1e6, " [MPa]")),
            (1e10, "rad", (1e9, " [Grad]")),
            (1e-3, "m/s", (1e-3, " [mm/s]")),
            (9.9e-4, "m/s", (1e-6, " [µm/s]")),
            (1e-9, "m", (1e-9, " [nm]")),
            (1e-12, "m", (1e-12, " [pm]")),
            (1e5, "1/m", (1.0, " [1/m]")),
            (1e5, "kN", (1.0, " [kN]")),
            (1e-3, "mm", (1.0, " [mm]")),
            (1e20, "m", (1.0, " [m]")),
        ] {
            assert_eq!(prefixed(most, unit), (wanted.0, wanted.1.to_owned()), "{most} {unit}");
        }
    }
}
