//! Gap and force of a rigid contact between two parts.

use lissom_core::kinematics::NodeId;
use lissom_core::system::System;
use lissom_motion::Vector3;

use super::differences::Touched;
use super::{Evaluation, OutputQuantity};
use crate::contact_point::RigidPoint;

/// All points of a rigid contact.
pub(super) struct RigidContactForce(pub(super) Vec<RigidPoint>);

impl OutputQuantity for RigidContactForce {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut gap, mut normal, mut force, mut friction) =
            (f64::INFINITY, 0.0, Vector3::zeros(), Vector3::zeros());
        let (mut largest, mut slip) = (0.0, 0.0);
        for RigidPoint { contact, sign } in &self.0 {
            let touching = contact.touching(at.motion());
            let (own, tangential) = contact.forces(at.motion(), &at.state.multipliers);
            gap = gap.min(touching.gap.value);
            normal += own;
            let global = |vector: &Vector3| *sign * contact.to_global(at.motion(), vector);
            force += global(&(own * touching.gap.normal + tangential));
            friction += global(&tangential);
            if own > largest {
                (largest, slip) = (own, touching.sliding().norm());
            }
        }
        out.extend([gap, normal, friction.norm(), force.x, force.y, force.z, slip]);
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        let nodes: Vec<NodeId> = self.0.iter().flat_map(|point| *point.contact.nodes()).collect();
        touched.nodes.extend(nodes);
        Some(touched)
    }
}
