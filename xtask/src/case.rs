//! Contents of a `case.toml`: models to run, comparisons, and their tolerances. Runs
//! nothing.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lissom::{Model, Override};
use serde::Deserialize;

/// A case that cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CaseError {
    /// A file cannot be read.
    #[error("{path}: {reason}")]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
    /// The case contradicts itself.
    #[error("case `{case}`: {reason}")]
    Wrong {
        /// Name of the case.
        case: String,
        /// The error.
        reason: String,
    },
}

/// One verification case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    /// Folder name.
    #[serde(skip)]
    pub(crate) name: String,
    /// Folder.
    #[serde(skip)]
    pub(crate) folder: PathBuf,
    /// One line.
    pub(crate) title: String,
    /// Rigid, statics, dynamics or invariants: where it is in the report.
    pub(crate) group: String,
    /// Source of the problem and of the reference digits.
    pub(crate) source: String,
    /// Whether it is part of `--quick`.
    #[serde(default)]
    pub(crate) quick: bool,
    /// A file below the folder of references without which the case is skipped.
    pub(crate) needs: Option<String>,
    /// How good the reference is, relative to the scale of its comparisons.
    pub(crate) uncertainty: Option<f64>,
    /// Times of other programs, in a sentence with their source.
    pub(crate) times: Option<String>,
    /// Why the whole case cannot be run yet.
    pub(crate) open: Option<String>,
    /// Findings: differences from a reference, and which one is correct.
    #[serde(default)]
    pub(crate) findings: Vec<String>,
    /// Model files with their changes, by name; `main` if none is named.
    #[serde(default)]
    pub(crate) runs: BTreeMap<String, Run>,
    /// Values compared.
    #[serde(default)]
    pub(crate) quantity: Vec<Quantity>,
    /// Curves compared.
    #[serde(default)]
    pub(crate) curve: Vec<Curve>,
    /// Families of meshes or steps.
    #[serde(default)]
    pub(crate) refinement: Vec<Refinement>,
    /// Checks over the project's examples.
    #[serde(default)]
    pub(crate) invariant: Vec<Invariant>,
    /// Warnings that its runs must report; any other fails the case.
    #[serde(default)]
    pub(crate) warns: Vec<Expected>,
}

/// A warning that is right.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expected {
    /// A part of its words.
    pub(crate) says: String,
    /// Why it is right.
    pub(crate) because: String,
}

/// A model and its changes.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Run {
    /// File in the case's folder; `model.toml` if it is not given.
    pub(crate) model: Option<String>,
    /// Elements of the blade in the file that the case `needs`; the model is its tables and this file together.
    pub(crate) blade: Option<usize>,
    /// Paths in the model and their new values.
    #[serde(default)]
    pub(crate) set: BTreeMap<String, toml::Value>,
}

impl Run {
    /// The model's file.
    pub(crate) fn path(&self, folder: &Path) -> PathBuf {
        folder.join(self.model.as_deref().unwrap_or("model.toml"))
    }

    /// The model.
    pub(crate) fn model(&self, folder: &Path) -> Result<Model, CaseError> {
        let path = self.path(folder);
        Model::read(&path).map_err(|error| CaseError::Unreadable {
            path: path.display().to_string(),
            reason: error.to_string(),
        })
    }
    /// Changes, and further changes after them.
    pub(crate) fn overrides(&self, further: &BTreeMap<String, toml::Value>) -> Vec<Override> {
        let mut all = self.set.clone();
        all.extend(further.iter().map(|(path, value)| (path.clone(), value.clone())));
        all.into_iter().map(|(path, value)| (path, value.to_string())).collect()
    }
}

/// How a number is found from a run.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Measure {
    /// Value at the time `at`.
    #[default]
    Value,
    /// Largest value from `from` on.
    Maximum,
    /// Largest less smallest value from `from` on.
    Range,
    /// Mean of largest and smallest value from `from` on.
    Middle,
    /// Circular frequency [rad/s] from the crossings of the middle, from `from` on.
    Frequency,
    /// Load (time) at which the value grows beyond all bounds: root of the inverse as a parabola in the square of the
    /// time, through the last three records; for symmetric problems.
    Divergence,
    /// Load at which the value grows beyond all bounds, from a parabola in the time itself.
    DivergenceOneSided,
    /// Largest `load` over the value, where the curve through the last four records turns: a limit point.
    Limit,
    /// Largest violation of a constraint over all records, from positions [m, rad].
    Violation,
    /// Whether the run reaches its end: 1 or 0.
    Completes,
}

/// One number to compare, or several of a kind of which the worst is reported.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Quantity {
    /// In words.
    pub(crate) name: String,
    /// Run; `main` if it is not given.
    pub(crate) run: Option<String>,
    /// Formula over columns, with `tip_x` for the component `x` of the output `tip`.
    pub(crate) value: Option<String>,
    /// How it is measured.
    #[serde(default)]
    pub(crate) measure: Measure,
    /// Formula of the load, for limit points.
    pub(crate) load: Option<String>,
    /// When; the end if it is not given.
    pub(crate) at: Option<f64>,
    /// From when on, for measures over a stretch of time.
    pub(crate) from: Option<f64>,
    /// Expected value.
    pub(crate) reference: Option<f64>,
    /// Several, instead of `at`, `value` and `reference`: time, formula, reference.
    #[serde(default)]
    pub(crate) entries: Vec<(f64, String, f64)>,
    /// Allowed difference over `scale`.
    pub(crate) tolerance: f64,
    /// Divisor of differences; default: the largest reference.
    pub(crate) scale: Option<f64>,
    /// Why the tolerance is wider than the reference's uncertainty.
    pub(crate) because: Option<String>,
    /// Why it may fail for now.
    pub(crate) open: Option<String>,
    /// Whom it is compared with, if not with the source.
    pub(crate) against: Option<String>,
    /// How good the reference is, over `scale`; the case's where it is not given.
    pub(crate) uncertainty: Option<f64>,
}

/// Curves to compare, drawn over each other.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Curve {
    /// In words; also the name of the plot.
    pub(crate) name: String,
    /// Run; `main` if it is not given.
    pub(crate) run: Option<String>,
    /// Formulas over columns.
    pub(crate) values: Vec<String>,
    /// Names in the plot.
    pub(crate) labels: Vec<String>,
    /// Unit of all.
    #[serde(default)]
    pub(crate) unit: String,
    /// Comma-separated reference in the case's folder; without it the curve is only drawn.
    pub(crate) file: Option<String>,
    /// Columns of the reference, counted from 0, the time being 0.
    #[serde(default)]
    pub(crate) columns: Vec<usize>,
    /// Compared up to here.
    pub(crate) until: Option<f64>,
    /// Allowed difference over `scale`.
    pub(crate) tolerance: Option<f64>,
    /// Divisor of differences; default: the largest reference value.
    pub(crate) scale: Option<f64>,
    /// Why the tolerance is wider than the reference's uncertainty.
    pub(crate) because: Option<String>,
    /// Why it may fail for now.
    pub(crate) open: Option<String>,
    /// Whom it is compared with, if not with the source.
    pub(crate) against: Option<String>,
    /// How good the reference is, over `scale`; the case's where it is not given.
    pub(crate) uncertainty: Option<f64>,
}

/// A family of meshes or steps of one run, each half as fine as the next unless `ratio` is given.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Refinement {
    /// In words, such as `mesh, 4-node elements`.
    pub(crate) name: String,
    /// Run; `main` if it is not given.
    pub(crate) run: Option<String>,
    /// From coarse to fine.
    pub(crate) levels: Vec<BTreeMap<String, toml::Value>>,
    /// How much finer each is than the one before.
    #[serde(default = "two")]
    pub(crate) ratio: f64,
    /// Formulas over columns whose vector is followed.
    pub(crate) values: Vec<String>,
    /// When; the end if it is not given.
    pub(crate) at: Option<f64>,
    /// Exact values; default: those of the finest level.
    #[serde(default)]
    pub(crate) reference: Vec<f64>,
    /// Minimum observed order.
    pub(crate) order: f64,
    /// Errors below this, relative to the largest value, are round-off.
    #[serde(default = "round_off")]
    pub(crate) floor: f64,
    /// Why it may fail for now.
    pub(crate) open: Option<String>,
}

/// Changes that must not affect a result.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Change {
    /// The parts are in reverse order in the file.
    Order,
    /// The whole model is turned in space.
    Turned,
    /// Millimetres and tonnes instead of metres and kilograms.
    Units,
    /// Four runs at the same time, in a thread each: not a bit may change.
    Threads,
}

/// A change to a model that must not change its results.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Invariant {
    /// File in the folder of examples, without its ending, or the name of a case, as in `case/heavy-top`.
    pub(crate) example: String,
    /// Kind of change.
    pub(crate) change: Change,
    /// Compared up to here [s].
    pub(crate) end: f64,
    /// Allowed relative difference.
    pub(crate) tolerance: f64,
    /// Why it is not zero.
    pub(crate) because: Option<String>,
    /// Why it may fail for now.
    pub(crate) open: Option<String>,
}

fn two() -> f64 {
    2.0
}

fn round_off() -> f64 {
    1e-11
}

impl Case {
    /// Reads the case in `folder`.
    pub(crate) fn read(folder: &Path) -> Result<Self, CaseError> {
        let path = folder.join("case.toml");
        let unreadable = |reason: String| CaseError::Unreadable { path: path.display().to_string(), reason };
        let text = std::fs::read_to_string(&path).map_err(|error| unreadable(error.to_string()))?;
        let mut case: Self = toml::from_str(&text).map_err(|error| unreadable(error.to_string()))?;
        case.name = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        folder.clone_into(&mut case.folder);
        if case.runs.is_empty() {
            case.runs.insert("main".to_owned(), Run::default());
        }
        case.check()?;
        Ok(case)
    }

    /// A complaint about this case.
    pub(crate) fn wrong(&self, reason: impl Into<String>) -> CaseError {
        CaseError::Wrong { case: self.name.clone(), reason: reason.into() }
    }

    /// The run called `name`.
    pub(crate) fn run(&self, name: Option<&str>) -> Result<&Run, CaseError> {
        let name = name.unwrap_or("main");
        self.runs.get(name).ok_or_else(|| self.wrong(format!("there is no run `{name}`")))
    }

    fn check(&self) -> Result<(), CaseError> {
        let named = (self.quantity.iter().map(|quantity| &quantity.run))
            .chain(self.curve.iter().map(|curve| &curve.run))
            .chain(self.refinement.iter().map(|refinement| &refinement.run));
        for name in named {
            self.run(name.as_deref())?;
        }
        for curve in &self.curve {
            let lengths = [
                curve.labels.len(),
                if curve.file.is_some() { curve.columns.len() } else { curve.values.len() },
            ];
            if lengths.iter().any(|length| *length != curve.values.len()) {
                return Err(self
                    .wrong(format!("curve `{}`: values, labels and columns differ in number", curve.name)));
            }
        }
        self.check_tolerances()?;
        for refinement in &self.refinement {
            if refinement.levels.len() < 3 && refinement.reference.is_empty() || refinement.levels.len() < 2 {
                return Err(self.wrong(format!("refinement `{}` has too few levels", refinement.name)));
            }
            if !refinement.reference.is_empty() && refinement.reference.len() != refinement.values.len() {
                return Err(self.wrong(format!("refinement `{}`: one reference per value", refinement.name)));
            }
        }
        Ok(())
    }

    /// Every comparison states the accuracy of its reference, and every larger tolerance its reason.
    fn check_tolerances(&self) -> Result<(), CaseError> {
        let quantities = self
            .quantity
            .iter()
            .filter(|quantity| quantity.measure != Measure::Completes)
            .map(|row| (&row.name, row.tolerance, row.uncertainty, &row.because));
        let curves =
            self.curve.iter().filter(|curve| curve.file.is_some()).map(|row| {
                (&row.name, row.tolerance.unwrap_or(f64::INFINITY), row.uncertainty, &row.because)
            });
        let invariants =
            self.invariant.iter().map(|row| (&row.example, row.tolerance, Some(0.0), &row.because));
        for (name, tolerance, uncertainty, because) in quantities.chain(curves).chain(invariants) {
            let Some(uncertainty) = uncertainty.or(self.uncertainty) else {
                return Err(self.wrong(format!("`{name}` does not say how good its reference is")));
            };
            let words = because.as_deref().map_or(0, |words| words.split_whitespace().count());
            if tolerance > uncertainty && words < FEWEST_WORDS {
                return Err(self.wrong(format!(
                    "`{name}` allows {tolerance:e}, more than its reference's {uncertainty:e}, and does not say why"
                )));
            }
        }
        Ok(())
    }
}

/// Fewer words than this are no reason.
const FEWEST_WORDS: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    fn case(row: &str) -> Result<(), CaseError> {
        let text = format!(
            "title = \"t\"\ngroup = \"rigid\"\nsource = \"s\"\nuncertainty = 1e-9\n[[quantity]]\nname = \"x\"\n{row}"
        );
        let case: Case = toml::from_str(&text).unwrap();
        case.check_tolerances()
    }

    #[test]
    fn wide_tolerances_need_a_reason() {
        assert!(case("tolerance = 1e-9").is_ok());
        assert!(case("tolerance = 1e-8").is_err());
        assert!(case("tolerance = 1e-8\nbecause = \"as above\"").is_err());
        assert!(case("tolerance = 1e-8\nbecause = \"the error of this step\"").is_ok());
        assert!(case("tolerance = 1e-8\nuncertainty = 1e-7").is_ok());
    }
}
