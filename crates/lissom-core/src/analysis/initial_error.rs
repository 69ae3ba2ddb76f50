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
            cause: ("statics and a start from equilibrium know no rates: {state} has no equation there"),
            remedy: "remove states, friction and rolling joints, or start a dynamic analysis as it is",
            meaning: "A state, friction or a rolling joint is governed by rates, which statics and a start from equilibrium do not have.",
            advice: "Remove it, or simulate the motion from the given positions.",
        }
        /// Something is free to rest anywhere.
        Free {
            /// Coordinates of joints, or degrees of freedom of nodes, that are free.
            free: Subject,
        } => "free-at-rest" {
            subject: free,
            cause: ("initial equilibrium: nothing holds or carries the {free}: neither weight nor a spring decides where it rests, so any \
                    place is as good as another"),
            remedy: "hold it by a joint, a drive or a spring, or start from the places given, without an equilibrium",
            meaning: "The equilibrium is not unique, because neither a spring nor weight determines the position of a part.",
            advice: "Add a joint, a drive or a spring, or start from the given positions.",
        }
        /// Velocities that the constraints exclude altogether.
        VelocityImpossible {
            /// Name of the node.
            part: Subject,
            /// Its velocities in words.
            given: String,
        } => "velocity-impossible" {
            subject: part,
            cause: ("the initial velocity of {part}, {given}, is excluded by the joints and drives: nothing of it remains"),
            remedy: "leave it out, or free what shall move",
            meaning: "The joints and drives admit nothing of a given initial velocity.",
            advice: "Remove the velocity, or free the coordinate.",
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
            cause: ("initial accelerations: the normal forces of wheels on rails and the creep forces they allow are not found together \
                    (they still change by {change:.1e} of their size)"),
            remedy: "look at friction_coefficient and at how the wheels are held",
            meaning: "The iteration for the normal forces of wheels on rails, on which creep forces depend, does not converge at the start.",
            advice: "Check `friction_coefficient` and the constraints of the wheels.",
        }
        /// A number is not finite.
        NotFinite {
            /// Name of the unknown.
            unknown: Subject,
        } => "initial-not-finite" {
            subject: unknown,
            cause: ("initial accelerations are not finite, first for the {unknown}: a force there is without bound at the start, or masses \
                    are too far apart"),
            remedy: "look at what acts on it, and at the units",
            meaning: "Initial accelerations are not finite.",
            advice: "Look at the forces on the reported unknown, and at the units.",
        }
    }
    wraps {
        /// A signal is not finite.
        Signal(crate::signals::SignalError), (error) => error.diagnostic().within("at the start"),
        /// The places of rest were not found.
        NoEquilibrium(Box<super::StepError>), (error) => error.diagnostic().within("initial equilibrium"),
        /// A beam is turned too far within an element.
        Wrapped(Box<super::StepError>), (error) => error.diagnostic().within("at the start"),
    }
}
