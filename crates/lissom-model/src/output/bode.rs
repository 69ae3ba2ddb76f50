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
#[path = "../../tests/unit/output/bode.rs"]
mod tests;
