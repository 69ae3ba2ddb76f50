//! What the search for a step's solution makes use of beside Newton's method itself. Each can be left out, so that a
//! command can show what it is worth.

/// Something that saves iterations or tangents, or finds a solution that Newton's method alone would miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Mechanism {
    /// First guesses by linear prediction.
    Prediction,
    /// Secants of earlier corrections (Anderson's mixing).
    Secants,
    /// A first correction is the last where the contraction of earlier solutions says so.
    SingleCorrection,
    /// A tangent is given up when solutions with it have become dear.
    Account,
    /// Corrections that went too far are halved.
    BackOff,
    /// Tangents far from equilibrium are made with the stresses at the start of the step.
    StartStresses,
    /// Steps of planned size without solution are taken in parts.
    Parts,
}

/// Every mechanism with its word and what it does.
pub const MECHANISMS: [(Mechanism, &str, &str); 7] = [
    (Mechanism::Prediction, "prediction", "first guesses by linear prediction from earlier steps"),
    (Mechanism::Secants, "secants", "corrections improved by secants of earlier ones"),
    (Mechanism::SingleCorrection, "single-correction", "a first correction accepted as the last"),
    (Mechanism::Account, "account", "a tangent renewed when solutions with it have become dear"),
    (Mechanism::BackOff, "back-off", "corrections that went too far halved"),
    (
        Mechanism::StartStresses,
        "start-stresses",
        "tangents far from equilibrium with the stresses at the start",
    ),
    (Mechanism::Parts, "parts", "steps without solution taken in parts"),
];

/// Their words.
pub const WORDS: [&str; MECHANISMS.len()] = {
    let mut words = [""; MECHANISMS.len()];
    let mut index = 0;
    while index < words.len() {
        words[index] = MECHANISMS[index].1;
        index += 1;
    }
    words
};

/// The mechanisms that are left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Without(u8);

impl Without {
    /// Leaves out one more.
    pub fn and(self, mechanism: Mechanism) -> Self {
        Self(self.0 | 1 << mechanism as u8)
    }

    /// Whether a mechanism is in use.
    pub fn has(self, mechanism: Mechanism) -> bool {
        self.0 & (1 << mechanism as u8) == 0
    }

    /// Those of these words; none where a word means nothing.
    pub fn of_words<'a>(words: impl IntoIterator<Item = &'a str>) -> Option<Self> {
        words.into_iter().try_fold(Self::default(), |without, word| {
            let (mechanism, ..) = MECHANISMS.iter().find(|(_, name, _)| *name == word)?;
            Some(without.and(*mechanism))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_leave_out_what_they_name_and_nothing_else() {
        for (mechanism, word, _) in MECHANISMS {
            let without = Without::of_words([word]).expect("a word of the table");
            for (other, ..) in MECHANISMS {
                assert_eq!(without.has(other), other != mechanism);
            }
        }
        assert_eq!(Without::of_words(["pivoting"]), None);
    }
}
