//! Gap and force of a contact between two parts.

use std::sync::Arc;

use super::contact_set_force::ContactSetForce;
use super::frames::name_of;
use super::rigid_contact_force::RigidContactForce;
use super::touched::Touched;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects, WHOLE_MODEL};
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Subject};
use crate::text::report::Problem;
use lissom_mechanics::elements::Unknowns;
use lissom_motion::Vector3;
use lissom_system::System;

/// Registry entry.
pub(crate) const CONTACT_FORCE: Declaration = Declaration {
    word: "contact_force",
    summary: "Smallest gap of a contact, sum of its normal forces, magnitude of its friction, force on the tip in global axes, \
              sliding velocity, numbers of points that touch and of those that slide, and the centre of the normal forces in global \
              axes.",
    subject: Subject::Contact,
    features: &[],
    components: &[
        ("gap", "m"),
        ("normal", "N"),
        ("friction", "N"),
        ("f1", "N"),
        ("f2", "N"),
        ("f3", "N"),
        ("slip", "m/s"),
        ("points", ""),
        ("sliding", ""),
        ("x1", "m"),
        ("x2", "m"),
        ("x3", "m"),
    ],
    build: Build::System(WHOLE_MODEL, quantity),
};

/// All points of a contact.
struct ContactForce(Vec<ContactPoint>);

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    if let Some(points) = subjects.names.contacts.rigid.get(&name.value) {
        return Ok(Arc::new(RigidContactForce(points.clone())));
    }
    if let Some(rule) = system.contacts().rules.iter().position(|rule| rule.name == name.value) {
        return Ok(Arc::new(ContactSetForce::new(system, rule)));
    }
    let points = subjects.names.contacts.compliant.get(&name.value);
    let points =
        points.ok_or_else(|| Problem::error(name.span, format!("there is no contact `{}`", name.value)))?;
    Ok(Arc::new(ContactForce(points.clone())))
}

impl OutputQuantity for ContactForce {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut gap, mut normal, mut force, mut friction) =
            (f64::INFINITY, 0.0, Vector3::zeros(), Vector3::zeros());
        let (mut largest, mut slip) = (0.0, 0.0);
        let (mut touching, mut sliding) = (0.0, 0.0);
        // Without contact the point with the smallest gap.
        let (mut center, mut nearest) = (Vector3::zeros(), Vector3::zeros());
        for point in &self.0 {
            let found = point.contact.forces_at(at.motion());
            if found.gap < gap {
                (gap, nearest) = (found.gap, found.point);
            }
            touching += f64::from(u8::from(found.is_touching));
            sliding += f64::from(u8::from(found.is_sliding));
            center += found.normal * found.point;
            normal += found.normal;
            force += point.sign * found.force;
            friction += point.sign * found.friction;
            if found.normal > largest {
                (largest, slip) = (found.normal, found.slip);
            }
        }
        let center = if normal > 0.0 { center / normal } else { nearest };
        out.extend([gap, normal, friction.norm(), force.x, force.y, force.z, slip, touching, sliding]);
        out.extend(center.iter());
    }

    fn touched(&self, _: &System) -> Option<Touched> {
        let mut touched = Touched::default();
        for ContactPoint { contact, .. } in &self.0 {
            let Unknowns { nodes, coordinates, .. } = contact.unknowns();
            touched.nodes.extend(nodes);
            touched.coordinates.extend(coordinates);
        }
        Some(touched)
    }
}
