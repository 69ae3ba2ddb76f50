//! Plots of a sweep's table: collected scalars over varied numbers, and all of them as parallel coordinates.

use lissom_drawing::{Align, Axis, Chart, Curve, Drawing, Mark, Panel, palette};

use super::{FigureError, Graphic};

/// Most members that are drawn, evenly chosen.
const MAX_MEMBERS: usize = 2000;
/// Most dots that a line joins.
const MAX_OF_CURVE: usize = 200;
/// Most panels side by side, and one above the other.
const MAX_PANELS: usize = 6;
/// Width of a picture with a single column of panels [pixels].
const SINGLE: f64 = 640.0;
/// Size of a panel and of the parallel coordinates [pixels].
const PANEL: (f64, f64) = (340.0, 260.0);
const PARALLEL: (f64, f64) = (220.0, 460.0);

/// A column of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepAxis {
    /// Name of the axis.
    pub name: String,
    /// Value of the varied quantity in each member; of words, their number among those that occur.
    pub values: Vec<f64>,
    /// Whether the scale is logarithmic.
    pub is_logarithmic: bool,
}

impl SweepAxis {
    /// A column of words, numbered in the order of their occurrence.
    pub fn of_words(name: &str, words: &[String]) -> Self {
        let mut known: Vec<&String> = Vec::new();
        let mut number = |word| {
            let found = known.iter().position(|own| *own == word);
            found.unwrap_or_else(|| {
                known.push(word);
                known.len() - 1
            })
        };
        let values = words.iter().map(|word| number(word) as f64).collect();
        let few = known.iter().take(4).enumerate().map(|(k, word)| format!("{k} {word}"));
        let more = if known.len() > 4 { ", …" } else { "" };
        let name = format!("{name} ({}{more})", few.collect::<Vec<_>>().join(", "));
        Self { name, values, is_logarithmic: false }
    }
}

/// The solved members of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPlot {
    /// Above the drawings.
    pub title: String,
    /// Varied paths.
    pub varied: Vec<SweepAxis>,
    /// Collected scalars.
    pub collected: Vec<SweepAxis>,
}

impl SweepPlot {
    /// Collected scalars, by row, over varied numbers, by column; of many, the first six each.
    ///
    /// # Errors
    /// If there are no members to draw.
    pub fn responses(&self) -> Result<Graphic, FigureError> {
        let members = self.members("responses")?;
        let collected = &self.collected[..self.collected.len().min(MAX_PANELS)];
        let varied = &self.varied[..self.varied.len().min(MAX_PANELS)];
        let mut panels = Vec::new();
        for (index, above) in collected.iter().enumerate() {
            for below in varied {
                let points = members.iter().map(|&member| (below.values[member], above.values[member]));
                let mut points: Vec<(f64, f64)> = points.collect();
                // The only varied value determines the collected one: the dots are points of a curve.
                let is_curve = self.varied.len() == 1 && points.len() <= MAX_OF_CURVE;
                if is_curve {
                    points.sort_by(|a, b| a.0.total_cmp(&b.0));
                }
                let (width, radius) = if is_curve { (1.2, 2.6) } else { (0.0, 1.6) };
                let own = Curve { width, radius, mark: Some(Mark::Circle), ..Curve::new(palette(index)) };
                let curves = vec![Curve { points, ..own }];
                let x = if below.is_logarithmic {
                    Axis::logarithmic(&below.name)
                } else {
                    Axis::new(&below.name)
                };
                panels.push(Panel { x, y: Axis::new(&above.name), curves });
            }
        }
        let chart = Chart {
            title: self.title_of(&members),
            columns: varied.len(),
            width: (PANEL.0 * varied.len() as f64).max(SINGLE),
            panel_height: PANEL.1,
            ..Chart::new("responses", panels)
        };
        Ok(chart.draw().into())
    }

    /// All members as lines across one axis per column.
    ///
    /// # Errors
    /// If there are no members to draw.
    pub fn parallel_coordinates(&self) -> Result<Graphic, FigureError> {
        let members = self.members("parallel-coordinates")?;
        let axes: Vec<&SweepAxis> = self.varied.iter().chain(&self.collected).collect();
        let width = PARALLEL.0 * (axes.len() as f64).max(3.0);
        let mut drawing = Drawing::new("parallel-coordinates", [width, PARALLEL.1]);
        let title = self.title_of(&members);
        drawing.words([0.5 * width, 28.0], &title, 16, Align::Middle, [0; 3]);
        let (top, bottom) = (76.0, PARALLEL.1 - 36.0);
        let across = |index: usize| 0.5 * PARALLEL.0 + PARALLEL.0 * index as f64;
        let ranges: Vec<[f64; 2]> = axes.iter().map(|axis| axis.range(&members)).collect();
        let shade = paler(palette(0), (200.0 / members.len() as f64).clamp(0.15, 0.6));
        for &member in &members {
            let place = |(index, axis): (usize, &&SweepAxis)| {
                let share = axis.share(ranges[index], axis.values[member]);
                [across(index), bottom - share * (bottom - top)]
            };
            let places: Vec<[f64; 2]> = axes.iter().enumerate().map(place).collect();
            if places.iter().flatten().all(|number| number.is_finite()) {
                drawing.line(places, shade, 1.0);
            }
        }
        for (index, axis) in axes.iter().enumerate() {
            let [low, high] = ranges[index];
            drawing.line(vec![[across(index), top], [across(index), bottom]], [0x33; 3], 1.2);
            drawing.words([across(index), top - 24.0], &axis.name, 12, Align::Middle, [0; 3]);
            drawing.words([across(index), top - 7.0], &short(high), 11, Align::Middle, [0x33; 3]);
            drawing.words([across(index), bottom + 16.0], &short(low), 11, Align::Middle, [0x33; 3]);
        }
        Ok(drawing.into())
    }

    /// The members that are drawn.
    fn members(&self, figure: &str) -> Result<Vec<usize>, FigureError> {
        let count =
            self.varied.iter().chain(&self.collected).map(|axis| axis.values.len()).min().unwrap_or(0);
        if count == 0 || self.varied.is_empty() || self.collected.is_empty() {
            return Err(FigureError { figure: figure.to_owned(), reason: "no member is solved".to_owned() });
        }
        let shown = count.min(MAX_MEMBERS);
        Ok((0..shown).map(|k| k * count / shown).collect())
    }

    fn title_of(&self, members: &[usize]) -> String {
        let count = self.varied[0].values.len();
        if members.len() == count {
            format!("{}: {count} members", self.title)
        } else {
            format!("{}: {} of {count} members", self.title, members.len())
        }
    }
}

impl SweepAxis {
    /// Minimum and maximum over members that have a value.
    fn range(&self, members: &[usize]) -> [f64; 2] {
        let values = members.iter().map(|&member| self.values[member]).filter(|value| value.is_finite());
        values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    }

    /// Fraction of the range below a value; one half if all values are equal.
    fn share(&self, [low, high]: [f64; 2], value: f64) -> f64 {
        if high - low <= 1e-12 * high.abs().max(low.abs()) {
            return if value.is_finite() { 0.5 } else { f64::NAN };
        }
        if self.is_logarithmic && low > 0.0 {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        }
    }
}

/// A colour, mixed with white.
fn paler(shade: [u8; 3], share: f64) -> [u8; 3] {
    shade.map(|part| (255.0 - share * (255.0 - f64::from(part))).round() as u8)
}

/// A number in few digits.
fn short(number: f64) -> String {
    lissom_mechanics::number::written(number, 4)
}

#[cfg(test)]
#[path = "../../tests/unit/output/sweep_plot.rs"]
mod tests;
