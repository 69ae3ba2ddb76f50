//! Table, diagram, summary and text of a Campbell diagram.

use std::fmt::Write;

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::linearized::Mode;
use lissom_core::number::Written;
use lissom_model::lower::registry::registry;
use lissom_model::output::{FigureError, Graphic};
use serde_json::{Value, json};

use super::figure::{CampbellLine, CampbellPlot};
use super::{CampbellReport, Crossing, Point, PointMode, of_line};
use crate::analyses::interface::AnalysisReport;
use crate::pictures::view::campbell::common_whirl;

impl CampbellReport {
    /// The table `campbell.csv`: value, rotation [Hz], line from 1, frequency [Hz] and damping ratio in the axes of the nodes,
    /// kind, whirl, frequency in axes at rest [Hz], likeness to the previous mode of the line.
    pub fn csv(&self) -> String {
        let mut text =
            "value,rotation,line,frequency,damping,kind,whirl,frequency_at_rest,likeness\n".to_owned();
        for point in &self.points {
            for of in &point.modes {
                let Mode { frequency, damping, kind, .. } = &of.mode;
                let number =
                    |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
                // Writing to a string cannot fail.
                let _ = writeln!(
                    text,
                    "{:?},{:?},{},{frequency:?},{damping:?},{},{},{},{}",
                    point.value,
                    point.spin,
                    of.line + 1,
                    kind.name(),
                    of.whirl.name(),
                    number(of.seen()),
                    number(of.assurance)
                );
            }
        }
        text
    }

    /// The diagram.
    ///
    /// # Errors
    /// If no mode has a frequency.
    pub fn diagram(&self, title: &str) -> Result<Graphic, FigureError> {
        let line = |line: usize| {
            let of = |point| Some((point, of_line(point, line)?));
            let own: Vec<(&Point, &PointMode)> = self.points.iter().filter_map(of).collect();
            let words = own.iter().filter(|(point, _)| point.spin > 0.0).map(|(_, own)| own.whirl.name());
            CampbellLine {
                points: own.iter().map(|(point, own)| (point.value, own.compared().0)).collect(),
                damping: own.iter().map(|(point, own)| (point.value, own.mode.damping)).collect(),
                whirl: common_whirl(words),
            }
        };
        let ray = |&ray: &u32| {
            let points = self.points.iter().map(|point| (point.value, f64::from(ray) * point.spin)).collect();
            (format!("{ray}P"), points)
        };
        let speeds = self.points.iter().map(|point| point.spin);
        let (least, most) = (speeds.clone().fold(f64::INFINITY, f64::min), speeds.fold(0.0, f64::max));
        let unit = self.unit().map_or_else(String::new, |unit| format!(" [{unit}]"));
        let speeds = if most > 0.0 {
            format!(", rotation {:.0} to {:.0} rpm", 60.0 * least, 60.0 * most)
        } else {
            String::new()
        };
        CampbellPlot {
            title: title.to_owned(),
            x_label: format!("{}{unit}{speeds}", self.path),
            lines: (0..self.lines).map(line).collect(),
            rays: self.rays.iter().filter(|_| most > 0.0).map(ray).collect(),
            crossings: self.crossings.iter().map(|of| (of.value, f64::from(of.ray) * of.spin)).collect(),
        }
        .draw()
    }

    /// Unit of the number that is varied, if it is known.
    fn unit(&self) -> Option<&'static str> {
        lissom_model::unit_of(&registry(), &self.path)
    }
}

impl AnalysisReport for CampbellReport {
    fn tables(&self) -> Vec<(String, String)> {
        vec![("campbell.csv".to_owned(), self.csv())]
    }

    fn figure(&self, title: &str) -> Option<Result<Graphic, FigureError>> {
        Some(self.diagram(title))
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("vary", json!(self.path));
        insert("unit", json!(self.unit()));
        insert("multiples", json!(self.rays));
        insert("values", json!(self.points.len()));
        insert("lines", json!(self.lines));
        let crossing = |of: &Crossing| {
            json!({
                "line": of.line + 1,
                "multiple": of.ray,
                "value": of.value,
                "rotation": of.spin,
                "whirl": of.whirl,
                "axes": if of.at_rest { "at rest" } else { "of the nodes" },
            })
        };
        insert("critical_speeds", self.crossings.iter().map(crossing).collect());
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn missing(&self) -> Option<Diagnostic> {
        let (_, first) = self.failed.first()?;
        let others = self.failed.len() - 1;
        Some(if others == 0 {
            first.clone()
        } else {
            first.clone().within(&format!("no modes, here and at {others} other values of {}", self.path))
        })
    }

    fn text(&self, time: &str) -> String {
        let mut text =
            format!("  {} lines over {} values of {}, {time}\n", self.lines, self.points.len(), self.path);
        for crossing in &self.crossings {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "  line {} crosses {}P at {} = {}, {} rpm, {} Hz, whirl {}",
                crossing.line + 1,
                crossing.ray,
                self.path,
                Written(crossing.value),
                Written(60.0 * crossing.spin),
                Written(f64::from(crossing.ray) * crossing.spin),
                crossing.whirl
            );
        }
        text
    }
}
