//! Campbell diagrams: frequencies over a parameter, with the multiples of the rotation.

use lissom_model::output::{Axis, Chart, Curve, FigureError, Graphic, Mark, Panel};

/// Name of the figure, fit for a file.
const NAME: &str = "campbell";
/// Damping ratios below this are round-off.
const UNDAMPED: f64 = 1e-9;

/// Modes of similar shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct CampbellLine {
    /// Values and frequencies [Hz].
    pub(super) points: Vec<(f64, f64)>,
    /// Values and damping ratios.
    pub(super) damping: Vec<(f64, f64)>,
    /// Word for its whirl, such as `forward`.
    pub(super) whirl: &'static str,
}

/// Lines of frequencies and rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct CampbellPlot {
    /// Above the drawing.
    pub(super) title: String,
    /// Varied path, with its unit if it is known.
    pub(super) x_label: String,
    /// The lines, by number. Those of backward whirl are dashed.
    pub(super) lines: Vec<CampbellLine>,
    /// Name, values and frequencies [Hz] of each multiple of the rotation.
    pub(super) rays: Vec<(String, Vec<(f64, f64)>)>,
    /// Values and frequencies [Hz] at which lines meet rays.
    pub(super) crossings: Vec<(f64, f64)>,
}

impl CampbellPlot {
    /// Draws it.
    ///
    /// # Errors
    /// If there is nothing to draw.
    pub(super) fn draw(&self) -> Result<Graphic, FigureError> {
        let most = self.lines.iter().flat_map(|line| &line.points).map(|point| point.1).fold(0.0, f64::max);
        if most <= 0.0 {
            return Err(FigureError::new(NAME, "no mode has a frequency above zero"));
        }
        let line = |(index, line): (usize, &CampbellLine)| {
            let whirl = if line.whirl == "none" { "" } else { line.whirl };
            Curve {
                name: format!("{} {whirl}", index + 1).trim_end().to_owned(),
                points: line.points.clone(),
                is_dashed: line.whirl == "backward",
                ..Curve::numbered(index)
            }
        };
        let ray = |(name, points): &(String, Vec<(f64, f64)>)| Curve {
            name: name.clone(),
            points: below(points, 1.1 * most),
            width: 0.8,
            ..Curve::new([0x88; 3])
        };
        let crossings = Curve {
            name: if self.crossings.is_empty() { String::new() } else { "crossing".to_owned() },
            points: self.crossings.clone(),
            width: 0.0,
            mark: Some(Mark::Diamond),
            ..Curve::new([0x22; 3])
        };
        let lines: Vec<Curve> = self.lines.iter().enumerate().map(line).collect();
        let damped = lines.iter().zip(&self.lines).map(|(curve, line)| Curve {
            name: String::new(),
            points: line.damping.clone(),
            ..curve.clone()
        });
        let below = Panel {
            x: Axis::new(&self.x_label),
            y: Axis::new("damping ratio [-]"),
            curves: damped.collect(),
        };
        let is_damped =
            self.lines.iter().flat_map(|line| &line.damping).any(|point| point.1.abs() > UNDAMPED);
        let curves = self.rays.iter().map(ray).chain(lines).chain([crossings]).collect();
        let mut panels = vec![Panel { x: Axis::new(&self.x_label), y: Axis::new("frequency [Hz]"), curves }];
        panels.extend(is_damped.then_some(below));
        let panel_height = if is_damped { 380.0 } else { 490.0 };
        let chart = Chart { panel_height, ..Chart::new(NAME, panels) };
        Ok(Chart { title: self.title.clone(), ..chart }.draw().into())
    }
}

/// A line up to a limit.
fn below(points: &[(f64, f64)], limit: f64) -> Vec<(f64, f64)> {
    let end = points.iter().position(|point| point.1 > limit).unwrap_or(points.len());
    let mut found = points[..end].to_vec();
    if let (Some(last), Some(next)) = (points[..end].last(), points.get(end)) {
        let share = (limit - last.1) / (next.1 - last.1);
        found.push((last.0 + share * (next.0 - last.0), limit));
    }
    found
}

#[cfg(test)]
#[path = "../../../tests/unit/analyses/campbell/figure.rs"]
mod tests;
