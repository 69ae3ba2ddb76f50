//! Contacts of bodies by a force over the penetration of their shapes.

use lissom_contact::elastic::ContactFriction;
use lissom_contact::law::Impact;
use lissom_mechanics::compliance::{Compliance, MIN_RESTITUTION, relative_dissipation};

use lissom_motion::Vector3;

use super::entry::{ContactLaw, Touching};
use super::law;
use super::parts::Parts;
use crate::format::keys::{Key, Shape, optional, unitless};
use crate::reading::reader::Reader;
use crate::text::report::Located;

/// A contact of solids by a force over the penetration.
#[derive(Clone, Debug, PartialEq)]
pub struct CompliantLaw {
    /// Normal force, or the materials of both parts, from which it follows.
    pub compliance: Result<Compliance, [Located<String>; 2]>,
    /// What an impact dissipates.
    pub impact: Impact,
    /// Friction of the contact, whose bristles are added with its points.
    pub friction: Option<ContactFriction>,
    /// Moments against rolling and spinning per normal force [m].
    pub resistance: [f64; 2],
    /// Velocity of the base's surface along itself, in the axes of the base [m/s].
    pub surface_velocity: Option<Vector3>,
}

pub(super) fn keys() -> Vec<Key> {
    let mut keys = vec![
        law::other_parts(),
        law::exceptions(),
        law::is_rigid(),
        optional("stiffness", Shape::Positive, "N/m^n", "normal force at a penetration of 1 m"),
        law::exponent(),
        unitless(
            "material",
            Shape::Name("materials"),
            "instead of `stiffness` and `exponent`: the material of both parts, for balls on balls or planes by the theory of Hertz",
        ),
        unitless("tip_material", Shape::Name("materials"), "material of the tip, if it is another one"),
        unitless(
            "restitution",
            Shape::Between(0.0, 1.0),
            "velocity after an impact over that before, at any impact velocity: from 0.01 to 1, and 1 if it is omitted",
        ),
        optional(
            "rest_velocity",
            Shape::Positive,
            "m/s",
            "slower impacts dissipate as those of this velocity; requires `restitution`",
        )
        .or_number(1e-3),
        optional(
            "dissipation",
            Shape::NotNegative,
            "s/m",
            "instead of `restitution`: relative increase of the normal force per penetration velocity",
        ),
    ];
    keys.extend(law::friction_keys());
    keys.push(optional(
        "surface_velocity",
        Shape::Vector,
        "m/s",
        "velocity at which the surface of the base moves along itself, as a conveyor belt, in the axes of the base; requires `friction`",
    ));
    keys.extend(
        [
            ("rolling_friction", "moment against rolling per normal force"),
            ("torsional_friction", "moment against spinning about the normal per normal force"),
        ]
        .map(|(key, words)| optional(key, Shape::NotNegative, "m", words).or_number(0.0)),
    );
    keys
}

pub(super) fn read(reader: &Reader<'_, '_>, parts: &Parts<'_>) -> Option<Touching> {
    let (between, others) = parts.read(reader)?;
    law::check_rigid(reader, false)?;
    let own = CompliantLaw {
        compliance: compliance(reader)?,
        impact: impact(reader)?,
        friction: law::friction(reader),
        surface_velocity: surface_velocity(reader)?,
        resistance: [reader.number("rolling_friction")?.value, reader.number("torsional_friction")?.value],
    };
    law::check(reader, (own.compliance.as_ref().ok().copied(), own.friction.as_ref()))?;
    Some((between, others, ContactLaw::Compliant(own)))
}

/// A surface without friction drives nothing.
#[expect(clippy::option_option, reason = "an error, or none")]
fn surface_velocity(reader: &Reader<'_, '_>) -> Option<Option<Vector3>> {
    let Some(node) = reader.node("surface_velocity") else { return Some(None) };
    if !reader.has("friction") {
        let message = format!("{} has `surface_velocity` without `friction`", reader.what);
        return reader.context.fail(
            node.span,
            message,
            "add `friction`: a surface drives by its friction alone",
        );
    }
    reader.vector("surface_velocity").map(|vector| Some(vector.value))
}

fn compliance(reader: &Reader<'_, '_>) -> Option<Result<Compliance, [Located<String>; 2]>> {
    let context = reader.context;
    if let Some(material) = reader.node("material") {
        for key in ["stiffness", "exponent"] {
            if reader.has(key) {
                let message = format!("{} has both `material` and `{key}`", reader.what);
                return context.fail(material.span, message, "remove one of them");
            }
        }
        let base = reader.name_in("material")?;
        let tip = if reader.has("tip_material") { reader.name_in("tip_material")? } else { base.clone() };
        return Some(Err([base, tip]));
    }
    if let Some(node) = reader.node("tip_material") {
        let message = format!("{} has `tip_material` without `material`", reader.what);
        return context.fail(node.span, message, "name the material of the base in `material`");
    }
    if !reader.has("stiffness") {
        let message = format!("{} has neither `stiffness` nor `material`", reader.what);
        return context.fail(reader.name, message, "add `stiffness`, such as 1e6");
    }
    let stiffness = reader.number("stiffness")?.value;
    Some(Ok(Compliance { stiffness, exponent: reader.number("exponent")?.value }))
}

fn impact(reader: &Reader<'_, '_>) -> Option<Impact> {
    let context = reader.context;
    if let Some(node) = reader.node("restitution")
        && reader.number("restitution")?.value < MIN_RESTITUTION
    {
        let message = format!("`restitution` of {} is below 0.01", reader.what);
        return context.fail(node.span, message, "set `rigid = true`, whose impacts may be without rebound");
    }
    match (reader.node("restitution"), reader.node("dissipation"), reader.node("rest_velocity")) {
        (None, None, None) => Some(Impact::Dissipation(0.0)),
        (None, Some(_), None) => Some(Impact::Dissipation(reader.number("dissipation")?.value)),
        (Some(_), None, _) => {
            let coefficient = reader.number("restitution")?.value;
            let relative = relative_dissipation(coefficient);
            let rest_velocity = reader.number("rest_velocity")?.value;
            Some(Impact::Restitution { coefficient, relative, rest_velocity })
        }
        (Some(_), Some(node), _) => {
            let message = format!("{} has both `restitution` and `dissipation`", reader.what);
            context.fail(node.span, message, "remove one of them")
        }
        (None, _, Some(node)) => {
            let message = format!("{} has `rest_velocity` without `restitution`", reader.what);
            context.fail(node.span, message, "add `restitution`, or remove this")
        }
    }
}
