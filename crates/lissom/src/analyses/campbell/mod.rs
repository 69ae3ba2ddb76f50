//! Campbell diagram: natural frequencies and damping over a parameter, with modes tracked by their shapes.

mod figure;
mod report;

use std::str::FromStr;

use lissom_core::catalogued;
use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::interrupt::check;
use lissom_core::linearized::{Mode, ModeKind, ModeOptions, Whirl};
use lissom_model::Report;
use serde::Deserialize;

#[cfg(feature = "clap")]
use crate::analyses::interface::counts;
use crate::analyses::interface::{Analysis, AnalysisError, Origin};
use crate::analyses::modes::{ModesError, Reliable, in_rotation};
use crate::analyses::operating_point::{LinearizationPoint, OperatingPoint};
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;
use crate::start::reject_units;

/// Modes with a smaller likeness of shapes do not belong to one line.
const ALIKE: f64 = 0.3;
/// Smaller likenesses are reported: a pair of equal frequencies splits into halves.
const DOUBTFUL: f64 = 0.45;
/// Number of first values without modes after which the others are not tried.
const HOPELESS: usize = 3;
/// Relative accuracy of a crossing's frequency …
const CROSSED: f64 = 1e-7;
/// … or maximum number of solutions.
const SOLUTIONS: usize = 8;

/// Compute natural frequencies and damping ratios over a parameter, such as the speed of a rotor.
///
/// At each value the model is linearised about the steady rotation specified by the velocities in the file, or about static
/// equilibrium if nothing rotates. Modes are tracked by their shapes. The results go to a folder: `campbell.csv`,
/// `campbell.svg` and `campbell.png` (diagram with the multiples of the rotor speed) and `summary.json` (critical speeds).
/// `lissom view` shows the folder as a page.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom campbell rotor.toml --vary parameters.speed=0:200:41
  lissom campbell blade.toml --vary parameters.speed=0:2:21 --count 6 --rays 1,3,6
  lissom campbell rotor.toml --vary parameters.speed=0:200:41 --shift 350   the modes nearest to 350 Hz
  lissom campbell turbine.toml --vary parameters.speed=0.2:2:10 --averaged    with gravity and tilt, averaged over the azimuth

Exit code: 0 success; 2 wrong model or command line; 3 no steady rotation, no modes, or coefficients that are not constant.")
)]
pub struct CampbellRequest {
    /// Path of a number in the model file, its first and last value, and the number of values.
    #[cfg_attr(feature = "clap", arg(long, value_name = "PATH=FROM:TO:VALUES"))]
    pub vary: Variation,
    /// Number of modes, the lowest first, without decays of first-order states.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", default_value_t = 8, value_parser = counts(1..)))]
    pub count: usize,
    /// Compute the modes nearest to this frequency [default: the lowest ones].
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ", allow_negative_numbers = true))]
    #[serde(default)]
    pub shift: Option<f64>,
    /// Average over the azimuth: for rotors under gravity across the axis, or in tilted or sheared wind.
    #[cfg_attr(feature = "clap", arg(long))]
    #[serde(default)]
    pub averaged: bool,
    /// Multiples of the rotor speed whose crossings with the frequencies are critical speeds.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1,2,3", value_parser = clap::value_parser!(u32).range(1..)))]
    pub rays: Vec<u32>,
}

/// A number of the model file and its values.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Variation {
    /// Path to the varied number.
    pub path: String,
    /// First value of the number.
    pub from: f64,
    /// Last value of the number.
    pub to: f64,
    /// Number of values, at least 2.
    pub values: usize,
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "it must be PATH=FROM:TO:VALUES, such as `parameters.speed=0:20:41`".to_owned();
        let (path, range) = text.split_once('=').ok_or_else(wrong)?;
        let parts: Vec<&str> = range.split(':').collect();
        let [from, to, values] = parts[..] else { return Err(wrong()) };
        let number =
            |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(wrong);
        let values = values.trim().parse::<usize>().map_err(|_| wrong())?;
        if !(2..=100_000).contains(&values) {
            return Err("the number of values must be from 2 to 100000".to_owned());
        }
        Ok(Self { path: path.trim().to_owned(), from: number(from)?, to: number(to)?, values })
    }
}

/// Why no diagram was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum CampbellError {
    /// The model is invalid.
    #[error(transparent)]
    Model(Report),
    /// The values are not a range.
    Range {
        /// The path.
        path: String,
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
    },
    /// There are no modes at a value.
    Modes {
        /// The path.
        path: String,
        /// The value.
        value: f64,
        /// The error.
        error: Box<ModesError>,
    },
    /// The unknowns depend on the value.
    Unlike(String),
}

impl AnalysisError for CampbellError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::Model(report) => Origin::Model(report),
            Self::Range { .. } | Self::Unlike(_) => Origin::Request,
            Self::Modes { .. } => Origin::Computation,
        }
    }
}

/// A mode at a value of the parameter.
#[derive(Clone, Debug)]
pub struct PointMode {
    /// The mode, in the axes of the nodes.
    pub mode: Mode,
    /// Whirl of the mode, in axes at rest.
    pub whirl: Whirl,
    /// Number of its line, from 0.
    pub line: usize,
    /// Likeness to the previous mode of the line; none for the first.
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
    /// Values without modes, and why.
    pub failed: Vec<(f64, Diagnostic)>,
}

impl Analysis for CampbellRequest {
    const NAME: &'static str = "campbell";
    type Report = CampbellReport;
    type Error = CampbellError;

    fn compute(&self, model: &Model) -> Result<CampbellReport, CampbellError> {
        campbell(model, self)
    }
}

/// The search, one value after another.
struct Search<'s> {
    model: &'s Model,
    request: &'s CampbellRequest,
    warnings: Vec<AnalysisWarning>,
}

/// Campbell diagram of `model`.
///
/// # Errors
/// If the model is invalid, or has no modes at a value.
pub fn campbell(model: &Model, request: &CampbellRequest) -> Result<CampbellReport, CampbellError> {
    let &Variation { ref path, from, to, values } = &request.vary;
    if !(from.is_finite() && to.is_finite()) || from == to {
        return Err(CampbellError::Range { path: path.clone(), from, to });
    }
    if let Some(frequency) = request.shift.filter(|frequency| !(frequency.is_finite() && *frequency >= 0.0)) {
        let error = Box::new(ModesError::Shift(frequency));
        return Err(CampbellError::Modes { path: path.clone(), value: from, error });
    }
    let last = values.max(2) - 1;
    let mut search = Search { model, request, warnings: Vec::new() };
    let (mut points, mut failed): (Vec<Point>, Vec<(f64, Diagnostic)>) = (Vec::new(), Vec::new());
    let (mut lines, mut first_error) = (0, None);
    for k in 0..=last {
        let value = if k == last { to } else { from + (to - from) * k as f64 / last as f64 };
        match search.point(value, points.last(), &mut lines) {
            Ok(point) => {
                search.check_shapes(&point, None);
                points.push(point);
            }
            // Other speeds may have a steady rotation.
            Err(error @ CampbellError::Modes { .. }) if check().is_ok() => {
                failed.push((value, error.diagnostic()));
                first_error.get_or_insert(error);
            }
            Err(error) => return Err(error),
        }
        if (failed.len() == HOPELESS || k == last) && points.is_empty() {
            break;
        }
    }
    if points.is_empty()
        && let Some(error) = first_error
    {
        return Err(error);
    }
    if points.iter().all(|point| point.spin == 0.0) {
        search.warnings.push(AnalysisWarning::NothingRotates { path: path.clone() });
    }
    let crossings = search.crossings(&points, &failed);
    search.warnings.dedup();
    Ok(CampbellReport {
        path: path.clone(),
        points,
        lines,
        crossings,
        rays: request.rays.clone(),
        warnings: search.warnings,
        failed,
    })
}

impl Search<'_> {
    fn point(
        &mut self,
        value: f64,
        before: Option<&Point>,
        lines: &mut usize,
    ) -> Result<Point, CampbellError> {
        let path = &self.request.vary.path;
        let document = self.model.with(path, value).document().map_err(CampbellError::Model)?;
        reject_units(&document).map_err(CampbellError::Model)?;
        let failed = |error| CampbellError::Modes { path: path.clone(), value, error: Box::new(error) };
        let count = self.request.count;
        let mut doubts = Vec::new();
        let mut about = OperatingPoint::rotation_or_static(&document).map_err(failed)?;
        if self.request.averaged && about == OperatingPoint::Rotation {
            about = OperatingPoint::AveragedRotation;
        }
        let find = |reached: LinearizationPoint<'_, '_>| -> Result<Option<Point>, ModesError> {
            let options = ModeOptions { count, shift: self.request.shift };
            let Reliable { found, at_rest, warnings } = in_rotation(reached.model, about, &options)?;
            let model = at_rest.as_ref().unwrap_or(reached.model);
            // Decays of states would hide the lines of the motion.
            let found: Vec<Mode> = found.modes.into_iter().filter(|mode| model.counts(mode)).collect();
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
        let point = about.linearized_for_modes(&document, find).map_err(|error| match error {
            ModesError::Model(report) => CampbellError::Model(report),
            other => failed(other),
        })?;
        self.warnings.extend(doubts);
        point.ok_or_else(|| CampbellError::Unlike(path.clone()))
    }

    /// Warns of lines that are continued to `point` between shapes that are hardly alike: of all lines, or of one.
    fn check_shapes(&mut self, point: &Point, line: Option<usize>) {
        let unlike = |of: &&PointMode| of.assurance.is_some_and(|alike| alike < DOUBTFUL);
        for of in point.modes.iter().filter(unlike).filter(|of| line.is_none_or(|line| of.line == line)) {
            self.warnings.push(AnalysisWarning::UnlikeShapes {
                line: of.line + 1,
                path: self.request.vary.path.clone(),
                value: point.value,
                correlation: of.assurance.unwrap_or(0.0),
            });
        }
    }

    /// Intersections of lines with rays: located between two values, then refined by further solutions.
    fn crossings(&mut self, points: &[Point], failed: &[(f64, Diagnostic)]) -> Vec<Crossing> {
        let mut crossings = Vec::new();
        let is_whole = |pair: &&[Point]| {
            !failed.iter().any(|(value, _)| (value - pair[0].value) * (value - pair[1].value) < 0.0)
        };
        for pair in points.windows(2).filter(is_whole) {
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
            self.check_shapes(&middle, Some(line));
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

catalogued! {
    Failure CampbellError {
        Range { path => path, from => from, to => to } => "campbell-range" {
            cause: "`{path}` varies from {from} to {to}",
            remedy: "specify two different finite numbers",
            meaning: "The range of the varied number of a Campbell diagram is empty or not finite.",
        }
        Unlike { 0 => path } => "campbell-unknowns" {
            cause: "a change of `{path}` changes the unknowns of the model, so modes cannot be tracked",
            remedy: "vary a number that changes neither parts nor elements",
            meaning: "Modes are tracked by their shapes, which requires the same unknowns for all values of the varied number.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Modes { path => path, value => value, error => error } => {
            error.diagnostic().within(&format!("at `{path}` = {value}"))
        },
    }
}
