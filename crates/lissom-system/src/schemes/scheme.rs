//! The parts of a scheme: its stages as linear combinations, its linear systems, its parameters. The table of all schemes is in
//! `schemes`.

use num_complex::Complex64;

use super::dense_polynomial::DensePolynomial;
use lissom_mechanics::kinematics::step_stages::STAGES;
use lissom_mechanics::registry::{DefaultValue, Parameter};

/// Maximum number of stages of a scheme.
pub const MAX_STAGES: usize = 7;

/// Coefficients of a linear combination.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combination {
    /// Coefficient of each stage's increment.
    pub increments: [f64; MAX_STAGES],
    /// Coefficient of the velocity q' at the start.
    pub velocity: f64,
    /// Coefficient of the scheme's algorithmic acceleration at the start, which is similar to q''.
    pub algorithmic: f64,
    /// Coefficient of the acceleration q'' at the start.
    pub acceleration: f64,
}

impl Combination {
    /// A combination of increments only, with these coefficients.
    pub fn of_increments(coefficients: &[f64]) -> Self {
        let mut increments = [0.0; MAX_STAGES];
        increments[..coefficients.len()].copy_from_slice(coefficients);
        Self { increments, ..Self::default() }
    }

    /// `factor` times this.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.increments.iter_mut().for_each(|value| *value *= factor);
        self.velocity *= factor;
        self.algorithmic *= factor;
        self.acceleration *= factor;
        self
    }

    /// Sum of two.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        for (value, add) in self.increments.iter_mut().zip(other.increments) {
            *value += add;
        }
        self.velocity += other.velocity;
        self.algorithmic += other.algorithmic;
        self.acceleration += other.acceleration;
        self
    }
}

/// One stage: an instant at which equilibrium and constraints hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Position in the step, 0 … 1.
    pub abscissa: f64,
    /// q' at the stage minus that at the start.
    pub velocity: Combination,
    /// q'' at the stage.
    pub acceleration: Combination,
    /// Initial guess of the increment.
    pub prediction: Combination,
}

/// Parametrization of the motion of a rotating frame H by a scheme's increments z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parametrization {
    /// H = H_start exp(c q'_start + z), and q' is the body twist: the scheme is defined on the Lie group. Only the
    /// departure z from extrapolation is unknown, so that it keeps its digits in short steps.
    FromStart,
    /// H = H_start exp(c q'_start) exp z, the departure from extrapolation with the twist at the start, c the stage's
    /// abscissa. q' - q'_start is the rate of z: the scheme is defined in these local coordinates. They remain small
    /// however fast the frame rotates, and both stages have nearly the same tangent.
    RelativeToDrift,
    /// x = x_start + R (c x'_start + z_x), R = R_start exp(c θ'_start + z_θ), with z, x' and θ' in body axes: a velocity in body axes at
    /// the end, whose change in inertial axes is the acceleration. A spinning part in free flight keeps its velocity, which schemes of
    /// first order would lose otherwise.
    Inertial,
}

/// Derivatives of velocity and acceleration with respect to the increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<T> {
    /// ∂q'/∂z.
    pub velocity: T,
    /// ∂q''/∂z.
    pub acceleration: T,
    /// Factor of constraints of velocities.
    pub slip: T,
    /// Factor of their augmented term.
    pub slip_augmented: f64,
}

impl Weights<f64> {
    /// Weights of load steps: a constraint of velocities, such as a latch, then keeps what it constrains at its place.
    pub const AT_REST: Self = Self { velocity: 0.0, acceleration: 0.0, slip: 1.0, slip_augmented: 1.0 };
}

impl<T: Copy> Weights<T> {
    /// Weights of a motion.
    pub fn of_motion(velocity: T, acceleration: T) -> Self {
        Self { velocity, acceleration, slip: velocity, slip_augmented: 0.0 }
    }
}

/// A linear system of the size of one stage. With the residuals r of the stages, solve J w = Σ left_i r_i; its contribution
/// to the correction of stage i is Re(right_i w).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decoupled<T> {
    /// Weights of its matrix J.
    pub weights: Weights<T>,
    /// Row of T⁻¹, by stage.
    pub left: [T; MAX_STAGES],
    /// Column of T, by stage; doubled for a pair of complex conjugates.
    pub right: [T; MAX_STAGES],
}

/// A decoupled system, one for each real eigenvalue or complex conjugate pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StageSystem {
    /// For a real eigenvalue.
    Real(Decoupled<f64>),
    /// For a complex conjugate pair.
    Complex(Decoupled<Complex64>),
}

/// The decoupled systems whose solutions sum to the corrections of all stages: with one tangent for all stages, T
/// diagonalises A⁻¹, the matrix of the velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// One per real eigenvalue and per complex conjugate pair.
    pub systems: Vec<StageSystem>,
}

impl Coupling {
    /// One stage with these weights.
    pub fn single(weights: Weights<f64>) -> Self {
        let alone = Combination::of_increments(&[1.0]).increments;
        Self { systems: vec![StageSystem::Real(Decoupled { weights, left: alone, right: alone })] }
    }

    /// Re(1/∂q''/∂z) of the first system: for vibrations with h ω ≪ 1, what its matrix adds to the mass over the stiffness.
    pub fn inertial_share(&self) -> f64 {
        match self.systems.first() {
            Some(StageSystem::Real(of)) => 1.0 / of.weights.acceleration,
            Some(StageSystem::Complex(of)) => of.weights.acceleration.re / of.weights.acceleration.norm_sqr(),
            None => 1.0,
        }
    }
}

/// Coefficients of a Runge-Kutta method that integrates velocities, strains and violations from their rates at the
/// stages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tableau {
    /// A: weights of the rates at the stages, for the values at a stage.
    pub stages: [[f64; STAGES]; STAGES],
    /// b: the same for the end of the step.
    pub end: [f64; STAGES],
    /// A⁻¹: from changes at the stages to rates.
    pub inverse: [[f64; STAGES]; STAGES],
    /// bᵀA⁻¹: from changes at the stages to the change over the step.
    pub reached: [f64; STAGES],
    /// Dissipation α, 0 (none) … 1 (high frequencies vanish).
    pub dissipation: f64,
}

impl Tableau {
    /// Whether the last stage is the end of the step in every respect.
    pub fn is_stiffly_accurate(&self) -> bool {
        self.dissipation == 1.0
    }
}

/// Error estimate for a step, a linear combination of its increments and its start. If the estimate of every step is τ^(k/p)/2,
/// with its `order` k and the order p of the scheme, the error at the end of a run is about τ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorEstimate {
    /// The estimate.
    pub combination: Combination,
    /// Order of the estimate in the step size.
    pub order: i32,
    /// The estimate for an oscillation of unit amplitude, over the power `order` of its phase per step.
    pub of_oscillation: f64,
}

/// A time-integration scheme for unit steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    /// Name including its parameter.
    pub name: String,
    /// The stages; without a tableau, the last is the end of the step.
    pub stages: Vec<Stage>,
    /// The scheme's algorithmic acceleration at the end of the step.
    pub algorithmic: Combination,
    /// What the increments mean.
    pub parametrization: Parametrization,
    /// The decoupled linear systems.
    pub coupling: Coupling,
    /// For schemes that integrate velocities, strains and violations; other schemes evaluate strains and violations
    /// at the stages.
    pub tableau: Option<Tableau>,
    /// Time after the start of the first step whose acceleration initialises the memory, in steps.
    pub memory_delay: f64,
    /// Order of the positions at the end of a run.
    pub order: i32,
    /// Estimated errors of a step, of positions. The last is also that of first-order states, which have no acceleration.
    pub errors: Vec<ErrorEstimate>,
    /// Error at the end of a run with constant step size, as a fraction of the sum of the estimated errors.
    pub planned_share: f64,
    /// Weights of the stages for integrals over the step; none if these are interpolated between the ends.
    pub quadrature: Vec<f64>,
    /// The motion within a step; none if it is interpolated between the ends.
    pub dense: Option<DensePolynomial>,
    /// Whether inertia is included.
    pub dynamic: bool,
}

impl Scheme {
    /// At how many instants per step its motion is sampled so that straight lines between them show it: steps of more stages are
    /// longer.
    pub fn samples(&self) -> usize {
        let stages = self.stages.len();
        if self.dense.is_some() { (stages * (stages - 1) / 2).max(1) } else { 1 }
    }
}

/// A parameter out of range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("`{parameter}` = {value} is outside {lowest} … {highest}")]
pub struct SchemeError {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Value of the parameter.
    pub value: f64,
    /// Lowest value allowed.
    pub lowest: f64,
    /// Highest value allowed.
    pub highest: f64,
}

/// How contacts of solids are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactSolution {
    /// Each touch is an element: a stiff spring with damper, whose begin and end are events.
    #[default]
    Elements,
    /// All touches of a step are found together with its motion, see [`ContactSet`](lissom_contact::set::ContactSet).
    Set,
}

/// A kind of scheme in the model file.
#[derive(Clone, Copy, Debug)]
pub struct SchemeKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Default tolerance of Newton's iterations, if the scheme needs its own.
    pub tolerance: Option<f64>,
    /// How it solves contacts by default. Schemes whose default are elements cannot use sets.
    pub contacts: ContactSolution,
    /// Parameter of the scheme, if it has one, with its default.
    pub parameters: &'static [Parameter],
    /// Builds the scheme of the parameter.
    pub build: fn(f64) -> Result<Scheme, SchemeError>,
}

impl SchemeKind {
    /// The scheme of the parameter, or of its default.
    ///
    /// # Errors
    /// If the parameter is out of range.
    pub fn scheme(&self, given: Option<f64>) -> Result<Scheme, SchemeError> {
        let default = match self.parameters {
            [Parameter { default: Some(DefaultValue::Number(default)), .. }] => *default,
            _ => 0.0,
        };
        (self.build)(given.unwrap_or(default))
    }
}

/// Returns `value` if it is between the limits.
pub(super) fn within(
    parameter: &'static str,
    value: f64,
    (lowest, highest): (f64, f64),
) -> Result<f64, SchemeError> {
    if (lowest..=highest).contains(&value) {
        Ok(value)
    } else {
        Err(SchemeError { parameter, value, lowest, highest })
    }
}
