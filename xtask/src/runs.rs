//! Runs of models, each performed once. Independent of references.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::{Duration, Instant};

use lissom::analyses::modes::ModeRequest;
use lissom::{Document, Model, Override, Record};
use lissom_model::document::AnalysisKind;
use lissom_model::output::Column;

use crate::blade;
use crate::case::{Case, Run};

/// Result of a run.
pub(crate) struct Finished {
    /// The record.
    pub(crate) record: Record,
    /// Why it ended early, if it did.
    pub(crate) failure: Option<String>,
    /// How long it took.
    pub(crate) wall: Duration,
    /// Largest violation of a constraint [m, rad].
    pub(crate) violation: f64,
    /// Mesh and step, in words.
    pub(crate) grid: String,
    /// Warnings of the run.
    pub(crate) warnings: Vec<String>,
}

/// Model and overrides.
type Key = (String, Vec<Override>);

/// Runs by model and overrides.
#[derive(Default)]
pub(crate) struct Runs {
    references: Option<PathBuf>,
    finished: RefCell<BTreeMap<Key, Rc<Finished>>>,
}

impl Runs {
    /// No runs yet; data of third parties are in `references`.
    pub(crate) fn new(references: Option<&Path>) -> Self {
        Self { references: references.map(Path::to_owned), ..Self::default() }
    }

    /// The run, made now or before.
    pub(crate) fn get(
        &self,
        case: &Case,
        run: &Run,
        further: &BTreeMap<String, toml::Value>,
    ) -> Result<Rc<Finished>, String> {
        let overrides = run.overrides(further);
        let blade = run.blade.map_or(String::new(), |elements| format!(" with {elements} elements"));
        let key = (format!("{}{blade}", run.model.as_deref().unwrap_or("model.toml")), overrides);
        if let Some(known) = self.finished.borrow().get(&key) {
            return Ok(Rc::clone(known));
        }
        let model = match run.blade {
            None => run.model(&case.folder).map_err(|error| error.to_string())?,
            Some(elements) => self.blade(case, run, elements)?,
        };
        let model = model.with_overrides(&key.1);
        let document = model.document().map_err(|report| report.render(false))?;
        let finished = Rc::new(match document.analysis.kind {
            AnalysisKind::Modes { .. } => modes(&model, &document)?,
            _ => finish(&document)?,
        });
        self.finished.borrow_mut().insert(key, Rc::clone(&finished));
        Ok(finished)
    }

    /// The model of a blade: the case's own tables after those of the blade.
    fn blade(&self, case: &Case, run: &Run, elements: usize) -> Result<Model, String> {
        let (Some(folder), Some(file)) = (&self.references, &case.needs) else {
            return Err("a blade needs a file below the folder of references".to_owned());
        };
        let path = run.path(&case.folder);
        let own = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let tables = blade::tables(&folder.join(file), elements)?;
        Ok(Model::from_text(&path.display().to_string(), &format!("lissom = 1\n\n{tables}{own}")))
    }
    /// Warnings of the runs: description of the run, and the warning.
    pub(crate) fn warnings(&self) -> Vec<(String, String)> {
        let finished = self.finished.borrow();
        let of = |((model, changes), run): (&Key, &Rc<Finished>)| {
            let changed: Vec<String> =
                changes.iter().map(|(path, value)| format!("{path} = {value}")).collect();
            let name = format!("`{model}` {}", changed.join(", "));
            run.warnings.iter().map(|words| (name.clone(), words.clone())).collect::<Vec<_>>()
        };
        finished.iter().flat_map(of).collect()
    }

    /// Time taken by all runs together.
    pub(crate) fn wall(&self) -> Duration {
        self.finished.borrow().values().map(|run| run.wall).sum()
    }
}

/// Runs a document to its end.
pub(crate) fn finish(document: &Document) -> Result<Finished, String> {
    let began = Instant::now();
    let mut session = lissom::Session::new(document).map_err(|error| error.to_string())?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let of_document = document.warnings.problems().map(|problem| problem.message.clone());
    let warnings = of_document.chain(session.warnings().map(ToString::to_string)).collect();
    Ok(Finished {
        warnings,
        failure: report.error().map(|error| format!("at {}: {error}", report.time)),
        violation: report.violation,
        record,
        wall: began.elapsed(),
        grid: grid(document),
    })
}

/// Natural modes as a record: their number in the place of time, `mode_frequency` [Hz] and `mode_damping`.
fn modes(model: &Model, document: &Document) -> Result<Finished, String> {
    let began = Instant::now();
    let found =
        lissom::analyses::modes::modes(model, &ModeRequest::default()).map_err(|error| error.to_string())?;
    let column = |component: &str, quantity: &str, unit: &str| Column {
        output: "mode".to_owned(),
        plot: "mode".to_owned(),
        component: component.to_owned(),
        quantity: quantity.to_owned(),
        unit: unit.to_owned(),
        fatigue: None,
    };
    let of_document = document.warnings.problems().map(|problem| problem.message.clone());
    Ok(Finished {
        record: Record {
            columns: vec![column("frequency", "frequency", "Hz"), column("damping", "damping ratio", "")],
            times: (1..=found.modes.len()).map(|number| number as f64).collect(),
            values: vec![
                found.modes.iter().map(|mode| mode.frequency).collect(),
                found.modes.iter().map(|mode| mode.damping).collect(),
            ],
        },
        failure: None,
        violation: 0.0,
        wall: began.elapsed(),
        grid: grid(document),
        warnings: of_document.chain(found.warnings.iter().map(ToString::to_string)).collect(),
    })
}

/// Mesh and step in words, such as `8 + 4 × 4 nodes, 50 load steps`.
fn grid(document: &Document) -> String {
    let mut words = Vec::new();
    for order in 1..=3 {
        let mut counts: Vec<usize> = document
            .beams
            .iter()
            .filter(|beam| beam.order == order)
            .map(|beam| beam.elements.value)
            .collect();
        let alike = counts.len() > 3 && counts.iter().all(|count| *count == counts[0]);
        let repeated = if alike { format!("{}·", counts.len()) } else { String::new() };
        counts.truncate(if alike { 1 } else { counts.len() });
        if !counts.is_empty() {
            let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
            words.push(format!("{repeated}{} × {}-node", counts.join("+"), order + 1));
        }
    }
    words.push(match &document.analysis.kind {
        AnalysisKind::Dynamics { step, control } => {
            let scheme =
                document.analysis.scheme.as_ref().map_or("generalized-alpha", |scheme| scheme.value.as_str());
            match control {
                Some(control) => {
                    format!("relative tolerance {} ({scheme})", short(control.relative_tolerance))
                }
                None => format!("h = {} s ({scheme})", short(step.value)),
            }
        }
        AnalysisKind::Statics { steps: Some(steps), .. } => format!("{steps} load steps"),
        AnalysisKind::Statics { steps: None, relative_tolerance } => {
            format!("load steps to a tolerance of {}", short(*relative_tolerance))
        }
        AnalysisKind::Path { end, .. } if document.analysis.vary.is_some() => {
            format!("path to {}", short(*end))
        }
        AnalysisKind::Path { end, .. } => format!("path to load factor {}", short(*end)),
        AnalysisKind::Buckling { count } => format!("{count} buckling load factors"),
        AnalysisKind::Modes { count, .. } => format!("{count} modes"),
    });
    words.join(", ")
}

/// A number in few characters.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        let text = format!("{value:.4}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    let text = format!("{value:.3e}");
    match text.split_once('e') {
        Some((mantissa, exponent)) => {
            format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
        }
        None => text,
    }
}
