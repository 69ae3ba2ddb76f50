//! What is worth knowing of a result that was reached: reported on the terminal and in the summary.

use serde::{Deserialize, Serialize};

/// Error of the largest interface force of a blade that bends as far as superelements may: errors grow with the square [%].
const PERCENT_AT_LIMIT: f64 = 1.4;

/// A reason to doubt a result. Each kind is reported once, with where it first showed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// Energy has grown by more than loads and drives have put in.
    #[error(
        "from t = {time:.6e} s on there is more energy than anything put in: a surplus of {surplus:.3e} J where \
         {turned_over:.3e} J are turned over; the step does not resolve the motion: make it smaller, or set \
         `relative_tolerance`"
    )]
    EnergySurplus {
        /// When the surplus was first worth telling [s].
        time: f64,
        /// The largest surplus [J].
        surplus: f64,
        /// Energy turned over until then [J].
        turned_over: f64,
    },
    /// An equilibrium is unstable.
    #[error(
        "the equilibrium at t = {time:.6e} is unstable in {directions} direction(s){onset}: the model would leave it \
         by itself (buckling, or a place of most energy); disturb it to find where it goes, or hold what is free"
    )]
    Unstable {
        /// Time, or load parameter, of the first unstable equilibrium [s].
        time: f64,
        /// Number of negative eigenvalues of the stiffness.
        directions: usize,
        /// Words on what went before, may be empty.
        onset: String,
    },
    /// An equilibrium was found downhill, not along a path of equilibria.
    #[error(
        "the equilibrium at t = {time:.6e} was found by relaxation, because Newton's method found none from the places given: \
         parts moved by up to {distance:.3e} m, downhill; of several equilibria it is one, and which one depends on where parts \
         begin: begin near the one that is meant"
    )]
    Relaxed {
        /// Time, or load parameter [s].
        time: f64,
        /// The longest way of a node [m].
        distance: f64,
    },
    /// An equilibrium path was left by a jump.
    #[error(
        "between t = {start:.6e} and {time:.6e} the model jumps: loads do {work:.3e} J more than it stores, so a limit \
         point of the load lies between them, beyond which no equilibrium is near; take more load steps to find it, or \
         follow the path beyond it with `kind = \"path\"`"
    )]
    Jump {
        /// Load parameter before the jump [s].
        start: f64,
        /// Load parameter after it [s].
        time: f64,
        /// Work that nothing stored [J].
        work: f64,
    },
    /// Given initial velocities do not agree with the constraints.
    #[error(
        "the initial velocity of `{part}` was given as {given} and does not agree with the joints and drives: the run \
         starts with {used}; give velocities that the joints allow, for instance by `[initial] angular_velocity` and \
         `about`"
    )]
    VelocityReplaced {
        /// Name of the node.
        part: String,
        /// Velocity and angular velocity as given, in words.
        given: String,
        /// As used.
        used: String,
    },
    /// A drive sets a flexible part into motion by a jolt.
    #[error(
        "drives and joints set `{part}` into motion at once and bend it by that: at the start it deforms at {rate:.3e} \
         1/s; give it the velocity it shall start with, or let the drive start from rest"
    )]
    StartsWithJolt {
        /// Name of a node of the part.
        part: String,
        /// Largest relative speed of neighbouring nodes over their distance [1/s].
        rate: f64,
    },
    /// What meets a contact is stopped by it faster than steps resolve.
    #[error(
        "at t = {time:.6e} s {what} stops what meets it within two steps: a contact so short is not resolved, and its \
         energy may be lost or won; take steps of at most a fiftieth of the contact, or set `relative_tolerance` instead of \
         `step`, which ends steps where contacts begin"
    )]
    ContactTooShort {
        /// When it was seen first [s].
        time: f64,
        /// What switches.
        what: String,
    },
    /// A drive goes from one place to another at once.
    #[error(
        "in the step to t = {time:.6e} s the drive `{drive}` goes by {way:.3e} (m or rad) without a rate that takes it there: it jumps, or changes faster than steps resolve; let it go there in a time that steps resolve"
    )]
    DriveJumps {
        /// End of the step in which it was seen first [s].
        time: f64,
        /// Name of the drive.
        drive: String,
        /// How far it goes [m or rad].
        way: f64,
    },
    /// Steps of planned size do not resolve the velocities of joints and drives.
    #[error(
        "the steps are too long for velocities and forces: from t = {time:.6e} s on places agree with joints and drives, but the rates of \
         these miss {:.1} % of the speed of the model, and forces more; take smaller steps, or set `relative_tolerance` instead of `step`",
        100.0 * missed
    )]
    UnresolvedRates {
        /// When it was first worth telling [s].
        time: f64,
        /// What rates of constraints miss, as a part of the largest speed.
        missed: f64,
    },
    /// Steps of planned size do not resolve the motion.
    #[error(
        "the steps are too long for the motion: from t = {time:.6e} s on they are estimated to miss more than 0.1 % of how far \
         the model moves, {:.2} % in the end, most in the {unknown}; take smaller steps, or set `relative_tolerance` \
         instead of `step`", 100.0 * error
    )]
    Unresolved {
        /// When it was first worth telling [s].
        time: f64,
        /// Estimated error over how far the model has moved.
        error: f64,
        /// Name of the unknown that errs most.
        unknown: String,
    },
    /// Constraints that repeat each other give way.
    #[error(
        "at t = {time:.6e} s constraints yield: {violated}; they repeat each other, or others, and hold what loads or drives strain, so \
         that results are good to that only: free what is held twice, or look whether units are right"
    )]
    RegularizedConstraints {
        /// When it was first seen [s].
        time: f64,
        /// Names of the constraints and their violations.
        violated: String,
    },
    /// A wheel's point of contact runs round faster than steps of planned size resolve.
    #[error(
        "at t = {time:.6e} s the wheel of `{joint}` lies nearly flat, and its point of contact runs round by {angle:.2} rad in a step, \
         which is too long for it: take smaller steps, or set `relative_tolerance` instead of `step`"
    )]
    ContactRunsRound {
        /// When it was first seen [s].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// By how much it ran round in the first such step [rad].
        angle: f64,
    },
    /// A function of time changes within a step of planned size in a way that its ends do not show.
    #[error(
        "around t = {time:.6e} s {function} does something within a step of {step:.3e} s that its values and slopes at the ends do not show, \
         such as a pulse or an oscillation: the step sees little of it, or takes it for something else; take smaller steps, or set \
         `relative_tolerance` instead of `step`"
    )]
    FunctionUnseen {
        /// Where it was first found [s].
        time: f64,
        /// The function, in words.
        function: String,
        /// Size of the step [s].
        step: f64,
    },
    /// A wheel on a rail touches where its model means nothing.
    #[error("at t = {time:.6e} s the wheel of `{joint}` {doubt}")]
    RailContact {
        /// When it was first seen [s].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// What is in doubt.
        doubt: String,
    },
    /// A wheel that rolls is pulled by its plane.
    #[error(
        "at t = {time:.6e} s the plane or rail of `{joint}` pulls its wheel with {force:.3e} N: a wheel that lies on it would \
         lift off, and this one cannot"
    )]
    WheelLifts {
        /// When it was first seen [s].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// How strongly it is pulled [N].
        force: f64,
    },
    /// A wheel that rolls needs more friction than there is.
    #[error(
        "at t = {time:.6e} s the wheel of `{joint}` needs {friction:.3e} N of friction at a normal force of {normal:.3e} N: \
         more than its coefficient gives, so that it would slide, and this one cannot"
    )]
    WheelSlides {
        /// When it was first seen [s].
        time: f64,
        /// Name of the joint.
        joint: String,
        /// Friction [N].
        friction: f64,
        /// Normal force [N].
        normal: f64,
    },
    /// A motion went through a position where constraints repeat each other.
    #[error(
        "at t = {time:.6e} s the mechanism is in a singular position: there the equations of {joints} repeat each other, one \
         freedom more is free, and there is more than one way to go on, between which round-off decides; start and go on away \
         from it, change the lengths that make it, or couple the joints that must keep their sense"
    )]
    SingularPosition {
        /// When it was first seen [s].
        time: f64,
        /// Joints whose equations repeat each other there, in words.
        joints: String,
    },
    /// Reactions of constraints that repeat each other.
    #[error(
        "{columns} not unique: constraints repeat each other there ({repeated}), and those reported are the least forces that \
         hold the motion; a real mechanism shares them out by its stiffness: replace rigid joints by bushings, or free the \
         directions that repeat"
    )]
    ReactionsNotUnique {
        /// Names of the columns, in words.
        columns: String,
        /// The directions that repeat, in words.
        repeated: String,
    },
    /// A superelement deforms by more than linear matrices allow.
    #[error(
        "from t = {time:.6e} s on the superelement's interface `{interface}` is displaced or turned by more than its linear \
         matrices are good for: by up to {largest:.2} times 0.2 rad, or 0.15 of the distance between interfaces, from the floating \
         frame; forces have an estimated error of {:.1} % or more; cut the part into several superelements, or model it by beams",
        PERCENT_AT_LIMIT * .largest * .largest
    )]
    BeyondLinear {
        /// When it was first seen [s].
        time: f64,
        /// Name of the interface.
        interface: String,
        /// The largest deformation over that up to which the matrices are believed.
        largest: f64,
    },
    /// A superelement turns nearly as fast as it swings.
    #[error(
        "from t = {time:.6e} s on the superelement of `{interface}` turns at up to {largest:.2} times the rate that its matrices \
         are good for, which is a quarter of its first natural frequency with that interface held, or all of it with `geometric` \
         matrices: centrifugal forces change its stiffness by more than they know; make them by `lissom reduce`, cut it into several \
         superelements, or model it by beams"
    )]
    TurnsFast {
        /// When it was first seen [s].
        time: f64,
        /// Name of the interface that carries its floating frame.
        interface: String,
        /// The largest rate of rotation over that up to which the matrices are believed.
        largest: f64,
    },
    /// Loads change the stiffness of a superelement, which its matrices do not know.
    #[error(
        "from t = {time:.6e} s on axial forces and rotation give or take an estimated share of up to {:.2} % of the stiffness against \
         what the superelement of `{interface}` bends, which its matrices do not know: it bends by up to that much wrongly; make its \
         matrices by `lissom reduce`, which finds them to second order, or model it by beams", 0.5 * largest
    )]
    LoadStiffness {
        /// When it was first seen [s].
        time: f64,
        /// Name of the interface that carries its floating frame.
        interface: String,
        /// The largest share over that up to which the matrices are believed, 0.5 %.
        largest: f64,
    },
    /// Moments couple bending and twist of a superelement, which no matrices know.
    #[error(
        "from t = {time:.6e} s on moments couple bending and twist of the superelement of `{interface}`, which its matrices do not know: \
         it is displaced by up to an estimated {:.2} % of its largest deformation otherwise; cut it into several superelements, or model \
         it by beams", 0.5 * largest
    )]
    MomentStiffness {
        /// When it was first seen [s].
        time: f64,
        /// Name of the interface that carries its floating frame.
        interface: String,
        /// What is missed over that up to which the matrices are believed, 0.5 %.
        largest: f64,
    },
    /// A superelement is excited faster than its modes can follow.
    #[error(
        "from t = {time:.6e} s on the superelement of `{interface}` is excited faster than its modes can follow: its interface forces \
         have an estimated error of up to {:.0} % of its inertial forces; reduce the part with more modes, start and stop its motion \
         smoothly, or model it by beams", 5.0 * largest
    )]
    ModesLeftOut {
        /// When it was first seen [s].
        time: f64,
        /// Name of the interface that carries its floating frame.
        interface: String,
        /// The largest estimated error over that from which on a warning is given, 5 %.
        largest: f64,
    },
    /// An output that goes on along the motion could not go on.
    #[error(
        "at t = {time:.6e} s the output `{output}` cannot go on: from one step to the next it changes by more than can be followed, \
         and is not a number from there on; take smaller steps; an angle about an axis has no value where the axis is turned \
         by half a turn"
    )]
    AccumulationLost {
        /// End of the first step over which it could not be determined [s].
        time: f64,
        /// Name of the output.
        output: String,
    },
    /// A warning from the model file.
    #[error("{message}")]
    Model {
        /// What it says.
        message: String,
    },
}

impl Warning {
    /// A short name for scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::EnergySurplus { .. } => "energy-surplus",
            Self::Unstable { .. } => "unstable-equilibrium",
            Self::Relaxed { .. } => "relaxed-equilibrium",
            Self::Jump { .. } => "jump",
            Self::VelocityReplaced { .. } => "velocity-replaced",
            Self::StartsWithJolt { .. } => "starts-with-jolt",
            Self::ContactTooShort { .. } => "contact-too-short",
            Self::DriveJumps { .. } => "drive-jumps",
            Self::Unresolved { .. } => "unresolved-motion",
            Self::UnresolvedRates { .. } => "unresolved-rates",
            Self::RegularizedConstraints { .. } => "constraints-yield",
            Self::ContactRunsRound { .. } => "contact-runs-round",
            Self::FunctionUnseen { .. } => "function-unseen",
            Self::WheelLifts { .. } => "wheel-lifts",
            Self::WheelSlides { .. } => "wheel-slides",
            Self::RailContact { .. } => "rail-contact",
            Self::SingularPosition { .. } => "singular-position",
            Self::ReactionsNotUnique { .. } => "reactions-not-unique",
            Self::BeyondLinear { .. } => "beyond-linear",
            Self::TurnsFast { .. } => "turns-fast",
            Self::LoadStiffness { .. } => "load-stiffness",
            Self::MomentStiffness { .. } => "moment-stiffness",
            Self::ModesLeftOut { .. } => "modes-left-out",
            Self::AccumulationLost { .. } => "output-lost",
            Self::Model { .. } => "model",
        }
    }
}
