//! Campbell diagram: natural frequencies and damping over a parameter, with modes tracked by their shapes.

use lissom_core::diagnostics::Diagnose;
use std::fmt::Write;
use std::time::{Duration, Instant};

use lissom_core::linear::{Mode, ModeKind, ModeOptions, Whirl};
use lissom_model::lower::registry::registry;
use lissom_model::output::{CampbellLine, CampbellPlot, Summary};
use lissom_model::{Document, Report};
use serde_json::{Value, json};

use crate::analysis_warning::AnalysisWarning;
use crate::model::{Model, Override};
use crate::modes::{ModesError, Reliable, reliable};
use crate::operating_point::{LinearizationPoint, OperatingPoint};

/// Modes with a smaller likeness of shapes do not belong to one line.
const ALIKE: f64 = 0.3;
/// Smaller likenesses are reported: a pair of equal frequencies splits into halves.
const DOUBTFUL: f64 = 0.45;
/// Relative accuracy of a crossing's frequency …
const CROSSED: f64 = 1e-7;
/// … or maximum number of solutions.
const SOLUTIONS: usize = 8;

/// The request.
#[derive(Clone, Debug, PartialEq)]
pub struct CampbellRequest {
    /// Path of the number that is varied.
    pub path: String,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
    /// Number of values, at least 2.
    pub values: usize,
    /// Number of modes at each.
    pub count: usize,
    /// Multiples of the rotation whose crossings are listed, such as 1 and 3.
    pub rays: Vec<u32>,
}

/// Why no diagram was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CampbellError {
    /// The model is invalid.
    #[error(transparent)]
    Model(Report),
    /// The values are not a range.
    #[error("{}", self.diagnostic())]
    Range {
        /// The path.
        path: String,
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// There are no modes at a value.
    #[error("{}", self.diagnostic())]
    Modes {
        /// The path.
        path: String,
        /// The value.
        value: f64,
        /// The error.
        error: Box<ModesError>,
    },
    /// The unknowns depend on the value.
    #[error("{}", self.diagnostic())]
    Unlike(String),
}

/// A mode at a value of the parameter.
#[derive(Clone, Debug)]
pub struct PointMode {
    /// The mode, in the axes of the nodes.
    pub mode: Mode,
    /// Its whirl, in axes at rest.
    pub whirl: Whirl,
    /// Number of its line, from 0.
    pub line: usize,
    /// Its likeness to the previous mode of its line; none for the first.
    pub assurance: Option<f64>,
}

impl PointMode {
    /// Frequency in axes at rest [Hz]; none if there are two.
    pub fn seen(&self) -> Option<f64> {
        match self.whirl {
            Whirl::Forward(frequency) | Whirl::Backward(frequency) => Some(frequency),
            Whirl::None => Some(self.mode.frequency),
            Whirl::Mixed => None,
        }
    }

    /// The frequency that is compared with rays [Hz], and whether it is that in axes at rest.
    fn compared(&self) -> (f64, bool) {
        self.seen().map_or((self.mode.frequency, false), |frequency| (frequency, true))
    }
}

/// Modes at a value of the parameter.
#[derive(Clone, Debug)]
pub struct Point {
    /// The value.
    pub value: f64,
    /// Rate of rotation [Hz].
    pub spin: f64,
    /// The modes, by frequency.
    pub modes: Vec<PointMode>,
}

/// Intersection of a line with a multiple of the rotation: a critical speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossing {
    /// Number of the line, from 0.
    pub line: usize,
    /// The multiple.
    pub ray: u32,
    /// Value of the parameter.
    pub value: f64,
    /// Rate of rotation there [Hz].
    pub spin: f64,
    /// Word for the whirl.
    pub whirl: &'static str,
    /// Whether frequencies are those in axes at rest.
    pub at_rest: bool,
}

/// A Campbell diagram.
#[derive(Clone, Debug)]
pub struct CampbellReport {
    /// Path of the number that is varied.
    pub path: String,
    /// Modes by value.
    pub points: Vec<Point>,
    /// Number of lines.
    pub lines: usize,
    /// Critical speeds.
    pub crossings: Vec<Crossing>,
    /// The multiples of the rotation.
    pub rays: Vec<u32>,
    /// Warnings.
    pub warnings: Vec<AnalysisWarning>,
    /// Wall-clock time.
    pub wall: Duration,
}

/// The search, one value after another.
struct Search<'s> {
    model: &'s Model,
    overrides: &'s [Override],
    request: &'s CampbellRequest,
    warnings: Vec<AnalysisWarning>,
}

/// Campbell diagram of `model` with `overrides`.
///
/// # Errors
/// If the model is invalid, or has no modes at a value.
pub fn campbell(
    model: &Model,
    overrides: &[Override],
    request: &CampbellRequest,
) -> Result<CampbellReport, CampbellError> {
    let began = Instant::now();
    let &CampbellRequest { from, to, .. } = request;
    if !(from.is_finite() && to.is_finite()) || from == to {
        return Err(CampbellError::Range { path: request.path.clone(), from, to });
    }
    let last = request.values.max(2) - 1;
    let mut search = Search { model, overrides, request, warnings: Vec::new() };
    let mut points: Vec<Point> = Vec::new();
    let mut lines = 0;
    for k in 0..=last {
        let value = if k == last { to } else { from + (to - from) * k as f64 / last as f64 };
        points.push(search.point(value, points.last(), &mut lines)?);
    }
    let crossings = search.crossings(&points);
    search.warnings.dedup();
    Ok(CampbellReport {
        path: request.path.clone(),
        points,
        lines,
        crossings,
        rays: request.rays.clone(),
        warnings: search.warnings,
        wall: began.elapsed(),
    })
}

impl Search<'_> {
    fn point(
        &mut self,
        value: f64,
        before: Option<&Point>,
        lines: &mut usize,
    ) -> Result<Point, CampbellError> {
        let path = &self.request.path;
        let mut changed = self.overrides.to_vec();
        changed.push((path.clone(), format!("{value:?}")));
        let document = self.model.document(&changed).map_err(CampbellError::Model)?;
        let failed = |error| CampbellError::Modes { path: path.clone(), value, error: Box::new(error) };
        let count = self.request.count;
        let mut doubts = Vec::new();
        let find = |reached: LinearizationPoint<'_, '_>| -> Result<Option<Point>, ModesError> {
            let options = ModeOptions { count, shift: None };
            let found = reached.model.modes(&options)?;
            let Reliable { found, at_rest, warnings } = reliable(reached.model, found, &options)?;
            let found = found.modes;
            let model = at_rest.as_ref().unwrap_or(reached.model);
            let at_value = warnings
                .into_iter()
                .filter(|own| *own != AnalysisWarning::AxesAtRest)
                .chain(reached.warnings);
            doubts.extend(at_value.map(|own| AnalysisWarning::At {
                path: path.clone(),
                value,
                warning: Box::new(own),
            }));
            if before.is_some_and(|before| different(before, &found)) {
                return Ok(None);
            }
            let known = before.map_or(&[][..], |before| &before.modes);
            let alike: Vec<Vec<f64>> = known
                .iter()
                .map(|known| found.iter().map(|mode| model.assurance(&known.mode, mode)).collect())
                .collect();
            let matched = matched(known, &found, &alike);
            let modes = found.into_iter().zip(matched).map(|(mode, (line, assurance))| {
                let whirl = model.whirl(&mode);
                let line = line.unwrap_or_else(|| {
                    *lines += 1;
                    *lines - 1
                });
                PointMode { mode, whirl, line, assurance }
            });
            let modes = modes.collect();
            Ok(Some(Point { value, spin: model.spin().norm() / std::f64::consts::TAU, modes }))
        };
        let about = OperatingPoint::rotation_or_static(&document).map_err(failed)?;
        let point = about.linearized(&document, find).map_err(|error| match error {
            ModesError::Model(report) => CampbellError::Model(report),
            other => failed(other),
        })?;
        self.warnings.extend(doubts);
        let point = point.ok_or_else(|| CampbellError::Unlike(path.clone()))?;
        for of in point.modes.iter().filter(|of| of.assurance.is_some_and(|alike| alike < DOUBTFUL)) {
            self.warnings.push(AnalysisWarning::UnlikeShapes {
                line: of.line + 1,
                path: path.clone(),
                value,
                correlation: of.assurance.unwrap_or(0.0),
            });
        }
        Ok(point)
    }

    /// Intersections of lines with rays: located between two values, then refined by further solutions.
    fn crossings(&mut self, points: &[Point]) -> Vec<Crossing> {
        let mut crossings = Vec::new();
        let pairs: Vec<_> = points.windows(2).collect();
        for pair in pairs {
            for of in pair[0].modes.iter().filter(|of| of.mode.kind != ModeKind::Rigid) {
                for &ray in &self.request.rays {
                    crossings.extend(self.crossing((&pair[0], &pair[1]), of.line, ray));
                }
            }
        }
        crossings
    }

    fn crossing(&mut self, (low, high): (&Point, &Point), line: usize, ray: u32) -> Option<Crossing> {
        let gap = |point: &Point| {
            let of = of_line(point, line)?;
            let (frequency, at_rest) = of.compared();
            Some((frequency - f64::from(ray) * point.spin, frequency, at_rest))
        };
        let (mut at, mut beyond) = (gap(low)?, gap(high)?);
        if at.2 != beyond.2 && low.spin > 0.0 && high.spin > 0.0 || at.0 * beyond.0 > 0.0 || beyond.0 == at.0
        {
            return None;
        }
        let (mut low, mut high) = (low.clone(), high.clone());
        let mut lines = usize::MAX / 2;
        let mut value = low.value;
        for _ in 0..SOLUTIONS {
            value = low.value - at.0 * (high.value - low.value) / (beyond.0 - at.0);
            // At the crossing itself a mode may have zero frequency in rotating axes, where its shape contains no
            // information.
            let Ok(middle) = self.point(value, Some(&low), &mut lines) else { break };
            let Some(own) = gap(&middle).filter(|own| own.2 == beyond.2) else { break };
            let is_found = own.0.abs() <= CROSSED * own.1;
            if own.0 * at.0 > 0.0 {
                (low, at) = (middle, own);
            } else {
                (high, beyond) = (middle, own);
            }
            if is_found || at.0 == beyond.0 {
                break;
            }
        }
        let share =
            if high.value == low.value { 0.0 } else { (value - low.value) / (high.value - low.value) };
        let whirl = of_line(&high, line).map_or("none", |of| of.whirl.name());
        Some(Crossing {
            line,
            ray,
            value,
            spin: low.spin + share * (high.spin - low.spin),
            whirl,
            at_rest: beyond.2,
        })
    }
}

/// The mode of a line.
fn of_line(point: &Point, line: usize) -> Option<&PointMode> {
    point.modes.iter().find(|of| of.line == line)
}

/// The word for the whirl of a line from those of its modes at nonzero speeds: `changes` if they differ.
pub(crate) fn common_whirl<'w>(mut words: impl Iterator<Item = &'w str>) -> &'w str {
    let first = words.next().unwrap_or("none");
    if words.all(|word| word == first) { first } else { "changes" }
}

/// Whether shapes have different numbers of unknowns.
fn different(before: &Point, found: &[Mode]) -> bool {
    let size = |mode: Option<&Mode>| mode.map(|mode| mode.shape.len());
    size(before.modes.first().map(|of| &of.mode)) != size(found.first())
}

/// Line and likeness of each mode: the pairs with the largest likeness first, of equal ones those with the nearest
/// frequencies.
fn matched(known: &[PointMode], found: &[Mode], alike: &[Vec<f64>]) -> Vec<(Option<usize>, Option<f64>)> {
    let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
    for (i, row) in alike.iter().enumerate() {
        for (j, &value) in row.iter().enumerate().filter(|&(_, &value)| value >= ALIKE) {
            let frequencies = [known[i].mode.frequency, found[j].frequency];
            let most = frequencies[0].max(frequencies[1]);
            let apart = if most > 0.0 { (frequencies[0] - frequencies[1]).abs() / most } else { 0.0 };
            pairs.push((i, j, value - 0.1 * apart));
        }
    }
    pairs.sort_by(|a, b| b.2.total_cmp(&a.2));
    let mut taken = vec![false; known.len()];
    let mut result = vec![(None, None); found.len()];
    for (i, j, _) in pairs {
        if !taken[i] && result[j].0.is_none() {
            taken[i] = true;
            result[j] = (Some(known[i].line), Some(alike[i][j]));
        }
    }
    result
}

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
    pub fn figure(&self, title: &str) -> CampbellPlot {
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
    }

    /// Unit of the number that is varied, if it is known.
    fn unit(&self) -> Option<&'static str> {
        lissom_model::unit_of(&registry(), &self.path)
    }

    /// The contents of `summary.json`.
    pub fn summary(&self, name: &str, overrides: &[Override], document: &Document) -> Summary {
        let mut summary = crate::summary::of_request("campbell", name, overrides, document);
        let mut insert = |name: &str, fact: Value| crate::summary::insert(&mut summary, name, fact);
        insert("stopped", json!("end"));
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
        insert("wall_seconds", json!(self.wall.as_secs_f64()));
        crate::summary::add_warnings(&mut summary, &self.warnings);
        summary
    }
}
