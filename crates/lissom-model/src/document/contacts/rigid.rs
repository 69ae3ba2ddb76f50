//! Rigid contacts, which have no stiffness.

use lissom_contact::rigid::RigidLaw;

use super::entry::{ContactLaw, Touching};
use super::law;
use super::parts::Parts;
use crate::format::keys::{Key, Shape, optional, unitless};
use crate::reading::reader::Reader;

pub(super) fn keys() -> Vec<Key> {
    vec![
        law::other_parts(),
        law::exceptions(),
        law::is_rigid(),
        unitless("restitution", Shape::Between(0.0, 1.0), "velocity after an impact over that before")
            .or_number(0.0),
        optional("rest_velocity", Shape::Positive, "m/s", "slower impacts do not rebound").or_number(1e-3),
        law::coefficient(),
    ]
}

pub(super) fn read(reader: &Reader<'_, '_>, parts: &Parts<'_>) -> Option<Touching> {
    let (between, others) = parts.read(reader)?;
    law::check_rigid(reader, true)?;
    let law = RigidLaw {
        restitution: reader.number("restitution")?.value,
        friction: reader.number("friction")?.value,
        rest_velocity: reader.number("rest_velocity")?.value,
    };
    Some((between, others, ContactLaw::Rigid(law)))
}
