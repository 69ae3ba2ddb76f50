//! Vectors as an observer sees them: in the axes of a frame that moves, and relative to its motion.
//!
//! Legend: x, v, a position, velocity and acceleration; R, ω rotation and angular velocity; F the observer's frame:
//!
//! ```text
//! x' = R_Fᵀ (x - x_F)    v' = R_Fᵀ (v - v_F(x))    a' = R_Fᵀ (a - a_F(x) - 2 ω_F × (v - v_F(x)))
//! ```
//!
//! where v_F(x) and a_F(x) are those of the point of F that is at x.

use lissom_core::kinematics::{Kinematics, NodeId};
use lissom_motion::{Motion, Vector3};

use crate::document::OutputKind;

/// A frame carried by a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Observer {
    /// The node.
    pub(crate) node: NodeId,
    /// The frame in the node's.
    pub(crate) offset: Motion,
}

impl Observer {
    /// Where it is.
    pub(crate) fn frame(&self, at: &Kinematics) -> Motion {
        at.nodes[self.node].frame * self.offset
    }

    /// Velocity and acceleration of its point at `place`, and its angular velocity, in global axes.
    fn carried(&self, place: &Vector3, at: &Kinematics) -> (Vector3, Vector3, Vector3) {
        let node = &at.nodes[self.node];
        let offset = node.frame.inverse_transform_point(place);
        (node.velocity_at(&offset), node.acceleration_at(&offset), node.angular_velocity())
    }
}

/// Motion of a point and of the frame that carries it, in global axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) frame: Motion,
    pub(crate) velocity: Vector3,
    pub(crate) angular_velocity: Vector3,
    pub(crate) acceleration: Vector3,
}

impl Seen {
    /// The quantity `kind` relative to `observer`, in its axes; `start` is the point's frame in the observer's at the start.
    pub(crate) fn relative_to(
        &self,
        observer: &Observer,
        (kind, start): (OutputKind, &Motion),
        at: &Kinematics,
    ) -> Vector3 {
        let own = observer.frame(at);
        let relative = self.frame.relative_to(&own);
        let (velocity, acceleration, angular) = observer.carried(&self.frame.position, at);
        let slip = self.velocity - velocity;
        let in_global = match kind {
            OutputKind::Position => return relative.position,
            OutputKind::Displacement => return relative.position - start.position,
            OutputKind::Rotation => return (relative.rotation * start.rotation.inverse()).logarithm(),
            OutputKind::Velocity => slip,
            OutputKind::AngularVelocity => self.angular_velocity - angular,
            _ => self.acceleration - acceleration - 2.0 * angular.cross(&slip),
        };
        own.rotation.apply_inverse(&in_global)
    }
}
