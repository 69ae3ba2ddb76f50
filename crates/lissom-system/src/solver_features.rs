//! Optional features of the nonlinear solver beyond Newton's method. Each can be switched off (`analysis.without`), so that a
//! command can show its effect.

/// A feature that saves iterations or tangents, or finds solutions that Newton's method alone would miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum SolverFeature {
    /// Initial guesses by linear prediction.
    Prediction,
    /// Secants of earlier corrections (Anderson acceleration).
    Secants,
    /// The first correction is the last if the contraction of earlier solutions allows it.
    SingleCorrection,
    /// A tangent is discarded when solutions with it have become expensive.
    JacobianCost,
    /// Corrections that overshoot are halved.
    BackOff,
    /// Tangents far from equilibrium use the stresses at the start of the step.
    StartStresses,
    /// Steps of planned size without solution are bisected.
    StepBisection,
    /// Increments of rotors are in axes that do not spin.
    StillAxes,
}

/// Every feature with its name and its effect.
pub const SOLVER_FEATURES: [(SolverFeature, &str, &str); 8] = [
    (SolverFeature::Prediction, "prediction", "first guesses by linear prediction from earlier steps"),
    (SolverFeature::Secants, "secants", "corrections improved by secants of earlier ones"),
    (SolverFeature::SingleCorrection, "single-correction", "a first correction accepted as the last"),
    (
        SolverFeature::JacobianCost,
        "account",
        "a tangent renewed when solutions with it have become expensive",
    ),
    (SolverFeature::BackOff, "back-off", "corrections that went too far halved"),
    (
        SolverFeature::StartStresses,
        "start-stresses",
        "tangents far from equilibrium with the stresses at the start",
    ),
    (SolverFeature::StepBisection, "parts", "steps without solution taken in parts"),
    (SolverFeature::StillAxes, "still-axes", "motions of rotors in axes that do not spin"),
];

/// Their names.
pub const WORDS: [&str; SOLVER_FEATURES.len()] = {
    let mut words = [""; SOLVER_FEATURES.len()];
    let mut index = 0;
    while index < words.len() {
        words[index] = SOLVER_FEATURES[index].1;
        index += 1;
    }
    words
};

/// The features that are switched off.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DisabledFeatures(u8);

impl DisabledFeatures {
    /// Switches off one more.
    pub fn and(self, feature: SolverFeature) -> Self {
        Self(self.0 | 1 << feature as u8)
    }

    /// Whether a feature is in use.
    pub fn allows(self, feature: SolverFeature) -> bool {
        self.0 & (1 << feature as u8) == 0
    }

    /// Features by name; none if a name is unknown.
    pub fn of_words<'a>(words: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        words.into_iter().try_fold(Self::default(), |disabled, word| {
            let (feature, ..) = SOLVER_FEATURES.iter().find(|(_, name, _)| *name == word)?;
            Some(disabled.and(*feature))
        })
    }
}
