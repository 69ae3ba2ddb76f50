//! Natural modes of a model about a state: computes the state, linearises there, and reports the modes in tables.

mod names;
mod report;

use lissom_core::catalogued;
use lissom_core::diagnostics::Diagnose;
use std::collections::BTreeMap;

use crate::start::lower;
use lissom_core::errors::{InitialError, StepError};
use lissom_core::kinematics::Kinematics;
use lissom_core::linearized::{
    Completeness, EffectiveMasses, LinearError, LinearModel, Mode, ModeDeviation, ModeError, ModeKind,
    ModeOptions, Modes, NodeShape, SteadyError,
};
use lissom_model::Report;
use lissom_model::document::AnalysisKind;
use lissom_model::lower::FrictionPoints;
use serde::Deserialize;

use crate::analyses::interface::{Analysis, AnalysisError, Origin};
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;
use crate::session::SessionError;

pub use crate::analyses::operating_point::OperatingPoint;
pub(crate) use report::shapes_table;

/// Number of shapes that are drawn.
const DRAWN: usize = 20;
/// Largest displacement in pictures of shapes, over the model's length, or rotation [rad].
const FAR: f64 = 0.25;

/// A mode with a larger deviation after a rotation of the model belongs to coefficients that are not constant.
const CONSTANT: f64 = 3e-4;
/// Deviations up to this multiple of their round-off are not significant …
const BEYOND_ROUND_OFF: f64 = 30.0;
/// … unless round-off dominates the comparison.
const MAX_ROUND_OFF: f64 = 1e-2;
/// Relative changes of eigenvalues with the azimuth whose effect, of second order, is beyond the digits of a frequency.
const NEGLIGIBLE: f64 = 0.02;

/// Compute natural modes: frequencies, damping ratios and shapes of the model linearised about a state.
///
/// The results go to a folder: `modes.csv` (number, frequency, damping ratio, kind), `shapes.csv` (displacement and rotation of
/// every node), `energy.csv` (share of each part in kinetic and strain energy), `participation.csv` (effective masses), `shapes.svg` (a
/// picture of the first shapes), `summary.json` (eigenvalues) and files for `lissom view`.
// Omitted values are those of the model's table `[analysis]` if it is of kind `modes`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom modes examples/tip-crank.toml --about undeformed
  lissom modes examples/tip-crank.toml --count 40 --shift 100   the modes nearest to 100 Hz
  lissom modes examples/top.toml --about 0.5      about the state at t = 0.5 s

Kinds: rigid (frequency 0), oscillation, decay (overdamped), divergence and flutter (growing).
Exit code: 0 success; 2 wrong model or command line; 3 no state to linearise about, or modes were missed.")
)]
pub struct ModeRequest {
    /// Number of modes, the lowest first, and decays of first-order states among them besides [default: 20].
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_parser = crate::analyses::interface::counts(1..)))]
    pub count: Option<usize>,
    /// State to linearise about: `static` (default), `undeformed`, `rotation` (steady, with the velocities of the file), `averaged-rotation` (over the azimuth) or a time of the model's analysis [s].
    #[cfg_attr(feature = "clap", arg(long, value_name = "STATE|TIME", allow_negative_numbers = true))]
    pub about: Option<OperatingPoint>,
    /// Compute the modes nearest to this frequency [default: the lowest ones].
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ", allow_negative_numbers = true))]
    pub shift: Option<f64>,
    /// Do not draw the shapes.
    #[cfg_attr(feature = "clap", arg(long, display_order = 901))]
    pub no_plots: bool,
}

impl Analysis for ModeRequest {
    const NAME: &'static str = "modes";
    type Report = ModeReport;
    type Error = ModesError;

    fn compute(&self, model: &Model) -> Result<ModeReport, ModesError> {
        modes(model, self)
    }
}

/// Why modes were not found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum ModesError {
    /// The model is invalid.
    #[error(transparent)]
    Model(#[from] Report),
    /// The time is outside the analysis.
    Time {
        /// The time [s].
        time: f64,
        /// The reason.
        reason: String,
    },
    /// An invalid frequency.
    Shift(f64),
    /// The analysis that computes the state has no consistent initial values.
    #[error(transparent)]
    Initial(#[from] InitialError),
    /// The analysis that computes the state has no solution.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The state is not in equilibrium.
    NotInEquilibrium {
        /// The state, in words.
        state: &'static str,
        /// Displacement over the model's length [-].
        imbalance: f64,
        /// Remedy.
        hint: &'static str,
    },
    /// There is no steady rotation.
    #[error(transparent)]
    Steady(#[from] SteadyError),
    /// The rotation is not steady.
    Unsteady(f64),
    /// The rotation is steady only at the azimuth of the start.
    SteadyHereAlone {
        /// Change of the twists at another azimuth.
        change: f64,
        /// What may cause it, in words.
        loads: String,
    },
    /// The rotor has no multi-blade coordinates in which a mean can be formed; the reason.
    NoMean(&'static str),
    /// An analysis that needs one state was requested for a mean over the azimuth.
    ModesAlone,
    /// Coefficients change as the model rotates.
    Periodic {
        /// Number of the mode, from 1.
        number: usize,
        /// Frequency of the mode at this instant [Hz].
        frequency: f64,
        /// Deviation of the mode from a solution a fraction of a turn later.
        departure: f64,
        /// Why multi-blade coordinates are not applicable.
        reason: &'static str,
    },
    /// There is no linear model.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// There are no modes.
    #[error(transparent)]
    Mode(#[from] ModeError),
    /// Some modes were not found.
    Missing(usize),
}

impl AnalysisError for ModesError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::Model(report) => Origin::Model(report),
            Self::Time { .. } | Self::Shift(_) | Self::ModesAlone => Origin::Request,
            _ => Origin::Computation,
        }
    }
}

impl From<SessionError> for ModesError {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Model(report) => Self::Model(report),
            SessionError::Initial(error) => Self::Initial(error),
            SessionError::NotInTime(kind) => {
                Self::Time { time: 0.0, reason: format!("an analysis of kind `{kind}` has no time steps") }
            }
        }
    }
}

/// Modes of a model, with warnings.
#[derive(Clone, Debug)]
pub struct ModeReport {
    /// The modes, by ascending frequency, unstable ones first.
    pub modes: Vec<Mode>,
    /// The state about which the model is linearised.
    pub state: Kinematics,
    /// Their shapes, node by node.
    pub shapes: Vec<Vec<NodeShape>>,
    /// Share of each part in the kinetic energy of each mode.
    pub shares: Vec<BTreeMap<String, f64>>,
    /// Share of each part in the strain energy of each mode; empty for modes without strain.
    pub strain_shares: Vec<BTreeMap<String, f64>>,
    /// Effective masses of each mode, see [`EffectiveMasses`].
    pub effective_masses: Vec<EffectiveMasses>,
    /// Mass and moments of inertia of the whole model.
    pub masses: EffectiveMasses,
    /// The state displaced along the first shapes, for pictures.
    pub moved: Vec<Kinematics>,
    /// Whether some may have been missed.
    pub completeness: Completeness,
    /// The requested number.
    pub asked: usize,
    /// The state, in words.
    pub about: String,
    /// Time of the state [s].
    pub time: f64,
    /// Number of coordinates and of multipliers.
    pub unknowns: [usize; 2],
    /// Points of contact with friction that touch; none without such contacts.
    pub friction: Option<FrictionPoints>,
    /// Warnings.
    pub warnings: Vec<AnalysisWarning>,
}

/// Natural modes of `model`.
///
/// # Errors
/// If the model is invalid, the state cannot be reached or is not in equilibrium, or modes were missed.
pub fn modes(model: &Model, request: &ModeRequest) -> Result<ModeReport, ModesError> {
    let document = model.document()?;
    let (mut count, mut about, mut shift) =
        (lissom_model::document::DEFAULT_MODE_COUNT, OperatingPoint::Static, None);
    if let AnalysisKind::Modes { count: own, undeformed, shift: near } = document.analysis.kind {
        (count, shift) = (own, near);
        about = if undeformed { OperatingPoint::Undeformed } else { OperatingPoint::Static };
    }
    let is_asked = request.count.is_some() || count != lissom_model::document::DEFAULT_MODE_COUNT;
    count = request.count.unwrap_or(count);
    about = request.about.unwrap_or(about);
    shift = request.shift.or(shift);
    if let Some(frequency) = shift.filter(|frequency| !(frequency.is_finite() && *frequency >= 0.0)) {
        return Err(ModesError::Shift(frequency));
    }
    let mut report = about.linearized_for_modes(&document, |reached| -> Result<ModeReport, ModesError> {
        let options = ModeOptions { count, shift };
        let rotates = matches!(about, OperatingPoint::Rotation | OperatingPoint::AveragedRotation);
        let mut report = if rotates || reached.model.rolls_on() {
            let Reliable { found, at_rest, warnings } = in_rotation(reached.model, about, &options)?;
            let mut report = report_of(at_rest.as_ref().unwrap_or(reached.model), found, count);
            report.warnings.extend(warnings);
            report
        } else {
            report_of(reached.model, reached.model.modes(&options)?, count)
        };
        report.warnings.extend(reached.warnings);
        Ok(report)
    })?;
    let number = report.modes.len();
    if is_asked && number < count {
        let is_counted = report.completeness == Completeness::Counted;
        let evidence = if is_counted { "the model has" } else { "the search found" };
        report.warnings.push(AnalysisWarning::FewerModes { wanted: count, evidence, found: number });
    }
    if request.no_plots {
        report.moved.clear();
    }
    report.about = about.name();
    if !document.contacts.is_empty() {
        report.friction = lower(&document)?.names.friction_points(&document, &report.state);
    }
    if let Completeness::Missing(missed) = report.completeness {
        return Err(ModesError::Missing(missed));
    }
    Ok(report)
}

/// Modes of a rotating model.
pub(crate) struct Reliable<'a> {
    /// The modes.
    pub(crate) found: Modes,
    /// The model in axes at rest, if the modes are computed there.
    pub(crate) at_rest: Option<LinearModel<'a>>,
    /// The modes that are omitted, and the axes.
    pub(crate) warnings: Vec<AnalysisWarning>,
}

/// A mode whose coefficients are not constant.
struct Inconstant {
    number: usize,
    frequency: f64,
    departure: f64,
}

/// Modes of a rotating model: of its mean over the azimuth, or those with constant coefficients.
///
/// # Errors
/// If there are none.
pub(crate) fn in_rotation<'a>(
    model: &LinearModel<'a>,
    about: OperatingPoint,
    options: &ModeOptions,
) -> Result<Reliable<'a>, ModesError> {
    if about != OperatingPoint::AveragedRotation {
        return with_constant_coefficients(model, options);
    }
    let averaged = model.averaged()?.map_err(|none| ModesError::NoMean(none.words()))?;
    let found = averaged.mean.modes(options)?;
    let change = averaged.variation_of(&found.modes)?;
    let warnings =
        if change > NEGLIGIBLE { vec![AnalysisWarning::VariesWithAzimuth { change }] } else { Vec::new() };
    Ok(Reliable { found, at_rest: Some(averaged.mean), warnings })
}

/// The modes of `model` whose coefficients are constant while it rotates, in the axes of the nodes or in axes at rest, whichever has more
/// of them.
fn with_constant_coefficients<'a>(
    model: &LinearModel<'a>,
    options: &ModeOptions,
) -> Result<Reliable<'a>, ModesError> {
    let found = model.modes(options)?;
    if model.is_at_rest() {
        return Ok(Reliable { found, at_rest: None, warnings: Vec::new() });
    }
    let later = model.turned()?;
    let (found, inconstant) = divide(found, model, &later)?;
    if inconstant.is_empty() {
        return Ok(Reliable { found, at_rest: None, warnings: Vec::new() });
    }
    let (mut chosen, mut left_out) = (Reliable { found, at_rest: None, warnings: Vec::new() }, inconstant);
    let (mut reason, warning, other) = if model.rolls_on() {
        (
            "they also change in axes that do not spin with the wheels",
            AnalysisWarning::RollingAxes,
            Ok(model.in_rolling_axes()),
        )
    } else {
        (
            "they also change in multi-blade coordinates of its rotor",
            AnalysisWarning::AxesAtRest,
            model.in_axes_at_rest(),
        )
    };
    match other {
        Err(no) => reason = no.words(),
        Ok(at_rest) => {
            let (found, inconstant) = divide(at_rest.modes(options)?, &at_rest, &later)?;
            if found.modes.len() > chosen.found.modes.len() {
                let warnings = vec![warning];
                chosen = Reliable { found, at_rest: Some(at_rest), warnings };
                left_out = inconstant;
            }
        }
    }
    let Some(&Inconstant { number, frequency, departure }) = left_out.first() else { return Ok(chosen) };
    let has_elastic = chosen.found.modes.iter().any(|mode| mode.kind != ModeKind::Rigid);
    if !has_elastic {
        return Err(ModesError::Periodic { number, frequency, departure, reason });
    }
    let names: Vec<String> =
        left_out.iter().map(|mode| format!("{} Hz", lissom_core::number::Written(mode.frequency))).collect();
    chosen.warnings.push(AnalysisWarning::ModesOmitted {
        omitted: left_out.len(),
        count: left_out.len() + chosen.found.modes.len(),
        frequencies: names.join(", "),
        reason,
    });
    Ok(chosen)
}

/// Separates the modes of `own` that are also modes of `later`, the model a fraction of a turn later, from the
/// others.
fn divide(
    found: Modes,
    own: &LinearModel<'_>,
    later: &LinearModel<'_>,
) -> Result<(Modes, Vec<Inconstant>), ModesError> {
    let Modes { modes, completeness } = found;
    let (mut constant, mut inconstant) = (Vec::new(), Vec::new());
    for (index, mode) in modes.into_iter().enumerate() {
        let ModeDeviation { size, round_off } = own.deviation_of(&mode, later)?;
        if size <= CONSTANT || (size <= BEYOND_ROUND_OFF * round_off && round_off <= MAX_ROUND_OFF) {
            constant.push(mode);
        } else {
            let frequency = mode.frequency;
            inconstant.push(Inconstant { number: index + 1, frequency, departure: size });
        }
    }
    Ok((Modes { modes: constant, completeness }, inconstant))
}

fn report_of(model: &LinearModel<'_>, found: Modes, count: usize) -> ModeReport {
    let mut warnings = Vec::new();
    let unstable = found.modes.iter().filter(|mode| mode.kind.is_unstable()).count();
    if unstable > 0 {
        warnings.push(AnalysisWarning::Unstable { modes: unstable });
    }
    match found.completeness {
        Completeness::Unknown => warnings.push(AnalysisWarning::ModeCountUnknown),
        Completeness::NotCounted | Completeness::Counted | Completeness::Missing(_) => {}
    }
    let layout = model.system().layout();
    ModeReport {
        state: model.kinematics().clone(),
        shapes: found.modes.iter().map(|mode| model.shape(mode)).collect(),
        shares: found.modes.iter().map(|mode| model.kinetic_shares(mode)).collect(),
        strain_shares: found.modes.iter().map(|mode| model.strain_shares(mode)).collect(),
        effective_masses: model.effective_masses(&found.modes),
        masses: model.masses(),
        moved: found.modes.iter().take(DRAWN).map(|mode| model.moved_along(mode, FAR)).collect(),
        modes: found.modes,
        completeness: found.completeness,
        asked: count,
        about: String::new(),
        time: model.kinematics().time,
        unknowns: [layout.coordinate_count(), layout.multiplier_rows().len()],
        friction: None,
        warnings,
    }
}

catalogued! {
    Failure ModesError {
        Time { time => time, reason => reason } => "linearization-time" {
            cause: "the model cannot be linearised at t = {time} s: {reason}",
            remedy: "choose a time of the analysis, `static` or `undeformed`",
            meaning: "The time `about` is outside of the analysis, or the analysis has no time steps.",
        }
        Shift { 0 => frequency } => "modes-shift" {
            cause: "modes near {frequency} Hz were requested",
            remedy: "the frequency must be a number that is not negative",
            meaning: "The frequency near which modes are computed is negative or not a number.",
            advice: "Choose a `shift` of zero or more, or none for the lowest modes.",
        }
        NotInEquilibrium { state => state, imbalance => imbalance, hint => hint } => "not-in-equilibrium" {
            cause: "the {state} is not in equilibrium: unbalanced forces would move it by {imbalance:.1e} of the model's length, so \
                    modes about it are not defined",
            remedy: "{hint}",
            meaning: "The model would start to move from the state of linearisation, so its linear equations describe no oscillation \
                      about this state.",
            advice: "Linearise about static equilibrium, or about the end of an analysis of kind `statics` with more load steps.",
        }
        Unsteady { 0 => change } => "rotation-not-steady" {
            cause: "the velocities at the start are not a steady rotation: in the axes of the nodes they change by {change:.1e} of \
                    their squares",
            remedy: "average over the azimuth (`averaged-rotation`), or remove gravity across the axis, loads fixed in space and other \
                     motions, which are not steady in rotating axes",
            meaning: "Linearisation about `rotation` requires velocities that are constant in rotating axes.",
        }
        SteadyHereAlone { change => change, loads => loads } => "rotation-steady-at-azimuth" {
            cause: "the rotation is not steady: at another azimuth the twists of nodes change by {change:.1e} of their squares, under \
                    loads fixed in space that do not act along the axis as it turns: {loads}",
            remedy: "average over the azimuth (`lissom campbell --averaged`, `lissom modes --about averaged-rotation`), remove these loads for \
                     this analysis (gravity by `--unset gravity`), let them act along the axis, or fix what tilts it",
            meaning: "The velocities are steady at the azimuth of the start, but not at another one: a load is fixed in space.",
        }
        NoMean { 0 => reason } => "no-mean-rotation" {
            cause: "there is no mean over the azimuth, because {reason}",
            remedy: "use at least three identical blades about one axis, or a simulation in time",
            meaning: "A mean over the azimuth is formed in multi-blade coordinates, which the rotor does not have.",
        }
        ModesAlone {} => "mean-has-modes-only" {
            cause: "`averaged-rotation` is a mean over the azimuth, of which modes are computed only",
            remedy: "use `lissom modes` or `lissom campbell`, or linearise about `rotation` or a time of the analysis",
            meaning: "Responses and matrices refer to one state of the model, and a mean over the azimuth is none.",
        }
        Periodic { number => number, frequency => frequency, departure => departure, reason => reason } => "periodic-coefficients" {
            cause: "mode {number} ({frequency} Hz) belongs to coefficients that change as the model rotates ({departure:.1e}): \
                    rotating and non-rotating parts are coupled across the axis, for example by a flexible support; there are no \
                    multi-blade coordinates in which the coefficients are constant, because {reason}",
            remedy: "such modes require Floquet theory, which is not implemented",
            meaning: "The linear equations of a rotating model have periodic coefficients, so natural modes do not exist.",
            advice: "Use at least three identical blades for multi-blade coordinates, a rigid support, or a simulation in time.",
        }
        Missing { 0 => missed } => "modes-missed" {
            cause: "{missed} of the modes between the first and the last one were missed, according to the count of negative pivots",
            remedy: "request another `count`; if very light parts make some frequencies thousands of times higher than others, \
                     request fewer modes, or those near a frequency by `shift`",
            meaning: "The search for modes found fewer modes than the factorisation counts in the interval.",
        }
    } wraps {
        Model { 0 => report } => report.diagnostic(),
        Initial { 0 => error } => error.diagnostic(),
        Step { 0 => error } => error.diagnostic(),
        Steady { 0 => error } => error.diagnostic(),
        Linear { 0 => error } => error.diagnostic(),
        Mode { 0 => error } => error.diagnostic(),
    }
}
