//! A component of the position, displacement or velocity of a point fixed to a node, in global axes.
//!
//! Legend: x position of the node, R its rotation, o the point in the node's axes, v and w twist, n the axis.
//!
//! ```text
//! n·(x + R o - x₀):      by place  nᵀR (δu - õ δθ)
//! n·R (v + w×o):         by twist  nᵀR (δv - õ δw),      by place  -nᵀR (v + w×o)~ δθ
//! ```

use lissom_motion::Vector3;

use super::measurement::{Gradient, Measurement};
use crate::kinematics::{Kinematics, NodeId};

/// Measured quantity of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Of {
    /// Its position minus this one [m].
    PositionFrom(Vector3),
    /// Its velocity [m/s].
    Velocity,
}

/// A component of a point's motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    node: [NodeId; 1],
    /// In the node's axes [m].
    offset: Vector3,
    /// Unit vector of the component, in global axes.
    axis: Vector3,
    of: Of,
}

impl Point {
    /// The component along `axis`, a unit vector in global axes, of a point at `offset` [m] in the axes of `node`.
    pub fn new(node: NodeId, offset: Vector3, axis: Vector3, of: Of) -> Self {
        Self { node: [node], offset, axis, of }
    }
}

impl Measurement for Point {
    fn nodes(&self) -> &[NodeId] {
        &self.node
    }

    fn value(&self, at: &Kinematics) -> f64 {
        let node = &at.nodes[self.node[0]];
        match self.of {
            Of::PositionFrom(start) => self.axis.dot(&(node.frame.transform_point(&self.offset) - start)),
            Of::Velocity => self.axis.dot(&node.velocity_at(&self.offset)),
        }
    }

    fn gradient(&self, at: &Kinematics) -> Gradient {
        let node = &at.nodes[self.node[0]];
        // nᵀR as a vector in the node's axes: nᵀR ã b = (a × b)·n in the node's axes.
        let axis = node.frame.rotation.apply_inverse(&self.axis);
        let turned = self.offset.cross(&axis);
        let mut gradient = Gradient::zero();
        let by_point = match self.of {
            Of::PositionFrom(_) => &mut gradient.by_place,
            Of::Velocity => &mut gradient.by_rate,
        };
        for k in 0..3 {
            by_point[k] = axis[k];
            by_point[3 + k] = turned[k];
        }
        if self.of == Of::Velocity {
            let (velocity, spin) = crate::kinematics::split(&node.twist);
            let turned = (velocity + spin.cross(&self.offset)).cross(&axis);
            for k in 0..3 {
                gradient.by_place[3 + k] = turned[k];
            }
        }
        gradient
    }
}
