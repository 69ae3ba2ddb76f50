//! Effects of scaling, augmented term and pivoting on the first step of a model.

use crate::start::{Lowered, lower};
use lissom_core::simulation::Simulation;
use lissom_core::studies::factorization::{Case, factorization_study};

use super::{StudyError, csv_line};
use crate::model_text::Model;

/// All combinations on one model.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Unknowns of the tangent.
    pub unknowns: usize,
    /// Step size [s].
    pub step_size: f64,
    /// Name of the scheme.
    pub scheme: String,
    /// One row each.
    pub cases: Vec<Case>,
}

/// Tries every combination of scaling, augmented term and solver on the first step.
///
/// # Errors
/// If the model is invalid or has no consistent initial values.
pub fn study(model: &Model) -> Result<Table, StudyError> {
    let Lowered { system, state, settings, .. } = lower(&model.document()?)?;
    let scheme = settings.scheme.name.clone();
    let step_size = settings.step_size;
    let simulation = Simulation::new(system, state, settings)?;
    let cases = factorization_study(&simulation);
    Ok(Table { unknowns: simulation.system().layout().size(), step_size, scheme, cases })
}

impl Table {
    /// As comma-separated values. Without factors, `stops_at` names the unknown and numbers are omitted.
    pub fn csv(&self) -> String {
        let mut text = csv_line([
            "scaling",
            "augmented",
            "solver",
            "factors",
            "stops_at",
            "relative_pivot",
            "smallest_pivot",
            "growth",
            "coordinate_error",
            "multiplier_error",
            "backward_error",
            "errors_known",
            "iterations",
            "update",
            "residual",
            "violation",
        ]);
        for case in &self.cases {
            let mut fields =
                vec![scaling_name(case).to_owned(), case.augmented.to_string(), case.solver.to_owned()];
            match &case.outcome {
                Err(stopped) => {
                    fields.extend(["false".to_owned(), stopped.unknown.clone()]);
                    fields.resize(16, String::new());
                }
                Ok(factored) => {
                    let newton = &factored.newton;
                    fields.extend(["true".to_owned(), newton.stopped_at.clone().unwrap_or_default()]);
                    fields.push(format!("{:e}", factored.report.relative_pivot()));
                    fields.push(factored.smallest_pivot.clone());
                    let errors = [
                        factored.report.growth,
                        factored.coordinate_error,
                        factored.multiplier_error,
                        factored.backward_error,
                    ];
                    fields.extend(errors.map(|value| format!("{value:e}")));
                    fields.extend([factored.errors_known.to_string(), newton.iterations.to_string()]);
                    let attained = [newton.update, newton.residual, newton.violation];
                    fields.extend(attained.map(|value| format!("{value:e}")));
                }
            }
            text += &csv_line(fields.iter().map(String::as_str));
        }
        text
    }
}

/// Name of a case's scaling in tables.
pub fn scaling_name(case: &Case) -> &'static str {
    if case.equilibrated { "equilibrated" } else { case.scaling.name() }
}
