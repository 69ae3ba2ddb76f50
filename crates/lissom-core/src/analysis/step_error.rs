//! Why a step failed, with where and when.

/// A step that could not be completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// Newton's iterations did not converge.
    #[error(
        "step to t = {time:.6e} s did not converge in {iterations} iterations: last correction {correction:.1e}, \
         worst equation: {worst}; try a smaller step, or a larger `max_iterations`"
    )]
    NotConverged {
        /// End of the step [s].
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Size of the last correction [-].
        correction: f64,
        /// Name of the unknown whose equation is worst.
        worst: String,
    },
    /// Numbers that are not finite appeared.
    #[error(
        "step to t = {time:.6e} s: numbers that are not finite after {iterations} iterations, first in: {worst}; \
         try a smaller step"
    )]
    NotFinite {
        /// End of the step [s].
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Name of the first unknown affected.
        worst: String,
    },
    /// The estimated error stays above the tolerance however short the step.
    #[error(
        "from t = {time:.6e} s: the estimated error stays above `relative_tolerance` down to steps of {size:.1e} s; \
         look for a load or drive that jumps there, or allow a larger error"
    )]
    TooInaccurate {
        /// Start of the step [s].
        time: f64,
        /// Size of the last attempt [s].
        size: f64,
    },
    /// A signal is not finite.
    #[error("{0}")]
    Signal(crate::signals::SignalError),
    /// The velocities at the end of the step could not be made consistent.
    #[error("step to t = {time:.6e} s, velocities at its end: {error}")]
    Velocities {
        /// End of the step [s].
        time: f64,
        /// What went wrong.
        error: super::InitialError,
    },
    /// A pivot vanished.
    #[error(
        "step to t = {time:.6e} s: elimination stops at a pivot of {pivot:.1e} for the {unknown}; {hint}"
    )]
    ZeroPivot {
        /// End of the step [s].
        time: f64,
        /// The pivot.
        pivot: f64,
        /// Name of the unknown.
        unknown: String,
        /// What to try.
        hint: &'static str,
    },
}

impl StepError {
    /// Whether a smaller step may have a solution where this one has none.
    pub fn may_need_a_smaller_step(&self) -> bool {
        matches!(self, Self::NotConverged { .. } | Self::NotFinite { .. } | Self::Signal(_))
    }
}

/// What to try when elimination stops at a coordinate or at a multiplier.
pub(crate) fn pivot_hint(is_multiplier: bool, augmented: bool) -> &'static str {
    match (is_multiplier, augmented) {
        (true, _) => {
            "the joint's equation repeats what other joints hold already: remove or relax one of them"
        }
        (false, false) => {
            "a coordinate without mass and stiffness needs the augmented term: set `augmented = true`"
        }
        (false, true) => "nothing holds or carries it: give it mass, stiffness or a joint",
    }
}
