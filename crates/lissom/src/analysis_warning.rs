//! Warnings about the results of analyses without time steps, of studies and of checks.

use std::fmt::{self, Display};

use lissom_core::catalogued;
use lissom_core::diagnostics::Diagnose;
use lissom_core::errors::Warning;

/// A warning about the result of an analysis.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnalysisWarning {
    /// A warning about the state.
    State(Warning),
    /// A warning about the analysis at one value of a varied number.
    At {
        /// The varied number.
        path: String,
        /// Value of the number.
        value: f64,
        /// The warning.
        warning: Box<Self>,
    },
    /// A force has a kink or a jump at the state.
    Kink {
        /// `stiffness` or `damping`.
        quantity: &'static str,
        /// The force.
        force: String,
    },
    /// The modes are those without loads, because a part that can move freely has no equilibrium under them.
    NoEquilibrium {
        /// The part.
        part: String,
        /// A load on it, in words.
        load: String,
    },
    /// The motion at the time of linearisation is not steady.
    Unsteady {
        /// The time [s].
        time: f64,
        /// Relative change of the twists.
        change: f64,
    },
    /// The modes are those in axes at rest.
    AxesAtRest,
    /// The modes are those in axes that do not spin with wheels.
    RollingAxes,
    /// Modes whose coefficients are not constant are omitted.
    ModesOmitted {
        /// Their number.
        omitted: usize,
        /// Number of all modes found.
        count: usize,
        /// Their frequencies, in words.
        frequencies: String,
        /// The reason why there are no other axes for them.
        reason: &'static str,
    },
    /// Modes grow.
    Unstable {
        /// Their number.
        modes: usize,
    },
    /// It is unknown whether modes were missed.
    ModeCountUnknown,
    /// There are fewer modes than requested.
    FewerModes {
        /// The requested number.
        wanted: usize,
        /// `the model has`, or `the search found` if their number could not be verified.
        evidence: &'static str,
        /// The number found.
        found: usize,
    },
    /// A line of a Campbell diagram is continued between unlike shapes.
    UnlikeShapes {
        /// The line, from 1.
        line: usize,
        /// The varied number.
        path: String,
        /// Value of the number.
        value: f64,
        /// The correlation of the shapes.
        correlation: f64,
    },
    /// Coefficients change with the azimuth, and modes are those of their mean.
    VariesWithAzimuth {
        /// Largest relative change of an eigenvalue.
        change: f64,
    },
    /// The number that is varied turns nothing.
    NothingRotates {
        /// The varied number.
        path: String,
    },
    /// Nodes rotate far under the loads of a buckling analysis.
    LargeRotation {
        /// The largest rotation [rad].
        angle: f64,
    },
    /// Stiffness that does not change in proportion to the loads, up to a load factor.
    NotProportional {
        /// The lowest such load factor.
        factor: f64,
        /// Relative error of the load factor.
        error: f64,
    },
    /// It is unknown whether a load factor was missed.
    LoadFactorUnknown,
    /// No load factor was found, and it is unknown whether there is one.
    NoLoadFactorFound,
    /// There is no positive load factor.
    Stiffening,
    /// There are fewer load factors than requested.
    FewerLoadFactors {
        /// The requested number.
        wanted: usize,
        /// The number found.
        found: usize,
    },
    /// Outputs of a moving model are those at an instant.
    ResponseOfMotion,
    /// A frequency response requires more frequencies than are computed.
    TooManyFrequencies {
        /// The number computed at most.
        limit: usize,
    },
    /// Natural frequencies for a response could not be computed.
    PeaksUnknown {
        /// The reason.
        reason: String,
    },
    /// A response is that of an unstable state.
    UnstableResponse {
        /// Number of growing modes.
        modes: usize,
    },
    /// Natural frequencies for a response are known to a limit only.
    PeaksAbove {
        /// The limit [Hz].
        frequency: f64,
    },
    /// Natural frequencies in the range of a response have no damping.
    Undamped {
        /// Their number.
        count: usize,
    },
    /// Gravity is omitted in a reduction.
    GravityOmitted,
    /// It is unknown whether modes with fixed interfaces were missed.
    InterfaceModesUnknown,
    /// A reduction lacks terms of second order.
    FirstOrder,
    /// No run of a study is close to its reference.
    FarFromReference,
    /// A constraint is redundant.
    Redundant {
        /// The joint.
        joint: String,
        /// Equation of the joint.
        equation: String,
        /// The joints from which it follows, and the direction that it repeats, in words.
        follows: String,
    },
}

impl AnalysisWarning {
    /// Code of the warning, as in `lissom explain`.
    pub fn code(&self) -> &'static str {
        self.diagnostic().code
    }
}

impl Display for AnalysisWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

catalogued! {
    Warning AnalysisWarning {
        Kink { quantity => quantity, force => force } => "linearization-kink" {
            cause: "the state is on a kink or a jump of a force ({force}): the {quantity} differs on its two sides, and the linear \
                    model is that of one side",
            remedy: "move the state off the kink, or make the law smooth there",
            meaning: "A force has different derivatives on the two sides of the state of linearisation, such as a stop that just \
                      touches.",
        }
        Unsteady { time => time, change => change } => "frozen-coefficients" {
            cause: "the motion at t = {time} s is not steady (relative change of its twists {change:.1e}): frequencies are those of \
                    coefficients frozen at that instant",
            remedy: "use a time of steady motion",
            meaning: "The coefficients of the linear equations change with the motion about which the model is linearised.",
            advice: "Linearise about a state at rest or a steady motion, or simulate in time.",
        }
        NoEquilibrium { part => part, load => load } => "free-part-under-load" {
            cause: "`{part}` can move freely and has no equilibrium under {load}: the state is that of the file without loads",
            remedy: "",
            meaning: "The model is linearised about an equilibrium, and loads on a part that nothing connects to the ground accelerate it.",
            advice: "Connect it to the ground, or remove the loads; `--about undeformed` takes the same state without this warning.",
        }
        AxesAtRest {} => "axes-at-rest" {
            cause: "the coefficients are constant only in axes at rest, with multi-blade coordinates: frequencies are those in these \
                    axes, shapes those at this instant",
            remedy: "",
            meaning: "Modes of a rotor are computed in axes that do not rotate with it, in which its equations have constant \
                      coefficients.",
            advice: "Compare frequencies with measurements in axes at rest.",
        }
        VariesWithAzimuth { change => change } => "varies-with-azimuth" {
            cause: "modes are those of the mean over the azimuth: with the coefficients of single azimuths an eigenvalue would change by \
                    a fraction of {change:.2}",
            remedy: "compare with a simulation in time",
            meaning: "Modes of a rotor under loads fixed in space are computed from the mean of its equations over a turn, which omits effects of \
                      second order in what changes.",
            advice: "Frequencies are accurate as long as the change is small; parametric resonances are not found.",
        }
        RollingAxes {} => "rolling-axes" {
            cause: "the coefficients are constant only in axes that do not spin with the wheels: frequencies are those in these axes, \
                    shapes those at this instant",
            remedy: "",
            meaning: "Modes of a vehicle are computed in axes that do not spin with its wheels, in which its equations have constant \
                      coefficients.",
            advice: "Compare frequencies with measurements on parts that do not spin.",
        }
        ModesOmitted { omitted => omitted, count => count, frequencies => frequencies, reason => reason } => "modes-omitted" {
            cause: "{omitted} of {count} modes are omitted ({frequencies}): their coefficients change as the model rotates, because \
                    rotating and non-rotating parts are coupled across the axis, and {reason}",
            remedy: "such modes require Floquet theory, which is not implemented",
            meaning: "Some modes of a rotating model belong to periodic coefficients and are not natural modes.",
            advice: "Use at least three identical blades, a rigid support, or a simulation in time.",
        }
        Unstable { modes => modes } => "unstable-state" {
            cause: "the state is unstable (growing modes: {modes})",
            remedy: "check whether it is the intended equilibrium",
            meaning: "Modes with a positive real part grow: the model leaves the state of linearisation after any disturbance.",
            advice: "Check supports, loads and follower forces, or linearise about another state.",
        }
        ModeCountUnknown {} => "mode-count-unknown" {
            cause: "it is unknown whether modes were missed: the matrices of the count could not be factored, or their counts are \
                    inconsistent",
            remedy: "compare with the modes of a larger `count`",
            meaning: "The number of modes below the last one could not be verified.",
        }
        FewerModes { wanted => wanted, evidence => evidence, found => found } => "fewer-modes" {
            cause: "{wanted} modes were requested, and {evidence} only {found}",
            remedy: "request fewer modes, or use more elements",
            meaning: "The model has fewer modes than requested, or the search has found fewer.",
        }
        UnlikeShapes { line => line, path => path, value => value, correlation => correlation } => "campbell-unlike-shapes" {
            cause: "line {line} is continued to `{path}` = {value} between shapes with a correlation of only {correlation:.2}",
            remedy: "use more values",
            meaning: "A line of a Campbell diagram may pass to another mode, because shapes change much between two values.",
        }
        NothingRotates { path => path } => "campbell-nothing-rotates" {
            cause: "nothing rotates at any value of `{path}`: the lines are those of the static equilibrium",
            remedy: "let the angular velocity of the rotor at the start depend on the number, such as \
                     `angular_velocity = [\"speed\", 0, 0]` of `[initial.rotor]`",
            meaning: "A Campbell diagram was asked for over a number that is no speed of rotation: a drive that accelerates from rest sets none at the start.",
        }
        LargeRotation { angle => angle } => "buckling-rotation" {
            cause: "nodes rotate by up to {angle:.2} rad under the loads: load factors far from 1 are extrapolated although the \
                    stiffness does not change in proportion to the loads",
            remedy: "locate the critical points by an analysis of kind `path`",
            meaning: "The linear estimate of buckling loads assumes small rotations under the loads.",
        }
        NotProportional { factor => factor, error => error } => "load-factor-extrapolated" {
            cause: "the load factor {factor} has a relative error of about {error:.1e}, and higher ones may have larger errors: the model bends \
                    under the loads before it buckles, and its stiffness does not change in proportion to the loads",
            remedy: "locate higher critical points by an analysis of kind `path`",
            meaning: "The linear estimate of buckling loads assumes that the stiffness changes in proportion to the loads. The lower load factors \
                      are accurate to 2 %.",
        }
        LoadFactorUnknown {} => "load-factor-unknown" {
            cause: "it is unknown whether a lower load factor was missed",
            remedy: "compare with the load factors of a larger `count`",
            meaning: "The number of load factors below the last one could not be verified.",
        }
        NoLoadFactorFound {} => "load-factor-not-found" {
            cause: "no load factor was found, and it is unknown whether there is one",
            remedy: "follow the equilibrium path by an analysis of kind `path`",
            meaning: "The search found no load factor, and the number of load factors could not be verified.",
        }
        Stiffening {} => "loads-stiffen" {
            cause: "no positive load factor makes the stiffness singular: these loads stiffen the model",
            remedy: "reverse the loads if they should compress the model",
            meaning: "The model does not buckle under any multiple of the loads.",
            advice: "Check the directions of the loads.",
        }
        FewerLoadFactors { wanted => wanted, found => found } => "fewer-load-factors" {
            cause: "{wanted} load factors were requested, and the model has only {found}",
            remedy: "request fewer load factors, or use more elements",
            meaning: "The model has fewer positive load factors than requested.",
        }
        ResponseOfMotion {} => "response-of-motion" {
            cause: "the model moves: outputs in global axes are those at the instant of linearisation",
            remedy: "use outputs in axes of parts, or linearise about a state at rest",
            meaning: "The axes of outputs of a moving model change with time, and a frequency response has those of an instant.",
        }
        TooManyFrequencies { limit => limit } => "response-not-resolved" {
            cause: "more than {limit} frequencies would be required to resolve every change",
            remedy: "use a smaller range of frequencies, or more damping",
            meaning: "A frequency response has more peaks than the table can resolve.",
        }
        PeaksUnknown { reason => reason } => "response-peaks-unknown" {
            cause: "narrow peaks may be missed, because natural frequencies could not be computed: {reason}",
            remedy: "use more `points`",
            meaning: "Frequencies are placed around natural ones, which could not be computed.",
            advice: "Use more frequencies, or remove the cause.",
        }
        UnstableResponse { modes => modes } => "response-unstable" {
            cause: "the state is unstable (growing modes: {modes}): the response is that of the linear equations, but no motion converges \
                    to it",
            remedy: "linearise about a stable state",
            meaning: "A harmonic response exists only as the limit of motions of a stable state.",
        }
        PeaksAbove { frequency => frequency } => "response-peaks-above" {
            cause: "natural frequencies were computed up to {frequency} Hz: above, peaks narrower than the spacing of frequencies \
                    may be missed",
            remedy: "use a smaller range of frequencies, or more `points`",
            meaning: "The range of a frequency response has more natural frequencies than are computed.",
        }
        Undamped { count => count } => "response-undamped" {
            cause: "the response is unbounded at natural frequencies that have no damping ({count} in the range)",
            remedy: "add damping to the materials, springs or joints",
            meaning: "The peaks of an undamped model are infinite; the table has finite values beside them.",
        }
        GravityOmitted {} => "reduction-without-gravity" {
            cause: "gravity is omitted: the weight is that in the model that uses the superelement",
            remedy: "",
            meaning: "A superelement has the mass of its parts, on which the gravity of the model that uses it acts.",
            advice: "Set gravity in the model that uses the superelement.",
        }
        InterfaceModesUnknown {} => "reduction-mode-count" {
            cause: "it is unknown whether modes with fixed interfaces were missed",
            remedy: "compare with a reduction with more modes",
            meaning: "The number of modes with fixed interfaces could not be verified.",
        }
        FirstOrder {} => "reduction-first-order" {
            cause: "the parts are connected by joints or relations: terms of second order in the deformation are not computed, so the \
                    superelement lacks the change of its stiffness by loads",
            remedy: "reduce parts without internal joints",
            meaning: "A superelement with internal joints has no geometric stiffness.",
        }
        FarFromReference {} => "study-far-from-reference" {
            cause: "no run is close to the reference, which may itself be inaccurate",
            remedy: "use a smaller step for the reference, and smaller steps",
            meaning: "The errors of a convergence study are differences from a reference, from which all runs are far away.",
        }
        Redundant { joint => joint, equation => equation, follows => follows } => "redundant-constraint" {
            cause: "{equation} of joint `{joint}` follows from {follows}",
            remedy: "",
            meaning: "A constraint repeats what others require. The motion is unaffected, but reactions are not unique.",
            advice: "Release the direction in one of the joints, or replace one by a bushing.",
        }
    } wraps {
        State { 0 => warning } => warning.diagnostic(),
        At { path => path, value => value, warning => warning } => {
            warning.diagnostic().within(&format!("at `{path}` = {value}"))
        },
    }
}
