//! Position of the contact between a wheel and its rail, and its forces.

use std::sync::Arc;

use lissom_system::OutputDerivatives;
use lissom_system::System;

use super::derivatives::of_local;
use super::frames::name_of;
use super::reaction::multipliers;
use super::{Build, Evaluation, Found, OutputQuantity, SOLUTION, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const CONTACT: Declaration = Declaration {
    word: "contact",
    summary: "Contact position of a wheel on a rail, with normal force, creep forces and creepages.",
    subject: Subject::Joint,
    features: &[Feature::Accelerations],
    components: &[
        ("wheel", "m"),
        ("rail", "m"),
        ("shift", "rad"),
        ("normal", "N"),
        ("along", "N"),
        ("across", "N"),
        ("creepage1", ""),
        ("creepage2", ""),
        ("spin", "1/m"),
    ],
    build: Build::System(SOLUTION, quantity),
};
/// Contact of a joint, by index.
struct OfJoint(usize);

fn quantity(output: &Output, system: &System, _: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let Some(index) = system.joints().iter().position(|joint| joint.name == name.value) else {
        let message = format!("`{}` stands between no two nodes", name.value);
        return Err(Problem::error(name.span, message).help("name the joint that it acts on"));
    };
    if system.joints()[index].joint().rail_contact().is_none() {
        let message = format!("`{}` is no wheel on a rail", name.value);
        return Err(Problem::error(name.span, message).help("name a joint of kind `wheel_on_rail`"));
    }
    Ok(Arc::new(OfJoint(index)))
}

impl OutputQuantity for OfJoint {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let joint = &at.system.joints()[self.0];
        let Some(contact) = joint.rail_contact(at.motion(), &multipliers(joint, at.state)) else { return };
        out.extend([contact.on_wheel, contact.on_rail, contact.shift_angle, contact.normal_force]);
        out.extend(contact.forces.iter().chain(&contact.creepages));
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let joint = &at.system.joints()[self.0];
        let found = joint.rail_contact_derivatives(at.motion(), &multipliers(joint, at.state))?;
        Some(of_local(&found, joint.first_multiplier, at.system))
    }
}
