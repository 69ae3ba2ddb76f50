//! Contacts between parts, and the shape of the ground.

use std::borrow::Cow;
use std::sync::Arc;

use lissom_contact::elastic::ContactFriction;
use lissom_contact::forms::PlacedSolid;
use lissom_contact::law::{Coulomb, Impact};
use lissom_contact::rigid::RigidLaw;
use lissom_mechanics::compliance::{Compliance, MIN_RESTITUTION, RestitutionLaw};
use lissom_motion::Vector3;

use super::beam_contacts::{self, BeamContactEntry, NOT_OF_BEAMS, OF_BEAMS};
use super::entries::each;
use super::ports::two_nodes;
use super::rigid_contacts::{self, OF_DEFORMATION};
use super::shell_contacts::{self, NOT_OF_SHELLS, OF_SHELLS, ShellContactEntry};
use super::solids::shape;
use super::{Body, NodeReference, PointMass};
use crate::format::keys::{Key, Shape, optional, required};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::Registry;
use crate::surface::Surface;
use crate::text::Value;
use crate::text::report::Located;

/// Solids that are fixed in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// Shape for drawings.
    pub surface: Option<Arc<Surface>>,
    /// Solids that parts touch, in global axes.
    pub(crate) solids: Vec<PlacedSolid>,
}

/// Parts that may touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactEntry {
    /// Name.
    pub name: Located<String>,
    /// Base and tip; of a beam its start.
    pub between: [Located<NodeReference>; 2],
    /// Further parts: every two of all touch each other.
    pub others: Vec<Located<NodeReference>>,
    /// How they touch.
    pub law: ContactLaw,
}

/// How parts touch.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactLaw {
    /// Without penetration.
    Rigid(RigidLaw),
    /// With a beam.
    OfBeam(BeamContactEntry),
    /// With a shell.
    OfShell(ShellContactEntry),
    /// By a force over the penetration.
    Compliant(CompliantEntry),
}

/// A contact of solids by a force over the penetration.
#[derive(Clone, Debug, PartialEq)]
pub struct CompliantEntry {
    /// Normal force, or the materials of both parts, from which it follows.
    pub compliance: Result<Compliance, [Located<String>; 2]>,
    /// What an impact dissipates.
    pub impact: Impact,
    /// Its friction, whose bristles are added with its points.
    pub friction: Option<ContactFriction>,
    /// Moments against rolling and spinning per normal force [m].
    pub resistance: [f64; 2],
}

impl ContactEntry {
    /// Number of its moving parts if shapes of each two of them may touch, otherwise zero.
    pub(super) fn moving_parts(&self) -> usize {
        if !matches!(self.law, ContactLaw::Compliant(_)) {
            return 0;
        }
        let parts = self.between.iter().chain(&self.others);
        parts.filter(|part| part.value != NodeReference::Ground).count()
    }

    /// Every two parts that may touch.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = [&Located<NodeReference>; 2]> {
        let parts: Vec<_> = self.between.iter().chain(&self.others).collect();
        (1..parts.len()).flat_map(move |tip| {
            let parts = parts.clone();
            (0..tip).map(move |base| [parts[base], parts[tip]])
        })
    }
}

/// Keys of `[ground]`.
pub(super) fn ground_keys() -> Vec<Key> {
    vec![
        optional("shape", Shape::Solid, "", "solids, in global axes; by default at the origin"),
        optional("mesh", Shape::Text, "", "instead of `shape`: an STL or glTF file in metres, drawn only"),
    ]
}

/// Keys of a contact.
pub(super) fn keys() -> Vec<Key> {
    let mut keys = vec![
        required(
            "base",
            Shape::Node,
            "",
            "a body or point mass with a `shape`, or \"ground\"; a beam, if the tip is one",
        ),
        optional("others", Shape::Nodes, "", "further parts: every two of `base`, `tip` and these may touch"),
        required("tip", Shape::Node, "", "the other part that may touch it; or the name of a beam or a shell"),
        optional(
            "rigid",
            Shape::Flag,
            "",
            "instead of `stiffness`: whether the parts touch without penetration, with impacts",
        ).or_flag(false),
        optional("stiffness", Shape::Positive, "N/m^n", "normal force at a penetration of 1 m"),
        optional("exponent", Shape::Positive, "", "exponent n of the penetration, at least 1").or_number(1.0),
        optional(
            "material",
            Shape::Name("materials"),
            "",
            "instead of `stiffness` and `exponent`: the material of both parts, for balls on balls or planes by the theory of Hertz",
        ),
        optional("tip_material", Shape::Name("materials"), "", "material of the tip, if it is another one"),
        optional(
            "restitution",
            Shape::Between(0.0, 1.0),
            "",
            "velocity after an impact over that before, at any impact velocity: from 0.01 to 1, and 1 if it is omitted; of rigid \
             contacts from 0 to 1, and 0 if it is omitted",
        ),
        optional(
            "rest_velocity",
            Shape::Positive,
            "m/s",
            "slower impacts dissipate as those of this velocity, those of rigid contacts do not rebound; requires `restitution` or \
             `rigid`",
        )
        .or_number(1e-3),
        optional(
            "restitution_law",
            Shape::Choice(Cow::Borrowed(&["exact", "lankarani_nikravesh", "flores"])),
            "",
            "how the dissipation follows from `restitution`; those other than \"exact\" are for comparison with publications",
        )
        .or_word("exact"),
        optional(
            "dissipation",
            Shape::NotNegative,
            "s/m",
            "instead of `restitution`: relative increase of the normal force per penetration velocity",
        ),
        optional("friction", Shape::NotNegative, "", "coefficient of sliding friction").or_number(0.0),
        optional(
            "static_friction",
            Shape::Positive,
            "",
            "coefficient at rest, not below `friction`; default: that of `friction`",
        ),
        optional(
            "stribeck",
            Shape::Positive,
            "m/s",
            "sliding velocity at which the difference has fallen to 1/e, and friction begins to yield",
        ).or_number(0.01),
        optional("deflection", Shape::Positive, "m", "tangential deflection before it slips").or_number(1e-5),
        optional(
            "rolling_friction",
            Shape::NotNegative,
            "m",
            "moment against rolling per normal force",
        ).or_number(0.0),
        optional(
            "torsional_friction",
            Shape::NotNegative,
            "m",
            "moment against spinning about the normal per normal force",
        ).or_number(0.0),
    ];
    keys.extend(beam_contacts::keys());
    keys.extend(shell_contacts::keys());
    keys
}

/// The shape of the ground; none stands for an error.
pub(super) fn ground(context: &Context<'_>) -> Option<Ground> {
    let Some((node, span)) = context.top("ground").filter(|(node, _)| node.table().is_some()) else {
        return Some(Ground::default());
    };
    let keys = (context.forms)("ground", &Registry::default()).all.into_iter().next()?.keys;
    let reader = Reader::open(context, node, ("[ground]".to_owned(), span), keys)?;
    shape(&reader, &Vector3::zeros()).map(|shape| Ground { surface: shape.surface, solids: shape.solids })
}

/// The contacts.
pub(super) fn contacts(
    context: &Context<'_>,
    (bodies, point_masses, ground): (&[Body], &[PointMass], Option<&Ground>),
) -> Vec<ContactEntry> {
    let has_solids = |node: &NodeReference| match node {
        NodeReference::Ground => ground.is_none_or(|ground| !ground.solids.is_empty()),
        NodeReference::Body(name) => {
            bodies.iter().find(|body| body.name.value == *name).is_none_or(|body| !body.solids.is_empty())
        }
        NodeReference::PointMass(name) => point_masses
            .iter()
            .find(|mass| mass.name.value == *name)
            .is_none_or(|mass| !mass.solids.is_empty()),
        _ => false,
    };
    let is_solid = |part: &Located<NodeReference>, what: &str| {
        if !matches!(part.value, NodeReference::Ground | NodeReference::Body(_) | NodeReference::PointMass(_))
        {
            let message = format!("{what} names a node that is no body");
            return context.fail(part.span, message, "name bodies, point masses or \"ground\"");
        }
        if !has_solids(&part.value) {
            let message = format!("{} has no solid that could touch", words(&part.value));
            let help = match part.value {
                NodeReference::Ground => "add [ground] with shape = { kind = \"plane\" }",
                _ => {
                    "add a `shape` to it, such as { kind = \"sphere\", radius = 0.1 }; one with `touches = false` is only drawn"
                }
            };
            return context.fail(part.span, message, help);
        }
        Some(())
    };
    each(context, "contacts", |reader, name| {
        let entry = |between, others, law| {
            let name = Located::new(name.to_owned(), reader.name);
            Some(ContactEntry { name, between, others, law })
        };
        let kind = kind(reader)?;
        if let Kind::OfBeam(sides) = kind {
            let (between, law) = beam_contacts::entry(reader, sides, &|part| is_solid(part, &reader.what))?;
            return entry(between, Vec::new(), ContactLaw::OfBeam(law));
        }
        if let Kind::OfShell(shell) = kind {
            let (between, law) = shell_contacts::entry(reader, shell, &|part| is_solid(part, &reader.what))?;
            return entry(between, Vec::new(), ContactLaw::OfShell(law));
        }
        let between = two_nodes(reader)?;
        let others = others(reader, &between)?;
        for part in between.iter().chain(&others) {
            is_solid(part, &reader.what)?;
        }
        if matches!(kind, Kind::Rigid) {
            return entry(between, others, ContactLaw::Rigid(rigid_contacts::law(reader)?));
        }
        let law = CompliantEntry {
            compliance: compliance(reader)?,
            impact: impact(reader)?,
            friction: friction(reader),
            resistance: [
                reader.number("rolling_friction")?.value,
                reader.number("torsional_friction")?.value,
            ],
        };
        check_law(reader, (law.compliance.as_ref().ok().copied(), law.friction.as_ref()))?;
        entry(between, others, ContactLaw::Compliant(law))
    })
}

/// What a contact is between, from its keys.
enum Kind {
    /// That of the base, if it is one, and that of the tip.
    OfBeam((Option<Located<String>>, Located<String>)),
    /// That of the tip.
    OfShell(Located<String>),
    Rigid,
    Compliant,
}

/// The kind of a contact, which has none of the keys of other kinds.
fn kind(reader: &Reader<'_, '_>) -> Option<Kind> {
    let (context, what) = (reader.context, &reader.what);
    let given = |keys: &[&'static str]| keys.iter().find_map(|key| Some((*key, reader.node(key)?.span)));
    if let Some(tip) = shell_contacts::shell_of(reader, "tip") {
        if let Some((key, span)) = given(&OF_BEAMS) {
            let message = format!("`{key}` of {what} is for beams");
            return context.fail(
                span,
                message,
                "remove it: a shell touches with its thickness, at its nodes",
            );
        }
        for (key, help) in NOT_OF_SHELLS {
            if let Some((_, span)) = given(&[key]) {
                let message = format!("`{key}` of {what} is not available for shells");
                return context.fail(span, message, help);
            }
        }
        return Some(Kind::OfShell(tip));
    }
    if let Some(base) = shell_contacts::shell_of(reader, "base") {
        let message = format!("{what} has a shell as `base`");
        return context.fail(base.span, message, "exchange `base` and `tip`: the shell is the tip");
    }
    if let Some((key, span)) = given(&[OF_SHELLS]) {
        let message = format!("`{key}` of {what} is for shells");
        return context.fail(span, message, "name a shell as `tip`, or give `stiffness`");
    }
    match (beam_contacts::beam_of(reader, "base"), beam_contacts::beam_of(reader, "tip")) {
        (base, Some(tip)) => {
            if let Some((_, span)) = given(&["others"]) {
                let help = "write a contact for each part that the beam touches";
                return context.fail(span, format!("{what} is of a beam and has `others`"), help);
            }
            for (key, help) in NOT_OF_BEAMS {
                if let Some((_, span)) = given(&[key]) {
                    let message = format!("`{key}` of {what} is not available for beams");
                    return context.fail(span, message, help);
                }
            }
            return Some(Kind::OfBeam((base, tip)));
        }
        (Some(base), None) => {
            let message = format!("{what} has a beam as `base` and none as `tip`");
            return context.fail(base.span, message, "exchange them: the beam is the tip");
        }
        (None, None) => {}
    }
    if let Some((key, span)) = given(&OF_BEAMS) {
        let message = format!("`{key}` of {what} is for beams");
        return context.fail(span, message, "name a beam as `tip`, or remove this");
    }
    if !reader.flag("rigid")?.value {
        return Some(Kind::Compliant);
    }
    if let Some((key, span)) = given(&OF_DEFORMATION) {
        return context.fail(span, format!("{what} is rigid and has `{key}`"), "remove one of them");
    }
    Some(Kind::Rigid)
}

/// Further parts of a contact, each named once.
fn others(
    reader: &Reader<'_, '_>,
    between: &[Located<NodeReference>; 2],
) -> Option<Vec<Located<NodeReference>>> {
    let Some(node) = reader.node("others") else { return Some(Vec::new()) };
    let (context, what) = (reader.context, format!("each entry of {}", reader.words("others")));
    let Value::List(list) = &node.value else {
        return context.wrong_type(node, &reader.words("others"), "a list of parts");
    };
    let mut found: Vec<Located<NodeReference>> = Vec::new();
    for entry in list {
        let part = context.node(entry, &what)?;
        if between.iter().chain(&found).any(|known| known.value == part.value) {
            let message = format!("{} names {} twice", reader.what, words(&part.value));
            return context.fail(part.span, message, "remove one of them");
        }
        found.push(part);
    }
    Some(found)
}

/// Penetration at which the force of a contact is checked [m].
const SMALL_PENETRATION: f64 = 1e-6;
/// Largest force at this penetration: the round-off of a position of 1 m then causes up to 0.1 N [N].
const MAX_FORCE: f64 = 1e9;

/// Checks stiffness, exponent and the coefficients of friction.
pub(super) fn check_law(
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
        let span = reader.node("stiffness").map_or(reader.name, |node| node.span);
        let message = format!(
            "{} pushes with more than 1e9 N at a penetration of 1 µm: no step resolves this",
            reader.what
        );
        return context.fail(span, message, "lower `stiffness`, or set `rigid = true` instead");
    }
    if friction.is_some_and(|friction| friction.law.at_rest < friction.law.sliding) {
        let span = reader.node("static_friction").map_or(reader.name, |node| node.span);
        let message = format!("`static_friction` of {} is below `friction`", reader.what);
        return context.fail(span, message, "static friction must not be smaller than sliding friction");
    }
    Some(())
}

/// A part in words.
pub(crate) fn words(node: &NodeReference) -> String {
    match node {
        NodeReference::Body(name) | NodeReference::PointMass(name) => format!("`{name}`"),
        _ => "the ground".to_owned(),
    }
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
    let fine = reader.node("rest_velocity").or_else(|| reader.node("restitution_law"));
    match (reader.node("restitution"), reader.node("dissipation"), fine) {
        (None, None, None) => Some(Impact::Dissipation(0.0)),
        (None, Some(_), None) => Some(Impact::Dissipation(reader.number("dissipation")?.value)),
        (Some(_), None, _) => {
            let law = match reader.choice("restitution_law")?.value {
                "lankarani_nikravesh" => RestitutionLaw::LankaraniNikravesh,
                "flores" => RestitutionLaw::Flores,
                _ => RestitutionLaw::Exact,
            };
            let coefficient = reader.number("restitution")?.value;
            let relative = law.relative_dissipation(coefficient);
            let rest_velocity = reader.number("rest_velocity")?.value;
            Some(Impact::Restitution { coefficient, relative, rest_velocity })
        }
        (Some(_), Some(node), _) => {
            let message = format!("{} has both `restitution` and `dissipation`", reader.what);
            context.fail(node.span, message, "remove one of them")
        }
        (None, _, Some(node)) => {
            let key = if reader.has("rest_velocity") { "rest_velocity" } else { "restitution_law" };
            let message = format!("{} has `{key}` without `restitution`", reader.what);
            context.fail(node.span, message, "add `restitution`, or remove this")
        }
    }
}
