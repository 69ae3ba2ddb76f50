//! Why a step failed, with where and when.

use lissom_solver::FactorError;

use super::settings::Settings;
use crate::kinematics::Layout;
use crate::newton::Failure;

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
        "step to t = {time:.6e} s: numbers that are not finite after {iterations} iterations, first in: {worst}; {hint}"
    )]
    NotFinite {
        /// End of the step [s].
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Name of the first unknown affected.
        worst: String,
        /// What to try.
        hint: &'static str,
    },
    /// A joint has come to a place where one of its equations vanishes.
    #[error(
        "step to t = {time:.6e} s did not converge: the `{kind}` joint `{joint}` has come to where its parts are turned by \
         {angle:.1} degrees against each other, and there its equation {equation} vanishes and holds nothing; keep it away from \
         there by a stop, by other lengths or by another start, or use a joint of another kind"
    )]
    JointLosesHold {
        /// End of the step [s].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
        /// Its equation.
        equation: &'static str,
        /// Angle of the relative rotation of its parts [degrees].
        angle: f64,
    },
    /// A closed loop has come to a singular position.
    #[error(
        "step to t = {time:.6e} s did not converge: {beside:.2} degrees before it the mechanism has a singular position, where \
         the equations of {joints} repeat each other and it locks or may go on in more than one way; keep it away from there by \
         other lengths, another drive or another start"
    )]
    LoopIsSingular {
        /// End of the step [s].
        time: f64,
        /// Joints whose equations repeat each other there, in words.
        joints: String,
        /// How far it is from there [degrees].
        beside: f64,
    },
    /// Something changes its side within a step that has no solution however short.
    #[error(
        "step to t = {time:.6e} s did not converge, nor do its shortest parts: within it {what} switches, and on neither side of the \
         switch the motion can go on; give the jump a width (`tanh(v/0.01)` instead of `sign(v)`), use a kind made for it, such as \
         friction, or set `relative_tolerance` instead of `step`, which ends steps where forces switch"
    )]
    Switches {
        /// End of the step [s].
        time: f64,
        /// What switches.
        what: String,
    },
    /// The estimated error stays above the tolerance however short the step.
    #[error(
        "from t = {time:.6e} s: the estimated error stays above `relative_tolerance` down to steps of {size:.1e} s, most \
         in the {unknown}; look for a load or drive that jumps there, or allow a larger error"
    )]
    TooInaccurate {
        /// Start of the step [s].
        time: f64,
        /// Size of the last attempt [s].
        size: f64,
        /// Name of the unknown with the largest estimated error.
        unknown: String,
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
    /// A function of time is not finite.
    #[error(
        "step to t = {time:.6e} s: {what} is {value} at t = {at:.6e} s, or its derivative is: an argument is outside of what its \
         functions allow; keep it within, for instance by `max(…, 0)` under a root or `clamp`, or end the run before"
    )]
    FunctionNotFinite {
        /// End of the step [s].
        time: f64,
        /// The function, in words.
        what: String,
        /// What it, or its derivative, comes to.
        value: f64,
        /// Where [s].
        at: f64,
    },
    /// Constraints are not held, though the equations were solved.
    #[error(
        "at t = {time:.6e} s constraints contradict each other: violated are {violated}: a drive asks for a place that \
         the joints do not allow, or two of them ask for different ones; remove one, or change what is prescribed"
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
    /// A slider has left its beam.
    #[error(
        "step to t = {time:.6e} s: slider `{joint}` passes the end of its beam: it is at {place:.6e} m of {length:.6e} m; make the \
         beam longer, hold it with a spring of kind `axial_stop`, or end the run before with an event"
    )]
    BeyondBeam {
        /// Time [s].
        time: f64,
        /// Name of the slider.
        joint: String,
        /// Its coordinate [m].
        place: f64,
        /// Length of the beam [m].
        length: f64,
    },
    /// The kinetic energy of a superelement is negative in some motion.
    #[error(
        "step to t = {time:.6e} s: the superelement with the interface `{interface}` is deformed beyond the range of its second-order \
         matrices: its kinetic energy is no longer positive; reduce the part in several pieces or without corrections (`--modes-alone`), or \
         model it by beams"
    )]
    NegativeKineticEnergy {
        /// End of the step [s].
        time: f64,
        /// Name of the first interface.
        interface: String,
    },
    /// Energy that nothing put in.
    #[error(
        "step to t = {time:.6e} s: there are {surplus:.3e} J more than anything put in, where {turned_over:.3e} J are \
         turned over, because the step does not resolve the motion, which is most restless at node `{node}`; make it smaller, set `relative_tolerance`, or choose \
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
        /// Name of the node whose velocity changes most in the step.
        node: String,
    },
    /// It was interrupted while a step was tried again.
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
                | Self::FunctionNotFinite { .. }
                | Self::TurnsTooFar { .. }
                | Self::ElementTurns { .. }
                | Self::JointLosesHold { .. }
                | Self::NegativeKineticEnergy { .. }
                | Self::EnergyFromNowhere { in_this_step: true, .. }
                | Self::ZeroPivot { after_pivoting: true, .. }
        )
    }
}

/// What to try when numbers of one attempt are not finite.
pub(crate) const SMALLER: &str = "try a smaller step";
/// What to try when a step has no solution even in the smallest parts.
pub(super) const NO_PART_CONVERGES: &str = "the shortest parts of it, a thousandth and less, do not either, so that a smaller `step` will hardly help: look there for a \
     force that jumps or grows without bound, for units that do not agree, for a joint close to where it cannot go on, and for a small `max_iterations`";
/// The same where numbers are not finite.
pub(super) const NO_PART_IS_FINITE: &str = "nor are they in the shortest parts of it, so that a smaller `step` will hardly help: look there for a force that grows \
     without bound, for masses or stiffnesses too far apart, and for units that do not agree";

/// What to try where an equilibrium path ends: it tries shorter steps itself.
pub(crate) const NO_STEP_HELPS: &str = "shorter steps along the path find none either: a force or a joint may reach there what it cannot go beyond; end the path \
     before it, or soften what jumps there";

/// What to try when a step, in motion or in statics, has no solution even in parts.
fn convergence_hint(is_motion: bool) -> &'static str {
    if is_motion {
        "try a smaller step, or a larger `max_iterations`"
    } else {
        "even the smallest load steps from there find no equilibrium: the load may be at a limit point (snap-through or \
         buckling), beyond which `kind = \"path\"` can follow it; or take a larger `max_iterations`"
    }
}

/// What to try when elimination stops at an unknown, a coordinate or a multiplier.
pub(crate) fn pivot_hint(unknown: usize, layout: &Layout, augmented: bool) -> &'static str {
    if unknown >= layout.coordinate_count() {
        return "the joint's equation repeats what other joints hold already: remove or relax one of them";
    }
    if !augmented {
        return "a coordinate without mass and stiffness needs the augmented term: set `augmented = true`";
    }
    if layout.impulses().next().is_some() {
        return "nothing holds or carries it there: give it mass, stiffness or a joint, or let an equilibrium be sought from another \
                place, where weight or a spring holds it; the force of a wheel that rolls repeats what \
                others hold already: give it a small `creep`";
    }
    "nothing holds or carries it there: give it mass, stiffness or a joint, or let an equilibrium be sought from another \
     place, where weight or a spring holds it"
}

/// A failure of Newton's method as that of a step to `time` [s], with names.
pub(crate) fn describe(
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
            StepError::NotFinite { time, iterations: *iterations, worst: worst.to_owned(), hint: SMALLER }
        }
        Failure::Factor(FactorError::ZeroPivot { unknown, pivot, .. }) => StepError::ZeroPivot {
            time,
            pivot: *pivot,
            unknown: layout.name_of(*unknown),
            hint: pivot_hint(*unknown, layout, settings.scaling.augmented),
            after_pivoting: false,
        },
        Failure::Factor(FactorError::NotFinite { unknown }) => {
            StepError::NotFinite { time, iterations: 0, worst: layout.name_of(*unknown), hint: SMALLER }
        }
        Failure::Interrupted => StepError::Interrupted { time },
    }
}
