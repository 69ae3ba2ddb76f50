//! Why a step failed, with where and when.

use lissom_solver::FactorError;

use crate::diagnostics::diagnostics;
use crate::kinematics::{Layout, Subject};
use crate::newton::Failure;
use crate::settings::Settings;

diagnostics! {
    /// A step that could not be completed.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure StepError {
        /// Newton's iterations did not converge.
        NotConverged {
            /// End of the step [s].
            time: f64,
            /// Iterations made.
            iterations: usize,
            /// Size of the last correction [-].
            correction: f64,
            /// Name of the unknown whose equation is worst.
            worst: Subject,
            /// What to try.
            hint: &'static str,
        } => "not-converged" {
            time: *time,
            subject: worst,
            cause: ("step to t = {time} s did not converge in {iterations} iterations: last correction {correction:.1e}, worst \
                    equation: {worst}"),
            remedy: "{hint}",
            meaning: "Newton's iteration did not converge in a step. In statics, a limit point of the load is a frequent cause: snap-through or \
                buckling.",
            advice: "Look for a force that jumps at the reported equation, for inconsistent units, and for a joint close to a position where \
                it locks; in statics, follow the path beyond a limit point (`kind = \"path\"`).",
        }
        /// Numbers that are not finite appeared.
        NotFinite {
            /// End of the step [s].
            time: f64,
            /// Iterations made.
            iterations: usize,
            /// Name of the first unknown affected.
            worst: Subject,
            /// What to try.
            hint: &'static str,
        } => "not-finite" {
            time: *time,
            subject: worst,
            cause: ("step to t = {time} s: numbers that are not finite after {iterations} iterations, first in: {worst}"),
            remedy: "{hint}",
            meaning: "A force, an acceleration or a position is not a finite number.",
            advice: "Look at the reported equation for a force that grows without bound, for masses or stiffnesses that differ by too many \
                orders of magnitude, and for inconsistent units.",
        }
        /// A joint is in a position in which one of its equations vanishes.
        JointLosesHold {
            /// End of the step [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// Kind of the joint.
            kind: &'static str,
            /// Equation of the joint.
            equation: &'static str,
            /// Angle of the relative rotation of its parts [degrees].
            angle: f64,
        } => "joint-degenerate" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("step to t = {time} s did not converge: the parts of the `{kind}` joint `{joint}` are rotated by {angle:.1} \
                    degrees relative to each other, where its equation \
                    {equation} vanishes"),
            remedy: "avoid this position by a stop, other lengths or another start, or use a joint of another kind",
            meaning: "A joint is in a position where one of its equations vanishes, such as a `constant_velocity` joint that is bent by half a \
                turn.",
        }
        /// A closed loop is close to a singular position.
        LoopIsSingular {
            /// End of the step [s].
            time: f64,
            /// Joints whose equations repeat each other there, in words.
            joints: Subject,
            /// How far it is from there [degrees].
            beside: f64,
        } => "loop-singular" {
            time: *time,
            subject: joints,
            cause: ("step to t = {time} s did not converge: {beside:.2} degrees before it the mechanism has a singular position, where \
                    the equations of {joints} are dependent, and it locks or can continue in more than one way"),
            remedy: "avoid this position by other lengths, another drive or another start",
            meaning: "A closed loop is close to a locking position, such as a slider crank at its dead centre.",
        }
        /// Something changes its side within a step that has no solution however short.
        Switches {
            /// End of the step [s].
            time: f64,
            /// What switches.
            what: Subject,
            /// What to try.
            hint: &'static str,
        } => "switches-within-step" {
            time: *time,
            subject: what,
            cause: ("step to t = {time} s did not converge, nor did its shortest substeps: {what} switches within it, and the motion \
                    can continue on neither side of \
                    the switch"),
            remedy: "{hint}",
            meaning: "A force changes its sign at a threshold and drives the motion back to it from both sides.",
            advice: "Smooth the force, use a kind such as friction, or raise the damping of a contact or stop.",
        }
        /// The estimated error stays above the tolerance however short the step.
        TooInaccurate {
            /// Start of the step [s].
            time: f64,
            /// Size of the last attempt [s].
            size: f64,
            /// Name of the unknown with the largest estimated error.
            unknown: Subject,
            /// What to try.
            hint: &'static str,
        } => "tolerance-not-met" {
            time: *time,
            subject: unknown,
            cause: ("from t = {time} s: the estimated error stays above `relative_tolerance` down to steps of {size:.1e} s, most in \
                    the {unknown}"),
            remedy: "{hint}",
            meaning: "The estimated error exceeds `relative_tolerance` with the shortest steps, as at a discontinuous load or drive.",
            advice: "Look for a load or drive that jumps at that time, or allow a larger error.",
        }
        /// The motion is inaccurate however short the step, and constraints depend on each other.
        ConstraintsDependent {
            /// Start of the step [s].
            time: f64,
            /// Size of the last attempt [s].
            size: f64,
            /// Multiplier of the constraint that repeats others.
            unknown: Subject,
        } => "constraints-dependent" {
            time: *time,
            subject: unknown,
            cause: ("from t = {time} s: steps down to {size:.1e} s have no accurate solution, and constraints depend on each other, \
                    detected at the {unknown}: in a singular position, such as a dead centre or links in line, the smallest violations \
                    are large motions"),
            remedy: "start farther from the singular position, or replace joints whose directions are guided twice (in a plane loop \
                of four bars a spherical and a universal joint instead of two of the revolute joints)",
            meaning: "Beside a singular position of redundant constraints the smallest violations are considerable motions, which the error \
                estimate reports.",
            advice: "Start farther from the singular position, or remove redundant constraints, which `lissom check` lists.",
        }
        /// Something passes through zero again and again.
        Chatters {
            /// Time [s].
            time: f64,
            /// What switches.
            what: Subject,
            /// What to try.
            hint: &'static str,
        } => "chattering" {
            time: *time,
            subject: what,
            cause: ("at t = {time} s {what} switches a thousand times within one step: the motion slides along the surface where it \
                    switches"),
            remedy: "{hint}",
            meaning: "A signal, an event or a force switches a thousand times within one step: the motion slides along the surface where it \
                switches.",
            advice: "Give the switch a width or a hysteresis, or use a kind such as friction.",
        }
        /// A time to be stepped to is not finite.
        NoTime {
            /// Requested time [s].
            target: f64,
        } => "time-not-finite" {
            cause: ("a session cannot be stepped to the time {target} s"),
            remedy: "specify a finite time",
            meaning: "A session was asked to go to a time that is not finite.",
        }
        /// A function of time is not finite.
        FunctionNotFinite {
            /// End of the step [s].
            time: f64,
            /// The function, in words.
            what: Subject,
            /// Value of the function, or that of its derivative.
            value: f64,
            /// Where [s].
            at: f64,
        } => "function-not-finite" {
            time: *time,
            subject: what,
            cause: ("step to t = {time} s: {what} is {value} at t = {at} s, or its derivative is: an argument is outside of the \
                    domain of its functions"),
            remedy: "restrict it, for example by `max(…, 0)` under a root or `clamp`, or end the run before",
            meaning: "A function of time is not finite: a root of a negative number, a division by zero.",
        }
        /// Constraints are not held, though the equations were solved.
        Contradiction {
            /// End of the step [s].
            time: f64,
            /// Names and violations of the constraints that are violated most.
            violated: Subject,
            /// The constraints on which they depend, and the reason.
            reason: String,
        } => "constraints-contradict" {
            time: *time,
            subject: violated,
            cause: ("at t = {time} s constraints contradict each other: violated is {violated}, which depends on {reason}"),
            remedy: "remove one of them, change the prescribed motion, or give positions and axes with more digits",
            meaning: "Constraints cannot be satisfied together: two drives of one coordinate, a drive beyond the reach of its links, or \
                redundant joints that are out of line by more than the geometric tolerance.",
        }
        /// A node turns further than a step resolves.
        TurnsTooFar {
            /// End of the step [s].
            time: f64,
            /// Name of the node.
            node: String,
            /// Angular velocity times step [rad].
            angle: f64,
        } => "rotation-per-step" {
            time: *time,
            subject: Subject::new("node", node),
            cause: ("step to t = {time} s: node `{node}` rotates by {angle:.2} rad in it, and angles beyond a quarter of a \
                    revolution per step are not resolved"),
            remedy: "use a smaller step, or set `relative_tolerance`",
            meaning: "A node rotates by more than a quarter of a turn in a step, which is too long for the angular velocity.",
        }
        /// A velocity is beyond that of any machine.
        Diverges {
            /// Time [s].
            time: f64,
            /// The coordinate or node that moves fastest.
            fastest: Subject,
            /// Velocity of this coordinate or node [m/s, rad/s].
            rate: f64,
        } => "motion-diverges" {
            time: *time,
            subject: fastest,
            cause: ("at t = {time} s the motion diverges: the velocity of {fastest} is {rate:.1e} (m/s or rad/s), beyond that of any \
                    machine"),
            remedy: "check the feedback that acts on it (sign and size of its gains, the period of its samples, which input belongs to \
                which joint), masses and units; an event with `stop` ends the run before",
            meaning: "A part moves faster than light or rotates by more than a million radians per second: a feedback loop is unstable, or \
                an input, a force or a mass has a wrong magnitude.",
        }
        /// Nodes of an element are turned against each other by nearly half a turn.
        ElementTurns {
            /// Time [s].
            time: f64,
            /// Names of the two nodes.
            nodes: [String; 2],
            /// Angle between them over π, at most 1.
            turns: f64,
        } => "rotation-in-element" {
            time: *time,
            subject: Subject::new("node", &nodes[0]),
            cause: ("at t = {time} s the beam element between `{}` and `{}` rotates by {turns:.2} of half a revolution or more: a \
                    larger rotation is indistinguishable from one in the opposite direction", nodes[0], nodes[1]),
            remedy: "use more elements",
            meaning: "The nodes of a beam element are rotated against each other by nearly half a turn or more: there are too few elements for \
                the twist or the bend.",
        }
        /// Sections of a beam overlap.
        SectionsOverlap {
            /// End of the step [s].
            time: f64,
            /// The beam.
            beam: String,
        } => "sections-overlap" {
            time: *time,
            subject: Subject::new("beam", beam),
            cause: ("step to t = {time} s: beam `{beam}` is compressed by more than its length: its sections overlap"),
            remedy: "check lengths, units, stiffnesses, loads and drives: a mechanism may be driven to a position that it cannot reach",
            meaning: "A beam is compressed by more than its length, so that its sections overlap. No beam can be.",
            advice: "Check lengths, units, stiffnesses, loads and drives. A mechanism that is driven beyond a dead centre strains its parts \
                instead of moving.",
        }
        /// A slider has left its beam.
        BeyondBeam {
            /// Time [s].
            time: f64,
            /// Name of the slider.
            joint: String,
            /// Coordinate of the slider [m].
            place: f64,
            /// Length of the beam [m].
            length: f64,
        } => "slider-off-beam" {
            time: *time,
            subject: Subject::new("slider", joint),
            cause: ("step to t = {time} s: slider `{joint}` passes the end of its beam: its position is {place} m of \
                    {length} m"),
            remedy: "make the beam longer, stop it with a spring of kind `axial_stop`, or end the run before with an event",
            meaning: "A slider has left its beam.",
        }
        /// A rope has left a sheave.
        OffSheave {
            /// Time [s].
            time: f64,
            /// Parts of the rope.
            parts: String,
            /// Number of the point along the rope, from 1 on.
            point: usize,
            /// How it has left the sheave.
            how: String,
        } => "rope-off-sheave" {
            time: *time,
            subject: Subject::new("part", parts),
            cause: ("step to t = {time} s: the rope on `{parts}` {how}, at its point {point}"),
            remedy: "keep the neighbours of the sheave on its side and in its plane, specify the `joint` of a drum, \
                or replace the sheave by a point",
            meaning: "A rope under tension no longer lies on one of its sheaves as the model describes, or its direction has turned by \
                so much that turns on its drum cannot be counted. Its length would be wrong from there on.",
        }
        /// The kinetic energy of a superelement is negative in some motion.
        NegativeKineticEnergy {
            /// End of the step [s].
            time: f64,
            /// Name of the first interface.
            interface: String,
        } => "kinetic-energy-negative" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("step to t = {time} s: the superelement with the interface `{interface}` is deformed beyond the range of its \
                    second-order matrices: its kinetic energy is no longer positive"),
            remedy: "reduce the part in several pieces or without corrections (`--modes-alone`), or model it by beams",
            meaning: "A superelement is deformed beyond the range of its second-order matrices.",
            advice: "Divide the part into several superelements, reduce it with `--modes-alone`, or model it by beams.",
        }
        /// Energy that nothing put in.
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
            /// What to change.
            remedy: &'static str,
        } => "energy-gain" {
            time: *time,
            subject: Subject::new("node", node),
            cause: ("step to t = {time} s: the energy exceeds the work of loads and drives by {surplus:.3e} J, where \
                    {turned_over:.3e} J are \
                    exchanged: the step does not resolve the motion, which is fastest at node `{node}`"),
            remedy: "{remedy}; `energy_check = false` continues such a run",
            meaning: "Energy grew beyond the work of loads and drives: the step is too long, or there is little numerical damping with masses \
                that differ by orders of magnitude.",
            advice: "Use a smaller step, `relative_tolerance`, or `scheme = \"radau-iia\"`; `energy_check = false` switches the check off.",
        }
        /// It was interrupted while a step was tried again.
        Interrupted {
            /// Where the simulation stands [s].
            time: f64,
        } => "interrupted" {
            time: *time,
            cause: ("interrupted after t = {time} s"),
            remedy: "",
            meaning: "The run was interrupted.",
            advice: "Run it again; with `--resume` it continues from its last checkpoint.",
        }
        /// A pivot vanished.
        ZeroPivot {
            /// End of the step [s].
            time: f64,
            /// The pivot.
            pivot: f64,
            /// Name of the unknown.
            unknown: Subject,
            /// What to try.
            hint: &'static str,
            /// Whether a pivoting solver went on from there, and Newton's iteration failed with it.
            after_pivoting: bool,
        } => "zero-pivot" {
            time: *time,
            subject: unknown,
            cause: ("step to t = {time} s: elimination stops at a pivot of {pivot:.1e} for the {unknown}"),
            remedy: "{hint}",
            meaning: "Elimination stops at a vanishing pivot: a part is not constrained, or an equation is redundant.",
            advice: "Add a mass, a stiffness or a joint, or remove the redundant constraint.",
        }
        /// A pivot of an equation that does not depend on others vanished, and no solver is to exchange rows.
        PivotLost {
            /// End of the step [s].
            time: f64,
            /// The pivot.
            pivot: f64,
            /// Sum of the magnitudes of its terms.
            terms: f64,
            /// Name of the multiplier.
            unknown: Subject,
            /// What to try.
            hint: &'static str,
        } => "pivot-lost" {
            time: *time,
            subject: unknown,
            cause: ("step to t = {time} s: elimination without exchanges of rows stops at the {unknown}: its equation does not depend on \
                    others, but a pivot of {pivot:.1e} is left of terms of {terms:.1e}, which is their round-off"),
            remedy: "{hint}",
            meaning: "With `solver = \"strict\"` elimination stops at a pivot that is only round-off, although no constraint is redundant.",
            advice: "Set `augmented = true` and `scaling = \"physical\"`, or use the solver `sparse`, which continues with exchanges of rows.",
        }
        /// A unit of another program failed.
        Unit {
            /// Time of the sample [s].
            time: f64,
            /// The unit.
            unit: String,
            /// What went wrong.
            cause: String,
            /// What to try.
            remedy: String,
        } => "unit-failed" {
            time: *time,
            subject: Subject::new("unit", unit),
            cause: ("the unit `{unit}` failed in its step to t = {time} s: {cause}"),
            remedy: "{remedy}",
            meaning: "A unit of another program reported an error, ended, or did not answer.",
            advice: "Run the unit alone in the program that made it, with the inputs of this instant.",
        }
    }
    wraps {
        /// A signal is not finite.
        Signal(crate::signals::SignalError), (error) => error.diagnostic(),
        /// The velocities at the end of the step could not be made consistent.
        Velocities {
            /// End of the step [s].
            time: f64,
            /// What went wrong.
            error: super::InitialError,
        }, { time, error } => {
            error.diagnostic().within(&format!("step to t = {} s, velocities at its end", crate::number::Written(*time))).at(*time)
        },
    }
}

impl StepError {
    /// Whether a smaller step may have a solution where this one has none.
    pub fn may_need_a_smaller_step(&self) -> bool {
        matches!(
            self,
            Self::NotConverged { .. }
                | Self::NotFinite { .. }
                | Self::Signal(_)
                | Self::Unit { .. }
                | Self::FunctionNotFinite { .. }
                | Self::TurnsTooFar { .. }
                | Self::ElementTurns { .. }
                | Self::SectionsOverlap { .. }
                | Self::JointLosesHold { .. }
                | Self::NegativeKineticEnergy { .. }
                | Self::EnergyFromNowhere { in_this_step: true, .. }
                | Self::ZeroPivot { after_pivoting: true, .. }
        )
    }
}

/// What to try when the estimated error stays above the tolerance.
pub(crate) const MORE_TOLERANT: &str =
    "check for a load or drive that jumps there, or increase the tolerance";
/// What to try when something switches without end.
pub(crate) const SMOOTHER: &str = "smooth it (`tanh(v/0.01)` instead of `sign(v)`, hysteresis for an event), or use a suitable kind, such \
     as friction";
/// What to try where a force switches within a step of planned size that has no solution.
pub(crate) const STEPS_THAT_END_THERE: &str = "smooth the jump (`tanh(v/0.01)` instead of `sign(v)`), use a suitable kind, such as \
     friction, or set `relative_tolerance` instead of `step`, which ends steps where forces switch";
/// What to try where a force switches within a step of chosen size that has no solution.
pub(crate) const SOFTER: &str = "smooth the jump (`tanh(v/0.01)` instead of `sign(v)`), or use a suitable kind, such as friction; raise the \
     `dissipation` or `damping` of a contact or stop that is touched again and again";
/// What to try when a step fails while parts touch at several points.
pub(crate) const FOR_MANY_TOUCHES: &str = "parts touch at several points: try `scheme = \"backward-euler\"` with a `step`, which solves \
     for all touches at once";

/// What to try where the first load step fails in which a drive moves.
pub(crate) const LOADS_BEFORE_DRIVES: &str = "a drive moves in the first load step, before the loads have determined the shape: let it begin \
     later, such as at t = 0.1 by `max(0, t - 0.1)`, so that an equilibrium under loads alone is found first; if there is one already, the load \
     may be at a limit point (snap-through or buckling), beyond which `kind = \"path\"` can follow it";

/// What to try when numbers of one attempt are not finite.
pub(crate) const SMALLER: &str = "try a smaller step";
/// What to try when a step has no solution even in the smallest parts.
pub(crate) const NO_PART_CONVERGES: &str = "substeps of a thousandth of it and less fail as well, so a smaller `step` is unlikely to help: \
     check for a force that jumps or grows without bound, for inconsistent units, for a joint that locks, and for a small `max_iterations`";
/// What to try when numbers are not finite even in the smallest parts of a step.
pub(crate) const NO_PART_IS_FINITE: &str = "this also occurs in its shortest substeps, so a smaller `step` is unlikely to help: check for a \
     force that grows without bound, for masses or stiffnesses of very different magnitude, and for inconsistent units";

/// What to try where an equilibrium path ends: it tries shorter steps itself.
pub(crate) const NO_STEP_HELPS: &str = "shorter steps along the path also fail: a force or a joint may have reached its limit; end \
     the path before it, or smooth forces that jump there";

/// What to try when a step, in motion or in statics, has no solution even in parts.
fn convergence_hint(is_motion: bool) -> &'static str {
    if is_motion {
        "try a smaller step, or a larger `max_iterations`"
    } else {
        "even the smallest load steps from there find no equilibrium: the load may be at a limit point (snap-through or \
         buckling), beyond which `kind = \"path\"` can follow it; or use a larger `max_iterations`"
    }
}

/// What to try when elimination stops at an unknown, a coordinate or a multiplier.
pub(crate) fn pivot_hint(unknown: usize, layout: &Layout, augmented: bool) -> &'static str {
    if unknown >= layout.coordinate_count() {
        if layout.velocity_rows().any(|row| row == unknown) {
            return "another wheel or joint prevents the same sliding: specify a small `creep`";
        }
        return "the joint's equation is redundant with those of other joints: remove or relax one of them";
    }
    undetermined_hint(augmented)
}

/// What to try when nothing determines a coordinate.
pub(crate) fn undetermined_hint(augmented: bool) -> &'static str {
    if !augmented {
        return "a coordinate without mass and stiffness requires the augmented term: set `augmented = true`";
    }
    "it has no resistance in this position: add mass, stiffness or a joint (a junction of springs needs a mass), or start the search for an equilibrium from another position, \
     where weight or a spring determines it"
}

/// What to try when a multiplier has lost its pivot although its equation does not depend on others.
pub(crate) fn lost_pivot_hint(augmented: bool) -> &'static str {
    if augmented {
        return "set `scaling = \"physical\"` or a larger `penalty`, or let `solver = \"sparse\"` exchange rows there";
    }
    "a coordinate without mass and stiffness has no pivot without the augmented term, and leaves none: set `augmented = true`, or let \
     `solver = \"sparse\"` exchange rows there"
}

/// A failure of Newton's method as that of a step to `time` [s], with names.
pub(crate) fn describe(
    failure: &Failure,
    layout: &Layout,
    time: f64,
    settings: &Settings,
    worst: &Subject,
) -> StepError {
    match failure {
        Failure::NotConverged { iterations, correction } => StepError::NotConverged {
            time,
            iterations: *iterations,
            correction: *correction,
            worst: worst.clone(),
            hint: convergence_hint(settings.scheme.dynamic),
        },
        Failure::NotFinite { iterations } => {
            StepError::NotFinite { time, iterations: *iterations, worst: worst.clone(), hint: SMALLER }
        }
        Failure::Factor(FactorError::ZeroPivot { unknown, pivot, .. }) => StepError::ZeroPivot {
            time,
            pivot: *pivot,
            unknown: layout.subject_of(*unknown),
            hint: pivot_hint(*unknown, layout, settings.scaling.augmented),
            after_pivoting: false,
        },
        Failure::Factor(FactorError::NotFinite { unknown }) => {
            StepError::NotFinite { time, iterations: 0, worst: layout.subject_of(*unknown), hint: SMALLER }
        }
        Failure::Factor(FactorError::Interrupted) | Failure::Interrupted => StepError::Interrupted { time },
    }
}
