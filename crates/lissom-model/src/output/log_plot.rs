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
mod tests {
    use super::*;

    fn figure(curves: Vec<(String, Vec<(f64, f64)>)>) -> LogFigure {
        let texts = ["conditioning", "Pendulum", "step size [s]", "condition number [-]"].map(str::to_owned);
        let [name, title, x_label, y_label] = texts;
        LogFigure { name, title, x_label, y_label, curves, guides: Vec::new() }
    }

    #[test]
    fn curves_over_many_decades_are_drawn() {
        let steep = (0..9).map(|k| (10.0_f64.powi(-k), 10.0_f64.powi(4 * k))).collect();
        let flat = (0..9).map(|k| (10.0_f64.powi(-k), 14.0)).collect();
        let figure = figure(vec![("none".to_owned(), steep), ("physical".to_owned(), flat)]);
        let svg = figure.draw().unwrap().svg().unwrap();
        for words in ["Pendulum", "step size [s]", "condition number [-]", ">none<", ">physical<", "#d55e00"]
        {
            assert!(svg.contains(words), "{words}");
        }
        assert!(figure.draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn numbers_without_logarithm_are_left_out() {
        let points = vec![(1.0, f64::INFINITY), (0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0)];
        assert!(figure(vec![("none".to_owned(), points.clone())]).draw().is_err());
        let one = vec![(1.0, 10.0)];
        let svg = figure(vec![("none".to_owned(), points), ("unit".to_owned(), one)])
            .draw()
            .unwrap()
            .svg()
            .unwrap();
        assert!(svg.contains(">unit<") && !svg.contains(">none<"));
    }

    #[test]
    fn coinciding_curves_and_guides_are_all_seen() {
        let line =
            |factor: f64| (0..5).map(|k| (10.0_f64.powi(k), factor * 10.0_f64.powi(-k))).collect::<Vec<_>>();
        let dashed = |svg: &str| svg.matches("stroke-dasharray").count();
        let of = |curves: Vec<(String, Vec<(f64, f64)>)>| figure(curves).draw().unwrap().svg().unwrap();
        let apart = of(vec![("a".to_owned(), line(1.0)), ("b".to_owned(), line(2.0))]);
        let equal = of(vec![("a".to_owned(), line(1.0)), ("b".to_owned(), line(1.01))]);
        assert_eq!(dashed(&apart), 0);
        assert!(dashed(&equal) > 0 && equal.contains("3.3"), "{equal}");
        let mut guided = figure(vec![("a".to_owned(), line(1.0))]);
        guided.guides = vec![("order 1".to_owned(), line(0.1))];
        let svg = guided.draw().unwrap().svg().unwrap();
        assert!(svg.contains(">order 1<") && dashed(&svg) > 0);
    }
}
