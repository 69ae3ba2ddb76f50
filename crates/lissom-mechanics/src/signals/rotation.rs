//! A component of the rotation vector of a node since the start, or of its angular velocity, in global axes.
//!
//! Legend: R rotation of the node, R₀ at the start, r = log(R R₀ᵀ), T tangent operator, w angular velocity, n the axis.
//!
//! ```text
//! n·r:      by place  nᵀ T(r)⁻¹ R₀ δθ
//! n·R w:    by twist  nᵀR δw,      by place  -nᵀR w~ δθ
//! ```

use lissom_motion::{Rotation, Vector3, inverse_tangent_times, rotation_part, screw};

use super::measurement::{Gradient, Measurement};
use crate::kinematics::{Kinematics, NodeId};

/// Measured quantity of a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Of {
    /// Rotation vector since this rotation [rad].
    RotationFrom(Rotation),
    /// Angular velocity [rad/s].
    AngularVelocity,
}

/// A component of a node's rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    node: [NodeId; 1],
    /// Unit vector of the component, in global axes.
    axis: Vector3,
    of: Of,
}

impl Turn {
    /// The component along `axis`, a unit vector in global axes, of the rotation of `node`.
    pub fn new(node: NodeId, axis: Vector3, of: Of) -> Self {
        Self { node: [node], axis, of }
    }
}

impl Measurement for Turn {
    fn nodes(&self) -> &[NodeId] {
        &self.node
    }

    fn value(&self, at: &Kinematics) -> f64 {
        let node = &at.nodes[self.node[0]];
        match self.of {
            Of::RotationFrom(start) => self.axis.dot(&(node.frame.rotation * start.inverse()).logarithm()),
            Of::AngularVelocity => self.axis.dot(&node.angular_velocity()),
        }
    }

    fn gradient(&self, at: &Kinematics) -> Gradient {
        let node = &at.nodes[self.node[0]];
        let mut gradient = Gradient::zero();
        match self.of {
            Of::RotationFrom(start) => {
                let turned = (node.frame.rotation * start.inverse()).logarithm();
                let zero = Vector3::zeros();
                for k in 0..3 {
                    let column = start.apply(&Vector3::ith(k, 1.0));
                    let change = inverse_tangent_times(&screw(&zero, &turned), &screw(&zero, &column));
                    gradient.by_place[3 + k] = self.axis.dot(&rotation_part(&change));
                }
            }
            Of::AngularVelocity => {
                let axis = node.frame.rotation.apply_inverse(&self.axis);
                let turned = rotation_part(&node.twist).cross(&axis);
                for k in 0..3 {
                    gradient.by_rate[3 + k] = axis[k];
                    gradient.by_place[3 + k] = turned[k];
                }
            }
        }
        gradient
    }
}
