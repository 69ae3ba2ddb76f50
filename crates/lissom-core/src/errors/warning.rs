//! Warnings about a result, reported on the terminal and in the summary.

use serde::{Deserialize, Serialize};

use crate::diagnostics::diagnostics;
use crate::kinematics::Subject;

/// Error of the largest interface force of a blade at the deformation limit of superelements: errors grow with the square
/// [%].
const PERCENT_AT_LIMIT: f64 = 1.4;

diagnostics! {
    /// A warning about a result. Each kind is reported once, with its first occurrence.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    #[non_exhaustive]
    Warning Warning {
        /// Energy has grown by more than the work of loads and drives.
        EnergySurplus {
            /// When the surplus was first significant [s].
            time: f64,
            /// The largest surplus [J].
            surplus: f64,
            /// Energy exchanged until then [J].
            turned_over: f64,
            /// What to change.
            remedy: String,
        } => "energy-surplus" {
            time: *time,
            cause: ("from t = {time} s on the energy exceeds the work of loads and drives: a surplus of {surplus:.3e} J where \
                    {turned_over:.3e} J are exchanged; the step does not resolve the motion"),
            remedy: "{remedy}",
            meaning: "Energy grew beyond the work of loads and drives, by more than 5 % of the energy exchanged.",
            advice: "The step does not resolve the motion, or the scheme adds energy to a motion that it does not resolve: use a smaller step, \
                `relative_tolerance`, or `scheme = \"radau-iia\"`.",
        }
        /// An expression is not finite at any record.
        NeverFinite {
            /// Name of the output.
            output: String,
        } => "never-finite" {
            subject: Subject::new("output", output),
            cause: ("the output `{output}` is not finite at any record: an argument is outside of what its functions allow"),
            remedy: "restrict the arguments, for example by `max(…, 0)` under a root, or correct the expression",
            meaning: "An output of kind `expression` is NaN or infinite at every record: a root of a negative number, a division by zero.",
        }
        /// A fluid without air is pulled.
        Cavitation {
            /// Time [s].
            time: f64,
            /// Where.
            node: Subject,
            /// Absolute pressure there [Pa].
            pressure: f64,
        } => "cavitation" {
            time: *time,
            subject: node,
            cause: ("at t = {time} s the absolute pressure of the {node} is {pressure:.3e} Pa: a fluid without air carries tension, but a \
                    real one is torn apart"),
            remedy: "give the fluid `air`, whose bubbles grow instead, and let fluid flow in from the tank by a check valve",
            meaning: "The absolute pressure in a fluid with `air = 0` fell below zero. Forces and times after that are those of a fluid that \
                carries tension.",
        }
        /// The restitution of an impact was reduced.
        RestitutionReduced {
            /// Time [s].
            time: f64,
            /// One of the contacts.
            contact: Subject,
            /// The fraction of it that is used.
            factor: f64,
        } => "restitution-reduced" {
            time: *time,
            subject: contact,
            cause: ("at t = {time} s an impact at the {contact} would gain energy with the given coefficients of restitution and \
                    friction: its restitution is multiplied by {factor:.3}"),
            remedy: "use a smaller `restitution` or `friction`, or a contact with a `stiffness`",
            meaning: "An impact at several rigid contacts, or at one with friction, would gain energy by Newton's law of restitution. The restitution \
                was reduced until it does not.",
        }
        /// An equilibrium is unstable.
        Unstable {
            /// Time, or load parameter, of the first unstable equilibrium [s].
            time: f64,
            /// Number of negative eigenvalues of the stiffness.
            directions: usize,
            /// Description of the onset, may be empty.
            onset: String,
            /// Description of the last equilibrium, if it is another one, otherwise empty.
            last: String,
        } => "unstable-equilibrium" {
            time: *time,
            cause: ("the equilibrium at t = {time} is unstable in {directions} direction(s){onset}: the model would leave it \
                    spontaneously (buckling, or a maximum of energy){last}"),
            remedy: "disturb it to find the stable equilibrium, or constrain the free parts",
            meaning: "An equilibrium, of statics or at the start, is unstable in the given number of directions. In statics the stability of the last \
                equilibrium is reported, too: if it is unstable, the result is not a position in which the model stays.",
            advice: "A column beyond its buckling load or an inverted pendulum stays there only in a computation: disturb it, or \
                constrain the free parts.",
        }
        /// An equilibrium was found by relaxation, not along a path of equilibria.
        Relaxed {
            /// Time, or load parameter [s].
            time: f64,
            /// The largest displacement of a node [m].
            distance: f64,
        } => "relaxed-equilibrium" {
            time: *time,
            cause: ("the equilibrium at t = {time} was found by relaxation, because Newton's method found none from the given \
                    positions: \
                    parts moved by up to {distance:.3e} m with decreasing energy; it may be one of several equilibria, depending on the \
                    given \
                    positions"),
            remedy: "start near the intended one",
            meaning: "Newton's method found no equilibrium from the given positions, for example for a cable without tension. The equilibrium \
                was found by relaxation: steps from rest with inertia, each of which lowers the energy.",
            advice: "It is one of possibly several equilibria: check that it is the intended one, or start closer to that.",
        }
        /// An equilibrium path was left by a jump.
        Jump {
            /// Load parameter before the jump [s].
            start: f64,
            /// Load parameter after it [s].
            time: f64,
            /// Work that was not stored [J].
            work: f64,
        } => "jump" {
            time: *time,
            cause: ("between t = {start} and {time} the model jumps: loads do {work:.3e} J more than it stores, so there is a \
                    limit point of the load between them, beyond which no equilibrium is close"),
            remedy: "use more load steps to find it, or follow the path beyond it with `kind = \"path\"`",
            meaning: "In one load step the loads did much more work than the model stored.",
            advice: "The step passed a limit point of the load: use more load steps, or follow the path.",
        }
        /// Given initial velocities do not satisfy the constraints.
        VelocityReplaced {
            /// Name of the node.
            part: Subject,
            /// Given velocity and angular velocity, in words.
            given: String,
            /// The velocities used.
            used: String,
        } => "velocity-replaced" {
            subject: part,
            cause: ("the initial velocity of {part} was given as {given} and violates the joints and drives: the run starts \
                    with {used}"),
            remedy: "specify velocities that the joints allow, for example by `[initial] angular_velocity` and `about`",
            meaning: "The given initial velocities violate joints or drives; they were changed as little as possible.",
            advice: "Give velocities that joints and drives allow; `[initial]` moves the whole model as a rigid body.",
        }
        /// A drive sets a flexible part into motion by a jump in velocity.
        StartsWithJolt {
            /// Name of a node of the part.
            part: String,
            /// Largest relative speed of neighbouring nodes over their distance [1/s].
            rate: f64,
        } => "starts-with-jolt" {
            subject: Subject::new("node", part),
            cause: ("drives and joints set `{part}` into motion instantaneously, which bends it: at the start it deforms at {rate:.3e} \
                    1/s"),
            remedy: "specify its initial velocity, or start the drive from rest",
            meaning: "Drives or joints set a beam into motion instantaneously, which bends it.",
        }
        /// A contact stops an approach faster than steps resolve.
        ContactTooShort {
            /// When it was first detected [s].
            time: f64,
            /// The switch.
            what: Subject,
            /// Effect of the switch.
            effect: String,
        } => "contact-too-short" {
            time: *time,
            subject: what,
            cause: ("at t = {time} s {what} {effect}, and energy may be lost or increased"),
            remedy: "use steps of at most a fiftieth of the time for which it acts, or set `relative_tolerance` instead of `step`, which ends steps \
                where it begins",
            meaning: "With fixed steps, a contact with a stop, a one-sided spring or a kink of an expression ends the motion within two steps, \
                from a tenth or more of the highest approach speed.",
            advice: "The contact is too short for the steps, and its energy may be lost: use steps of a fiftieth of its duration, or \
                `relative_tolerance`.",
        }
        /// A drive jumps from one position to another.
        DriveJumps {
            /// End of the step in which it was first detected [s].
            time: f64,
            /// Name of the drive.
            drive: String,
            /// The jump [m or rad].
            way: f64,
        } => "drive-jumps" {
            time: *time,
            subject: Subject::new("drive", drive),
            cause: ("in the step to t = {time} s the drive `{drive}` moves by {way:.3e} (m or rad), which does not follow from its \
                    rates: \
                    it jumps, or changes faster than steps resolve"),
            remedy: "let it move in a time that the steps resolve",
            meaning: "A drive moves in one step by more than twice the distance that follows from its rates at both ends: it jumps, or changes \
                faster than the steps resolve.",
            advice: "Make the drive smooth on the scale of a step, for example by a spline table or `smoothstep`, or use smaller steps.",
        }
        /// Steps of planned size do not resolve the velocities of joints and drives.
        UnresolvedRates {
            /// When it was first significant [s].
            time: f64,
            /// Violation of velocity constraints, as a fraction of the largest speed.
            missed: f64,
        } => "unresolved-rates" {
            time: *time,
            cause: ("the steps are too long for velocities and forces that signals and events read: from t = {time} s on positions \
                    satisfy joints and drives, but their rates have an error of {:.1} % of the speed of the model, and forces a larger \
                    one", 100.0 * *missed),
            remedy: "use smaller steps, or set `relative_tolerance` instead of `step`",
            meaning: "Fixed steps satisfy the constraints of joints and drives, but not their rates: the mean error of the constraint rates \
                over the sampled steps exceeds 2 % of the speed. Signals and events read velocities with the same error, accelerations and forces \
                with a larger one. Recorded outputs are recovered from the positions and do not have it.",
        }
        /// A beam is strained more than a beam can be.
        LargeStrain {
            /// When it was first significant [s].
            time: f64,
            /// The beam with the largest strain.
            beam: String,
            /// That strain [-].
            strain: f64,
        } => "large-strain" {
            time: *time,
            subject: Subject::new("beam", beam),
            cause: ("from t = {time} s on beam `{beam}` is strained by up to {:.1} %, more than its linear law describes",
                    100.0 * *strain),
            remedy: "check lengths, units, stiffnesses and drives: a mechanism may be driven to a position that it cannot reach",
            meaning: "A beam is stretched or sheared by more than 10 %.",
            advice: "Check units, lengths and stiffnesses. A mechanism that is driven beyond a dead centre strains its parts instead of \
                moving. Rubber is strained so much, but not by a linear law.",
        }
        /// The elements of a beam do not resolve section forces.
        SectionForces {
            /// When it was first significant [s].
            time: f64,
            /// The beam.
            beam: String,
            /// Number of its elements.
            elements: usize,
            /// Estimated error over the largest force or moment there.
            error: f64,
        } => "coarse-section-forces" {
            time: *time,
            subject: Subject::new("beam", beam),
            cause: ("the {elements} elements of beam `{beam}` do not resolve its section forces: they differ by up to {:.1} % from \
                    equilibrium with the neighbouring elements", 100.0 * *error),
            remedy: "use more elements, or record the reaction of the joint at its end, which converges faster",
            meaning: "A recorded section force or moment, which follows from the strains of one element, differs by more than 1 % of its \
                largest value from the one in equilibrium with the forces of the neighbouring elements and their loads. Forces with a \
                steep slope, such as those beside the root of a fast blade, need short elements.",
            advice: "Use more elements (half the length reduces the error to a quarter or less), a higher `order`, or record the reaction of \
                the joint at the end of the beam.",
        }
        /// Steps chosen for positions do not resolve the forces of a beam.
        UnresolvedForces {
            /// When it was first significant [s].
            time: f64,
            /// The beam.
            beam: String,
            /// Estimated error over the largest force or moment there.
            error: f64,
        } => "unresolved-forces" {
            time: *time,
            subject: Subject::new("beam", beam),
            cause: ("the steps resolve the motion, but not the vibrations in the recorded forces of beam `{beam}`: from t = {time} s \
                    on their estimated error exceeds 1 % of the largest value, and it reaches about {:.0} %", 100.0 * *error),
            remedy: "set a smaller `relative_tolerance`, or `control = \"forces\"`; a smooth start or `damping` of the section avoids \
                such vibrations",
            meaning: "Adaptive steps are chosen by the error of positions. Vibrations of a stiff direction are small as motions and large as forces: \
                the estimated error of a recorded force or moment of a beam, or of the reaction of a joint at it, exceeds 1 % of its \
                largest value at some instants. Means over several periods are accurate.",
            advice: "Use a smaller `relative_tolerance`, or `control = \"forces\"`, which resolves every vibration. If the vibrations are not meant, \
                start loads and drives smoothly, or add `damping` to the section.",
        }
        /// Steps of planned size do not resolve the motion.
        Unresolved {
            /// When it was first significant [s].
            time: f64,
            /// Estimated error over the displacement of the model.
            error: f64,
            /// Name of the unknown with the largest error.
            unknown: Subject,
        } => "unresolved-motion" {
            time: *time,
            subject: unknown,
            cause: ("the steps are too long for the motion: from t = {time} s on their estimated error exceeds 0.1 % of the \
                    amplitude of motion of the model; it reaches {:.2} % at the end, mostly in the \
                    {unknown}", 100.0 * *error),
            remedy: "use smaller steps, or set `relative_tolerance` instead of `step`",
            meaning: "Fixed steps are too long for the motion: their estimated errors add up to more than 0.1 % of the amplitude of motion of \
                the model.",
        }
        /// Steps that solve for all touches at once damp the motion between touches.
        SchemeDamps {
            /// When it was first significant [s].
            time: f64,
            /// Energy lost between touches [J].
            lost: f64,
            /// Energy lost between touches over the energy exchanged.
            share: f64,
            /// The part that loses most.
            part: Subject,
        } => "scheme-damps-motion" {
            time: *time,
            subject: part,
            cause: ("the steps damp the motion between touches: from t = {time} s on by more than 5 % of the energy exchanged; they have \
                    removed {lost:.3e} J, {:.1} %, most of it from the {part}", 100.0 * *share),
            remedy: "halve `step`: the loss is halved with it",
            meaning: "A scheme of first order, with which contacts of many parts are solved, removes more than 5 % of the energy exchanged from parts \
                that do not touch.",
        }
        /// Friction of rigid contacts that slide depends on normal forces that are not unique.
        SlidingForcesNotUnique {
            /// Time [s].
            time: f64,
            /// One of the contacts.
            contact: Subject,
        } => "sliding-forces-not-unique" {
            time: *time,
            subject: contact,
            cause: ("at t = {time} s more rigid contacts slide than are needed to support the part: their normal forces are not unique, and the \
                    {contact} is taken without force, so that its friction is missing and that of others is too large"),
            remedy: "use contacts with a `stiffness` instead of `rigid`",
            meaning: "More rigid contacts with friction slide than are needed to support a part. Its normal forces are not unique, and its motion depends \
                on which contacts carry it.",
        }
        /// The phase of a long motion without damping has drifted.
        EnergyDrift {
            /// When it was first significant [s].
            time: f64,
            /// Estimated shift of the phase at the end [rad].
            shift: f64,
            /// Energy dissipated by the scheme over the energy exchanged.
            lost: f64,
        } => "energy-drift" {
            time: *time,
            cause: ("the scheme has dissipated {:.2e} of the energy of a long motion without damping: the phase of its vibrations is \
                    shifted by about {:.2} rad at the end, and by 0.01 rad at t = {time} s", *lost, *shift),
            remedy: "set a smaller `relative_tolerance`",
            meaning: "A long motion without damping or drives loses energy to the scheme steadily. Where its frequency depends on its energy, \
                the phase drifts with the square of the time.",
            advice: "Use a smaller `relative_tolerance`: a tenth of it reduces the drift to less than a tenth.",
        }
        /// A constraint is nearly redundant.
        JointsOutOfLine {
            /// The start [s].
            time: f64,
            /// The joint that is out of line.
            joint: Subject,
            /// The joints that it repeats nearly.
            others: Subject,
            /// Angle between its direction and theirs [rad].
            angle: f64,
        } => "joints-out-of-line" {
            time: *time,
            subject: joint,
            cause: ("{joint} repeats directions of {others}, but is out of line by {angle:.1e} rad, so that each holds what the others leave \
                    free"),
            remedy: "give positions and axes with more digits (up to 1e-5 rad count as in line), or replace the joint by a kind that leaves \
                the direction free",
            meaning: "Joints that are meant to guide the same motion are out of line by more than the geometric tolerance of 1e-5 rad, and lock \
                it.",
        }
        /// The geometry of redundant constraints does not fit the others.
        RedundantMisfit {
            /// When it was first detected [s].
            time: f64,
            /// Name of the equation and its violation.
            violated: Subject,
            /// The constraints on which it depends.
            others: Subject,
        } => "redundant-misfit" {
            time: *time,
            subject: violated,
            cause: ("at t = {time} s the geometry does not fit: {violated}; the constraint is redundant beside {others}, which the motion \
                    follows"),
            remedy: "give positions and axes with more digits, or remove the redundant constraint",
            meaning: "A redundant constraint is violated by more than 1e-6 of the representative length, or 1e-6 rad: its axes or lengths differ \
                from those that the other constraints imply. The motion follows the others; from 1e-4 on this is a failure.",
            advice: "Give positions and axes with more digits, or replace one of the joints by a kind that leaves the direction free.",
        }
        /// A wheel's point of contact travels faster than steps of planned size resolve.
        ContactRunsRound {
            /// When it was first detected [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// Angle of its travel in the first such step [rad].
            angle: f64,
        } => "contact-runs-round" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("at t = {time} s the wheel of `{joint}` is nearly flat, and its contact point moves along the rim by {angle:.2} \
                    rad in a step, which is too long"),
            remedy: "use smaller steps, or set `relative_tolerance` instead of `step`",
            meaning: "With fixed steps, the contact point of a `rolling` wheel that lies nearly flat moves round the rim by more than 0.5 rad \
                in a step.",
            advice: "No part rotates as fast as that, but the error of every such step is 1 % of a radius or more: use steps of a fiftieth of \
                a revolution, or `relative_tolerance`.",
        }
        /// A law of time or of the motion changes within a step of planned size in a way that its ends do not determine.
        FunctionUnseen {
            /// Where it was first found [s].
            time: f64,
            /// The law, in words.
            function: Subject,
            /// Size of the step [s].
            step: f64,
        } => "function-unseen" {
            time: *time,
            subject: function,
            cause: ("around t = {time} s {function} changes within a step of {step:.3e} s in a way that its values and slopes at the \
                    ends do not show, such as a pulse or an oscillation: the step misses or aliases it"),
            remedy: "use smaller steps, or set `relative_tolerance` instead of `step`",
            meaning: "With fixed steps, a law of time or of the motion changes within a step in a way that its values and slopes at the ends do not \
                show: a pulse, a narrow peak over a position, or an oscillation with fewer than about four steps per period.",
            advice: "The step misses or aliases it: use smaller steps, or `relative_tolerance`, which adapts the steps to such laws.",
        }
        /// A wheel on a rail touches outside the range of its model.
        RailContact {
            /// When it was first detected [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// The limit exceeded.
            doubt: String,
        } => "rail-contact" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("at t = {time} s the wheel of `{joint}` {doubt}"),
            remedy: "reduce the speed, or specify profiles over the whole width",
            meaning: "A `wheel_on_rail` touches beyond its `tread`, on the flank of the rail's head, at two points simultaneously, or at none \
                with a common normal.",
            advice: "A flange or a second contact would carry load from there on, which one constraint cannot represent: reduce the \
                speed, or specify profiles over the whole width.",
        }
        /// Many steps end at kinks and jumps of laws.
        LawsEndSteps {
            /// When it was reported [s].
            time: f64,
            /// Number of steps that ended there.
            ended: usize,
            /// Number of all steps.
            steps: usize,
            /// The laws at which most of them ended, with their numbers.
            laws: Subject,
        } => "laws-end-steps" {
            time: *time,
            subject: laws,
            cause: ("until t = {time} s {ended} of {steps} steps ended at kinks or jumps of laws: {laws}"),
            remedy: "if the run is too slow, use smooth laws, such as `sqrt(x^2 + 0.01)` instead of `abs(x)`, or `interpolation = \"spline\"`",
            meaning: "At least a quarter of the steps ended at kinks or jumps of the laws of signals and local loads, such as `max`, `abs` or the \
                rows of a linear table. At each of them a step is repeated until it ends there.",
            advice: "The result is accurate, but the run is slower than with smooth laws: replace `abs(x)` by `sqrt(x^2 + e^2)`, `max` by a \
                smooth transition, and give tables `interpolation = \"spline\"`. `summary.json` lists the laws under `laws_that_end_steps`.",
        }
        /// Two solids in contact overlap at the start.
        ContactOverlaps {
            /// The start [s].
            time: f64,
            /// Name of one of the parts.
            part: String,
            /// Penetration [m].
            depth: f64,
        } => "contact-overlaps" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at the start a contact of `{part}` is {depth:.3e} m deep, and will push the parts apart"),
            remedy: "start the parts apart, or leave a solid out of contacts with `touches = false`",
            meaning: "Two shapes in contact overlap at the start by more than a load would press them into each other. Their contact \
                force accelerates them.",
        }
        /// A rope is slack at the start.
        RopeSlack {
            /// The start [s].
            time: f64,
            /// Parts of the rope.
            parts: String,
            /// How much longer it is than the way along its points [m].
            slack: f64,
            /// Length of the rope [m].
            length: f64,
        } => "rope-slack" {
            time: *time,
            subject: Subject::new("part", parts),
            cause: ("at the start the rope on `{parts}` is slack by {slack:.3} m: it is {length:.3} m long"),
            remedy: "shorten its `length`, unless the part is meant to fall into it",
            meaning: "A rope is longer at the start than the way along its points by more than 5 %. It carries nothing until its parts are so far \
                apart.",
            advice: "Without `length` a rope is as long as its way at the start. Write a `length` only if it is slack or stretched.",
        }
        /// A rope is taut far beyond its length at the start.
        RopeStretched {
            /// The start [s].
            time: f64,
            /// Parts of the rope.
            parts: String,
            /// How much shorter it is than the way along its points [m].
            stretch: f64,
            /// Length of the rope [m].
            length: f64,
        } => "rope-stretched" {
            time: *time,
            subject: Subject::new("part", parts),
            cause: ("at the start the rope on `{parts}` is stretched by {stretch:.3} m: it is only {length:.3} m long"),
            remedy: "omit `length`, which is then the way along its points, or write that of the whole rope with its arcs",
            meaning: "A rope is shorter at the start than the way along its points by more than a tenth: its tension, `stiffness` times the difference, throws \
                its parts together. Ropes of steel break at a hundredth.",
            advice: "`length` is that of the whole rope in metres, with the arcs on its sheaves. Without it a rope is as long as its way at the start.",
        }
        /// A joint starts beyond its stops.
        BeyondStop {
            /// The start [s].
            time: f64,
            /// Name of the coordinate.
            coordinate: String,
            /// How far it is beyond [m or rad].
            depth: f64,
        } => "beyond-stop" {
            time: *time,
            subject: Subject::new("coordinate", coordinate),
            cause: ("at the start `{coordinate}` is {depth:.3e} beyond the range of its stop, which will push it back"),
            remedy: "start it within the range, or correct the range, which is relative to the position at the start",
            meaning: "A joint with an `axial_stop` or a `torsional_stop` starts outside the range by more than a load would press it into \
                the stop. The force of the stop accelerates it.",
            advice: "Start the joint within the range. Coordinates of joints are zero at the start, unless the joint specifies \
                another value: the range is relative to the position at the start.",
        }
        /// A coordinate leaves the table over it.
        BeyondTable {
            /// When it was first detected [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// The coordinate [m or rad].
            value: f64,
            /// First argument of the table.
            first: f64,
            /// Last argument of the table.
            last: f64,
        } => "beyond-table" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("at t = {time} s the coordinate is {value:.4}, but the table of `{joint}` is from {first:.4} to {last:.4}"),
            remedy: "specify its `period`, such as `2*pi` for one turn, more rows, or `extrapolation`",
            meaning: "The coordinate on which a `cam` depends has left the rows of its table, which is continued by straight lines: a cam \
                given by a table of one turn lifts on the first turn only.",
            advice: "Specify the `period` of the table, such as `2*pi` for one turn, or more rows. `extrapolation` states that the table is \
                to be continued, and by what.",
        }
        /// A spring between two points reverses its direction within a step.
        SpringThroughZero {
            /// When it was first detected [s].
            time: f64,
            /// Name of the node of its base.
            base: String,
            /// Name of the node of its tip.
            tip: String,
        } => "spring-through-zero" {
            time: *time,
            subject: Subject::new("node", tip),
            cause: ("at t = {time} s the spring from `{base}` to `{tip}` passes zero length, where its force reverses within a step: the \
                motion from there on is less accurate than the tolerance"),
            remedy: "use an `axial` spring on the coordinate of a joint, which has no such jump, a free length of zero, or smaller steps",
            meaning: "The ends of a spring of kind `point` have passed each other within one step. Its force is along the line through \
                them, so that one that does not vanish at zero length reverses there. The instant is not located.",
            advice: "On a straight guide use an `axial` spring on the joint, whose elongation may be negative. Otherwise keep the ends \
                apart, or compare results of smaller steps.",
        }
        /// Two solids in contact are almost within each other.
        ContactTooDeep {
            /// When it was first detected [s].
            time: f64,
            /// Name of one of the parts.
            part: String,
            /// Penetration [m].
            depth: f64,
            /// Half of the penetration at which the solids are within each other [m].
            limit: f64,
        } => "contact-too-deep" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at t = {time} s a contact of `{part}` is {depth:.3e} m deep, more than half of what its shapes allow ({limit:.3e} m): \
                    deeper, the parts leave each other on the other side"),
            remedy: "use a larger contact stiffness, or start the parts apart",
            meaning: "Two shapes in contact penetrate each other by more than half of their size; the contact force is no longer meaningful, \
                and the parts may pass through each other.",
        }
        /// A contact of a set is deeper than its force explains.
        ContactSunk {
            /// When it was first detected [s].
            time: f64,
            /// Name of one of the parts.
            part: String,
            /// Penetration [m].
            depth: f64,
        } => "contact-sunk" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at t = {time} s a contact of `{part}` is {depth:.3e} m deep, more than ten times deeper than its force explains"),
            remedy: "use a shorter `step`",
            meaning: "A penetration that appears within a step, such as that of an edge whose nearest point jumps, is not pressed apart, because \
                that would supply energy. Here it is more than ten times the penetration by the force, so that the part rests too deep.",
        }
        /// A ball in a hollow of a shape touches two sides of it.
        ContactInHollow {
            /// When it was first detected [s].
            time: f64,
            /// The contact.
            contact: Subject,
            /// Penetration of the second side that remains without that of the nearest one [m].
            depth: f64,
        } => "contact-in-hollow" {
            time: *time,
            subject: contact,
            cause: ("at t = {time} s the {contact} touches two sides of a hollow, but has a force on the nearest side only; on the other \
                    side {depth:.3e} m of penetration are not resisted"),
            remedy: "split the shape into solids without hollows, such as planes, boxes or convex outlines; where points approximate a curve, \
                use `smooth = true`",
            meaning: "A ball or roller in a hollow of an `outline`, a `mesh` or another shape touches two sides of it. The contact force acts on the \
                nearest side only: it has a wrong direction, and may change from side to side in every step.",
            advice: "Split the shape into several solids without hollows, such as planes, boxes or convex outlines (`shape` may be a list). Where the \
                points of an outline approximate a curve, use `smooth = true`.",
        }
        /// Walls of a shell pass through each other.
        ShellCrossesItself {
            /// Time, or load parameter, at the end [s].
            time: f64,
            /// Name of the shell.
            shell: String,
            /// Where they cross, x, y and z [m].
            position: String,
        } => "shell-crosses-itself" {
            time: *time,
            subject: Subject::new("shell", shell),
            cause: ("at the end, t = {time} s, walls of shell `{shell}` pass through each other at ({position}) m: nothing prevents this in the \
                    model, but real walls touch"),
            remedy: "reduce the loads, or add a contact of the shell with itself",
            meaning: "Elements of one shell that are apart at the start cross each other at the end of the run, for example the opposite walls of a \
                tube under pressure beyond its buckling. The shell has no contact with itself.",
            advice: "The result is valid up to the load at which the walls touch. Reduce the loads, or add a contact of the shell with itself.",
        }
        /// A tyre is flat.
        TyreDeflected {
            /// When it was first detected [s].
            time: f64,
            /// Name of its wheel.
            part: String,
            /// Deflection [m].
            deflection: f64,
            /// Largest one of usual tyres [m].
            limit: f64,
        } => "tyre-deflected" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at t = {time} s the tyre of `{part}` is pressed flat by {deflection:.3} m: a real one would rest on its rim from some {limit:.3} m on"),
            remedy: "check the `radius` and `stiffness` of the tyre [m, N/m] and the height of the wheel at the start",
            meaning: "The deflection of a tyre exceeds a quarter of its radius, about half of the height of its section.",
            advice: "Check `radius` and `stiffness` of the tyre, and the height of its wheel at the start. Impacts on the rim need a contact of the wheel.",
        }
        /// A tyre with data of one direction starts in the other one.
        TyreRollsBackwards {
            /// The start [s].
            time: f64,
            /// Name of its wheel.
            part: String,
            /// Speed against the direction of rolling [m/s].
            speed: f64,
        } => "tyre-rolls-backwards" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at the start the wheel `{part}` moves at {speed:.2} m/s against the direction of rolling of its tyre: offsets of its file act on the wrong \
                    side"),
            remedy: "let `wheel_axis` point to the left of the direction of travel, unless the vehicle starts in reverse",
            meaning: "Data of a Magic Formula are those of a wheel whose axis points to the left of its direction of travel. The wheel starts in the \
                opposite direction.",
            advice: "Reverse `wheel_axis`, and state the side on which the tyre is by `mounted`. A vehicle that starts in reverse is right as it is.",
        }
        /// A tyre carries more than the loads for which it has data.
        TyreBeyondData {
            /// When it was first detected [s].
            time: f64,
            /// Name of its wheel.
            part: String,
            /// Normal force [N].
            load: f64,
            /// Largest load of the data [N].
            limit: f64,
        } => "tyre-beyond-data" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at t = {time} s the tyre of `{part}` carries {load:.0} N, more than the {limit:.0} N for which its file has data: its forces are \
                    extrapolated"),
            remedy: "reduce the load, or use a file of a larger tyre",
            meaning: "A tyre property file states the loads of its measurements. Beyond them the coefficients are those of its largest load, and the \
                forces are proportional to the load: a real tyre has less friction.",
            advice: "Look for the cause of the load, such as a stiff stop or an impact, or use a file of a larger tyre.",
        }
        /// The road under a tyre is far from the plane that replaces it.
        RoadBeyondContact {
            /// When it was first detected [s].
            time: f64,
            /// Name of its wheel.
            part: String,
            /// Standard deviation of the road from the plane within the contact [m].
            deviation: f64,
            /// Largest deviation that the model resolves [m].
            limit: f64,
        } => "road-beyond-contact" {
            time: *time,
            subject: Subject::new("part", part),
            cause: ("at t = {time} s the road under the tyre of `{part}` deviates by {deviation:.3} m from a plane within the contact, more than the \
                    {limit:.3} m that the tyre's model resolves: a step or an obstacle is replaced by an inclined plane"),
            remedy: "extend the step of the road over a greater length than that of the contact, or model the obstacle with a contact",
            meaning: "A tyre is on the plane that fits the heights of the road within its contact best. The standard deviation from this plane exceeds \
                three hundredths of the radius: at steps and short obstacles the forces are not those of a tyre with a belt.",
            advice: "Extend the step of the road over a greater length than that of the contact, or use a rigid contact for the obstacle. A short \
                `contact_length` follows the road more closely.",
        }
        /// A wheel that rolls is pulled by its plane.
        WheelLifts {
            /// When it was first detected [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// Magnitude of the pull [N].
            force: f64,
        } => "wheel-lifts" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("at t = {time} s the plane or rail of `{joint}` pulls its wheel with {force:.3e} N: a real wheel would lift off, \
                    but the joint prevents it"),
            remedy: "reduce the speed, or use another contact model",
            meaning: "The plane of a `rolling` joint, or the rail of a `wheel_on_rail`, pulls on its wheel.",
            advice: "A real wheel would lift off: reduce the speed, or use another contact model.",
        }
        /// A wheel that rolls needs more friction than there is.
        WheelSlides {
            /// When it was first detected [s].
            time: f64,
            /// Name of the joint.
            joint: String,
            /// Friction [N].
            friction: f64,
            /// Normal force [N].
            normal: f64,
        } => "wheel-slides" {
            time: *time,
            subject: Subject::new("joint", joint),
            cause: ("at t = {time} s the wheel of `{joint}` requires {friction:.3e} N of friction at a normal force of {normal:.3e} N: \
                    this exceeds its coefficient, so a real wheel would slide, but the joint prevents it"),
            remedy: "reduce the driving or braking forces, or use another contact model",
            meaning: "A `rolling` joint requires more friction than its `friction_coefficient` allows.",
            advice: "A real wheel would slide: from then on the motion is that of a gear wheel on a rack.",
        }
        /// A motion crossed a position at which constraints become redundant.
        SingularPosition {
            /// When it was first detected [s].
            time: f64,
            /// Joints whose equations become redundant there, in words.
            joints: Subject,
        } => "singular-position" {
            time: *time,
            subject: joints,
            cause: ("at t = {time} s the mechanism is in a singular position: there the equations of {joints} are dependent, the \
                    mechanism has an additional degree of freedom, and round-off decides in which way the motion continues"),
            remedy: "start and stay away from it, change the lengths, or couple the joints that must keep their sense of rotation",
            meaning: "Constraints of a closed loop become dependent at one position, for example where a parallelogram's bars are collinear: \
                the mechanism gains a degree of freedom there.",
            advice: "The motion can continue in more than one way, and round-off decides: start elsewhere, change the lengths, or couple the \
                bars that must keep their sense of rotation.",
        }
        /// Reactions of redundant constraints.
        ReactionsNotUnique {
            /// Names of the columns, in words.
            columns: String,
            /// The redundant directions.
            repeated: Subject,
        } => "reactions-not-unique" {
            subject: repeated,
            cause: ("{columns} not unique: constraints are redundant there ({repeated}), and the reported reactions are those of minimum \
                    norm; in a real mechanism they depend \
                    on the stiffness"),
            remedy: "replace rigid joints by bushings, or release the redundant directions",
            meaning: "Constraints are redundant, so the listed columns are the reactions of minimum norm.",
            advice: "Real joints share the load according to their stiffness: replace rigid joints by bushings, or release the listed \
                directions.",
        }
        /// A superelement deforms by more than its linear matrices allow.
        BeyondLinear {
            /// When it was first detected [s].
            time: f64,
            /// Name of the interface.
            interface: String,
            /// The largest deformation over the limit up to which the matrices are valid.
            largest: f64,
        } => "beyond-linear" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("from t = {time} s on the superelement's interface `{interface}` is displaced or rotated beyond the \
                    range of its linear matrices: by up to {largest:.2} times 0.2 rad, or 0.15 of the distance between interfaces, from \
                    the \
                    floating frame; forces have an estimated error of {:.1} % or more", PERCENT_AT_LIMIT * largest.powi(2)),
            remedy: "divide the part into several superelements, or model it by beams",
            meaning: "An interface of a superelement is turned by more than 0.2 rad, or displaced by more than 0.15 of the distance between \
                interfaces, against its floating frame.",
            advice: "Linear matrices are not valid for such deformations: divide the part into several superelements, or model it by beams.",
        }
        /// A superelement rotates nearly as fast as it oscillates.
        TurnsFast {
            /// When it was first detected [s].
            time: f64,
            /// Name of the interface that carries its floating frame.
            interface: String,
            /// The largest angular velocity over the limit up to which the matrices are valid.
            largest: f64,
        } => "turns-fast" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("from t = {time} s on the superelement of `{interface}` rotates at up to {largest:.2} times the limit of its \
                    matrices, which is a quarter of its first natural frequency with that interface fixed, or that frequency with \
                    `geometric` matrices: centrifugal forces change its stiffness by more than they represent"),
            remedy: "compute them with `lissom reduce`, divide it into several superelements, or model it by beams",
            meaning: "A superelement rotates at more than a quarter of its first natural frequency with the floating interface fixed, or at \
                more than that frequency if it has `geometric` matrices.",
            advice: "Centrifugal forces stiffen it by more than a sixteenth, which its matrices do not contain, or by more than they can \
                represent: compute them with `lissom reduce`, divide it into several superelements, or model it by beams.",
        }
        /// Loads change the stiffness of a superelement, which its matrices do not contain.
        LoadStiffness {
            /// When it was first detected [s].
            time: f64,
            /// Name of the interface that carries its floating frame.
            interface: String,
            /// The largest effect over the limit up to which the matrices are valid, 0.5 %.
            largest: f64,
        } => "load-stiffness" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("from t = {time} s on axial forces and rotation change the bending stiffness of the superelement of \
                    `{interface}` by up to an estimated {:.2} %, which its \
                    matrices do not contain: its deflection has an error of up to this size", 0.5 * *largest),
            remedy: "compute its matrices with `lissom reduce`, which includes second-order terms, or model it by beams",
            meaning: "Axial forces and rotation change the bending stiffness of a superelement by an estimated 0.5 % or more, which its \
                matrices do not contain.",
            advice: "The error of its deflection is about half the estimate: compute its matrices with `lissom reduce`, which includes \
                second-order terms, or model it by beams.",
        }
        /// Moments couple bending and torsion of a superelement, which no matrices contain.
        MomentStiffness {
            /// When it was first detected [s].
            time: f64,
            /// Name of the interface that carries its floating frame.
            interface: String,
            /// The omitted effect over the limit up to which the matrices are valid, 0.5 %.
            largest: f64,
        } => "moment-stiffness" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("from t = {time} s on moments couple bending and twist of the superelement of `{interface}`, which its matrices \
                    do not contain: \
                    the estimated error of its displacement is up to {:.2} % of its largest deformation", 0.5 * *largest),
            remedy: "divide it into several superelements, or model it by beams",
            meaning: "Moments couple bending and twist of a superelement by an estimated 0.5 % of its largest deformation or more.",
            advice: "Its matrices contain only part of that coupling: divide it into several superelements, or model it by beams.",
        }
        /// A superelement is excited faster than its modes can follow.
        ModesLeftOut {
            /// When it was first detected [s].
            time: f64,
            /// Name of the interface that carries its floating frame.
            interface: String,
            /// The largest estimated error over the limit for a warning, 5 %.
            largest: f64,
        } => "modes-left-out" {
            time: *time,
            subject: Subject::new("interface", interface),
            cause: ("from t = {time} s on the superelement of `{interface}` is excited faster than its modes can follow: its interface \
                    forces have an estimated error of up to {:.0} % of its inertial forces", 5.0 * *largest),
            remedy: "reduce the part with more modes, start and stop its motion smoothly, or model it by beams",
            meaning: "A superelement is excited faster than its modes can follow, for example by a motion that starts or stops suddenly: its \
                interface forces have an estimated error of 5 % of its inertial forces or more.",
        }
        /// An output that accumulates along the motion could not be continued.
        AccumulationLost {
            /// End of the first step over which it could not be determined [s].
            time: f64,
            /// Name of the output.
            output: String,
        } => "output-lost" {
            time: *time,
            subject: Subject::new("output", output),
            cause: ("at t = {time} s the output `{output}` ends: from one step to the next it changes by more than can be tracked, \
                    and it is not a number from there on"),
            remedy: "use smaller steps; an angle about an axis is undefined when the axis is rotated by half a revolution",
            meaning: "An output of kind `angle` changed by too much within a step to be tracked, or its axis was rotated by half a turn; it is \
                not a number from there on.",
            advice: "Use smaller steps, another axis, or `quaternion` and `cardan_angles` for motions about all axes.",
        }
        /// A warning from the model file.
        Model {
            /// The part.
            part: Subject,
            /// Text of the warning.
            message: String,
            /// The remedy; may be empty.
            help: String,
        } => "model" {
            subject: part,
            cause: ("{message}"),
            remedy: "{help}",
            meaning: "Something in the model file is allowed but probably unintended, such as a drive whose speed jumps at the rows of a table.",
            advice: "See the message.",
        }
    }
}
