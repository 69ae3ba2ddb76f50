//! Gap and force of a contact between two parts.

use std::sync::Arc;

use super::frames::name_of;
use super::touched::Touched;
use super::{Build, Evaluation, Found, OutputQuantity, Subjects, WHOLE_MODEL};
use crate::outputs::contact_point::{ContactPoint, PointsOfSet, RigidPoint};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Subject};
use crate::text::report::Problem;
use lissom_contact::reading::ContactReading;
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

/// The points of a contact, however it is solved.
pub(super) trait Points: Send + Sync {
    /// Passes what each of them reports.
    fn visit(&self, at: &Evaluation<'_>, visit: &mut dyn FnMut(ContactReading));

    /// The unknowns on which that depends.
    fn touched(&self, system: &System) -> Touched;
}

impl Points for Vec<ContactPoint> {
    fn visit(&self, at: &Evaluation<'_>, visit: &mut dyn FnMut(ContactReading)) {
        for point in self {
            visit(point.contact.reading(at.motion()).with_sign(point.sign));
        }
    }

    fn touched(&self, _: &System) -> Touched {
        let mut touched = Touched::default();
        for ContactPoint { contact, .. } in self {
            let Unknowns { nodes, coordinates, .. } = contact.unknowns();
            touched.nodes.extend(nodes);
            touched.coordinates.extend(coordinates);
        }
        touched
    }
}

impl Points for Vec<RigidPoint> {
    fn visit(&self, at: &Evaluation<'_>, visit: &mut dyn FnMut(ContactReading)) {
        for point in self {
            visit(point.contact.reading(at.motion(), &at.state.multipliers).with_sign(point.sign));
        }
    }

    fn touched(&self, _: &System) -> Touched {
        let mut touched = Touched::default();
        touched.nodes.extend(self.iter().flat_map(|point| *point.contact.nodes()));
        touched
    }
}

impl Points for PointsOfSet {
    /// Without touches the smallest gap.
    fn visit(&self, at: &Evaluation<'_>, visit: &mut dyn FnMut(ContactReading)) {
        let mut own = at.state.touches.iter().filter(|touch| touch.key.rule as usize == self.rule).peekable();
        if own.peek().is_none() {
            visit(ContactReading::apart(self.gap.at(at.system.contacts(), at.motion())));
        }
        for touch in own {
            visit(touch.reading());
        }
    }

    fn touched(&self, system: &System) -> Touched {
        let contacts = system.contacts();
        let mut touched = Touched::default();
        touched.nodes.extend(contacts.rules[self.rule].parts.iter().map(|&part| contacts.parts[part].node));
        touched
    }
}

/// The sum over all points of a contact.
struct ContactForce<P>(P);

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    if let Some(points) = subjects.names.contacts.rigid.get(&name.value) {
        return Ok(Arc::new(ContactForce(points.clone())));
    }
    if let Some(rule) = system.contacts().rules.iter().position(|rule| rule.name == name.value) {
        return Ok(Arc::new(ContactForce(PointsOfSet::new(system, rule))));
    }
    let points = subjects.names.contacts.compliant.get(&name.value);
    let points =
        points.ok_or_else(|| Problem::error(name.span, format!("there is no contact `{}`", name.value)))?;
    Ok(Arc::new(ContactForce(points.clone())))
}

impl<P: Points> OutputQuantity for ContactForce<P> {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (mut gap, mut normal, mut force, mut friction) =
            (f64::INFINITY, 0.0, Vector3::zeros(), Vector3::zeros());
        let (mut largest, mut slip) = (0.0, 0.0);
        let (mut touching, mut sliding) = (0.0, 0.0);
        // Without contact the point with the smallest gap.
        let (mut center, mut nearest) = (Vector3::zeros(), Vector3::zeros());
        self.0.visit(at, &mut |found| {
            if found.gap < gap {
                (gap, nearest) = (found.gap, found.point);
            }
            touching += f64::from(u8::from(found.is_touching));
            sliding += f64::from(u8::from(found.is_sliding));
            center += found.normal * found.point;
            normal += found.normal;
            force += found.force;
            friction += found.friction;
            if found.normal > largest {
                (largest, slip) = (found.normal, found.slip);
            }
        });
        let center = if normal > 0.0 { center / normal } else { nearest };
        out.extend([gap, normal, friction.norm(), force.x, force.y, force.z, slip, touching, sliding]);
        out.extend(center.iter());
    }

    fn touched(&self, system: &System) -> Option<Touched> {
        Some(self.0.touched(system))
    }
}
