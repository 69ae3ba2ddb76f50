//! Rigid contacts, which have no stiffness.

use super::NodeReference;
use super::contacts::{ContactEntry, Restitution, number_or};
use crate::reading::reader::Reader;
use crate::text::report::Located;

/// Keys that describe a deformation.
const OF_DEFORMATION: [&str; 11] = [
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

/// Law of a rigid contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidEntry {
    /// Normal velocity after an impact over that before.
    pub restitution: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Slower impacts do not rebound [m/s].
    pub rest_velocity: f64,
}

/// The law if the contact is rigid; the outer none stands for an error.
#[allow(clippy::option_option)]
pub(super) fn rigid(reader: &Reader<'_, '_>) -> Option<Option<RigidEntry>> {
    let is_rigid = match reader.node("rigid") {
        Some(_) => reader.flag("rigid")?.value,
        None => false,
    };
    if !is_rigid {
        return Some(None);
    }
    if let Some((key, node)) = OF_DEFORMATION.into_iter().find_map(|key| Some((key, reader.node(key)?))) {
        let message = format!("{} is rigid and has `{key}`", reader.what);
        return reader.context.fail(node.span, message, "remove one of them");
    }
    for key in ["restitution", "friction", "rest_velocity"] {
        if reader.has(key) {
            reader.number(key)?;
        }
    }
    Some(Some(RigidEntry {
        restitution: number_or(reader, "restitution", 0.0),
        friction: number_or(reader, "friction", 0.0),
        rest_velocity: number_or(reader, "rest_velocity", 1e-3),
    }))
}

/// The entry of a rigid contact.
pub(super) fn entry(
    name: &str,
    reader: &Reader<'_, '_>,
    between: [Located<NodeReference>; 2],
    rigid: RigidEntry,
) -> ContactEntry {
    ContactEntry {
        name: Located::new(name.to_owned(), reader.name),
        between,
        others: Vec::new(),
        beams: None,
        stiffness: Ok(0.0),
        exponent: 1.0,
        restitution: Restitution::Dissipation(0.0),
        friction: None,
        stribeck: 0.0,
        deflection: 0.0,
        resistance: [0.0; 2],
        rigid: Some(rigid),
    }
}
