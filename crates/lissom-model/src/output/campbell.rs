//! Campbell diagrams: frequencies over a parameter, with the multiples of the rotation.

use kuva::plot::LinePlot;
use kuva::plot::legend::LegendPosition;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};
use kuva::render::theme::Theme;

use super::FigureError;
use super::plot::COLOURS;
use super::render;

/// Lines of frequencies and rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CampbellPlot {
    /// Above the drawing.
    pub title: String,
    /// What is varied.
    pub x_label: String,
    /// Values and frequencies [Hz] of each line.
    pub lines: Vec<Vec<(f64, f64)>>,
    /// Name, values and frequencies [Hz] of each multiple of the rotation.
    pub rays: Vec<(String, Vec<(f64, f64)>)>,
}

impl CampbellPlot {
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
        let failure = |reason| FigureError { figure: "campbell".to_owned(), reason };
        render::png(self.draw()?).map_err(failure)
    }

    fn draw(&self) -> Result<Scene, FigureError> {
        let most = self.lines.iter().flatten().map(|point| point.1).fold(0.0, f64::max);
        if self.lines.iter().all(Vec::is_empty) || most <= 0.0 {
            let reason = "no mode has a frequency above zero".to_owned();
            return Err(FigureError { figure: "campbell".to_owned(), reason });
        }
        let line = |(index, points): (usize, &Vec<(f64, f64)>)| {
            let line = LinePlot::new().with_data(points.clone()).with_stroke_width(1.6);
            Plot::Line(line.with_color(COLOURS[index % COLOURS.len()]).with_legend(format!("{}", index + 1)))
        };
        let ray = |(name, points): &(String, Vec<(f64, f64)>)| {
            let below: Vec<(f64, f64)> =
                points.iter().copied().filter(|point| point.1 <= 1.1 * most).collect();
            let line = LinePlot::new().with_data(below).with_color("#888888").with_stroke_width(1.0);
            Plot::Line(line.with_dashed().with_legend(name.as_str()))
        };
        let plots: Vec<Plot> =
            self.lines.iter().enumerate().map(line).chain(self.rays.iter().map(ray)).collect();
        let theme = Theme { grid_color: "#e4e4e4".into(), legend_border: "none".into(), ..Theme::light() };
        let layout = Layout::auto_from_plots(&plots)
            .with_width(760.0)
            .with_height(520.0)
            .with_theme(theme)
            .with_title(self.title.as_str())
            .with_title_size(16)
            .with_x_label(self.x_label.as_str())
            .with_y_label("frequency [Hz]")
            .with_legend_position(LegendPosition::OutsideRightTop);
        Ok(render_multiple(plots, layout))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_rays_are_drawn() {
        let plot = CampbellPlot {
            title: "Rotor".to_owned(),
            x_label: "parameters.speed".to_owned(),
            lines: vec![vec![(0.0, 10.0), (20.0, 12.0)], vec![(0.0, 10.0), (20.0, 8.0)]],
            rays: vec![("1P".to_owned(), vec![(0.0, 0.0), (20.0, 20.0)])],
        };
        let svg = plot.svg().unwrap();
        for words in ["Rotor", "parameters.speed", "1P", "frequency [Hz]"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(plot.png().unwrap().starts_with(b"\x89PNG"));
        assert!(CampbellPlot { lines: vec![Vec::new()], ..plot }.svg().is_err());
    }
}
