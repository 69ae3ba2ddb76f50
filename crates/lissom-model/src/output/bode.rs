//! Bode plots: magnitude and phase of transfer functions over the frequency.

use std::f64::consts::PI;

use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::render::figure::Figure as Panels;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::Scene;
use kuva::render::theme::Theme;

use super::FigureError;
use super::plot::COLOURS;
use super::render;

/// Width of a figure, and height of each of its two panels.
const CELL: (f64, f64) = (760.0, 340.0);

/// Transfer functions over one list of frequencies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodePlot {
    /// Name, fit for a file.
    pub name: String,
    /// Above the drawing.
    pub title: String,
    /// Frequencies [Hz], ascending and above zero.
    pub frequencies: Vec<f64>,
    /// Name, magnitudes, and phases [rad] of each curve.
    pub curves: Vec<(String, Vec<f64>, Vec<f64>)>,
}

impl BodePlot {
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
        let failure = |reason| FigureError { figure: self.name.clone(), reason };
        render::png(self.draw()?).map_err(failure)
    }

    fn draw(&self) -> Result<Scene, FigureError> {
        let (mut magnitudes, mut phases) = (Vec::new(), Vec::new());
        for (index, (name, of, angles)) in self.curves.iter().enumerate() {
            let line = |points: Vec<(f64, f64)>| {
                LinePlot::new()
                    .with_data(points)
                    .with_color(COLOURS[index % COLOURS.len()])
                    .with_stroke_width(1.6)
                    .with_legend(name.as_str())
            };
            let points = |values: &[f64]| -> Vec<(f64, f64)> {
                self.frequencies.iter().copied().zip(values.iter().copied()).collect()
            };
            let positive: Vec<_> =
                points(of).into_iter().filter(|point| point.1 > 0.0 && point.1.is_finite()).collect();
            if positive.is_empty() {
                continue;
            }
            magnitudes.push(Plot::Line(line(positive)));
            let unwound: Vec<f64> = unwound(angles).iter().map(|angle| angle.to_degrees()).collect();
            phases.push(Plot::Line(line(points(&unwound))));
        }
        if magnitudes.is_empty() {
            let reason = "no response is above zero".to_owned();
            return Err(FigureError { figure: self.name.clone(), reason });
        }
        let layout = |plots: &[Plot], label: &str| {
            let theme =
                Theme { grid_color: "#e4e4e4".into(), legend_border: "none".into(), ..Theme::light() };
            Layout::auto_from_plots(plots)
                .with_theme(theme)
                .with_x_label("frequency [Hz]")
                .with_y_label(label)
                .with_legend_position(LegendPosition::OutsideRightTop)
        };
        let layouts = vec![
            layout(&magnitudes, "magnitude [output per input]").with_log_scale(),
            layout(&phases, "phase [°]").with_log_x(),
        ];
        let figure = Panels::new(2, 1)
            .with_title(self.title.as_str())
            .with_title_size(16)
            .with_cell_size(CELL.0, CELL.1)
            .with_plots(vec![magnitudes, phases])
            .with_layouts(layouts);
        Ok(figure.render())
    }
}

/// Angles without jumps of whole turns.
fn unwound(angles: &[f64]) -> Vec<f64> {
    let mut last = None;
    angles
        .iter()
        .map(|&angle| {
            let near =
                last.map_or(angle, |last: f64| angle - ((angle - last) / (2.0 * PI)).round() * 2.0 * PI);
            if near.is_finite() {
                last = Some(near);
            }
            near
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_go_on_beyond_half_a_turn() {
        let found = unwound(&[-3.0, 3.0, 2.9]);
        assert!((found[1] - (3.0 - 2.0 * PI)).abs() < 1e-15 && (found[2] - (2.9 - 2.0 * PI)).abs() < 1e-15);
    }

    #[test]
    fn both_panels_are_drawn_and_nothing_is_refused() {
        let frequencies = vec![0.1, 1.0, 10.0];
        let curve = ("tip.u3 / push".to_owned(), vec![1.0, 30.0, 0.01], vec![0.0, -1.5, -3.1]);
        let plot = BodePlot {
            name: "response".to_owned(),
            title: "Cantilever".to_owned(),
            frequencies,
            curves: vec![curve],
        };
        let svg = plot.svg().unwrap();
        for words in ["Cantilever", "tip.u3 / push", "frequency [Hz]", "phase"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(plot.png().unwrap().starts_with(b"\x89PNG"));
        let nothing = BodePlot { curves: vec![("a".to_owned(), vec![0.0; 3], vec![0.0; 3])], ..plot };
        assert!(nothing.svg().is_err());
    }
}
