//! Rigid contacts, which have no stiffness.

use lissom_contact::rigid::RigidLaw;

use crate::reading::reader::Reader;

/// Keys that describe a deformation.
pub(super) const OF_DEFORMATION: [&str; 11] = [
    "stiffness",
    "exponent",
    "material",
    "tip_material",
    "dissipation",
    "static_friction",
    "stribeck",
    "deflection",
    "restitution_law",
    "rolling_friction",
    "torsional_friction",
];

/// The law of a rigid contact.
pub(super) fn law(reader: &Reader<'_, '_>) -> Option<RigidLaw> {
    Some(RigidLaw {
        restitution: if reader.has("restitution") { reader.number("restitution")?.value } else { 0.0 },
        friction: reader.number("friction")?.value,
        rest_velocity: reader.number("rest_velocity")?.value,
    })
}
