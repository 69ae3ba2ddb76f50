//! Gap and force of a contact whose touches have no elements.

use super::touched::Touched;
use super::{Evaluation, OutputQuantity};
use lissom_contact::set::SmallestGap;
use lissom_motion::Vector3;
use lissom_system::System;

/// All touches of a contact.
pub(super) struct ContactSetForce {
    rule: usize,
    gap: SmallestGap,
}

impl ContactSetForce {
    /// Of the contact of this index.
    pub(super) fn new(system: &System, rule: usize) -> Self {
        Self { rule, gap: SmallestGap::new(system.contacts(), rule) }
    }
}

impl OutputQuantity for ContactSetForce {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut normal, mut force, mut friction, mut center) =
            (0.0, Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let (mut gap, mut largest, mut slip) = (f64::INFINITY, 0.0, 0.0);
        let (mut touching, mut sliding) = (0.0, 0.0);
        let touches = &at.state.touches;
        for touch in touches.iter().filter(|touch| touch.key.rule as usize == self.rule) {
            gap = gap.min(touch.gap);
            touching += 1.0;
            sliding += f64::from(u8::from(touch.is_sliding));
            normal += touch.normal;
            force += touch.force();
            friction += touch.friction();
            center += touch.normal * touch.point();
            if touch.normal > largest {
                (largest, slip) = (touch.normal, touch.slip);
            }
        }
        if touching == 0.0 {
            gap = self.gap.at(at.system.contacts(), at.motion());
        }
        let center = if normal > 0.0 { center / normal } else { center };
        out.extend([gap, normal, friction.norm(), force.x, force.y, force.z, slip, touching, sliding]);
        out.extend(center.iter());
    }

    fn touched(&self, system: &System) -> Option<Touched> {
        let contacts = system.contacts();
        let mut touched = Touched::default();
        touched.nodes.extend(contacts.rules[self.rule].parts.iter().map(|&part| contacts.parts[part].node));
        Some(touched)
    }
}
