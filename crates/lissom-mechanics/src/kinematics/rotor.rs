//! Nodes that are symmetric about an axis, with all that is attached to them: their motion does not depend on how far they have turned
//! about it.

use lissom_motion::{
    Matrix6, Rotation, Vector3, Vector6, lie_bracket_matrix, rotation_part, screw, skew, translation_part,
};

use super::NodeId;
use crate::round_off::COINCIDENT;

/// A node that is symmetric about an axis.
#[derive(Clone, Debug)]
pub struct Rotor {
    /// The node.
    pub node: NodeId,
    /// Direction of the axis, in the node's axes.
    pub axis: Vector3,
    /// Rotation of the node from which the angle about the axis counts.
    pub first: Rotation,
    /// Equations in axes that turn with the node.
    pub triples: Vec<Triple>,
}

/// Three equations of a joint that are components in axes of the node.
#[derive(Clone, Debug)]
pub struct Triple {
    /// First of their multipliers.
    pub first_multiplier: usize,
    /// Direction of the rotor's axis in these axes.
    pub axis: Vector3,
}

/// Whether a vector is along a unit vector or opposed to it, or zero.
pub fn is_along(vector: &Vector3, axis: &Vector3) -> bool {
    vector.cross(axis).norm() <= COINCIDENT * vector.norm()
}

/// Cross products of a vector with both parts of a twist or wrench.
pub fn across(vector: &Vector3, twist: &Vector6) -> Vector6 {
    screw(&vector.cross(&translation_part(twist)), &vector.cross(&rotation_part(twist)))
}

impl Rotor {
    /// Angle about the axis of a node with this rotation: of its twist, which precedes the swing of the axis [rad].
    pub fn angle(&self, rotation: &Rotation) -> f64 {
        let [w, x, y, z] = (self.first.inverse() * *rotation).quaternion();
        2.0 * Vector3::new(x, y, z).dot(&self.axis).atan2(w)
    }

    /// A motion or wrench in axes that are turned by `angle` [rad] about the axis.
    pub fn turned(&self, angle: f64, vector: &Vector6) -> Vector6 {
        let rotation = Rotation::about_axis(&self.axis, angle);
        screw(&rotation.apply(&translation_part(vector)), &rotation.apply(&rotation_part(vector)))
    }

    /// Angular velocity about the axis [rad/s], and the rest of a twist.
    pub fn parts(&self, twist: &Vector6) -> (Vector3, Vector6) {
        let spin = self.axis.dot(&rotation_part(twist)) * self.axis;
        (spin, twist - screw(&Vector3::zeros(), &spin))
    }

    /// Squared angular velocity of a node with this twist without that about the axis [rad²/s²].
    pub fn swing(&self, twist: &Vector6) -> f64 {
        rotation_part(&self.parts(twist).1).norm_squared()
    }
}

/// The drift of the axes of a rotor that do not spin, in derivatives of its motion.
///
/// Legend: δz, δz', δz'' variations of the increments and their derivatives, turned into the axes of the rotor; W its spin about the axis; V_S
/// twist of the drift in axes of the rotor, ad = ad_{V_S}.
///
/// ```text
/// δV = δz' + A δz,     A = ad,          δV̇ = δz'' + B δz' + C δz,     B = ad - W×,     C = -W× ad
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AxisSpin {
    /// The node.
    pub node: NodeId,
    /// W [rad/s].
    pub spin: Vector3,
    /// V_S.
    pub drift: Vector6,
}

impl AxisSpin {
    /// A, B and C.
    pub fn matrices(&self) -> [Matrix6; 3] {
        let of_axes = skew(&self.spin);
        let mut turning = Matrix6::zeros();
        turning.fixed_view_mut::<3, 3>(0, 0).copy_from(&of_axes);
        turning.fixed_view_mut::<3, 3>(3, 3).copy_from(&of_axes);
        let drift = lie_bracket_matrix(&self.drift);
        [drift, drift - turning, -turning * drift]
    }
}
