//! Contacts along beams: their keys, and what these say of the law of contact.

use lissom_contact::elastic::ContactFriction;
use lissom_mechanics::compliance::Compliance;

use super::NodeReference;
use super::contacts::{check_law, friction};
use crate::format::keys::{Key, Shape, optional};
use crate::reading::reader::Reader;
use crate::text::Value;
use crate::text::report::Located;

/// Where a beam touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touching {
    /// Along its length, in points that are fixed to it: force per length at a penetration of 1 m [N/mⁿ⁺¹], and intervals between
    /// points in an element.
    Along(f64, usize),
    /// Where it is nearest: force at a penetration of 1 m [N/mⁿ].
    Nearest(f64),
}

/// A contact of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamContactEntry {
    /// The tip.
    pub beam: Located<String>,
    /// The base, if it is a beam.
    pub base: Option<Located<String>>,
    /// Radii of base and tip, if given [m].
    pub radii: [Option<f64>; 2],
    /// Where they touch.
    pub touching: Touching,
    /// Exponent n of the penetration.
    pub exponent: f64,
    /// Relative increase of the normal force per penetration velocity [s/m].
    pub dissipation: f64,
    /// Its friction, whose bristles are added with its points.
    pub friction: Option<ContactFriction>,
}

/// Keys that only beams have.
pub(super) const OF_BEAMS: [&str; 4] = ["radius", "base_radius", "stiffness_per_length", "points"];

/// Keys that beams do not have, with remedies.
pub(super) const NOT_OF_BEAMS: [(&str, &str); 8] = [
    ("material", "give `stiffness` or `stiffness_per_length` instead"),
    ("tip_material", "give `stiffness` or `stiffness_per_length` instead"),
    ("restitution", "give `dissipation` instead: waves in the beam determine how it rebounds"),
    ("rest_velocity", "remove it, and give `dissipation`"),
    ("restitution_law", "remove it, and give `dissipation`"),
    ("rigid", "give `stiffness` or `stiffness_per_length` instead"),
    ("rolling_friction", "remove it"),
    ("torsional_friction", "remove it"),
];

/// Further keys of a contact.
pub(super) fn keys() -> [Key; 4] {
    [
        optional(
            "radius",
            Shape::Positive,
            "m",
            "of a beam as tip: its radius where it touches; default that of its sections, if they are round and equal",
        ),
        optional("base_radius", Shape::Positive, "m", "the same of a beam as base"),
        optional(
            "stiffness_per_length",
            Shape::Positive,
            "N/m^(n+1)",
            "of a beam as tip, instead of `stiffness`: it touches along its length, with this normal force per length at a penetration of 1 m",
        ),
        optional(
            "points",
            Shape::Count(1, 64),
            "",
            "with `stiffness_per_length`: number of intervals between points of contact in an element",
        )
        .or_count(2),
    ]
}

/// The beam that a key names, if it does.
pub(super) fn beam_of(reader: &Reader<'_, '_>, key: &str) -> Option<Located<String>> {
    let node = reader.node(key)?;
    let Value::Text(text) = &node.value else { return None };
    let name = reader.context.entry_named("beams", text, node, &reader.words(key))?;
    reader.context.has("beams", &name).then(|| Located::new(name, node.span))
}

/// Base, a beam or a solid, and tip of a contact of a beam, and what it says of them.
pub(super) fn entry(
    reader: &Reader<'_, '_>,
    (base, beam): (Option<Located<String>>, Located<String>),
    is_solid: &dyn Fn(&Located<NodeReference>) -> Option<()>,
) -> Option<([Located<NodeReference>; 2], BeamContactEntry)> {
    let context = reader.context;
    let start = |beam: &Located<String>| {
        let node = NodeReference::Beam { beam: beam.value.clone(), fraction: 0.0 };
        Located::new(node, beam.span)
    };
    let other = match &base {
        Some(base) if base.value == beam.value => {
            let message = format!("{} names one beam twice", reader.what);
            return context.fail(beam.span, message, "make two beams of it that share a node");
        }
        Some(base) => start(base),
        None => {
            let part = context.node(reader.node("base")?, &reader.words("base"))?;
            is_solid(&part)?;
            part
        }
    };
    let given = |key: &str| reader.node(key).map(|node| node.span);
    let friction = friction(reader);
    let touching = match (given("stiffness"), given("stiffness_per_length")) {
        (Some(_), None) => {
            if let Some(span) = given("points") {
                let message = format!("`points` of {} is without `stiffness_per_length`", reader.what);
                return context.fail(span, message, "with `stiffness` a beam touches where it is nearest");
            }
            Touching::Nearest(reader.number("stiffness")?.value)
        }
        (None, Some(_)) => {
            Touching::Along(reader.number("stiffness_per_length")?.value, reader.count("points")?.value)
        }
        (Some(span), Some(_)) => {
            let message = format!("{} has both `stiffness` and `stiffness_per_length`", reader.what);
            return context.fail(span, message, "remove one of them");
        }
        (None, None) => {
            let message = format!("{} has neither `stiffness` nor `stiffness_per_length`", reader.what);
            let help = "add `stiffness_per_length` for contact along the beam, or `stiffness` for contact where it is nearest";
            return context.fail(reader.name, message, help);
        }
    };
    let is_along_part = base.is_none() && matches!(touching, Touching::Along(..));
    if let Some(span) =
        given("friction").or(given("static_friction")).filter(|_| friction.is_some() && !is_along_part)
    {
        let message = format!("friction of {} is not available", reader.what);
        let help = "beams have friction with a body or the ground, with `stiffness_per_length`";
        return context.fail(span, message, help);
    }
    if let Some(span) = given("base_radius").filter(|_| base.is_none()) {
        let message = format!("`base_radius` of {} is for a beam as base", reader.what);
        return context.fail(span, message, "remove it: the base touches with its shape");
    }
    let radius = |key: &str| reader.number(key).map(|number| number.value);
    let entry = BeamContactEntry {
        radii: [radius("base_radius"), radius("radius")],
        touching,
        exponent: reader.number("exponent")?.value,
        dissipation: if reader.has("dissipation") { reader.number("dissipation")?.value } else { 0.0 },
        friction,
        beam,
        base,
    };
    let (Touching::Along(stiffness, _) | Touching::Nearest(stiffness)) = touching;
    let law = Compliance { stiffness, exponent: entry.exponent };
    check_law(reader, (Some(law), entry.friction.as_ref()))?;
    Some(([other, start(&entry.beam)], entry))
}
