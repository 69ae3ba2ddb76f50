//! Plots of studies: curves over logarithmic axes, with a mark at every point. Independent of the study.

use lissom_drawing::{Axis, Chart, Curve, Mark, Panel, Shade, palette};

use super::{FigureError, Graphic};

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
    /// Names and points of lines for comparison, such as slopes, drawn below the curves.
    pub guides: Vec<(String, Vec<(f64, f64)>)>,
}

/// Relative distance of values that are drawn as one point.
const COINCIDENT: f64 = 0.05;
/// Increase of the width of a line and of the size of its marks for each curve that covers it.
const HALO: f64 = 1.7;
/// Colour of guides.
const GUIDE: Shade = [0x99, 0x99, 0x99];

/// Whether two curves of sorted points mostly coincide, so that the upper one would cover the lower one.
fn coincide(a: &[(f64, f64)], b: &[(f64, f64)]) -> bool {
    let is_near = |p: &&(f64, f64)| {
        let close = |x: f64, y: f64| (x - y).abs() <= COINCIDENT * x.abs().max(y.abs());
        b.iter().any(|q| close(p.0, q.0) && close(p.1, q.1))
    };
    2 * a.iter().filter(is_near).count() > a.len()
}

impl LogFigure {
    /// Draws it.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn draw(&self) -> Result<Graphic, FigureError> {
        let usable = |value: f64| value > 0.0 && value.is_finite();
        let mut curves: Vec<Curve> = Vec::new();
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
        // Of curves that coincide, the lower ones are wider, and the upper ones dashed: all of them are seen.
        for upper in 1..curves.len() {
            for lower in 0..upper {
                if coincide(&curves[lower].points, &curves[upper].points) {
                    curves[lower].width += HALO;
                    curves[lower].radius += HALO;
                    curves[upper].is_dashed = true;
                }
            }
        }
        let guide = |(name, points): &(String, Vec<(f64, f64)>)| Curve {
            name: name.clone(),
            points: points.iter().copied().filter(|&(x, y)| usable(x) && usable(y)).collect(),
            width: 0.9,
            is_dashed: true,
            ..Curve::new(GUIDE)
        };
        curves.splice(0..0, self.guides.iter().map(guide));
        let [x, y] = [&self.x_label, &self.y_label].map(|label| Axis::logarithmic(label));
        let chart = Chart::new(&self.name, vec![Panel { x, y, curves }]);
        Ok(Chart { title: self.title.clone(), ..chart }.draw().into())
    }
}

#[cfg(test)]
#[path = "../../tests/unit/output/log_plot.rs"]
mod tests;
