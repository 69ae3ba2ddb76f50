//! States about which a model is linearised: the positions of the file, static equilibrium, an instant of a run.

use crate::start::{Lowered, lower, reject_units};
use lissom_core::errors::Warning;
use lissom_core::kinematics::{CoordinateId, Quantity};
use lissom_core::linearized::{LinearModel, steady, steady_on_average};
use lissom_core::settings::Settings;
use lissom_core::simulation::equilibrium::at_rest;
use lissom_core::system::{State, System};
use lissom_model::Document;
use lissom_model::channels::Channel;
use lissom_model::document::AnalysisKind;
use lissom_motion::{Vector3, rotation_part, translation_part};
use serde::Deserialize;

use crate::analyses::modes::ModesError;
use crate::analysis_warning::AnalysisWarning;
use crate::session::Session;

/// A state at rest whose unbalanced forces displace it by less than this fraction of the model's length is in equilibrium …
const BALANCED: f64 = 1e-8;
/// … and this is the limit for a state that was computed as an equilibrium.
const STILL_BALANCED: f64 = 1e-6;
/// Upper bound of the tolerance of the equilibrium.
const TOLERANCE: f64 = 1e-12;
/// A motion whose twists change by less, relative to the square of its rate, is steady.
const STEADY: f64 = 1e-6;
/// A rotation with computed positions whose twists change by less is steady: light parts have more round-off.
const STEADY_ROTATION: f64 = 1e-5;
/// Number of loads that are named.
const NAMED: usize = 3;

/// The state about which a model is linearised.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub enum OperatingPoint {
    /// Static equilibrium: for a model with load steps at their end, for others under the loads at the start.
    Static,
    /// The positions of the model file, without gravity and loads.
    Undeformed,
    /// Steady rotation with the velocities of the file.
    Rotation,
    /// Rotation with the velocities of the file under loads that change with the azimuth, averaged over a turn.
    AveragedRotation,
    /// The state of the model's own analysis at this time [s].
    Time(f64),
}

/// A model linearised at a state.
pub(crate) struct LinearizationPoint<'m, 'a> {
    /// The linear model.
    pub(crate) model: &'m LinearModel<'a>,
    /// Outputs of the model.
    pub(crate) channels: &'m [Channel],
    /// Warnings about the results of the linear model.
    pub(crate) warnings: Vec<AnalysisWarning>,
}

impl std::str::FromStr for OperatingPoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "static" => Ok(Self::Static),
            "undeformed" => Ok(Self::Undeformed),
            "rotation" => Ok(Self::Rotation),
            "averaged-rotation" => Ok(Self::AveragedRotation),
            _ => match text.parse::<f64>() {
                Ok(time) if time.is_finite() => Ok(Self::Time(time)),
                _ => Err(
                    "it must be `static`, `undeformed`, `rotation`, `averaged-rotation` or a time in seconds"
                        .to_owned(),
                ),
            },
        }
    }
}

impl TryFrom<String> for OperatingPoint {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse().map_err(|reason| format!("`about` is \"{text}\": {reason}"))
    }
}

impl OperatingPoint {
    /// Name of the operating point in `summary.json`.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Static => "static".to_owned(),
            Self::Undeformed => "undeformed".to_owned(),
            Self::Rotation => "rotation".to_owned(),
            Self::AveragedRotation => "averaged-rotation".to_owned(),
            Self::Time(time) => format!("t = {time} s"),
        }
    }

    /// Steady rotation, or static equilibrium if nothing rotates at the start.
    pub(crate) fn rotation_or_static(document: &Document) -> Result<Self, ModesError> {
        let lowered = lower(document)?;
        let turns = lowered.state.kinematics.nodes.iter().any(|node| rotation_part(&node.twist).norm() > 0.0);
        Ok(if turns { Self::Rotation } else { Self::Static })
    }

    /// Computes the state, linearises `document` there, and passes it to `then`.
    pub(crate) fn linearized<T, E: From<ModesError>>(
        self,
        document: &Document,
        then: impl FnOnce(LinearizationPoint<'_, '_>) -> Result<T, E>,
    ) -> Result<T, E> {
        if self == Self::AveragedRotation {
            return Err(ModesError::ModesAlone.into());
        }
        self.linearized_for_modes(document, then)
    }

    /// Linearises for modes, which may be those of a mean over the azimuth: `then` receives the model of one azimuth of the mean state.
    pub(crate) fn linearized_for_modes<T, E: From<ModesError>>(
        self,
        document: &Document,
        then: impl FnOnce(LinearizationPoint<'_, '_>) -> Result<T, E>,
    ) -> Result<T, E> {
        handed_over(then, |hand| {
            self.find(document, &mut |mut reached| {
                reached.warnings.extend(kink_warning(reached.model));
                hand(reached);
            })
        })
    }

    fn find(self, document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
        let elements = &*document.with_contacts_as_elements();
        match self {
            Self::Undeformed => undeformed(elements, hand),
            Self::Rotation => in_rotation(elements, hand),
            Self::AveragedRotation => in_averaged_rotation(elements, hand),
            Self::Static if !matches!(document.analysis.kind, AnalysisKind::Statics { .. }) => {
                in_equilibrium(elements, hand)
            }
            Self::Static => after(document, document.analysis.end, hand),
            Self::Time(time) => after(document, time, hand),
        }
    }
}

/// A warning if a force has a kink at the state.
fn kink_warning(model: &LinearModel<'_>) -> Option<AnalysisWarning> {
    let kink = model.kink()?;
    let quantity = if kink.is_of_rate { "damping" } else { "stiffness" };
    Some(AnalysisWarning::Kink { quantity, force: kink.name })
}

/// Receives the computed state.
type Hand<'h> = &'h mut dyn FnMut(LinearizationPoint<'_, '_>);

/// Result of `then` for the state that `find` computes. The search for the state is compiled once for all uses.
fn handed_over<T, E: From<ModesError>>(
    then: impl FnOnce(LinearizationPoint<'_, '_>) -> Result<T, E>,
    find: impl FnOnce(Hand<'_>) -> Result<(), ModesError>,
) -> Result<T, E> {
    let mut then = Some(then);
    let mut made = None;
    find(&mut |reached| made = then.take().map(|then| then(reached)))?;
    made.expect("a successful search passes on its state")
}

fn undeformed(document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
    let mut lowered = lower(&document.without_loads())?;
    stop(&mut lowered.state);
    let model = linear(&lowered.system, &lowered.state, &lowered.settings)?;
    balanced(
        &model,
        "undeformed state",
        STILL_BALANCED,
        "springs, drives or temperatures exert forces in it: use the static equilibrium",
    )?;
    hand(LinearizationPoint { model: &model, channels: &lowered.channels, warnings: Vec::new() });
    Ok(())
}

fn in_equilibrium(document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
    let Lowered { system, mut state, mut settings, channels, .. } = lower(document)?;
    stop(&mut state);
    let model = linear(&system, &state, &settings)?;
    if balanced(&model, "state of the file", BALANCED, "").is_ok() {
        hand(LinearizationPoint { model: &model, channels: &channels, warnings: Vec::new() });
        return Ok(());
    }
    drop(model);
    if let Some((part, load)) = document.accelerated_part() {
        let warning = AnalysisWarning::NoEquilibrium { part: part.to_owned(), load };
        return undeformed(document, &mut |mut reached| {
            reached.warnings.push(warning.clone());
            hand(reached);
        });
    }
    settings.limits.tolerance = settings.limits.tolerance.min(TOLERANCE);
    let (system, mut state, doubts) = at_rest(system, state, &settings)?;
    // Instability is reported with the modes themselves.
    let relaxed = doubts.iter().filter(|doubt| matches!(doubt, Warning::Relaxed { .. }));
    let warnings = relaxed.map(|doubt| AnalysisWarning::State(doubt.clone())).collect();
    stop(&mut state);
    let model = linear(&system, &state, &settings)?;
    let hint = "specify an analysis of kind `statics` with more load steps, and linearise at its end";
    balanced(&model, "computed state", STILL_BALANCED, hint)?;
    hand(LinearizationPoint { model: &model, channels: &channels, warnings });
    Ok(())
}

fn in_rotation(document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
    let Lowered { system, state, settings, channels, .. } = lower(document)?;
    let state = steady(&system, &state, settings.solver)?;
    let model = linear(&system, &state, &settings)?;
    if model.unsteadiness() > STEADY_ROTATION {
        return Err(ModesError::Unsteady(model.unsteadiness()));
    }
    // Loads fixed in space can be in balance at one azimuth, such as gravity perpendicular to the axis of a rotor.
    let later = model.turned()?.unsteadiness();
    if later.is_nan() || later > STEADY_ROTATION {
        let gravity = (document.gravity != Vector3::zeros()).then(|| "gravity".to_owned());
        let names = document
            .loads
            .iter()
            .map(|load| &load.name)
            .chain(document.local_loads.iter().map(|load| &load.name));
        let mut loads: Vec<String> =
            gravity.into_iter().chain(names.map(|name| format!("`{}`", name.value))).collect();
        if loads.len() > NAMED {
            let more = loads.len() - NAMED;
            loads.truncate(NAMED);
            loads.push(format!("{more} more"));
        }
        return Err(ModesError::SteadyHereAlone { change: later, loads: loads.join(", ") });
    }
    hand(LinearizationPoint { model: &model, channels: &channels, warnings: Vec::new() });
    Ok(())
}

fn in_averaged_rotation(document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
    let Lowered { system, state, settings, channels, .. } = lower(document)?;
    let state = steady_on_average(&system, &state, settings.solver)?;
    let model = linear(&system, &state, &settings)?;
    hand(LinearizationPoint { model: &model, channels: &channels, warnings: Vec::new() });
    Ok(())
}

/// The state of the model's own analysis.
fn after(document: &Document, time: f64, hand: Hand<'_>) -> Result<(), ModesError> {
    let (start, end) = (document.analysis.start, document.analysis.end);
    let wrong = |reason: String| Err(ModesError::Time { time, reason });
    if !matches!(document.analysis.kind, AnalysisKind::Dynamics { .. } | AnalysisKind::Statics { .. }) {
        return wrong("an analysis of this kind has no time steps; use `static` or `undeformed`".to_owned());
    }
    if !(time >= start && time <= end) {
        return wrong(format!("the analysis runs from {start} to {end} s"));
    }
    let mut document = document.clone();
    let is_static = matches!(document.analysis.kind, AnalysisKind::Statics { .. });
    if is_static {
        document.analysis.tolerance = document.analysis.tolerance.min(TOLERANCE);
    }
    reject_units(&document)?;
    let mut session = Session::new(&document)?;
    session.step_to(time)?;
    where_it_stands(&session, &document, hand)
}

/// Linearises at the state of `session`, which runs `document`.
pub(crate) fn now<T, E: From<ModesError>>(
    session: &Session,
    document: &Document,
    then: impl FnOnce(LinearizationPoint<'_, '_>) -> Result<T, E>,
) -> Result<T, E> {
    handed_over(then, |hand| {
        where_it_stands(session, document, &mut |mut reached| {
            reached.warnings.extend(kink_warning(reached.model));
            hand(reached);
        })
    })
}

fn where_it_stands(session: &Session, document: &Document, hand: Hand<'_>) -> Result<(), ModesError> {
    let is_static = matches!(document.analysis.kind, AnalysisKind::Statics { .. });
    let time = session.progress().time;
    let simulation = session.simulation();
    let (system, state, settings) = (simulation.system(), simulation.state(), simulation.settings());
    let lowered = if system.contacts().is_empty() {
        None
    } else {
        let mut lowered = lower(&document.with_contacts_as_elements())?;
        copy_motion((system, state), (&lowered.system, &mut lowered.state));
        Some(lowered)
    };
    let (system, state, settings, channels) = match &lowered {
        None => (system, state, settings, session.observed().channels()),
        Some(own) => (&*own.system, &own.state, &own.settings, &own.channels[..]),
    };
    let mut model = linear(system, state, settings)?;
    let duration = document.analysis.end - document.analysis.start;
    if !is_static && has_come_to_rest(&model, duration) {
        let mut still = state.clone();
        stop(&mut still);
        let resting = linear(system, &still, settings)?;
        if resting.imbalance() <= STILL_BALANCED {
            model = resting;
        }
    }
    if is_static {
        if time > document.analysis.start {
            balanced(&model, "computed state", STILL_BALANCED, "use more load steps")?;
        } else {
            let hint = "there is no load step before this time: use a later one";
            balanced(&model, "state at the start", STILL_BALANCED, hint)?;
        }
    } else if model.is_at_rest() {
        let hint = "it starts to move from there: use the static equilibrium";
        balanced(&model, "state at that time", STILL_BALANCED, hint)?;
    }
    let mut warnings = Vec::new();
    if model.unsteadiness() > STEADY {
        warnings.push(AnalysisWarning::Unsteady { time, change: model.unsteadiness() });
    }
    hand(LinearizationPoint { model: &model, channels, warnings });
    Ok(())
}

/// Copies the motion of a state to that of the same model with further coordinates: states of contacts that are elements.
fn copy_motion((from, state): (&System, &State), (to, out): (&System, &mut State)) {
    let (from, to) = (from.layout(), to.layout());
    out.kinematics.time = state.kinematics.time;
    out.kinematics.nodes.clone_from(&state.kinematics.nodes);
    for (name, motion) in from.coordinate_names.iter().zip(&state.kinematics.coordinates) {
        if let Some(index) = to.coordinate_names.iter().position(|own| own == name) {
            out.kinematics.coordinates[index] = *motion;
        }
    }
    if from.multiplier_count == to.multiplier_count {
        out.multipliers.clone_from(&state.multipliers);
        out.kinematics.show_multipliers(&state.multipliers);
    }
}

/// Whether the velocities would displace the model by a negligible fraction of its length during the whole analysis, as after
/// vibrations have decayed.
fn has_come_to_rest(model: &LinearModel<'_>, duration: f64) -> bool {
    let (at, layout) = (model.kinematics(), model.system().layout());
    let of_nodes = at.nodes.iter().map(|node| {
        (translation_part(&node.twist).norm() / model.length()).max(rotation_part(&node.twist).norm())
    });
    let of_coordinates = CoordinateId::enumerate(&at.coordinates).map(|(coordinate, motion)| {
        match layout.coordinate_quantity(coordinate) {
            Quantity::Length => motion.rate.abs() / model.length(),
            Quantity::Angle => motion.rate.abs(),
            Quantity::State => 0.0,
        }
    });
    of_nodes.chain(of_coordinates).fold(0.0, f64::max) * duration < BALANCED
}

fn linear<'a>(system: &'a System, state: &State, settings: &Settings) -> Result<LinearModel<'a>, ModesError> {
    Ok(LinearModel::of(system, state, settings.solver)?)
}

fn stop(state: &mut State) {
    for node in &mut state.kinematics.nodes {
        node.twist.fill(0.0);
    }
    for coordinate in &mut state.kinematics.coordinates {
        coordinate.rate = 0.0;
    }
}

fn balanced(
    model: &LinearModel<'_>,
    state: &'static str,
    limit: f64,
    hint: &'static str,
) -> Result<(), ModesError> {
    let imbalance = model.imbalance();
    if imbalance <= limit { Ok(()) } else { Err(ModesError::NotInEquilibrium { state, imbalance, hint }) }
}
