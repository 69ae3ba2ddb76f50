//! Contacts of flexible parts: along a beam, at the nodes of a shell or a solid, or where a beam or a shell is nearest.

use lissom_contact::elastic::ContactFriction;
use lissom_mechanics::compliance::Compliance;

use super::super::NodeReference;
use super::entry::{ContactLaw, Touching};
use super::law;
use super::parts::Parts;
use crate::format::keys::{Key, Shape, optional, required, unitless};
use crate::parts::context::Context;
use crate::reading::mesh_nodes::ALL;
use crate::reading::node_reference::MeshPlace;
use crate::reading::reader::Reader;
use crate::text::report::Located;
use crate::text::{Node, Value};

/// A flexible part, by its name.
#[derive(Clone, Debug, PartialEq)]
pub enum FlexiblePart {
    /// A beam.
    Beam(Located<String>),
    /// A shell.
    Shell(Located<String>),
    /// An elastic solid.
    Solid(Located<String>),
}

/// Where a flexible part touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Along its length, in points that are fixed to it: intervals between points in an element. The stiffness is per length [N/mⁿ⁺¹].
    Along(usize),
    /// Where it is nearest, with the stiffness of the whole [N/mⁿ].
    Nearest,
    /// At its nodes, with a stiffness per area [N/mⁿ⁺²].
    Nodes,
}

/// How a flexible part touches another.
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibleLaw {
    /// The tip.
    pub tip: FlexiblePart,
    /// The base, if it is a beam or a shell.
    pub base: Option<FlexiblePart>,
    /// Radii of base and tip, if given [m].
    pub radii: [Option<f64>; 2],
    /// Set of nodes of a solid whose faces touch, otherwise all outer faces.
    pub faces: Option<Located<String>>,
    /// Where they touch.
    pub way: Way,
    /// Normal force over the penetration, by the way: of all, per length or per area.
    pub compliance: Compliance,
    /// Relative increase of the normal force per penetration velocity [s/m].
    pub dissipation: f64,
    /// Friction of the contact, whose bristles are added with its points.
    pub friction: Option<ContactFriction>,
}

impl FlexiblePart {
    /// The part that a text names, if it does.
    pub(super) fn named(context: &Context<'_>, node: &Node, what: &str) -> Option<Self> {
        let Value::Text(text) = &node.value else { return None };
        let of = |table: &str| {
            let name = context.entry_named(table, text, node, what)?;
            context.has(table, &name).then(|| Located::new(name, node.span))
        };
        let shell = || of("shells").map(Self::Shell);
        of("beams").map(Self::Beam).or_else(shell).or_else(|| of("solids").map(Self::Solid))
    }

    pub(crate) fn name(&self) -> &Located<String> {
        let (Self::Beam(name) | Self::Shell(name) | Self::Solid(name)) = self;
        name
    }

    pub(crate) fn words(&self) -> &'static str {
        match self {
            Self::Beam(_) => "a beam",
            Self::Shell(_) => "a shell",
            Self::Solid(_) => "a solid",
        }
    }

    /// The key of its stiffness at points.
    pub(super) fn stiffness(&self) -> &'static str {
        match self {
            Self::Beam(_) => "stiffness_per_length",
            Self::Shell(_) | Self::Solid(_) => "stiffness_per_area",
        }
    }

    /// The node that stands for it.
    fn node(&self) -> Located<NodeReference> {
        match self {
            Self::Beam(name) => {
                Located::new(NodeReference::Beam { beam: name.value.clone(), fraction: 0.0 }, name.span)
            }
            Self::Shell(name) | Self::Solid(name) => {
                let place = MeshPlace::Set(ALL.to_owned());
                Located::new(NodeReference::Mesh { part: name.value.clone(), place }, name.span)
            }
        }
    }
}

fn keys(stiffness: Key) -> Vec<Key> {
    let mut keys = vec![stiffness, law::exponent(), law::dissipation()];
    keys.extend(law::friction_keys());
    keys
}

fn radii() -> [Key; 2] {
    let words = "of a beam as tip: its radius where it touches; default that of its sections, if they are round and equal";
    [
        optional("radius", Shape::Positive, "m", words),
        optional("base_radius", Shape::Positive, "m", "of a beam as base: its radius"),
    ]
}

pub(super) fn keys_along() -> Vec<Key> {
    let words = "of a beam: normal force per length at a penetration of 1 m";
    let mut keys = keys(required("stiffness_per_length", Shape::Positive, "N/m^(n+1)", words));
    let words = "of a beam: number of intervals between points of contact in an element";
    keys.push(unitless("points", Shape::Count(1, 64), words).or_count(2));
    keys.extend(radii());
    keys
}

pub(super) fn keys_nearest() -> Vec<Key> {
    let words = "normal force at a penetration of 1 m";
    let mut keys = keys(required("stiffness", Shape::Positive, "N/m^n", words));
    keys.extend(radii());
    keys
}

pub(super) fn keys_nodes() -> Vec<Key> {
    let words = "of a shell or a solid: normal force per area at a penetration of 1 m";
    let mut keys = keys(required("stiffness_per_area", Shape::Positive, "N/m^(n+2)", words));
    keys.push(unitless(
        "faces",
        Shape::Text,
        "of a solid: set of nodes whose faces touch; default all outer faces",
    ));
    keys
}

pub(super) fn along(reader: &Reader<'_, '_>, parts: &Parts<'_>) -> Option<Touching> {
    read((reader, parts), "stiffness_per_length", Way::Along(reader.count("points")?.value))
}

pub(super) fn nearest(reader: &Reader<'_, '_>, parts: &Parts<'_>) -> Option<Touching> {
    read((reader, parts), "stiffness", Way::Nearest)
}

pub(super) fn at_nodes(reader: &Reader<'_, '_>, parts: &Parts<'_>) -> Option<Touching> {
    read((reader, parts), "stiffness_per_area", Way::Nodes)
}

fn read((reader, parts): (&Reader<'_, '_>, &Parts<'_>), stiffness: &str, way: Way) -> Option<Touching> {
    let (context, what) = (reader.context, &reader.what);
    let named = |key: &str| FlexiblePart::named(context, reader.node(key)?, &reader.words(key));
    let tip = named("tip").filter(|tip| match tip {
        FlexiblePart::Beam(_) => way != Way::Nodes,
        FlexiblePart::Shell(_) => !matches!(way, Way::Along(_)),
        FlexiblePart::Solid(_) => way == Way::Nodes,
    });
    let Some(tip) = tip else {
        let span = reader.node("tip")?.span;
        let message = format!("`tip` of {what} is not what touches in this way");
        return context.fail(
            span,
            message,
            "`along` is for beams, `nodes` for shells and solids, `nearest` for beams and shells",
        );
    };
    let (base, between) = match (named("base"), &tip) {
        (None, _) => {
            let part = context.node(reader.node("base")?, &reader.words("base"))?;
            parts.check(reader, &part)?;
            (None, [part, tip.node()])
        }
        (Some(FlexiblePart::Beam(base)), FlexiblePart::Beam(own)) if base.value == own.value => {
            let message = format!("{what} names one beam twice");
            return context.fail(own.span, message, "make two beams of it that share a node");
        }
        (Some(other @ FlexiblePart::Beam(_)), FlexiblePart::Beam(_)) => {
            let nodes = [other.node(), tip.node()];
            (Some(other), nodes)
        }
        (Some(other @ FlexiblePart::Shell(_)), _) if way == Way::Nodes => {
            let nodes = [other.node(), tip.node()];
            (Some(other), nodes)
        }
        (Some(other), _) => {
            let message = format!("{what} is between two flexible parts");
            let help = "nodes of shells and solids touch shells: give `stiffness_per_area`; otherwise clamp bodies with a `shape` to the other part";
            return context.fail(other.name().span, message, help);
        }
    };
    let is_beam = matches!(tip, FlexiblePart::Beam(_));
    let radius = |key: &str, is_used: bool, whose: &str| match reader.has(key).then(|| reader.number(key)) {
        None => Some(None),
        Some(number) if is_used => number.map(|number| Some(number.value)),
        Some(_) => {
            let message = format!("`{key}` of {what} is for a beam as {whose}");
            let help = "remove it: other parts touch with their shape or thickness";
            context.fail(reader.node(key)?.span, message, help)
        }
    };
    let radii = match way {
        Way::Nodes => [None; 2],
        _ => [
            radius("base_radius", matches!(base, Some(FlexiblePart::Beam(_))), "base")?,
            radius("radius", is_beam, "tip")?,
        ],
    };
    let faces = if way == Way::Nodes && reader.has("faces") {
        let set = reader.text("faces")?;
        if !matches!(tip, FlexiblePart::Solid(_)) {
            let message = format!("`faces` of {what} is for solids");
            return context.fail(set.span, message, "remove it: a shell touches at all of its nodes");
        }
        Some(set.map(str::to_owned))
    } else {
        None
    };
    let friction = law::friction(reader);
    let is_frictionless = is_beam && (base.is_some() || way == Way::Nearest);
    if friction.is_some() && is_frictionless {
        let key = if reader.has("friction") { "friction" } else { "static_friction" };
        let message = format!("friction of {what} is not available");
        let help = "beams have friction with a body or the ground, with `stiffness_per_length`";
        return context.fail(reader.node(key)?.span, message, help);
    }
    let (stiffness, exponent) = (reader.number(stiffness)?.value, reader.number("exponent")?.value);
    let compliance = Compliance { stiffness, exponent };
    law::check(reader, (Some(compliance), friction.as_ref()))?;
    let dissipation = reader.number("dissipation")?.value;
    let law = FlexibleLaw { tip, base, radii, faces, way, compliance, dissipation, friction };
    Some((between, Vec::new(), ContactLaw::Flexible(law)))
}
