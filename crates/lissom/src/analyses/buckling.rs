//! Linear buckling of a model: its equilibria without loads and under them, and the load factors at which the stiffness,
//! interpolated and extrapolated from them, is singular.

use lissom_core::catalogued;
use lissom_core::diagnostics::{Diagnose, Diagnostic};
use lissom_core::interrupt;
use std::fmt::Write;
use std::sync::Arc;

use crate::start::{Lowered, lower};
use lissom_core::linearized::{Buckling, BucklingError, Completeness, LinearError, LinearModel, NodeShape};
use lissom_core::number::Written;
use lissom_core::path::{BranchChoice, EquilibriumPath, PathError, PathSettings};
use lissom_model::Report;
use lissom_model::document::{AnalysisKind, DEFAULT_BUCKLING_COUNT};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::analyses::interface::{Analysis, AnalysisError, AnalysisReport, Origin};
use crate::analyses::modes::shapes_table;
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;

/// First step of the load factor towards one, and maximum number of steps.
const FIRST: f64 = 0.25;
const MAX_STEPS: usize = 500;
/// Rotations under the loads above which the stiffness is not assumed to change in proportion to them [rad].
const LARGE_TURN: f64 = 0.05;
/// Relative errors of load factors, because the stiffness does not change in proportion to the loads, above which a warning is issued, and above
/// which the lowest one is not reported.
const NOTEWORTHY_ERROR: f64 = 0.02;
const MAX_ERROR: f64 = 0.1;

/// Estimate the load factors at which a model buckles, from its stiffness with and without the loads.
///
/// The results go to a folder: `buckling.csv` (number, load factor), `shapes.csv` and `summary.json`. The loads of the model must be
/// smaller than the critical ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Example:
  lissom buckling column.toml --count 3

Exit code: 0 success; 2 wrong model or command line; 3 no equilibrium, loads that already exceed the critical ones, or \
load factors missed.")
)]
pub struct BucklingRequest {
    /// Number of load factors, the lowest first [default: 5].
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_parser = crate::analyses::interface::counts(1..)))]
    pub count: Option<usize>,
}

impl Analysis for BucklingRequest {
    const NAME: &'static str = "buckling";
    type Report = BucklingReport;
    type Error = BucklingRunError;

    fn compute(&self, model: &Model) -> Result<BucklingReport, BucklingRunError> {
        buckling(model, self.count)
    }
}

/// Why load factors were not found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum BucklingRunError {
    /// The model is invalid.
    #[error(transparent)]
    Model(#[from] Report),
    /// The equilibrium under the loads was not reached.
    #[error(transparent)]
    Path(#[from] PathError),
    /// The loads are larger than a critical load.
    AlreadyCritical(f64),
    /// There is no linear model.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// There are no buckling modes.
    #[error(transparent)]
    Buckling(#[from] BucklingError),
    /// Some modes were not found.
    Missing(usize),
    /// The stiffness does not change in proportion to the loads: the lowest load factor, and its relative error.
    NotProportional(f64, f64),
}

impl AnalysisError for BucklingRunError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::Model(report) => Origin::Model(report),
            _ => Origin::Computation,
        }
    }
}

/// Buckling modes of a model, with warnings.
#[derive(Clone, Debug)]
pub struct BucklingReport {
    /// Load factors and shapes.
    pub buckling: Buckling,
    /// Shapes, node by node, in the state without loads.
    pub shapes: Vec<Vec<NodeShape>>,
    /// The requested number.
    pub asked: usize,
    /// Largest rotation of a node under the loads [rad].
    pub turn: f64,
    /// Warnings.
    pub warnings: Vec<AnalysisWarning>,
}

/// The lowest load factors at which `model` buckles: `count` of them, or as many as the model requests.
///
/// # Errors
/// If the model is invalid, its loads are already critical, or load factors were missed.
pub fn buckling(model: &Model, count: Option<usize>) -> Result<BucklingReport, BucklingRunError> {
    let document = model.document()?.under_full_loads();
    let own = match document.analysis.kind {
        AnalysisKind::Buckling { count } => count,
        _ => DEFAULT_BUCKLING_COUNT,
    };
    let asked = count.unwrap_or(own);
    let Lowered { system, state, settings, .. } = lower(&document)?;
    let unloaded = lower(&document.without_loads())?.system;
    let path_settings = PathSettings {
        first: FIRST,
        end: 1.0,
        most_steps: MAX_STEPS,
        branch: BranchChoice::default(),
        scaling: settings.scaling,
        limits: settings.limits,
        solver: settings.solver,
    };
    let path_of = |first: f64, end: f64| {
        let settings = PathSettings { first, end, ..path_settings };
        EquilibriumPath::new(Arc::clone(&unloaded), Arc::clone(&system), state.clone(), settings)
    };
    let mut path = path_of(FIRST, 1.0)?;
    let start = path.state().clone();
    while !path.is_finished() {
        let step = path.advance()?;
        if let Some(point) = step.critical.first() {
            return Err(BucklingRunError::AlreadyCritical(point.load_factor));
        }
    }
    let zero = LinearModel::of(path.unloaded(), &start, settings.solver)?;
    let one = LinearModel::of(path.system(), path.state(), settings.solver)?;
    let buckling = zero.buckling(&one, asked)?;
    let mut warnings = Vec::new();
    let turn = zero.largest_turn(&one);
    if turn > LARGE_TURN {
        warnings.push(AnalysisWarning::LargeRotation { angle: turn });
    }
    check_proportion(&buckling, ([&zero, &one], path_settings), path_of, &mut warnings)?;
    match buckling.completeness {
        Completeness::Missing(missing) => return Err(BucklingRunError::Missing(missing)),
        Completeness::Counted => {}
        Completeness::Unknown | Completeness::NotCounted => warnings.push(if buckling.modes.is_empty() {
            AnalysisWarning::NoLoadFactorFound
        } else {
            AnalysisWarning::LoadFactorUnknown
        }),
    }
    if buckling.completeness == Completeness::Counted {
        let number = buckling.modes.len();
        if number == 0 {
            warnings.push(AnalysisWarning::Stiffening);
        } else if number < asked && (count.is_some() || own != DEFAULT_BUCKLING_COUNT) {
            warnings.push(AnalysisWarning::FewerLoadFactors { wanted: asked, found: number });
        }
    }
    Ok(BucklingReport {
        shapes: buckling.modes.iter().map(|mode| zero.shape_of(&mode.shape)).collect(),
        buckling,
        asked,
        turn,
        warnings,
    })
}

/// Checks whether the stiffness changes in proportion to the loads up to half of the lowest load factor: round-off hides the change under loads that
/// are small beside the critical ones.
fn check_proportion(
    buckling: &Buckling,
    ([zero, one], settings): ([&LinearModel<'_>; 2], PathSettings),
    path_of: impl Fn(f64, f64) -> Result<EquilibriumPath, PathError>,
    warnings: &mut Vec<AnalysisWarning>,
) -> Result<(), BucklingRunError> {
    let Some(lowest) = buckling.modes.first() else { return Ok(()) };
    let estimate = lowest.load_factor;
    // Stiffnesses of loads that follow the motion, such as pressure, are those of the whole load: the critical point itself is looked for.
    let follows = one.system().has_loads_of_motion();
    let end = if follows { (1.0 + MAX_ERROR) * estimate } else { (0.5 * estimate).max(1.0) };
    let mut path = path_of(FIRST * end, end)?;
    let mut halfway = (path.state().clone(), 0.0);
    while !path.is_finished() {
        // An equilibrium that ends or becomes unstable far below the estimate refutes it.
        let critical = path.advance().map(|step| step.critical.first().map(|point| point.load_factor));
        if !matches!(critical, Ok(None)) {
            interrupt::check().map_err(LinearError::from)?;
            let error = critical.ok().flatten().map_or(0.5, |factor| (factor / estimate - 1.0).abs());
            if error > MAX_ERROR {
                return Err(BucklingRunError::NotProportional(estimate, error));
            }
            if error > NOTEWORTHY_ERROR {
                warnings.push(AnalysisWarning::NotProportional { factor: estimate, error });
            }
            return Ok(());
        }
        let distance = |factor: f64| (factor - 0.5 * end).abs();
        if distance(path.load_factor()) < distance(halfway.1) {
            halfway = (path.state().clone(), path.load_factor());
        }
    }
    if follows {
        return Err(BucklingRunError::NotProportional(estimate, 1.0));
    }
    let [halfway_models, end_models] = [&halfway.0, path.state()].map(|state| {
        [path.unloaded(), path.system()].map(|system| LinearModel::of(system, state, settings.solver))
    });
    let [[a, b], [c, d]] = [halfway_models, end_models];
    let (models, at) = ([[&a?, &b?], [&c?, &d?]], [halfway.1, path.load_factor()]);
    let errors = buckling.modes.iter();
    let mut errors = errors.map(|mode| (mode.load_factor, zero.load_factor_error(models, at, mode).abs()));
    match errors.find(|(_, error)| *error > NOTEWORTHY_ERROR) {
        Some((factor, error)) if error > MAX_ERROR && factor <= estimate => {
            Err(BucklingRunError::NotProportional(factor, error))
        }
        Some((factor, error)) => {
            warnings.push(AnalysisWarning::NotProportional { factor, error });
            Ok(())
        }
        None => Ok(()),
    }
}

impl BucklingReport {
    /// The table `buckling.csv`: number from 1 and load factor.
    pub fn csv(&self) -> String {
        let mut text = "mode,load_factor\n".to_owned();
        for (index, mode) in self.buckling.modes.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{},{:?}", index + 1, mode.load_factor);
        }
        text
    }
}

impl AnalysisReport for BucklingReport {
    fn tables(&self) -> Vec<(String, String)> {
        let tables = [("buckling.csv", self.csv()), ("shapes.csv", shapes_table(&self.shapes, false))];
        tables.map(|(name, text)| (name.to_owned(), text)).to_vec()
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("asked", json!(self.asked));
        insert("found", json!(self.buckling.modes.len()));
        insert("completeness", json!(self.buckling.completeness.name()));
        insert("load_factors", self.buckling.modes.iter().map(|mode| json!(mode.load_factor)).collect());
        insert("largest_turn", json!(self.turn));
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.warnings.iter().map(Diagnose::diagnostic).collect()
    }

    fn text(&self, time: &str) -> String {
        let modes = &self.buckling.modes;
        let mut text = format!(
            "  {} load factors ({} requested), {}, {time}\n",
            modes.len(),
            self.asked,
            match self.buckling.completeness {
                Completeness::Counted => "none missed according to a count of pivots",
                _ => "not counted",
            }
        );
        for (index, mode) in modes.iter().enumerate() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {:>4}   {:.9e}", index + 1, Written(mode.load_factor));
        }
        text
    }
}

catalogued! {
    Failure BucklingRunError {
        AlreadyCritical { 0 => load_factor } => "buckling-loads-critical" {
            cause: "the loads of the model exceed a critical load at load factor {load_factor}",
            remedy: "reduce the loads, or follow the equilibrium path by an analysis of kind `path`",
            meaning: "The linear estimate of buckling loads requires an equilibrium under loads below the first critical load.",
        }
        Missing { 0 => missed } => "load-factors-missed" {
            cause: "{missed} of the load factors below the last one were missed, according to the count of negative pivots",
            remedy: "request another `count`",
            meaning: "The search for load factors found fewer of them than the factorisation counts in the interval.",
        }
        NotProportional { 0 => factor, 1 => error } => "buckling-not-proportional" {
            cause: "the stiffness does not change in proportion to the loads: the linear estimate {factor} of the lowest load factor has a relative \
                    error of about {error:.1e}, because the model bends under the loads before it buckles",
            remedy: "follow the equilibrium path by an analysis of kind `path`, or specify loads close to the critical ones",
            meaning: "Deflections before buckling change the stiffness with the square of the loads, but linear buckling extrapolates it in \
                      proportion to the loads. Plates under pressure and beams under transverse loads may have such a load factor although they \
                      never buckle.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Path { 0 => error } => error.diagnostic(),
        Linear { 0 => error } => error.diagnostic(),
        Buckling { 0 => error } => error.diagnostic(),
    }
}
