//! Campbell diagrams: frequencies over a parameter, with the multiples of the rotation.

use lissom_drawing::{Axis, Chart, Curve, Drawing, Panel};

use super::FigureError;

/// Name of the figure, fit for a file.
const NAME: &str = "campbell";

/// Lines of frequencies and rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CampbellPlot {
    /// Above the drawing.
    pub title: String,
    /// Varied path, with its unit if it is known.
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
        self.draw()?.svg().map_err(FigureError::of(NAME))
    }

    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.draw()?.png().map_err(FigureError::of(NAME))
    }

    fn draw(&self) -> Result<Drawing, FigureError> {
        let most = self.lines.iter().flatten().map(|point| point.1).fold(0.0, f64::max);
        if most <= 0.0 {
            return Err(FigureError::new(NAME, "no mode has a frequency above zero"));
        }
        let line = |(index, points): (usize, &Vec<(f64, f64)>)| Curve {
            name: format!("{}", index + 1),
            points: points.clone(),
            ..Curve::numbered(index)
        };
        let ray = |(name, points): &(String, Vec<(f64, f64)>)| Curve {
            name: name.clone(),
            points: points.iter().copied().filter(|point| point.1 <= 1.1 * most).collect(),
            width: 1.0,
            is_dashed: true,
            ..Curve::new([0x88; 3])
        };
        let lines = self.lines.iter().enumerate().map(line);
        let curves = self.rays.iter().map(ray).chain(lines).collect();
        let panel = Panel { x: Axis::new(&self.x_label), y: Axis::new("frequency [Hz]"), curves };
        let chart = Chart { panel_height: 490.0, ..Chart::new(NAME, vec![panel]) };
        Ok(Chart { title: self.title.clone(), ..chart }.draw())
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
        let many = CampbellPlot { lines: vec![plot.lines[0].clone(); 20], ..plot.clone() }.svg().unwrap();
        assert!(many.matches("<circle").count() >= 2 * 7, "lines after the seventh have marks");
        assert!(plot.png().unwrap().starts_with(b"\x89PNG"));
        let flat = CampbellPlot { lines: vec![vec![(0.0, 0.0), (20.0, 0.0)]], ..plot };
        assert!(flat.svg().is_err());
        assert!(CampbellPlot { lines: vec![Vec::new()], ..flat }.svg().is_err());
    }
}
