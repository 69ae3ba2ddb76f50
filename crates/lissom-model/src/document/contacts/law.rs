//! What the laws of several kinds of contacts share: normal force and friction.

use lissom_contact::elastic::ContactFriction;
use lissom_contact::law::Coulomb;
use lissom_mechanics::compliance::Compliance;

use crate::format::keys::{Key, Shape, optional, unitless};
use crate::reading::reader::Reader;

/// Penetration at which the force of a contact is checked [m].
const SMALL_PENETRATION: f64 = 1e-6;
/// Largest force at this penetration: the round-off of a position of 1 m then causes up to 0.1 N [N].
const MAX_FORCE: f64 = 1e9;

/// Keys of the stiffness, with the kinds that they imply.
pub(super) const STIFFNESSES: [(&str, &str); 3] =
    [("stiffness", "nearest"), ("stiffness_per_length", "along"), ("stiffness_per_area", "nodes")];

/// The coefficient of friction.
pub(super) fn coefficient() -> Key {
    unitless("friction", Shape::NotNegative, "coefficient of sliding friction").or_number(0.0)
}

/// Friction with bristles.
pub(super) fn friction_keys() -> [Key; 4] {
    [
        coefficient(),
        unitless(
            "static_friction",
            Shape::Positive,
            "coefficient at rest, not below `friction`; default: that of `friction`",
        ),
        optional(
            "stribeck",
            Shape::Positive,
            "m/s",
            "sliding velocity at which the difference has fallen to 1/e, and friction begins to yield",
        )
        .or_number(0.01),
        optional("deflection", Shape::Positive, "m", "tangential deflection before it slips").or_number(1e-5),
    ]
}

/// The exponent of the penetration.
pub(super) fn exponent() -> Key {
    unitless("exponent", Shape::Positive, "exponent n of the penetration, at least 1").or_number(1.0)
}

/// What an impact dissipates.
pub(super) fn dissipation() -> Key {
    let words = "relative increase of the normal force per penetration velocity";
    optional("dissipation", Shape::NotNegative, "s/m", words).or_number(0.0)
}

/// Two parts whose shapes touch.
pub(super) fn other_parts() -> Key {
    unitless("others", Shape::Nodes, "further parts: every two of `base`, `tip` and these may touch")
}

/// Groups of parts that do not touch each other.
pub(super) fn exceptions() -> Key {
    let words = "with `others`: lists of parts of which no two touch";
    unitless("except", Shape::GroupsOfNodes, words)
}

/// The older word for the kind of rigid contacts.
pub(super) fn is_rigid() -> Key {
    let words = "older word for the kinds `rigid` and `compliant`";
    unitless("rigid", Shape::Flag, words)
}

/// Checks `rigid` against the kind.
pub(super) fn check_rigid(reader: &Reader<'_, '_>, is_rigid: bool) -> Option<()> {
    let Some(node) = reader.node("rigid") else { return Some(()) };
    if reader.flag("rigid")?.value == is_rigid {
        return Some(());
    }
    let message = format!("`rigid` of {} contradicts its `kind`", reader.what);
    reader.context.fail(node.span, message, "remove one of them")
}

/// Checks stiffness, exponent and the coefficients of friction.
pub(super) fn check(
    reader: &Reader<'_, '_>,
    (compliance, friction): (Option<Compliance>, Option<&ContactFriction>),
) -> Option<()> {
    let context = reader.context;
    if compliance.is_some_and(|law| law.exponent < 1.0) {
        let span = reader.node("exponent").map_or(reader.name, |node| node.span);
        let message = format!("`exponent` of {} is below 1", reader.what);
        return context.fail(span, message, "the stiffness at touch would be infinite");
    }
    if let Some(Compliance { stiffness, exponent }) = compliance
        && stiffness * SMALL_PENETRATION.powf(exponent) > MAX_FORCE
    {
        let message = format!(
            "{} pushes with more than 1e9 N at a penetration of 1 µm: no step resolves this",
            reader.what
        );
        let key = STIFFNESSES.iter().find(|(key, _)| reader.has(key)).map(|(key, _)| reader.node(key));
        let span = key.flatten().map_or(reader.name, |node| node.span);
        return context.fail(span, message, "lower `stiffness`, or set `rigid = true` instead");
    }
    if friction.is_some_and(|friction| friction.law.at_rest < friction.law.sliding) {
        let span = reader.node("static_friction").map_or(reader.name, |node| node.span);
        let message = format!("`static_friction` of {} is below `friction`", reader.what);
        return context.fail(span, message, "static friction must not be smaller than sliding friction");
    }
    Some(())
}

/// The friction of a contact, without bristles, if it has any; none also after an error that is reported.
pub(super) fn friction(reader: &Reader<'_, '_>) -> Option<ContactFriction> {
    let sliding = reader.number("friction")?.value;
    let at_rest =
        if reader.has("static_friction") { reader.number("static_friction")?.value } else { sliding };
    let (stribeck, deflection) = (reader.number("stribeck")?.value, reader.number("deflection")?.value);
    let law =
        ContactFriction { bristles: Vec::new(), law: Coulomb { sliding, at_rest, stribeck }, deflection };
    (at_rest > 0.0).then_some(law)
}
