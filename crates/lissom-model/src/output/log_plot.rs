//! Plots of studies: curves over logarithmic axes, with a mark at every point. Knows no study.

use std::sync::Arc;

use kuva::plot::legend::LegendPosition;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{Primitive, Scene, render_multiple};
use kuva::render::theme::Theme;

use super::FigureError;
use super::plot::COLOURS;
use super::render;

/// Marks, so that curves that coincide in colour or on paper are still told apart.
const MARKS: [MarkerShape; 4] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond];

/// One drawing of positive numbers over positive numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogFigure {
    /// Name, fit for a file.
    pub name: String,
    /// Above the drawing.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// Names and points of the curves. Points that have no logarithm are left out.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

impl LogFigure {
    /// The drawing as an SVG text.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        let (plots, layout) = self.draw()?;
        Ok(render::svg(&whole_marks(render_multiple(plots, layout))))
    }

    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    /// If there is nothing to draw, or the drawing library fails.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        let (plots, layout) = self.draw()?;
        render::png(whole_marks(render_multiple(plots, layout))).map_err(|reason| self.failure(reason))
    }

    fn failure(&self, reason: impl Into<String>) -> FigureError {
        FigureError { figure: self.name.clone(), reason: reason.into() }
    }

    fn draw(&self) -> Result<(Vec<Plot>, Layout), FigureError> {
        let mut plots = Vec::new();
        for (index, (name, points)) in self.curves.iter().enumerate() {
            let usable = |value: f64| value > 0.0 && value.is_finite();
            let mut points: Vec<(f64, f64)> =
                points.iter().copied().filter(|&(x, y)| usable(x) && usable(y)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            if points.is_empty() {
                continue;
            }
            let colour = COLOURS[index % COLOURS.len()];
            let line = LinePlot::new().with_data(points.clone()).with_color(colour).with_stroke_width(1.6);
            let marks = ScatterPlot::new()
                .with_data(points)
                .with_color(colour)
                .with_size(4.0)
                .with_marker(MARKS[index % MARKS.len()]);
            plots.push(Plot::Line(line.with_legend(name.as_str())));
            plots.push(Plot::Scatter(marks));
        }
        if plots.is_empty() {
            return Err(self.failure("it has no positive finite values"));
        }
        let theme = Theme { grid_color: "#e4e4e4".into(), legend_border: "none".into(), ..Theme::light() };
        let layout = Layout::auto_from_plots(&plots)
            .with_log_scale()
            .with_tick_format(TickFormat::Custom(Arc::new(|value| format!("{value:e}"))))
            .with_width(760.0)
            .with_height(460.0)
            .with_theme(theme)
            .with_title(self.title.as_str())
            .with_title_size(16)
            .with_x_label(self.x_label.as_str())
            .with_y_label(self.y_label.as_str())
            .with_legend_position(LegendPosition::OutsideRightTop);
        Ok((plots, layout))
    }
}

/// Axes span all points: what is cut at them are only halves of marks.
fn whole_marks(mut scene: Scene) -> Scene {
    scene.elements.retain(|element| !matches!(element, Primitive::ClipStart { .. } | Primitive::ClipEnd));
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(curves: Vec<(String, Vec<(f64, f64)>)>) -> LogFigure {
        let texts = ["conditioning", "Pendulum", "step size [s]", "condition number [-]"].map(str::to_owned);
        let [name, title, x_label, y_label] = texts;
        LogFigure { name, title, x_label, y_label, curves }
    }

    #[test]
    fn curves_over_many_decades_are_drawn() {
        let steep = (0..9).map(|k| (10.0_f64.powi(-k), 10.0_f64.powi(4 * k))).collect();
        let flat = (0..9).map(|k| (10.0_f64.powi(-k), 14.0)).collect();
        let figure = figure(vec![("none".to_owned(), steep), ("physical".to_owned(), flat)]);
        let svg = figure.svg().unwrap();
        for words in ["Pendulum", "step size [s]", "condition number [-]", ">none<", ">physical<", COLOURS[1]]
        {
            assert!(svg.contains(words), "{words}");
        }
        assert!(figure.png().unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn numbers_without_logarithm_are_left_out() {
        let points = vec![(1.0, f64::INFINITY), (0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0)];
        assert!(figure(vec![("none".to_owned(), points.clone())]).svg().is_err());
        let one = vec![(1.0, 10.0)];
        let svg = figure(vec![("none".to_owned(), points), ("unit".to_owned(), one)]).svg().unwrap();
        assert!(svg.contains(">unit<") && !svg.contains(">none<"));
    }
}
