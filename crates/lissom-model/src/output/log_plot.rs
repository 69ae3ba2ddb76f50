//! Plots of studies: curves over logarithmic axes, with a mark at every point. Independent of the study.

use lissom_drawing::{Axis, Chart, Curve, Drawing, Mark, Panel, palette};

use super::FigureError;

/// Marks, so that curves that coincide in colour or on paper are still distinguished.
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond];

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
    /// Names and points of the curves. Points that have no logarithm are omitted.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

impl LogFigure {
    /// The drawing as an SVG text.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn svg(&self) -> Result<String, FigureError> {
        self.draw()?.svg().map_err(FigureError::of(&self.name))
    }

    /// The drawing as the bytes of a PNG file.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn png(&self) -> Result<Vec<u8>, FigureError> {
        self.draw()?.png().map_err(FigureError::of(&self.name))
    }

    fn draw(&self) -> Result<Drawing, FigureError> {
        let usable = |value: f64| value > 0.0 && value.is_finite();
        let mut curves = Vec::new();
        for (index, (name, points)) in self.curves.iter().enumerate() {
            let mut points: Vec<(f64, f64)> =
                points.iter().copied().filter(|&(x, y)| usable(x) && usable(y)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            if !points.is_empty() {
                let mark = Some(MARKS[index % MARKS.len()]);
                curves.push(Curve { name: name.clone(), points, mark, ..Curve::new(palette(index)) });
            }
        }
        if curves.is_empty() {
            return Err(FigureError::new(&self.name, "it has no positive finite values"));
        }
        let [x, y] = [&self.x_label, &self.y_label].map(|label| Axis::logarithmic(label));
        let chart = Chart::new(&self.name, vec![Panel { x, y, curves }]);
        Ok(Chart { title: self.title.clone(), ..chart }.draw())
    }
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
        for words in ["Pendulum", "step size [s]", "condition number [-]", ">none<", ">physical<", "#d55e00"]
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
