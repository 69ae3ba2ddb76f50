//! Dependence of the tangent's condition number on the step size, and on another value of the model, without scaling
//! and with it: tables 2.1 and 2.2 of [Epple 2008], for any model.

use crate::start::{Lowered, lower};
use lissom_core::scaling::{ScaleBy, ScalingChoice};
use lissom_core::simulation::{ConditionMethod, Simulation};
use lissom_model::output::LogFigure;

use super::members::{Effort, in_parallel};
use super::observed::with_step;
use super::{StudyError, Watch, csv_line};
use crate::model_text::Model;

/// Maximum number of steps: longer runs end earlier.
pub const MAX_STEPS: usize = 2_000_000;

/// One of the scalings compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compared {
    /// Name of its column.
    pub name: &'static str,
    /// Label of the scaling in the drawing.
    label: &'static str,
    by: ScaleBy,
    equilibrated: bool,
}

/// The scalings compared, in the order of the columns.
pub const SCALINGS: [Compared; 4] = [
    Compared { name: "none", label: "no scaling", by: ScaleBy::None, equilibrated: false },
    Compared { name: "unit", label: "s = 1", by: ScaleBy::Unit, equilibrated: false },
    Compared { name: "physical", label: "s physical", by: ScaleBy::Physical, equilibrated: false },
    Compared { name: "equilibrated", label: "equilibrated", by: ScaleBy::Physical, equilibrated: true },
];

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
    /// Result of the measurement.
    pub outcome: Result<Measured, StudyError>,
}

/// Result of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Condition numbers of the last step's tangent, by [`SCALINGS`].
    pub conditions: [f64; SCALINGS.len()],
    /// Method of their computation.
    pub method: ConditionMethod,
    /// Unknowns of the tangent.
    pub unknowns: usize,
    /// Time at which the run ended [s].
    pub end: f64,
    /// Whether that is earlier than the end of the model, because of too many steps.
    pub is_shortened: bool,
}

/// All runs.
#[derive(Debug)]
pub struct Table {
    /// Path of the varied value.
    pub path: Option<String>,
    /// The runs, ordered by step, then by varied value.
    pub rows: Vec<Row>,
}

impl Request {
    /// The model of the first run.
    pub fn first(&self, model: &Model) -> Model {
        let first = |values: &Vec<String>| values.first().cloned().unwrap_or_default();
        self.of(model, &first(&self.steps), self.vary.as_ref().map(|(_, values)| first(values)).as_ref())
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
        self.steps.iter().flat_map(|step| values.iter().map(move |&value| (step, value))).collect()
    }
}

/// Runs the model with every step size and varied value, in parallel. The rows of failed runs contain the reason.
///
/// # Errors
/// If the model is invalid, with one of the values or without, has load steps, or if the study is interrupted.
pub fn study(model: &Model, request: &Request, watch: Watch<'_>) -> Result<Table, StudyError> {
    let members = request.members();
    let mut rows = Vec::with_capacity(members.len());
    let mut planned = 0;
    for &(step, value) in &members {
        let lowered = lower(&request.of(model, step, value).document()?)?;
        if lowered.plan.is_static {
            return Err(StudyError::NotDynamic);
        }
        planned += steps_of(&lowered).0;
        rows.push((step.clone(), lowered.settings.step_size, value.cloned()));
    }
    let effort = Effort::new(watch, planned);
    let outcomes = in_parallel(members.len(), |index| {
        let (step, value) = members[index];
        measure(&request.of(model, step, value), &effort)
    });
    let row = |((step, step_size, varied), outcome)| Row { step, step_size, varied, outcome };
    let rows: Vec<Row> = rows.into_iter().zip(outcomes).map(row).collect();
    if rows.iter().any(|row| matches!(row.outcome, Err(StudyError::Interrupted))) {
        return Err(StudyError::Interrupted);
    }
    Ok(Table { path: request.vary.as_ref().map(|(path, _)| path.clone()), rows })
}

/// Number of whole steps to the end, and whether it is smaller than planned.
fn steps_of(lowered: &Lowered) -> (usize, bool) {
    let plan = &lowered.plan;
    let whole = ((plan.end - plan.start) / lowered.settings.step_size).round().max(1.0);
    if whole > MAX_STEPS as f64 { (MAX_STEPS, true) } else { (whole as usize, false) }
}

fn measure(model: &Model, effort: &Effort<'_>) -> Result<Measured, StudyError> {
    let lowered = lower(&model.document()?)?;
    let (steps, is_shortened) = steps_of(&lowered);
    let Lowered { system, state, settings, .. } = lowered;
    let choice = settings.scaling;
    let mut simulation = Simulation::new(system, state, settings)?;
    for step in 1..=steps {
        simulation.step()?;
        if effort.note(step).is_break() {
            return Err(StudyError::Interrupted);
        }
    }
    let tangents = simulation
        .converged_tangents(&SCALINGS.map(|Compared { by, equilibrated, .. }| ScalingChoice {
            by,
            equilibrated,
            ..choice
        }))
        .ok_or(StudyError::NotDynamic)?;
    let structure = simulation.system().structure();
    let conditions: Vec<_> = tangents.iter().map(|tangent| tangent.condition(structure)).collect();
    Ok(Measured {
        conditions: std::array::from_fn(|k| conditions[k].value),
        method: conditions[0].method,
        unknowns: simulation.system().layout().size(),
        end: simulation.state().kinematics.time,
        is_shortened,
    })
}

impl Table {
    /// As comma-separated values: `step_size`, the path of the varied value, a column for each scaling, `method`,
    /// `end`. Failed runs have `NaN`.
    pub fn csv(&self) -> String {
        let mut heading = vec!["step_size"];
        heading.extend(self.path.as_deref());
        heading.extend(SCALINGS.map(|compared| compared.name));
        heading.extend(["method", "end"]);
        let mut text = csv_line(heading);
        for row in &self.rows {
            let mut fields = vec![row.step.clone()];
            fields.extend(row.varied.clone());
            if let Ok(measured) = &row.outcome {
                fields.extend(measured.conditions.map(|value| format!("{value:e}")));
                fields.extend([measured.method.name().to_owned(), measured.end.to_string()]);
            } else {
                fields.extend(SCALINGS.map(|_| "NaN".to_owned()));
                fields.extend(["failed", "NaN"].map(str::to_owned));
            }
            text += &csv_line(fields.iter().map(String::as_str));
        }
        text
    }

    /// The drawing: over the step size, or over the varied value if there is only one step size.
    pub fn figure(&self, title: &str) -> LogFigure {
        let one_step = self.rows.iter().all(|row| row.step == self.rows[0].step);
        let over_value = self.path.is_some() && one_step;
        let mut curves: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
        for row in &self.rows {
            let Ok(measured) = &row.outcome else { continue };
            let varied = row.varied.as_deref().unwrap_or_default();
            let x = if over_value { varied.parse().unwrap_or(f64::NAN) } else { row.step_size };
            for (compared, value) in SCALINGS.iter().zip(measured.conditions) {
                let name = match &self.path {
                    Some(_) if !over_value => format!("{}, {varied}", compared.label),
                    _ => compared.label.to_owned(),
                };
                match curves.iter_mut().find(|curve| curve.0 == name) {
                    Some(curve) => curve.1.push((x, value)),
                    None => curves.push((name, vec![(x, value)])),
                }
            }
        }
        let x_label = match &self.path {
            Some(path) if over_value => path.clone(),
            _ => "step size [s]".to_owned(),
        };
        LogFigure {
            name: "conditioning".to_owned(),
            title: title.to_owned(),
            x_label,
            y_label: "condition number of the tangent [-]".to_owned(),
            curves,
            guides: Vec::new(),
        }
    }
}
