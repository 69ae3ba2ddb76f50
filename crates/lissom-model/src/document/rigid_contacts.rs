//! Rigid contacts, which have no stiffness.

use lissom_mechanics::joints::rigid_contact::RigidLaw;

use super::contacts::number_or;
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
    for key in ["restitution", "friction", "rest_velocity"] {
        if reader.has(key) {
            reader.number(key)?;
        }
    }
    Some(RigidLaw {
        restitution: number_or(reader, "restitution", 0.0),
        friction: number_or(reader, "friction", 0.0),
        rest_velocity: number_or(reader, "rest_velocity", 1e-3),
    })
}
