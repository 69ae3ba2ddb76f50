//! Why initial values do not exist.

/// Initial values that do not exist.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InitialError {
    /// A pivot vanished.
    #[error("initial accelerations: elimination stops at a pivot of {pivot:.1e} for the {unknown}; {hint}")]
    ZeroPivot {
        /// The pivot.
        pivot: f64,
        /// Name of the unknown.
        unknown: String,
        /// What to try.
        hint: &'static str,
    },
    /// A signal is not finite.
    #[error("at the start: {0}")]
    Signal(crate::signals::SignalError),
    /// States where there are no rates.
    #[error(
        "statics and a start from equilibrium know no rates: {0} has no equation there; remove states, friction and \
         rolling joints, or start a dynamic analysis as it is"
    )]
    StateInStatics(String),
    /// The places of rest were not found.
    #[error("initial equilibrium: {0}")]
    NoEquilibrium(Box<super::StepError>),
    /// Something is free to rest anywhere.
    #[error(
        "initial equilibrium: nothing holds or carries the {free}: neither weight nor a spring decides where it rests, so any place \
         is as good as another; hold it by a joint, a drive or a spring, or start from the places given, without an equilibrium"
    )]
    Free {
        /// Coordinates of joints, or freedoms of nodes, that are free.
        free: String,
    },
    /// Velocities that the constraints exclude altogether.
    #[error(
        "the initial velocity of `{part}`, {given}, is excluded by the joints and drives: nothing of it remains; leave it \
         out, or free what shall move"
    )]
    VelocityImpossible {
        /// Name of the node.
        part: String,
        /// Its velocities in words.
        given: String,
    },
    /// Drives or joints ask for different velocities.
    #[error("at the start {violated} contradict each other: no velocities satisfy them all, {cause}")]
    RatesContradict {
        /// Names of the constraints.
        violated: String,
        /// The cause, and what to try.
        cause: &'static str,
    },
    /// Normal forces and the creep forces that they allow do not agree.
    #[error(
        "initial accelerations: the normal forces of wheels on rails and the creep forces they allow are not found together (they \
         still change by {change:.1e} of their size); look at friction_coefficient and at how the wheels are held"
    )]
    NormalForces {
        /// The last change, relative to the largest multiplier.
        change: f64,
    },
    /// A beam is turned too far within an element.
    #[error("at the start: {0}")]
    Wrapped(Box<super::StepError>),
    /// A number is not finite.
    #[error(
        "initial accelerations are not finite, first for the {unknown}: a force there is without bound at the start, or masses are \
         too far apart; look at what acts on it, and at the units"
    )]
    NotFinite {
        /// Name of the unknown.
        unknown: String,
    },
}
