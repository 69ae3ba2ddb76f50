//! The analysis that a model file requests, with its settings.

use lissom_mechanics::registry::{Parameter, Parameters};
use lissom_system::schemes::{self, ContactSolution};
use lissom_system::settings::Controlled;
use lissom_system::solver_features::DisabledFeatures;

use super::entries::of_kind;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::{ChoiceEntry, Registry};
use crate::sweep::{TimeWindow, Window, WindowContext};
use crate::text::Node;
use crate::text::report::{Located, Problem, Span};

/// Kind of analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnalysisKind {
    /// Motion in time.
    Dynamics {
        /// Time step, or the first one where steps are chosen [s].
        step: Located<f64>,
        /// Steps are chosen by their error; none where all are of one size.
        control: Option<StepChoice>,
    },
    /// Equilibrium under loads that grow with the time.
    Statics {
        /// Number of load steps; none where they are chosen.
        steps: Option<usize>,
        /// Part of its work that a load step of chosen size may leave unexplained.
        relative_tolerance: f64,
    },
    /// Equilibria under loads times a load factor, or along a number of the model file (`Analysis::vary`).
    Path {
        /// First step of the load factor or the number, greater than zero; none for a part of the way.
        first: Option<f64>,
        /// Load factor at which the path ends, not zero; or the last value of the number.
        end: f64,
        /// Most steps.
        most_steps: usize,
        /// Number of the bifurcation at which it continues on the branch, from 1, negative for the opposite direction; 0 for none.
        branch: i32,
    },
    /// Buckling load factors, by a linear estimate.
    Buckling {
        /// How many.
        count: usize,
    },
    /// Natural modes about a state at rest.
    Modes {
        /// How many.
        count: usize,
        /// Whether gravity and loads are omitted, and positions are those of the file.
        undeformed: bool,
        /// Frequency near which they are sought [Hz]; none for the lowest ones.
        shift: Option<f64>,
    },
}

impl Analysis {
    /// Whether no scheme was written.
    pub(super) fn has_default_scheme(&self) -> bool {
        self.scheme.as_ref().is_none_or(|scheme| scheme.span == self.span)
    }
}

impl AnalysisKind {
    /// Word for the kind in the model file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dynamics { .. } => "dynamics",
            Self::Statics { .. } => "statics",
            Self::Path { .. } => "path",
            Self::Buckling { .. } => "buckling",
            Self::Modes { .. } => "modes",
        }
    }
}

/// Modes that are sought where no number is given.
pub const DEFAULT_MODE_COUNT: usize = 20;
/// Load factors of buckling that are sought where no number is given.
pub const DEFAULT_BUCKLING_COUNT: usize = 5;

/// How steps are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepChoice {
    /// Error allowed per step, relative to the motion.
    pub relative_tolerance: f64,
    /// Longest step [s].
    pub max_step: f64,
    /// Time from record to record, if not every step is recorded [s].
    pub output_step: Option<f64>,
    /// Whose errors the tolerance limits.
    pub of: Controlled,
}

/// Tolerance of the local error if a model specifies neither step nor tolerance.
pub(super) const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;
/// Default tolerance of Newton's iterations. With adaptive steps it is a fraction of their tolerance: errors of the iterations add
/// up over the steps, and with more than two stages, whose estimates compare positions of much smaller errors, steps become shorter
/// by them.
pub(super) const DEFAULT_TOLERANCE: f64 = 1e-8;
const NEWTON_PART: f64 = 1e-3;
/// Word of `control` by which tolerances apply to forces, too.
pub(super) const FORCES: &str = "forces";
/// Words of `contacts`.
pub(super) const CONTACTS: &[&str] = &["elements", SET];
const SET: &str = "set";
/// Scheme where steps are chosen and none is named, and that for tolerances above the limit: with large errors, the order of more
/// stages does not pay for them.
const CONTROLLED_SCHEME: &str = "radau-iia-9";
const COARSE_SCHEME: &str = "radau-iia-5";
const COARSE: f64 = 3e-5;
/// Part of the whole duration that the longest step and the first step are where they are not given.
const LONGEST_PART: f64 = 0.05;
const FIRST_PART: f64 = 1e-4;

/// How the equations are scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scaling {
    /// By the time step and representative mass, damping and stiffness.
    Physical,
    /// By the time step, with the factor one for the constraints.
    Unit,
    /// Not at all.
    None,
}

/// Kind of analysis and its settings.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Dynamics or statics.
    pub kind: AnalysisKind,
    /// Word of the time integration scheme, if the registry has any and time is integrated.
    pub scheme: Option<Located<String>>,
    /// Parameters of the scheme that were given.
    pub parameters: Parameters,
    /// How contacts of solids are solved.
    pub contacts: ContactSolution,
    /// First time [s].
    pub start: f64,
    /// Last time [s].
    pub end: f64,
    /// How the tangent is scaled and augmented.
    pub conditioning: Conditioning,
    /// Word of the linear solver, if the registry has any.
    pub solver: Option<Located<String>>,
    /// Tolerance of Newton's iteration in scaled units.
    pub tolerance: f64,
    /// Most iterations of a step.
    pub max_iterations: usize,
    /// Disabled features of the nonlinear solver, for studies.
    pub disabled: DisabledFeatures,
    /// What is recorded of a run.
    pub records: Records,
    /// Whether a motion with much more energy than anything put in fails.
    pub energy_check: bool,
    /// Path in the model file of the number varied along an equilibrium path; none for the load factor.
    pub vary: Option<Located<String>>,
    /// Whether constant loads of statics grow from nothing over the load steps.
    pub ramp: bool,
    /// The word `analysis`.
    pub span: Span,
}

/// Scaling of the equations, and the augmented Lagrangian term: what the condition of the tangent depends on.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditioning {
    /// How the equations are scaled.
    pub scaling: Scaling,
    /// Whether rows and columns of the scaled tangent are brought to one size.
    pub equilibrated: bool,
    /// Whether the augmented Lagrangian term is added.
    pub augmented: bool,
    /// Factor of the augmented term.
    pub penalty: f64,
}

/// Instants of a run that are recorded, and those of which statistics are computed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Records {
    /// Steps from one record to the next; none for each step, or for instants that suit adaptive steps.
    pub output_every: Option<usize>,
    /// Frames of the motion file per second of simulated time; none for a number that suits the run [1/s].
    pub frames_per_second: Option<f64>,
    /// Part of the records from which statistics are computed.
    pub statistics_window: TimeWindow,
}

pub(super) fn analysis(context: &Context<'_>, registry: &Registry) -> Option<Analysis> {
    let (node, name) = context.top("analysis")?;
    let (reader, word) = of_kind(context, "analysis", (node, "[analysis]".to_owned(), name), registry)?;
    let dynamics = word == "dynamics";
    let is_run = matches!(word, "dynamics" | "statics");
    let start = reader.number("start");
    let end = match (is_run, &start) {
        // Loads are those of an instant; functions of time are also evaluated slightly after it.
        (false, Some(start)) => Some(Located::new(start.value + 1.0, name)),
        _ if reader.has("end") => reader.number("end"),
        _ => Some(Located::new(1.0, name)),
    };
    let kind = if dynamics {
        stepping(&reader, end.as_ref()?.value - start.as_ref()?.value)
    } else if word == "modes" {
        modes(&reader)
    } else if word == "buckling" {
        let count = reader.count("count");
        count.map(|count| AnalysisKind::Buckling { count: count.value })
    } else if word == "path" {
        path(&reader)
    } else {
        load_steps(&reader)
    };
    let scaling = match reader.choice("scaling")?.value {
        "unit" => Scaling::Unit,
        "none" => Scaling::None,
        _ => Scaling::Physical,
    };
    let scheme = match (dynamics.then(|| chosen(&reader, "scheme", &registry.schemes)).flatten(), &kind) {
        (Some(_), Some(AnalysisKind::Dynamics { control: Some(control), .. })) if !reader.has("scheme") => {
            let name = if control.relative_tolerance > COARSE { COARSE_SCHEME } else { CONTROLLED_SCHEME };
            Some(Located::new(name.to_owned(), reader.name))
        }
        (chosen, _) => chosen,
    };
    let parameters =
        if dynamics { scheme_parameters(&reader, scheme.as_ref(), registry) } else { Parameters::new() };
    let contacts = scheme.as_ref().map_or(ContactSolution::Elements, |scheme| contacts(&reader, scheme));
    let solver = chosen(&reader, "solver", &registry.solvers);
    let of_scheme = scheme.as_ref().and_then(|scheme| {
        registry.schemes.iter().find(|entry| entry.name == scheme.value).and_then(|entry| entry.tolerance)
    });
    let of_newton = of_scheme.unwrap_or(match &kind {
        Some(AnalysisKind::Dynamics { control: Some(control), .. }) => {
            NEWTON_PART * control.relative_tolerance
        }
        _ => DEFAULT_TOLERANCE,
    });
    let tolerance = if reader.has("tolerance") { reader.number("tolerance")?.value } else { of_newton };
    let mut analysis = Analysis {
        scheme,
        parameters,
        contacts,
        conditioning: Conditioning {
            scaling,
            equilibrated: reader.flag("equilibrated")?.value,
            augmented: reader.flag("augmented")?.value,
            penalty: reader.number("penalty")?.value,
        },
        solver,
        tolerance,
        max_iterations: reader.count("max_iterations")?.value,
        disabled: disabled(&reader),
        records: if is_run { records(&reader) } else { Records::default() },
        energy_check: !dynamics || reader.flag("energy_check")?.value,
        vary: if word == "path" { reader.text("vary").map(|path| path.map(str::to_owned)) } else { None },
        ramp: word == "statics" && reader.flag("ramp")?.value,
        span: name,
        start: start.as_ref()?.value,
        end: end.as_ref()?.value,
        kind: kind?,
    };
    check_times(context, &analysis, end?.span);
    check_frames(&reader, &analysis);
    if is_run && analysis.end > analysis.start {
        analysis.records.statistics_window = statistics_window(&reader, &analysis).unwrap_or_default();
    }
    Some(analysis)
}

/// What is recorded, except the window of statistics.
fn records(reader: &Reader<'_, '_>) -> Records {
    Records {
        output_every: reader.count("output_every").map(|count| count.value),
        frames_per_second: reader.number("frames_per_second").map(|rate| rate.value),
        ..Records::default()
    }
}

fn statistics_window(reader: &Reader<'_, '_>, analysis: &Analysis) -> Option<TimeWindow> {
    let text = reader.text("statistics_window")?;
    let names = reader.context.names("events");
    let events: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
    let context = WindowContext {
        events: &events,
        parameters: &reader.context.own_parameters(),
        start: analysis.start,
        end: analysis.end,
    };
    match Window::parse(text.value).and_then(|window| window.resolve(&context)) {
        Ok(window) => Some(window),
        Err(error) => {
            reader.context.fail(text.span, format!("`statistics_window`: {}", error.message), error.remedy)
        }
    }
}

fn disabled(reader: &Reader<'_, '_>) -> DisabledFeatures {
    let words = reader.choices("without").unwrap_or_default();
    DisabledFeatures::of_words(words.iter().map(String::as_str)).unwrap_or_default()
}

fn path(reader: &Reader<'_, '_>) -> Option<AnalysisKind> {
    let varies = reader.has("vary");
    if varies && !reader.has("end") {
        return reader.context.fail(
            reader.name,
            "the path along a number lacks `end`".to_owned(),
            "specify the value of the number at which the path ends",
        );
    }
    let end = reader.number("end")?;
    if end.value == 0.0 && !varies {
        return reader.context.fail(
            end.span,
            "the path ends at load factor 0, where it starts".to_owned(),
            "choose an `end` that is not zero",
        );
    }
    let first = if reader.has("step") { Some(reader.number("step")?.value) } else { None };
    let most_steps = reader.count("steps")?.value;
    let branch = reader.number("branch")?.value;
    if branch.fract() != 0.0 {
        return reader.context.fail(
            reader.node("branch")?.span,
            format!("`branch` must be a whole number, not {branch}"),
            "1 is the first bifurcation of the path, -1 its branch in the opposite direction; 0 continues the path",
        );
    }
    Some(AnalysisKind::Path { first, end: end.value, most_steps, branch: branch as i32 })
}

/// Load steps of one size, or chosen.
fn load_steps(reader: &Reader<'_, '_>) -> Option<AnalysisKind> {
    let steps = reader.node("steps").map_or(Some(None), |_| reader.count("steps").map(Some))?;
    let tolerance = reader.node("relative_tolerance");
    if let (Some(node), Some(_)) = (tolerance, steps) {
        return reader.context.fail(
            node.span,
            "this is for adaptive load steps, but `steps` specifies their number".to_owned(),
            "remove one of them",
        );
    }
    let relative_tolerance = reader.number("relative_tolerance")?.value;
    Some(AnalysisKind::Statics { steps: steps.map(|steps| steps.value), relative_tolerance })
}

fn modes(reader: &Reader<'_, '_>) -> Option<AnalysisKind> {
    let shift = reader.node("shift").map_or(Some(None), |_| reader.number("shift").map(Some))?;
    Some(AnalysisKind::Modes {
        count: reader.count("count")?.value,
        undeformed: reader.choice("about")?.value == "undeformed",
        shift: shift.map(|shift| shift.value),
    })
}

/// Steps of one size, or chosen by their error, over `duration` [s].
fn stepping(reader: &Reader<'_, '_>, duration: f64) -> Option<AnalysisKind> {
    let given = |key: &str| reader.node(key).map_or(Some(None), |_| reader.number(key).map(Some));
    let (step, tolerance) = (given("step")?, given("relative_tolerance")?);
    let (max_step, output_step) = (given("max_step")?, given("output_step")?);
    if tolerance.is_none()
        && step.is_some()
        && let Some(stray) =
            max_step.or(output_step).map(|value| value.span).or(reader.node("control").map(|node| node.span))
    {
        return reader.context.fail(
            stray,
            "this is for adaptive steps, but only `step` is specified".to_owned(),
            "add `relative_tolerance`, or remove this; `output_every` is for steps of equal size",
        );
    }
    if tolerance.is_none()
        && let Some(step) = step
    {
        return Some(AnalysisKind::Dynamics { step, control: None });
    }
    if let Some(interval) = output_step
        && reader.count("output_every").is_some_and(|every| every.value > 1)
    {
        return reader.context.fail(
            interval.span,
            "both `output_step` and `output_every` specify what is recorded".to_owned(),
            "remove one of them",
        );
    }
    let max_step = max_step.map_or(LONGEST_PART * duration, |most| most.value);
    let step = step.unwrap_or(Located::new((FIRST_PART * duration).min(max_step), reader.name));
    let relative_tolerance = reader.number("relative_tolerance")?.value;
    let output_step = output_step.map(|step| step.value);
    let of =
        if reader.choice("control")?.value == FORCES { Controlled::Forces } else { Controlled::Positions };
    Some(AnalysisKind::Dynamics {
        step,
        control: Some(StepChoice { relative_tolerance, max_step, output_step, of }),
    })
}

fn check_times(context: &Context<'_>, analysis: &Analysis, end: Span) {
    let duration = analysis.end - analysis.start;
    if !(duration > 0.0 && duration.is_finite()) {
        let message =
            format!("the analysis ends at {} s, not after its start at {} s", analysis.end, analysis.start);
        context.fail::<()>(end, message, "`end` must be greater than `start`");
    } else if let AnalysisKind::Dynamics { step, .. } = &analysis.kind
        && step.value > duration
    {
        let message = format!("the time step {} s is longer than the analysis of {duration} s", step.value);
        context.fail::<()>(step.span, message, "choose a smaller `step` or a later `end`");
    }
}

/// A motion file of more frames fills a disk and is shown by nobody.
const MAX_FRAMES: f64 = 100_000.0;

fn check_frames(reader: &Reader<'_, '_>, analysis: &Analysis) {
    let Some(rate) = analysis.records.frames_per_second else { return };
    let Some(node) = reader.node("frames_per_second") else { return };
    let duration = analysis.end - analysis.start;
    if rate * duration > MAX_FRAMES {
        let message = format!("`frames_per_second` requires {:.0} frames of motion", rate * duration);
        let help = format!(
            "at most {MAX_FRAMES} are recorded: choose at most {}",
            lissom_mechanics::number::Written(MAX_FRAMES / duration)
        );
        reader.context.fail::<()>(node.span, message, help);
    }
}

/// The word that was chosen, or the first of the table.
fn chosen(reader: &Reader<'_, '_>, key: &str, table: &[ChoiceEntry]) -> Option<Located<String>> {
    if reader.has(key) {
        return reader.choice(key).map(|word| word.map(str::to_owned));
    }
    table.first().map(|entry| Located::new(entry.name.to_owned(), reader.name))
}

/// How contacts are solved: as written, or as the scheme does by default.
fn contacts(reader: &Reader<'_, '_>, scheme: &Located<String>) -> ContactSolution {
    let of_scheme = |name: &str| schemes::kind(name).map_or(ContactSolution::Elements, |kind| kind.contacts);
    let default = of_scheme(&scheme.value);
    let chosen = if reader.has("contacts") { reader.choice("contacts") } else { None };
    match chosen {
        Some(chosen) if chosen.value == SET => {
            if default != ContactSolution::Set {
                let able = schemes::KINDS.iter().filter(|kind| kind.contacts == ContactSolution::Set);
                let able: Vec<String> = able.map(|kind| format!("`scheme = \"{}\"`", kind.name)).collect();
                let message =
                    format!("the scheme `{}` cannot solve for all touches of a step at once", scheme.value);
                let help = format!("choose {}, or remove `contacts`", able.join(" or "));
                reader.context.fail::<()>(chosen.span, message, help);
            }
            ContactSolution::Set
        }
        Some(_) => ContactSolution::Elements,
        None => default,
    }
}

/// The parameters of the chosen scheme; those of others are reported.
fn scheme_parameters(
    reader: &Reader<'_, '_>,
    scheme: Option<&Located<String>>,
    registry: &Registry,
) -> Parameters {
    let Some(scheme) = scheme else { return Parameters::new() };
    let of = |name: &str| registry.schemes.iter().find(|entry| entry.name == name);
    let own: &'static [Parameter] = of(&scheme.value).map_or(&[], |entry| entry.parameters);
    for parameter in registry.schemes.iter().flat_map(|entry| entry.parameters) {
        let given =
            reader.node(parameter.name).filter(|_| !own.iter().any(|known| known.name == parameter.name));
        // Where an override chooses another scheme, parameters of the one in the file mean nothing any more.
        let sources = reader.context.sources;
        let is_former = |node: &&Node| sources.is_override(scheme.span) && !sources.is_override(node.span);
        if given.as_ref().is_some_and(is_former) {
            continue;
        }
        if let Some(node) = given {
            let owners = registry
                .schemes
                .iter()
                .filter(|entry| entry.parameters.iter().any(|known| known.name == parameter.name))
                .map(|entry| entry.name);
            let message = format!("the scheme `{}` has no parameter `{}`", scheme.value, parameter.name);
            let problem = Problem::error(node.span, message).also(scheme.span, "this scheme");
            let help = format!(
                "it belongs to {}: remove it, or choose that scheme",
                crate::format::suggest::list(owners)
            );
            reader.context.report(problem.help(help));
        }
    }
    for parameter in own.iter().filter(|parameter| parameter.required && !reader.has(parameter.name)) {
        let message = format!("the scheme `{}` lacks `{}`", scheme.value, parameter.name);
        reader.context.fail::<()>(scheme.span, message, format!("add it: {}", parameter.summary));
    }
    reader.parameters(own).0
}
