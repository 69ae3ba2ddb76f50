//! Why a step failed, with where and when.

use lissom_solver::FactorError;

use super::dynamics::Settings;
use crate::newton::Failure;
use crate::system::Layout;

/// A step that could not be completed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// Newton's iterations did not converge.
    #[error(
        "step to t = {time:.6e} s did not converge in {iterations} iterations: last correction {correction:.1e}, \
         worst equation: {worst}; {hint}"
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
        /// What to try.
        hint: &'static str,
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
    /// Something passes through zero again and again.
    #[error(
        "at t = {time:.6e} s {what} switches again and again, a thousand times within one step: the motion slides along \
         the surface where it switches; give it a width (`tanh(v/0.01)` instead of `sign(v)`, hysteresis for an event), \
         or use a kind made for it, such as friction"
    )]
    Chatters {
        /// Time [s].
        time: f64,
        /// What switches.
        what: String,
    },
    /// A time to be stepped to is not finite.
    #[error("a session cannot be stepped to the time {target} s: give a finite time")]
    NoTime {
        /// What was asked for [s].
        target: f64,
    },
    /// A signal is not finite.
    #[error("{0}")]
    Signal(crate::signals::SignalError),
    /// Constraints are not held, though the equations were solved.
    #[error(
        "at t = {time:.6e} s constraints contradict each other: violated are {violated}; a drive asks for a place that \
         the joints do not allow, or two of them ask for different ones: remove one, or change what is prescribed"
    )]
    Contradiction {
        /// End of the step [s].
        time: f64,
        /// Names and violations of the constraints that are violated most.
        violated: String,
    },
    /// A node turns further than a step resolves.
    #[error(
        "step to t = {time:.6e} s: node `{node}` turns by {angle:.2} rad in it, and angles beyond a quarter of a turn a \
         step are not resolved; take a smaller step, or set `relative_tolerance`"
    )]
    TurnsTooFar {
        /// End of the step [s].
        time: f64,
        /// Name of the node.
        node: String,
        /// Angular velocity times step [rad].
        angle: f64,
    },
    /// Nodes of an element are turned against each other by nearly half a turn.
    #[error(
        "at t = {time:.6e} s the beam element between `{}` and `{}` turns by {turns:.2} of half a turn or more: beyond \
         half a turn it would be taken for a turn the other way; use more elements", nodes[0], nodes[1]
    )]
    ElementTurns {
        /// Time [s].
        time: f64,
        /// Names of the two nodes.
        nodes: [String; 2],
        /// Angle between them over π, at most 1.
        turns: f64,
    },
    /// Energy that nothing put in.
    #[error(
        "step to t = {time:.6e} s: there are {surplus:.3e} J more than anything put in, where {turned_over:.3e} J are \
         turned over; the step does not resolve the motion: make it smaller, set `relative_tolerance`, or choose \
         `scheme = \"radau-iia\"`; `energy_check = false` lets such a run go on"
    )]
    EnergyFromNowhere {
        /// End of the step [s].
        time: f64,
        /// Energy that nothing put in, since the start [J].
        surplus: f64,
        /// Energy turned over since the start [J].
        turned_over: f64,
        /// Whether most of it came in this step.
        in_this_step: bool,
    },
    /// It was told to stop while a step was tried again.
    #[error("interrupted after t = {time:.6e} s")]
    Interrupted {
        /// Where the simulation stands [s].
        time: f64,
    },
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
        /// Whether a pivoting solver went on from there, and Newton's iteration failed with it.
        after_pivoting: bool,
    },
}

impl StepError {
    /// Whether a smaller step may have a solution where this one has none.
    pub fn may_need_a_smaller_step(&self) -> bool {
        matches!(
            self,
            Self::NotConverged { .. }
                | Self::NotFinite { .. }
                | Self::Signal(_)
                | Self::TurnsTooFar { .. }
                | Self::ElementTurns { .. }
                | Self::EnergyFromNowhere { in_this_step: true, .. }
                | Self::ZeroPivot { after_pivoting: true, .. }
        )
    }
}

/// What to try when a step, in motion or in statics, has no solution even in parts.
fn convergence_hint(is_motion: bool) -> &'static str {
    if is_motion {
        "try a smaller step, or a larger `max_iterations`"
    } else {
        "even the smallest load steps from there find no equilibrium: the load may be at a limit point (snap-through or \
         buckling), beyond which `kind = \"path\"` can follow it; or take a larger `max_iterations`"
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
        (false, true) => {
            "nothing holds or carries it: give it mass, stiffness or a joint; the force of a wheel that rolls repeats what \
             others hold already: give it a small `creep`"
        }
    }
}

/// A failure of Newton's method as that of a step to `time` [s], with names.
pub(super) fn describe(
    failure: &Failure,
    layout: &Layout,
    time: f64,
    settings: &Settings,
    worst: &str,
) -> StepError {
    match failure {
        Failure::NotConverged { iterations, correction } => StepError::NotConverged {
            time,
            iterations: *iterations,
            correction: *correction,
            worst: worst.to_owned(),
            hint: convergence_hint(settings.scheme.dynamic),
        },
        Failure::NotFinite { iterations } => {
            StepError::NotFinite { time, iterations: *iterations, worst: worst.to_owned() }
        }
        Failure::Factor(FactorError::ZeroPivot { unknown, pivot, .. }) => StepError::ZeroPivot {
            time,
            pivot: *pivot,
            unknown: layout.name_of(*unknown),
            hint: pivot_hint(*unknown >= layout.coordinate_count(), settings.scaling.augmented),
            after_pivoting: false,
        },
        Failure::Factor(FactorError::NotFinite { unknown }) => {
            StepError::NotFinite { time, iterations: 0, worst: layout.name_of(*unknown) }
        }
        Failure::Interrupted => StepError::Interrupted { time },
    }
}
