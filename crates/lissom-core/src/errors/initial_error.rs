//! Why initial values do not exist.

use crate::diagnostics::diagnostics;
use crate::kinematics::Subject;

diagnostics! {
    /// Initial values that do not exist.
    #[derive(Clone, Debug, PartialEq)]
    #[non_exhaustive]
    Failure InitialError {
        /// A pivot vanished.
        ZeroPivot {
            /// The pivot.
            pivot: f64,
            /// Name of the unknown.
            unknown: Subject,
            /// What to try.
            hint: &'static str,
        } => "initial-zero-pivot" {
            subject: unknown,
            cause: ("initial accelerations: elimination stops at a pivot of {pivot:.1e} for the {unknown}"),
            remedy: "{hint}",
            meaning: "The initial accelerations are not determined: a part has no mass, or a constraint is redundant.",
            advice: "Add a mass, a stiffness or a joint, or remove the redundant constraint.",
        }
        /// States where there are no rates.
        StateInStatics {
            /// What has no equation there.
            state: Subject,
        } => "rates-in-statics" {
            subject: state,
            cause: ("statics and a start from equilibrium have no rates: {state} has no equation there"),
            remedy: "remove states, friction and rolling joints, or start a dynamic analysis without an equilibrium",
            meaning: "A state, friction or a rolling joint is governed by rates, which statics and a start from equilibrium do not have.",
        }
        /// Algebraic unknowns whose equations do not determine them.
        Unbalanced {
            /// The unknown.
            unknown: Subject,
        } => "unbalanced" {
            subject: unknown,
            cause: ("the balance of the {unknown} has no unique solution, or none that is found from its first guess"),
            remedy: "give it a better first guess; let flow into a junction in every position of the valves, or give it a volume",
            meaning: "An algebraic unknown, such as the pressure of a junction, follows from an equation that determines it at all times.",
        }
        /// A delayed signal where there is no time.
        DelayInStatics {
            /// The signal.
            signal: Subject,
        } => "delay-in-statics" {
            subject: signal,
            cause: ("statics and a start from equilibrium have no past: the delayed {signal} has no value there"),
            remedy: "remove its `delay`, or start a dynamic analysis without an equilibrium",
            meaning: "A delayed signal is a value of the past, which statics, equilibrium paths and a start from equilibrium do not have.",
        }
        /// Something is free to rest anywhere.
        Free {
            /// Coordinates of joints, or degrees of freedom of nodes, that are free.
            free: Subject,
        } => "free-at-rest" {
            subject: free,
            cause: ("initial equilibrium: the {free} has no resistance: neither weight nor a spring determines its position of rest, so \
                    any position is an equilibrium"),
            remedy: "constrain it by a joint, a drive or a spring, or start from the given positions, without an equilibrium",
            meaning: "The equilibrium is not unique, because neither a spring nor weight determines the position of a part.",
        }
        /// Velocities that the constraints exclude altogether.
        VelocityImpossible {
            /// Name of the node.
            part: Subject,
            /// Velocities of the node in words.
            given: String,
        } => "velocity-impossible" {
            subject: part,
            cause: ("the initial velocity of {part}, {given}, is entirely prevented by the joints and drives"),
            remedy: "remove the velocity, or release the part",
            meaning: "The joints and drives prevent a given initial velocity entirely.",
        }
        /// Nothing can move, because constraints that are meant to repeat others are out of line.
        NoFreedom {
            /// The joint that is out of line.
            joint: Subject,
            /// The joints that it repeats nearly.
            others: String,
            /// Angle between its direction and theirs [rad].
            angle: f64,
        } => "no-freedom" {
            subject: joint,
            cause: ("the mechanism has no degree of freedom: {joint} repeats directions of {others}, but is out of line by {angle:.1e} rad, \
                    so that each holds what the others leave free"),
            remedy: "give positions and axes with more digits (up to 1e-5 rad count as in line), or replace the joint by a kind that leaves \
                the direction free",
            meaning: "Nothing can move: joints that are meant to guide the same motion, such as two hinges of a door, are out of line by more \
                than the geometric tolerance of 1e-5 rad.",
        }
        /// Drives or joints ask for different velocities.
        RatesContradict {
            /// Names of the constraints.
            violated: Subject,
            /// The cause.
            cause: &'static str,
            /// What to try.
            remedy: &'static str,
        } => "rates-contradict" {
            subject: violated,
            cause: ("at the start {violated} contradict each other: no velocities satisfy them all, {cause}"),
            remedy: "{remedy}",
            meaning: "No velocities satisfy all constraints at the start.",
            advice: "Remove a constraint, or change what is prescribed.",
        }
        /// Normal forces and the creep forces that they allow do not agree.
        NormalForces {
            /// The last change, relative to the largest multiplier.
            change: f64,
        } => "normal-forces" {
            cause: ("initial accelerations: the iteration for normal forces and the friction or creep that depends on them did not converge \
                    (last relative change {change:.1e})"),
            remedy: "check `friction_coefficient` and the constraints of wheels on rails, and `friction` of rigid contacts",
            meaning: "The iteration for the normal forces of wheels on rails or of rigid contacts, on which creep and friction depend, does not converge.",
        }
        /// Rigid contacts without consistent forces.
        ContactForces {
            /// One of the contacts that touch.
            contact: Subject,
        } => "rigid-contact-forces" {
            subject: contact,
            cause: ("no forces or impulses were found that satisfy the conditions of all rigid contacts that touch, the {contact} among \
                    them"),
            remedy: "reduce `friction`, or give one of the contacts a `stiffness` instead of `rigid`",
            meaning: "The conditions of rigid contacts that touch at the same instant have no solution, or the iteration does not find it.",
        }
        /// A rigid contact with friction at which a normal force does not push the solids apart.
        ContactParadox {
            /// The contact.
            contact: Subject,
        } => "rigid-contact-paradox" {
            subject: contact,
            cause: ("the {contact} slides in Painlevé's paradox: with the friction that it causes, a normal force does not push the \
                    parts apart, and the forces are not determined"),
            remedy: "reduce `friction`, or give the contact a `stiffness` instead of `rigid`",
            meaning: "A rigid part slides such that no unique normal force exists (Painlevé's paradox).",
        }
        /// A rigid contact that begins with a penetration.
        ContactPenetration {
            /// The contact.
            contact: Subject,
            /// The penetration [m].
            depth: f64,
        } => "rigid-contact-penetrates" {
            subject: contact,
            cause: ("at the start the parts of the rigid {contact} penetrate each other by {depth:.3e} m"),
            remedy: "move one of them apart",
            meaning: "The parts of a rigid contact penetrate each other at the start.",
        }
        /// A number is not finite.
        NotFinite {
            /// Name of the unknown.
            unknown: Subject,
        } => "initial-not-finite" {
            subject: unknown,
            cause: ("initial accelerations are not finite, first for the {unknown}: a force is unbounded at the start, or masses differ \
                    by too many orders of magnitude"),
            remedy: "check the forces on the unknown, and the units",
            meaning: "Initial accelerations are not finite.",
        }
        /// A unit of another program cannot start.
        Unit {
            /// The unit.
            unit: String,
            /// What went wrong.
            cause: String,
            /// What to try.
            remedy: String,
        } => "unit-start" {
            subject: Subject::new("unit", unit),
            cause: ("the unit `{unit}` cannot start: {cause}"),
            remedy: "{remedy}",
            meaning: "A unit of another program could not be loaded or initialised.",
            advice: "Run the unit alone in the program that made it.",
        }
    }
    wraps {
        /// A signal is not finite.
        Signal(crate::signals::SignalError), (error) => error.diagnostic().within("at the start"),
        /// The places of rest were not found.
        NoEquilibrium(Box<super::StepError>), (error) => error.diagnostic().within("initial equilibrium"),
        /// It was interrupted.
        Interrupted(crate::interrupt::Interrupted), (_) => {
            super::StepError::Interrupted { time: f64::NAN }.diagnostic()
        },
        /// A beam is turned too far within an element.
        Wrapped(Box<super::StepError>), (error) => error.diagnostic().within("at the start"),
    }
}
