//! What a scheme consists of: its stages as linear combinations, its linear systems, its parameters. The table of all schemes is
//! in `schemes`.

use num_complex::Complex64;

use crate::kinematics::step_stages::STAGES;

/// Most stages a scheme may have.
pub const MAX_STAGES: usize = 3;

/// Coefficients of a linear combination.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combination {
    /// Of each stage's increment.
    pub increments: [f64; MAX_STAGES],
    /// Of the rate q' at the start.
    pub rate: f64,
    /// Of the scheme's memory at the start, which is like q''.
    pub algorithmic: f64,
    /// Of the curvature q'' at the start.
    pub curvature: f64,
}

impl Combination {
    /// `factor` times this.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.increments.iter_mut().for_each(|value| *value *= factor);
        self.rate *= factor;
        self.algorithmic *= factor;
        self.curvature *= factor;
        self
    }

    /// Sum of two.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        for (value, add) in self.increments.iter_mut().zip(other.increments) {
            *value += add;
        }
        self.rate += other.rate;
        self.algorithmic += other.algorithmic;
        self.curvature += other.curvature;
        self
    }
}

/// One stage: an instant at which equilibrium and constraints hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Position in the step, 0 … 1.
    pub abscissa: f64,
    /// q' at the stage, less that at the start.
    pub rate: Combination,
    /// q'' at the stage.
    pub curvature: Combination,
    /// A first guess of the increment.
    pub prediction: Combination,
}

/// What a scheme's increments z mean for a frame H that turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Increments {
    /// H = H_start exp(c q'_start + z), and q' is the body twist: the scheme is stated on the Lie group. Only
    /// the departure z from going straight on is unknown, so that it keeps its digits in short steps.
    FromStart,
    /// H = H_start exp(c q'_start) exp z, the departure from going on as at the start, c the stage's
    /// abscissa. q' - q'_start is the rate of z: the scheme is stated in these local coordinates. They stay small
    /// however fast the frame turns, and both stages see nearly the same tangent.
    Departure,
}

/// Derivatives of rate and curvature with respect to the increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<T> {
    /// ∂q'/∂z.
    pub rate: T,
    /// ∂q''/∂z.
    pub curvature: T,
}

/// A linear system of the size of one stage. With the residuals r of the stages, solve J w = Σ left_i r_i; the corrections of
/// stage i have the part Re(right_i w).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decoupled<T> {
    /// Weights of its matrix J.
    pub weights: Weights<T>,
    /// Row of T⁻¹, by stage.
    pub left: [T; MAX_STAGES],
    /// Column of T, by stage; twice that for a pair of complex conjugates.
    pub right: [T; MAX_STAGES],
}

/// A decoupled system of a real eigenvalue, or of a pair of complex ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StageSystem {
    /// Of a real eigenvalue.
    Real(Decoupled<f64>),
    /// Of a pair of complex conjugates.
    Complex(Decoupled<Complex64>),
}

/// The decoupled systems whose solutions add up to the corrections of all stages: with one tangent for all stages, T
/// diagonalises A⁻¹, the matrix of the rates.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// One per real eigenvalue and per pair of complex ones.
    pub systems: Vec<StageSystem>,
}

impl Coupling {
    /// One stage with these weights.
    pub(crate) fn single(weights: Weights<f64>) -> Self {
        let alone = [1.0, 0.0, 0.0];
        Self { systems: vec![StageSystem::Real(Decoupled { weights, left: alone, right: alone })] }
    }
}

/// Coefficients of a Runge-Kutta method that integrates velocities, strains and violations from their rates at
/// the stages.
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
    pub(crate) fn is_stiffly_accurate(&self) -> bool {
        self.dissipation == 1.0
    }
}

/// A time-integration scheme for unit steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    /// Name, with its parameter.
    pub name: String,
    /// The stages; without tableau, the last is the end of the step.
    pub stages: Vec<Stage>,
    /// The scheme's memory at the end of the step.
    pub algorithmic: Combination,
    /// What the increments mean.
    pub increments: Increments,
    /// How the linear systems come apart.
    pub coupling: Coupling,
    /// For schemes that integrate velocities, strains and violations; the others evaluate strains and
    /// violations where a stage is.
    pub tableau: Option<Tableau>,
    /// The memory starts as the acceleration this long after the start of the first step, in steps.
    pub memory_delay: f64,
    /// Local error at the end of a step over what the last stage's prediction misses, both of third order.
    pub error_constant: f64,
    /// Order of the errors that step control keeps at the tolerance: those of positions, unless velocities are of lower order.
    pub controlled_order: i32,
    /// Error at the end of a run with steps of one size, as a fraction of the sum of such errors.
    pub planned_share: f64,
    /// Whether inertia takes part.
    pub dynamic: bool,
}

/// Parameters a scheme may take.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SchemeParameters {
    /// α of HHT-α, -1/3 … 0.
    pub alpha: Option<f64>,
    /// Spectral radius at infinite frequency, 0 … 1.
    pub spectral_radius: Option<f64>,
}

/// A parameter out of range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("`{parameter}` = {value} is outside {lowest} … {highest}")]
pub struct SchemeError {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Its value.
    pub value: f64,
    /// Lowest value allowed.
    pub lowest: f64,
    /// Highest value allowed.
    pub highest: f64,
}

/// A kind of scheme, as the model file knows it.
#[derive(Clone, Copy, Debug)]
pub struct SchemeKind {
    /// Name in the model file.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Tolerance of Newton's iterations where the user names none and the scheme needs its own.
    pub tolerance: Option<f64>,
    /// Makes the scheme.
    pub build: fn(&SchemeParameters) -> Result<Scheme, SchemeError>,
}

/// `value`, if it lies between the limits.
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
