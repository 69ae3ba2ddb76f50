//! Settings of a simulation.

use lissom_solver::SolverKind;

use crate::schemes::Scheme;
use crate::solver_features::DisabledFeatures;
use crate::tuning::Tuning;

/// Settings of a simulation, besides system and state.
#[derive(Clone)]
pub struct Settings {
    /// Time scheme.
    pub scheme: Scheme,
    /// Step size [s], with step-size control that of the first step; in statics, the step of the load parameter.
    pub step_size: f64,
    /// Step-size control; none for steps of one size.
    pub control: Option<StepControl>,
    /// Scaling and augmented term.
    pub scaling: ScalingChoice,
    /// When Newton's iterations stop.
    pub limits: Limits,
    /// Linear solver.
    pub solver: &'static SolverKind,
    /// Threads that evaluate elements and joints of a large system. Results do not depend on it.
    pub threads: usize,
    /// Whether a motion starts from the static equilibrium under the loads of the first instant.
    pub from_equilibrium: bool,
    /// Whether flexible parts without given velocities start with those that deform them least, instead of those with the least
    /// kinetic energy, if drives or joints set them in motion.
    pub follow_drives: bool,
    /// Whether a motion with much more energy than anything put in fails.
    pub energy_check: bool,
}

/// What the user asks of step-size control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepControl {
    /// Error to be expected of places at the end, relative to how far the model has moved, see `integrator/error_estimate` [-].
    pub relative_tolerance: f64,
    /// Largest step [s].
    pub max_step: f64,
    /// What the tolerance applies to.
    pub of: Controlled,
}

/// Whose errors determine adaptive steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Controlled {
    /// Errors of positions, velocities and states.
    #[default]
    Positions,
    /// Errors of accelerations and forces too, relative to the largest acceleration: steps resolve every vibration that
    /// contributes to them.
    Forces,
}

/// Stopping criteria.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Estimated remaining error relative to the correction's reference [-].
    pub tolerance: f64,
    /// Maximum number of iterations in one solution.
    pub max_iterations: usize,
    /// Features that are switched off, for studies.
    pub disabled: DisabledFeatures,
    /// Parameters of the solver.
    pub tuning: Tuning,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            max_iterations: 25,
            disabled: DisabledFeatures::default(),
            tuning: Tuning::default(),
        }
    }
}

/// How the equations are scaled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScaleBy {
    /// s = m_r + d_r h + k_r h², from the model's representative mass, damping and stiffness.
    #[default]
    Physical,
    /// s = 1.
    Unit,
    /// No scaling: the equations in SI units.
    None,
}

impl ScaleBy {
    /// Names in the model file.
    pub const NAMES: &'static [&'static str] = &["physical", "unit", "none"];

    /// Name of the choice in the model file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Physical => "physical",
            Self::Unit => "unit",
            Self::None => "none",
        }
    }
}

/// The user's choice of scaling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalingChoice {
    /// How s is determined.
    pub by: ScaleBy,
    /// Whether rows and columns of a scaled tangent are also equilibrated.
    pub equilibrated: bool,
    /// Whether the augmented Lagrangian term is included.
    pub augmented: bool,
    /// Factor p of the augmented term [-].
    pub penalty: f64,
}

/// Small, because s includes the stiffest part of the model. With p = 1 the augmented term is a spring as stiff as
/// that part across every constraint, and a tangent that is kept while joints rotate contracts slowly. On the tip
/// crank (HHT, h = 1e-4 s) p = 1 takes 395 tangents, 1e-3 takes 45 and 1e-6 takes 37. Any p > 0 makes the block of
/// massless coordinates definite.
pub const DEFAULT_PENALTY: f64 = 1e-3;

impl Default for ScalingChoice {
    fn default() -> Self {
        Self { by: ScaleBy::Physical, equilibrated: true, augmented: true, penalty: DEFAULT_PENALTY }
    }
}

impl ScalingChoice {
    /// Whether tangents are equilibrated: only scaled ones are.
    pub fn equilibrates(&self) -> bool {
        self.equilibrated && self.by == ScaleBy::Physical
    }
}

impl Settings {
    /// What to change where steps do not resolve the motion, except what is the case already, or what contacts that are solved as a
    /// set exclude.
    pub fn resolution_remedy(&self, has_sets: bool) -> &'static str {
        if has_sets {
            return "use a smaller step";
        }
        match (self.control.is_some(), self.scheme.name.starts_with("radau-iia")) {
            (true, true) => "use a smaller `relative_tolerance`",
            (true, false) => "use a smaller `relative_tolerance`, or choose `scheme = \"radau-iia\"`",
            (false, true) => "use a smaller step, or set `relative_tolerance` instead of `step`",
            (false, false) => {
                "use a smaller step, set `relative_tolerance` instead of `step`, or choose `scheme = \"radau-iia\"`"
            }
        }
    }
}
