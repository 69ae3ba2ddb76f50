//! Gap and force of a rigid contact between two parts.

use lissom_contact::rigid::Mode;
use lissom_mechanics::kinematics::NodeId;
use lissom_motion::Vector3;
use lissom_system::System;

use super::touched::Touched;
use super::{Evaluation, OutputQuantity};
use crate::outputs::contact_point::RigidPoint;

/// All points of a rigid contact.
pub(super) struct RigidContactForce(pub(super) Vec<RigidPoint>);

impl OutputQuantity for RigidContactForce {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut gap, mut normal, mut force, mut friction) =
            (f64::INFINITY, 0.0, Vector3::zeros(), Vector3::zeros());
        let (mut largest, mut slip) = (0.0, 0.0);
        let (mut count, mut sliding) = (0.0, 0.0);
        // Without contact the point with the smallest gap.
        let (mut center, mut nearest) = (Vector3::zeros(), Vector3::zeros());
        for RigidPoint { contact, sign } in &self.0 {
            let touching = contact.touching(at.motion());
            let (own, tangential) = contact.forces(at.motion(), &at.state.multipliers);
            let point = contact.point_in_space(at.motion(), &touching.gap.point);
            if touching.gap.value < gap {
                (gap, nearest) = (touching.gap.value, point);
            }
            let mode = contact.mode(at.motion());
            count += f64::from(u8::from(mode != Mode::Open));
            sliding += f64::from(u8::from(mode == Mode::Sliding));
            center += own * point;
            normal += own;
            let global = |vector: &Vector3| *sign * contact.to_global(at.motion(), vector);
            force += global(&(own * touching.gap.normal + tangential));
            friction += global(&tangential);
            if own > largest {
                (largest, slip) = (own, touching.sliding().norm());
            }
        }
        let center = if normal > 0.0 { center / normal } else { nearest };
        out.extend([gap, normal, friction.norm(), force.x, force.y, force.z, slip, count, sliding]);
        out.extend(center.iter());
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        let nodes: Vec<NodeId> = self.0.iter().flat_map(|point| *point.contact.nodes()).collect();
        touched.nodes.extend(nodes);
        Some(touched)
    }
}
