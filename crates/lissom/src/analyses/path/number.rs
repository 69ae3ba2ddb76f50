//! Models along a path that varies a number of the model file.

use std::sync::Arc;

use crate::start::{Lowered, lower};
use lissom_core::kinematics::{Kinematics, LOCKED};
use lissom_core::path::Family;
use lissom_core::system::{State, System};
use lissom_model::lower::registry::registry;
use lissom_model::numbers::number_at;
use lissom_model::{Document, ModelText, Problem, Report};

use crate::model_text::Model;

/// Positions that differ by less than this, over the size of the model, and angles [rad], are equal.
const SIZE_TOLERANCE: f64 = 1e-9;

/// A model with a varied number.
#[derive(Clone)]
pub(super) struct Varied {
    text: Arc<ModelText>,
    /// Path to the number in the model file.
    pub(super) path: String,
    /// Value of the number in the file.
    pub(super) from: f64,
    /// Positions of the model as it is written.
    start: Arc<Kinematics>,
}

impl Varied {
    /// The number that an analysis of kind `path` varies; none if it varies the load factor.
    pub(super) fn of(model: &Model, document: &Document, start: &State) -> Result<Option<Self>, Report> {
        let Some((path, from)) = varied_number(model, document)? else { return Ok(None) };
        let text = Arc::new(model.model_text()?);
        Ok(Some(Self { text, path, from, start: Arc::new(start.kinematics.clone()) }))
    }

    /// The model with this value of the number.
    pub(super) fn at(&self, value: f64) -> Result<Lowered, Report> {
        let document = self.text.document(&registry(), &[(self.path.clone(), format!("{value:?}"))])?;
        lower(&document)
    }
}

impl Family for Varied {
    fn system(&mut self, value: f64) -> Result<Arc<System>, String> {
        let lowered = self.at(value).map_err(|report| {
            let first = report.problems().next().map(|problem| problem.message.clone());
            first.unwrap_or_else(|| report.to_string())
        })?;
        match moved_where_locked(&lowered, &self.start) {
            None => Ok(lowered.system),
            Some(node) => Err(format!(
                "it moves {node}, but no joint or load can move it along the path: determine its position by a joint, or vary another number"
            )),
        }
    }
}

/// Path and value of the number that an analysis varies; none for the load factor.
///
/// # Errors
/// If there is no such number, it has no effect, or it already has its last value.
pub fn varied_number(model: &Model, document: &Document) -> Result<Option<(String, f64)>, Report> {
    let Some(vary) = &document.analysis.vary else { return Ok(None) };
    let path = vary.value.trim();
    let wrong = |message: String, help: &str| {
        Err(document.report(vec![Problem::error(vary.span, message).help(help.to_owned())]))
    };
    if path.split('.').next().is_some_and(|table| table.trim() == "analysis") {
        return wrong(
            format!("`{path}` belongs to the analysis, not to the model"),
            "vary a number of the model, such as `parameters.height`; without `vary` the load factor is varied",
        );
    }
    let from = match number_at(model.text(), model.overrides(), &document.parameters, path) {
        Ok(from) => from,
        Err(words) => return wrong(words, "name a number of the model file, such as `parameters.height`"),
    };
    if let lissom_model::document::AnalysisKind::Path { end, .. } = document.analysis.kind
        && end == from
    {
        return wrong(
            format!("`{path}` is {from} already, where the path ends"),
            "choose another `end`, or another value to begin with",
        );
    }
    Ok(Some((path.to_owned(), from)))
}

/// A node that is displaced in a locked direction.
fn moved_where_locked(lowered: &Lowered, start: &Kinematics) -> Option<String> {
    let layout = lowered.system.layout();
    let own = &lowered.state.kinematics.nodes;
    let size = own.iter().map(|node| node.frame.position.amax()).fold(f64::MIN_POSITIVE, f64::max);
    for (node, rows) in layout.nodes().map(|node| (node, layout.rows_of_node(node))) {
        let change = own[node].frame.relative_to(&start.nodes[node].frame).logarithm();
        for (k, _) in rows.iter().enumerate().filter(|&(_, &row)| row == LOCKED) {
            let unit = if k < 3 { size } else { 1.0 };
            if change[k].abs() > SIZE_TOLERANCE * unit {
                return Some(layout.node_name(node).to_owned());
            }
        }
    }
    None
}
