//! Bode plots: magnitude and phase of transfer functions over the frequency.

use std::f64::consts::PI;

use lissom_drawing::{Axis, Chart, Curve, Panel};

use super::{FigureError, Graphic};

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
    /// Draws it.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub fn draw(&self) -> Result<Graphic, FigureError> {
        let (mut magnitudes, mut phases) = (Vec::new(), Vec::new());
        for (index, (name, of, angles)) in self.curves.iter().enumerate() {
            let curve = |values: &[f64]| Curve {
                name: name.clone(),
                points: self.frequencies.iter().copied().zip(values.iter().copied()).collect(),
                ..Curve::numbered(index)
            };
            if !of.iter().any(|magnitude| *magnitude > 0.0 && magnitude.is_finite()) {
                continue;
            }
            magnitudes.push(curve(of));
            let unwound: Vec<f64> = unwound(angles).iter().map(|angle| angle.to_degrees()).collect();
            phases.push(curve(&unwound));
        }
        if magnitudes.is_empty() {
            return Err(FigureError::new(&self.name, "no response is above zero"));
        }
        let ends = [self.frequencies.first(), self.frequencies.last()].map(|end| end.copied().unwrap_or(1.0));
        let x = Axis { range: Some(ends), ..Axis::logarithmic("frequency [Hz]") };
        let panel = |y, curves| Panel { x: x.clone(), y, curves };
        let panels = vec![
            panel(Axis::logarithmic("magnitude [output per input]"), magnitudes),
            panel(Axis::new("phase [°]"), phases),
        ];
        Ok(Chart { title: self.title.clone(), ..Chart::new(&self.name, panels) }.draw().into())
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
        let svg = plot.draw().unwrap().svg().unwrap();
        for words in ["Cantilever", "tip.u3 / push", "frequency [Hz]", "phase"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(plot.draw().unwrap().png().unwrap().starts_with(b"\x89PNG"));
        let nothing = BodePlot { curves: vec![("a".to_owned(), vec![0.0; 3], vec![0.0; 3])], ..plot };
        assert!(nothing.draw().is_err());
    }
}
