//! Derivatives of an output with respect to numbers of the model file, along the steps of a run.

mod confirmation;
mod method;
mod output_history;
mod runs;

use lissom_core::diagnostics::{Diagnose, Diagnostic};
use std::fmt::Write;

use lissom_core::diagnostics::{Entry, Severity};
use lissom_core::errors::{InitialError, StepError};
use lissom_core::kinematics::Switch;
use lissom_core::number::Written;
use lissom_core::schemes::Parametrization;
use lissom_model::document::AnalysisKind;
use lissom_model::{Document, Report};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::analyses::interface::{Analysis, AnalysisError, AnalysisReport, Origin};
use crate::command_error::CommandError;
use crate::model_text::Model;
use crate::session::{Session, SessionError};
use crate::start::reject_units;
pub use confirmation::Confirmation;
use confirmation::{DirectDerivative, confirm};
use method::{ParameterSensitivities, Question};
use output_history::OutputHistory;
use runs::by_runs;

/// Upper bound of Newton's tolerance: the remaining error is divided by the distance of the neighbours.
const TOLERANCE: f64 = 1e-12;

/// Compute derivatives of an output with respect to numbers of the model file.
///
/// The results go to a folder: `gradient.csv` (path, number, derivative) and `summary.json`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom gradient examples/pendulum.toml --of bob.x@0.5 --by point_masses.bob.mass,springs.spring.stiffness
  lissom gradient examples/tip-crank.toml --of midspan.u3@max --by materials.steel.E

Exit code: 0 success; 2 wrong model or command line; 3 no solution.")
)]
pub struct GradientRequest {
    /// Output column, and a scalar derived from it: `tip.u3` (at the end), `tip.u3@0.5` (at a time), `tip.u3@max`, `tip.u3@rms`.
    #[cfg_attr(feature = "clap", arg(long, visible_alias = "output", value_name = "OUTPUT[@TIME|max|rms]"))]
    pub of: String,
    /// Paths of numbers in the model file, such as `bodies.top.mass,springs.s.stiffness`.
    #[cfg_attr(
        feature = "clap",
        arg(long, visible_alias = "vary", value_name = "PATH,…", value_delimiter = ',', required = true)
    )]
    pub by: Vec<String>,
    /// Skip the run with perturbed numbers that verifies the derivatives.
    #[cfg_attr(feature = "clap", arg(long, display_order = 901))]
    pub unconfirmed: bool,
}

impl Analysis for GradientRequest {
    const NAME: &'static str = "gradient";
    type Report = GradientReport;
    type Error = GradientError;

    fn compute(&self, model: &Model) -> Result<GradientReport, GradientError> {
        let target =
            self.of.parse().map_err(|reason| GradientError::Target(CommandError::Request(reason)))?;
        let report = gradient(model, &target, &self.by, !self.unconfirmed)?;
        Ok(GradientReport { of: self.of.clone(), ..report })
    }
}

/// The scalar of an output that is differentiated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// Value of the output at the end.
    End,
    /// Value of the output at this time [s].
    Time(f64),
    /// Largest value of the output over all steps.
    Max,
    /// The root of the mean of its square over time.
    Rms,
}

/// An output's column and the scalar of it that is differentiated, such as `tip.u3@max`.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Name of the column.
    pub column: String,
    /// The scalar.
    pub measure: Measure,
}

impl std::str::FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (column, measure) = text.split_once('@').unwrap_or((text, "end"));
        let measure = match measure.trim() {
            "end" => Measure::End,
            "max" => Measure::Max,
            "rms" => Measure::Rms,
            time => match time.parse::<f64>() {
                Ok(time) if time.is_finite() => Measure::Time(time),
                _ => return Err(format!("`{time}` is neither a time in seconds nor `max`, `rms` or `end`")),
            },
        };
        Ok(Self { column: column.trim().to_owned(), measure })
    }
}

/// Why derivatives were not found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum GradientError {
    /// The model is invalid, or becomes invalid if a number is changed slightly.
    #[error(transparent)]
    Model(#[from] Report),
    /// There are no consistent initial values.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// A step has no solution, or a neighbouring model's has none.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The scalar is unknown.
    #[error(transparent)]
    Target(CommandError),
    /// The model has no such column.
    Column {
        /// The given name.
        name: String,
        /// The existing columns.
        known: String,
    },
    /// There is no such number.
    Number(String),
    /// The time is outside the analysis.
    Time {
        /// The time [s].
        time: f64,
        /// First time of the analysis [s].
        start: f64,
        /// Last time [s].
        end: f64,
    },
    /// The analysis has no steps.
    NotInTime(&'static str),
    /// A neighbouring model has different unknowns.
    Unlike(String),
    /// A function of time has its kinks at different times in a neighbouring model.
    KinkMoves {
        /// Path of the number.
        path: String,
        /// The kink [s].
        time: f64,
    },
    /// Loads depend on the motion, or signals are sampled.
    Feedback,
    /// A step was subdivided.
    InParts(f64),
    /// Differences of runs depend on their distance.
    NotSmooth {
        /// Path of the number.
        path: String,
    },
    /// Runs of neighbouring models contradict the derivatives.
    Denied {
        /// Change predicted by the derivatives, in the unit of the output.
        expected: f64,
        /// Change between the runs.
        found: f64,
    },
}

impl AnalysisError for GradientError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::Model(report) => Origin::Model(report),
            Self::Target(_)
            | Self::Column { .. }
            | Self::Number(_)
            | Self::Time { .. }
            | Self::NotInTime(_)
            | Self::Unlike(_)
            | Self::KinkMoves { .. }
            | Self::Feedback => Origin::Request,
            _ => Origin::Computation,
        }
    }
}

impl From<SessionError> for GradientError {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Model(report) => Self::Model(report),
            SessionError::Initial(error) => Self::Initial(error),
            SessionError::NotInTime(kind) => Self::NotInTime(kind),
        }
    }
}

/// A derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivative {
    /// Path of the number.
    pub path: String,
    /// The number.
    pub number: f64,
    /// Derivative of the measure by it.
    pub value: f64,
    /// Method by which it was found.
    pub method: Method,
}

/// Method by which a derivative was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Direct differentiation along the steps.
    Direct,
    /// Neighbouring models with the same steps.
    Neighbours,
    /// Comparison of whole runs, because forces switch during the run.
    Runs,
}

impl Method {
    /// Name of the method in `summary.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "carried",
            Self::Neighbours => "neighbours",
            Self::Runs => "runs",
        }
    }
}

/// Derivatives of a measure of an output.
#[derive(Clone, Debug)]
pub struct GradientReport {
    /// The measure, as requested.
    pub of: String,
    /// The measure's own value.
    pub value: f64,
    /// Time of the value, or of the largest one [s]; none for a mean.
    pub time: Option<f64>,
    /// Derivatives of the value, in the requested order.
    pub derivatives: Vec<Derivative>,
    /// Steps of the run.
    pub steps: usize,
    /// Corrections of derivatives over all steps, and of neighbouring models.
    pub corrections: usize,
    /// Verification of direct derivatives by whole runs; none if there are none, or if it was not requested.
    pub confirmation: Option<Confirmation>,
}

/// Derivatives of `target` with respect to the numbers at `paths` of `model`. If `confirms`, direct
/// derivatives are compared with a run of a neighbouring model.
///
/// # Errors
/// If the request is invalid for the model, a step has no solution, or runs contradict the derivatives.
pub fn gradient(
    model: &Model,
    target: &Target,
    paths: &[String],
    confirms: bool,
) -> Result<GradientReport, GradientError> {
    let document = prepared(model, target)?;
    reject_units(&document)?;
    let mut session = Session::new(&document)?;
    let system = session.simulation().system();
    let is_dynamic = matches!(document.analysis.kind, AnalysisKind::Dynamics { .. });
    let has_samples = system.signals().has_samples() || !system.signals().delays().is_empty();
    // The derivatives of its steps are not available.
    let is_inertial = session.simulation().settings().scheme.parametrization == Parametrization::Inertial;
    let is_direct =
        !(is_inertial || system.has_feedback() || has_samples) && system.signals().events().is_empty();
    // Restitution and friction of contacts are events and states, which whole runs include.
    let has_contacts = is_dynamic && !document.contacts.is_empty() && document.events.is_empty();
    if !(is_direct || (has_contacts || is_inertial) && !has_samples) {
        return Err(GradientError::Feedback);
    }
    let Some(column) = crate::Column::named(session.columns(), &target.column) else {
        let known: Vec<String> = session.columns().iter().map(crate::Column::name).collect();
        return Err(GradientError::Column { name: target.column.clone(), known: known.join(", ") });
    };
    let question = Question { model, target, document: &document, session: &session };
    if !is_direct {
        let numbers = paths.iter().map(|path| Ok((path.clone(), question.number(path)?)));
        let numbers = numbers.collect::<Result<_, GradientError>>()?;
        return across_switches((model, target), column, numbers);
    }
    let mut sensitivities = ParameterSensitivities::new(&question, paths)?;
    let mut history = OutputHistory::new(target.measure);
    history.note(&session, column, &mut |column| sensitivities.derivatives(&session, column));
    let mut switches = Switches::default();
    switches.have_changed(&session);
    while !session.is_finished() {
        session.advance()?;
        // Equilibria are independent of the path to them.
        if is_dynamic && switches.have_changed(&session) {
            let numbers =
                sensitivities.into_numbers().0.into_iter().map(|(path, number, _)| (path, number)).collect();
            return across_switches((model, target), column, numbers);
        }
        sensitivities.advance(&mut session)?;
        history.note(&session, column, &mut |column| sensitivities.derivatives(&session, column));
    }
    let (value, time, derivatives) = history.measured();
    let steps = history.steps();
    let (numbers, corrections) = sensitivities.into_numbers();
    let derivatives: Vec<Derivative> = numbers
        .into_iter()
        .zip(derivatives)
        .map(|((path, number, is_carried), value)| {
            let method = if is_carried { Method::Direct } else { Method::Neighbours };
            Derivative { path, number, value, method }
        })
        .collect();
    let confirmation = if confirms {
        confirmed((model, target), column, (value, history.largest()), &derivatives)?
    } else {
        None
    };
    Ok(GradientReport { of: String::new(), value, time, derivatives, steps, corrections, confirmation })
}

/// Signs of the switching functions of forces with kinks or jumps.
#[derive(Default)]
struct Switches {
    sides: Vec<f64>,
    values: Vec<Switch>,
}

impl Switches {
    /// Whether a force has switched since the last call.
    fn have_changed(&mut self, session: &Session) -> bool {
        let simulation = session.simulation();
        self.values.clear();
        simulation.system().switches(&simulation.state().kinematics, &mut self.values);
        self.sides.resize(self.values.len(), 0.0);
        let mut have_changed = false;
        for (side, value) in self.sides.iter_mut().zip(&self.values) {
            let own = value.side();
            have_changed |= *side != 0.0 && *side != own;
            *side = own;
        }
        have_changed
    }
}

/// The request: model and target.
type Asked<'a> = (&'a Model, &'a Target);

/// Maximum error of a step in runs that are compared.
const TOLERANCE_OF_RUNS: f64 = 1e-9;

/// A run with other values of the numbers at `paths`.
fn run(
    (model, target): Asked<'_>,
    values: impl Iterator<Item = (String, f64)>,
    column: usize,
    tolerance: Option<f64>,
) -> Result<OutputHistory, GradientError> {
    let changed = values.fold(model.clone(), |model, (path, value)| model.with(&path, value));
    let mut document = prepared(&changed, target)?;
    if let (AnalysisKind::Dynamics { control: Some(control), .. }, Some(tolerance)) =
        (&mut document.analysis.kind, tolerance)
    {
        control.relative_tolerance = control.relative_tolerance.min(tolerance);
    }
    reject_units(&document)?;
    let mut session = Session::new(&document)?;
    let mut history = OutputHistory::new(target.measure);
    let mut nothing = |_| Vec::new();
    history.note(&session, column, &mut nothing);
    while !session.is_finished() {
        session.advance()?;
        history.note(&session, column, &mut nothing);
    }
    Ok(history)
}

/// Derivatives of a measure with respect to numbers, if forces switch during the run.
fn across_switches(
    asked: Asked<'_>,
    column: usize,
    numbers: Vec<(String, f64)>,
) -> Result<GradientReport, GradientError> {
    let tolerance = Some(TOLERANCE_OF_RUNS);
    let own = run(asked, std::iter::empty(), column, tolerance)?;
    let (value, time, _) = own.measured();
    let (mut derivatives, mut missed, mut runs) = (Vec::new(), 0.0_f64, 0);
    for (path, number) in numbers {
        let mut measure = |value: f64| {
            let changed = std::iter::once((path.clone(), value));
            Ok(run(asked, changed, column, tolerance)?.measured().0)
        };
        let found = by_runs(&path, number, own.largest(), &mut measure)?;
        missed = missed.max(found.missed);
        runs += found.runs;
        derivatives.push(Derivative { path, number, value: found.value, method: Method::Runs });
    }
    Ok(GradientReport {
        of: String::new(),
        value,
        time,
        derivatives,
        steps: own.steps(),
        corrections: 0,
        confirmation: Some(Confirmation::Confirmed { missed, runs }),
    })
}

/// Compares derivatives with runs of neighbouring models.
fn confirmed(
    asked: Asked<'_>,
    column: usize,
    values: (f64, f64),
    derivatives: &[Derivative],
) -> Result<Option<Confirmation>, GradientError> {
    let carried: Vec<DirectDerivative> =
        derivatives.iter().map(|of| DirectDerivative { number: of.number, derivative: of.value }).collect();
    let mut measure = |changes: &[f64]| {
        let changed =
            derivatives.iter().zip(changes).map(|(of, change)| (of.path.clone(), of.number + change));
        Ok(run(asked, changed, column, None)?.measured().0)
    };
    confirm(&carried, values, &mut measure).map(Some)
}

/// Number of load steps if the model does not specify it.
const LOAD_STEPS: usize = 10;

/// The document of a run up to the requested time.
fn prepared(model: &Model, target: &Target) -> Result<Document, GradientError> {
    let mut document = model.document()?;
    let analysis = &mut document.analysis;
    if !matches!(analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. }) {
        return Err(GradientError::NotInTime(analysis.kind.name()));
    }
    analysis.tolerance = analysis.tolerance.min(TOLERANCE);
    if let AnalysisKind::Statics { steps, .. } = &mut analysis.kind {
        // The neighbouring model takes the same steps.
        steps.get_or_insert(LOAD_STEPS);
    }
    if let Measure::Time(time) = target.measure {
        let (start, end) = (analysis.start, analysis.end);
        if !(time > start && time <= end) {
            return Err(GradientError::Time { time, start, end });
        }
        if let AnalysisKind::Statics { steps: Some(steps), .. } = &mut analysis.kind {
            // As many load steps as end there.
            *steps = ((*steps as f64 * (time - start) / (end - start)) - 1e-9).ceil().max(1.0) as usize;
        }
        analysis.end = time;
    }
    Ok(document)
}

/// Entries of the catalogue for derivatives.
pub(crate) const ENTRIES: &[Entry] = &[Entry {
    code: "gradient-unconfirmed",
    variant: "Confirmation",
    severity: Severity::Warning,
    message: "runs of the model with perturbed numbers neither confirm nor refute the derivatives",
    meaning: "The finite-difference check, which runs the model with perturbed parameters, neither confirms nor refutes the derivatives of \
        `lissom gradient`.",
    advice: "The output changes by less than the error of a run, or is not smooth: use another output, or another time.",
}];

impl GradientReport {
    /// The table `gradient.csv`: path, number, derivative.
    pub fn csv(&self) -> String {
        let mut text = "path,number,derivative\n".to_owned();
        for Derivative { path, number, value, .. } in &self.derivatives {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{path},{number:?},{value:?}");
        }
        text
    }

    /// A warning about the derivatives, if there is one.
    pub fn doubt(&self) -> Option<Diagnostic> {
        let cause = match self.confirmation {
            Some(Confirmation::Confirmed { .. }) => return None,
            Some(Confirmation::Untold { .. }) => {
                "runs of the model with perturbed numbers neither confirm nor refute the derivatives: the output changes by \
                 less than the error of a run, or is not smooth"
            }
            None => "the derivatives were not compared with runs of the model with perturbed numbers",
        };
        Some(Diagnostic::of(&ENTRIES[0], cause, ""))
    }
}

impl AnalysisReport for GradientReport {
    fn tables(&self) -> Vec<(String, String)> {
        vec![("gradient.csv".to_owned(), self.csv())]
    }

    fn add_facts(&self, insert: &mut dyn FnMut(&str, Value)) {
        insert("of", json!(self.of));
        insert("value", json!(self.value));
        insert("time", json!(self.time));
        let derivative = |of: &Derivative| json!({ "path": of.path, "number": of.number, "derivative": of.value, "way": of.method.name() });
        insert("derivatives", self.derivatives.iter().map(derivative).collect());
        insert("steps", json!(self.steps));
        insert("corrections", json!(self.corrections));
        let confirmed = |of: &Confirmation| match of {
            Confirmation::Confirmed { missed, runs } => json!({ "missed": missed, "runs": runs }),
            Confirmation::Untold { runs } => json!({ "missed": null, "runs": runs }),
        };
        insert("confirmed", self.confirmation.as_ref().map_or(Value::Null, confirmed));
    }

    fn warnings(&self) -> Vec<Diagnostic> {
        self.doubt().into_iter().collect()
    }

    fn text(&self, time: &str) -> String {
        let at = self.time.map_or_else(String::new, |time| format!(" at t = {} s", Written(time)));
        let mut text = format!(
            "  {} = {:.9e}{at}, {} steps, {} corrections, {time}\n",
            self.of,
            Written(self.value),
            self.steps,
            self.corrections
        );
        for Derivative { path, number, value, .. } in &self.derivatives {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  by {path} = {}: {:.9e}", Written(*number), Written(*value));
        }
        if let Some(Confirmation::Confirmed { missed, runs }) = &self.confirmation {
            let missed = Written(*missed);
            let _ = writeln!(text, "  verified to {missed:.1e} by {runs} run(s) with all numbers perturbed");
        }
        text
    }
}
