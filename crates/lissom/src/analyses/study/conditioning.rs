//! Condition numbers of the tangent over the step size and over another value of the model, without scaling and with it: tables 2.1 and 2.2
//! of [Epple 2008], for any model.

use lissom_core::scaling::{ScaleBy, ScalingChoice};
use lissom_core::simulation::Simulation;
use lissom_model::output::LogFigure;

use super::members::{Effort, in_parallel};
use super::observed::{prepared, with_step};
use super::{StudyError, Watch, csv_line};
use crate::model_text::Model;
use crate::run::report::RunError;
use crate::start::Lowered;

/// Scalings in the order of the columns: name, label of the curve, s, whether rows and columns are equilibrated.
pub const SCALINGS: [(&str, &str, ScaleBy, bool); 4] = [
    ("none", "no scaling", ScaleBy::None, false),
    ("unit", "s = 1", ScaleBy::Unit, false),
    ("physical", "s physical", ScaleBy::Physical, false),
    ("equilibrated", "equilibrated", ScaleBy::Physical, true),
];
/// Tolerance of Newton's iteration: that of the model.
const TOLERANCE: f64 = f64::INFINITY;

/// The request. Numbers are strings, so that they are passed to the model unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// Step sizes [s].
    pub steps: Vec<String>,
    /// A path into the model and its values.
    pub vary: Option<(String, Vec<String>)>,
}

/// One run.
#[derive(Debug)]
pub struct Row {
    /// Step size, as written [s].
    pub step: String,
    /// Step size [s].
    pub step_size: f64,
    /// The varied value, as written.
    pub varied: Option<String>,
    /// Condition numbers of the last step's tangent, by [`SCALINGS`].
    pub outcome: Result<[f64; SCALINGS.len()], StudyError>,
}

/// All runs.
#[derive(Debug)]
pub struct Table {
    /// Path of the varied value.
    pub path: Option<String>,
    /// The runs, ordered by varied value, then by step.
    pub rows: Vec<Row>,
}

/// Condition numbers over one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What is the same in all its runs, such as `mass = 1`; empty if there is nothing else.
    pub of: String,
    /// Values of the parameter, with the condition numbers.
    pub points: Vec<(f64, [f64; SCALINGS.len()])>,
}

impl Request {
    /// The model of the first run.
    pub fn first(&self, model: &Model) -> Model {
        self.members().first().map_or_else(|| model.clone(), |&(step, value)| self.of(model, step, value))
    }

    fn of(&self, model: &Model, step: &str, value: Option<&String>) -> Model {
        let model = with_step(model, step);
        match (&self.vary, value) {
            (Some((path, _)), Some(value)) => model.with_overrides(&[(path.clone(), value.clone())]),
            _ => model,
        }
    }

    /// Step size and varied value of every run.
    fn members(&self) -> Vec<(&String, Option<&String>)> {
        let values = self.vary.as_ref().map_or(vec![None], |(_, values)| values.iter().map(Some).collect());
        values.into_iter().flat_map(|value| self.steps.iter().map(move |step| (step, value))).collect()
    }
}

/// Runs the model with every step size and varied value, in parallel. The rows of failed runs contain the reason.
///
/// # Errors
/// If the model is invalid with one of the values, has load steps, or if the study is interrupted.
pub fn study(model: &Model, request: &Request, watch: Watch<'_>) -> Result<Table, StudyError> {
    let members = request.members();
    let mut rows = Vec::with_capacity(members.len());
    let mut planned = 0;
    for &(step, value) in &members {
        let lowered = prepared(&request.of(model, step, value), step, TOLERANCE)?;
        planned += steps_of(&lowered);
        rows.push((step.clone(), lowered.settings.step_size, value.cloned()));
    }
    let effort = Effort::new(watch, planned);
    let outcomes = in_parallel(members.len(), |index| {
        let (step, value) = members[index];
        measure(prepared(&request.of(model, step, value), step, TOLERANCE)?, &effort)
    });
    let row = |((step, step_size, varied), outcome)| Row { step, step_size, varied, outcome };
    let rows: Vec<Row> = rows.into_iter().zip(outcomes).map(row).collect();
    if rows.iter().any(|row| matches!(row.outcome, Err(StudyError::Interrupted))) {
        return Err(StudyError::Interrupted);
    }
    Ok(Table { path: request.vary.as_ref().map(|(path, _)| path.clone()), rows })
}

fn steps_of(Lowered { plan, settings, .. }: &Lowered) -> usize {
    ((plan.end - plan.start) / settings.step_size).round().max(1.0) as usize
}

fn measure(lowered: Lowered, effort: &Effort<'_>) -> Result<[f64; SCALINGS.len()], StudyError> {
    let steps = steps_of(&lowered);
    let Lowered { system, state, mut settings, .. } = lowered;
    settings.control = None;
    let choice = settings.scaling;
    let mut simulation = Simulation::new(system, state, settings)?;
    for step in 1..=steps {
        simulation.step().map_err(RunError::from)?;
        if effort.note(step).is_break() {
            return Err(StudyError::Interrupted);
        }
    }
    let choices = SCALINGS.map(|(_, _, by, equilibrated)| ScalingChoice { by, equilibrated, ..choice });
    let tangents = simulation.converged_tangents(&choices).ok_or(StudyError::NotDynamic)?;
    let system = simulation.system();
    let mut conditions = [f64::NAN; SCALINGS.len()];
    for (condition, tangent) in conditions.iter_mut().zip(&tangents) {
        *condition = tangent.condition_estimate(system);
    }
    Ok(conditions)
}

impl Table {
    /// As comma-separated values: `step_size`, the path of the varied value, a column for each scaling. Failed runs have `NaN`.
    pub fn csv(&self) -> String {
        let names = SCALINGS.map(|(name, ..)| name);
        let mut text = csv_line(["step_size"].into_iter().chain(self.path.as_deref()).chain(names));
        for row in &self.rows {
            let values = row.outcome.as_ref().copied().unwrap_or([f64::NAN; SCALINGS.len()]);
            let values = values.map(|value| format!("{value:e}"));
            let fields = [row.step.as_str()].into_iter().chain(row.varied.as_deref());
            text += &csv_line(fields.chain(values.iter().map(String::as_str)));
        }
        text
    }

    /// What the condition numbers are plotted over: the step size, or the varied value if there is only one step size.
    pub fn parameter(&self) -> &str {
        let is_one_step = self.rows.iter().all(|row| row.step == self.rows[0].step);
        self.path.as_deref().filter(|_| is_one_step).unwrap_or("step size [s]")
    }

    /// Condition numbers over [`parameter`](Self::parameter), one series for each value of the other parameter.
    pub fn series(&self) -> Vec<Series> {
        let over_value = self.path.as_deref() == Some(self.parameter());
        let mut all: Vec<Series> = Vec::new();
        for row in &self.rows {
            let Ok(conditions) = row.outcome else { continue };
            let varied = row.varied.as_deref().unwrap_or_default();
            let (at, of) = match &self.path {
                Some(_) if over_value => (varied.parse().unwrap_or(f64::NAN), String::new()),
                Some(path) => (row.step_size, format!("{path} = {varied}")),
                None => (row.step_size, String::new()),
            };
            match all.iter_mut().find(|series| series.of == of) {
                Some(series) => series.points.push((at, conditions)),
                None => all.push(Series { of, points: vec![(at, conditions)] }),
            }
        }
        all
    }

    /// The drawing.
    pub fn figure(&self, title: &str) -> LogFigure {
        let curve = |series: &Series, k: usize| {
            let comma = if series.of.is_empty() { "" } else { ", " };
            let points = series.points.iter().map(|(at, conditions)| (*at, conditions[k])).collect();
            (format!("{}{comma}{}", SCALINGS[k].1, series.of), points)
        };
        let series = self.series();
        LogFigure {
            name: "conditioning".to_owned(),
            title: title.to_owned(),
            x_label: self.parameter().to_owned(),
            y_label: "condition number of the tangent [-]".to_owned(),
            curves: series.iter().flat_map(|own| (0..SCALINGS.len()).map(|k| curve(own, k))).collect(),
            guides: Vec::new(),
        }
    }
}

impl Series {
    /// Exponents of the parameter with which the condition numbers grow between the first and the last of its values.
    pub fn exponents(&self) -> Option<[f64; SCALINGS.len()]> {
        let [(from, first), .., (to, last)] = &self.points[..] else { return None };
        Some(std::array::from_fn(|k| (last[k] / first[k]).ln() / (to / from).ln()))
    }
}
