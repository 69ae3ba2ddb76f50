//! Parameters of the nonlinear solver and of step-size control. Each can be halved and doubled by a command that
//! shows their influence. Bounds of round-off and sizes of buffers are defined where they are used.

/// A parameter of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum TuningParameter {
    /// Cost of a new tangent, in iterations: some seven of soft-beam-64 and beam-net-4 take as long. The tangent is renewed
    /// within a solution that would need more of them.
    TangentCost,
    /// If a solution is accepted without a measured contraction, its estimated error must be below this fraction of
    /// the tolerance: many such solutions in a row have errors of the same sign.
    Unseen,
    /// Lower bound of the contraction assumed for a tangent from another solution: the largest part of a correction
    /// may vanish at once and hide a small part that shrinks slowly.
    Contraction,
    /// Corrections that shrink by less than this are round-off if they are small.
    Stalled,
    /// A secant is kept if the tangent's error is below this fraction of it. A worse tangent has to be renewed, and
    /// corrections at round-off contain no information.
    SecantCredible,
    /// Weight of a step after the next one in linear prediction: the coefficients change with the motion.
    PredictionFading,
    /// Safety factor between the step allowed by the estimated error and the one chosen, so that few are rejected.
    Safety,
    /// The step size is kept if it would change by less than this factor: data of earlier steps remain valid.
    Kept,
    /// Allowed error of a step over the tolerance, raised to the power at which errors at the end are proportional to it.
    /// With 1 they are about the tolerance; with a half nine in ten are below it.
    ShareOfStep,
}

/// Every parameter with its name, its value and its use.
pub const TUNING_PARAMETERS: [(TuningParameter, &str, f64, &str); 9] = [
    (TuningParameter::TangentCost, "tangent-cost", 8.0, "iterations that a new tangent costs"),
    (
        TuningParameter::Unseen,
        "unseen",
        0.02,
        "part of the tolerance for solutions whose contraction is not seen",
    ),
    (TuningParameter::Contraction, "contraction", 0.05, "best contraction believed of a kept tangent"),
    (TuningParameter::Stalled, "stalled", 0.5, "contraction of corrections that are round-off"),
    (TuningParameter::SecantCredible, "secant-credible", 0.7, "what a tangent may have missed of a secant"),
    (
        TuningParameter::PredictionFading,
        "prediction-fading",
        0.5,
        "weight of a step after the next one in predictions",
    ),
    (TuningParameter::Safety, "safety", 0.8, "part of the step that the estimated error allows"),
    (TuningParameter::Kept, "kept", 1.2, "changes of steps that are left out"),
    (TuningParameter::ShareOfStep, "share-of-step", 0.5, "part of the tolerance that a step may err"),
];

/// Maximum number of halvings of a planned step, a load step or a correction.
pub const MAX_HALVINGS: u32 = 12;

/// Maximum number of iterations that end by their own criteria: solutions need far fewer, and where there is none this one ends them.
pub const MAX_ITERATIONS: usize = 100;

/// Inverse iterations at a shift close to an eigenvalue; one is sufficient at a distance of 1e-10.
pub const INVERSE_ITERATIONS: usize = 4;

/// Their names.
pub const WORDS: [&str; TUNING_PARAMETERS.len()] = {
    let mut words = [""; TUNING_PARAMETERS.len()];
    let mut index = 0;
    while index < words.len() {
        words[index] = TUNING_PARAMETERS[index].1;
        index += 1;
    }
    words
};

/// The values in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuning([f64; TUNING_PARAMETERS.len()]);

impl Default for Tuning {
    fn default() -> Self {
        Self(std::array::from_fn(|index| TUNING_PARAMETERS[index].2))
    }
}

impl Tuning {
    /// The value of one parameter.
    pub fn of(&self, parameter: TuningParameter) -> f64 {
        self.0[parameter as usize]
    }

    /// With the named parameters multiplied by `factor`; none if a name is unknown.
    pub fn times<'a>(mut self, words: impl IntoIterator<Item = &'a str>, factor: f64) -> Option<Self> {
        for word in words {
            let (parameter, ..) = TUNING_PARAMETERS.iter().find(|(_, name, ..)| *name == word)?;
            self.0[*parameter as usize] *= factor;
        }
        Some(self)
    }
}
