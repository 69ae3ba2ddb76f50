//! Scheme, step size, scaling and limits from the table `[analysis]`.

use lissom_system::schemes::{self, Scheme, statics};
use lissom_system::settings::Limits;
use lissom_system::settings::Settings;
use lissom_system::settings::{Controlled, StepControl};
use lissom_system::settings::{ScaleBy, ScalingChoice};
use serde::{Deserialize, Serialize};

use crate::document::{Analysis, AnalysisKind, Document, Scaling, StepChoice};
use crate::text::report::Problem;

/// From when to when, in how many steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// First time [s].
    pub start: f64,
    /// Last time [s].
    pub end: f64,
    /// Number of steps; the last may be shorter.
    pub steps: usize,
    /// Which instants are recorded.
    pub records: Records,
    /// Whether it is a load history without inertia.
    pub is_static: bool,
    /// Whether steps are chosen by their error: then `steps` has no meaning.
    pub is_controlled: bool,
}

/// Which instants are recorded, besides the start and the end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Records {
    /// The ends of every so many steps.
    Every(usize),
    /// Instants at this distance [s], at which steps end.
    Ends(f64),
    /// Instants at this distance [s], wherever steps end.
    Within(f64),
    /// So many instants at equal distances in each step, but none closer to the last one than `least` [s].
    Resolved {
        /// Per step; the last of them is its end.
        per_step: usize,
        /// Shortest time from one to the next [s].
        least: f64,
    },
}

/// Most records of a run if nothing is said about them.
const MOST_RECORDS: f64 = 5000.0;

impl Records {
    /// Records of steps that are chosen by their error. `output_step` [s] is the requested distance, if any.
    fn of_chosen_steps(scheme: &Scheme, output_step: Option<f64>, duration: f64) -> Self {
        match output_step {
            Some(step) if scheme.dense.is_some() => Self::Within(step),
            Some(step) => Self::Ends(step),
            None => Self::Resolved { per_step: scheme.samples(), least: duration / MOST_RECORDS },
        }
    }
}

/// First and longest load step of chosen size, as parts of the whole range.
const FIRST_LOAD_STEP: f64 = 0.1;
const LONGEST_LOAD_STEP: f64 = 0.25;

/// Settings and plan of an analysis.
///
/// # Errors
/// If a word or a parameter is invalid.
pub fn settings(document: &Document) -> Result<(Settings, Plan), Problem> {
    let analysis = &document.analysis;
    let duration = analysis.end - analysis.start;
    let (scheme, step_size, steps, choice) = match &analysis.kind {
        AnalysisKind::Dynamics { step, control } => {
            let steps = (duration / step.value - 1e-6).ceil().max(1.0);
            (scheme(analysis)?, step.value, steps as usize, *control)
        }
        AnalysisKind::Statics { steps: Some(steps), .. } => {
            (statics::statics(), duration / *steps as f64, *steps, None)
        }
        AnalysisKind::Statics { steps: None, relative_tolerance } => {
            let max_step = LONGEST_LOAD_STEP * duration;
            let choice = StepChoice {
                relative_tolerance: *relative_tolerance,
                max_step,
                output_step: None,
                of: Controlled::Positions,
            };
            (statics::statics(), FIRST_LOAD_STEP * duration, 1, Some(choice))
        }
        AnalysisKind::Modes { .. } | AnalysisKind::Path { .. } | AnalysisKind::Buckling { .. } => {
            (statics::statics(), duration, 1, None)
        }
    };
    let control = choice.map(|choice| StepControl {
        relative_tolerance: choice.relative_tolerance,
        max_step: choice.max_step,
        of: choice.of,
    });
    let solver = analysis.solver.as_ref().map_or("sparse", |solver| solver.value.as_str());
    let Some(solver) = lissom_solver::kind(solver) else {
        return Err(Problem::error(analysis.span, format!("unknown solver `{solver}`")));
    };
    let settings = Settings {
        scheme,
        step_size,
        control,
        scaling: ScalingChoice {
            by: match analysis.conditioning.scaling {
                Scaling::Physical => ScaleBy::Physical,
                Scaling::Unit => ScaleBy::Unit,
                Scaling::None => ScaleBy::None,
            },
            equilibrated: analysis.conditioning.equilibrated,
            augmented: analysis.conditioning.augmented,
            penalty: analysis.conditioning.penalty,
        },
        limits: Limits {
            tolerance: analysis.tolerance,
            max_iterations: analysis.max_iterations,
            disabled: analysis.disabled,
            tuning: lissom_system::tuning::Tuning::default(),
        },
        solver,
        threads: 1,
        from_equilibrium: document.starts_in_equilibrium(),
        follow_drives: document.initial.is_none_or(|initial| initial.follow_drives),
        energy_check: analysis.energy_check,
    };
    let is_static = !matches!(analysis.kind, AnalysisKind::Dynamics { .. });
    let records = match (analysis.records.output_every, choice) {
        (every, Some(choice)) if !is_static && (every.is_none() || choice.output_step.is_some()) => {
            Records::of_chosen_steps(&settings.scheme, choice.output_step, duration)
        }
        (every, _) => Records::Every(every.unwrap_or(1)),
    };
    let plan = Plan {
        start: analysis.start,
        end: analysis.end,
        steps,
        records,
        is_static,
        is_controlled: choice.is_some(),
    };
    Ok((settings, plan))
}

fn scheme(analysis: &Analysis) -> Result<Scheme, Problem> {
    let (name, span) = analysis
        .scheme
        .as_ref()
        .map_or(("generalized-alpha", analysis.span), |word| (&*word.value, word.span));
    let fault = |error: lissom_mechanics::registry::ParameterError| Problem::error(span, error.to_string());
    let kind = schemes::kind(name).ok_or_else(|| Problem::error(span, format!("unknown scheme `{name}`")))?;
    let own = kind.parameters.iter().find(|own| analysis.parameters.has(own.name));
    let given = own.map(|own| analysis.parameters.number(own.name)).transpose().map_err(fault)?;
    kind.scheme(given).map_err(|error| Problem::error(span, error.to_string()))
}
