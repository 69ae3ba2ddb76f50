//! The parts that a contact names, and whether they have solids.

use std::collections::BTreeMap;

use super::super::ports::two_nodes;
use super::super::{Body, Ground, NodeReference, PointMass};
use crate::reading::reader::Reader;
use crate::text::Value;
use crate::text::report::Located;

/// Base and tip.
pub(super) type TwoParts = [Located<NodeReference>; 2];

/// The parts of a model that may have solids.
pub(in super::super) struct Parts<'d> {
    pub(in super::super) bodies: &'d [Body],
    pub(in super::super) point_masses: &'d [PointMass],
    /// None stands for an error.
    pub(in super::super) ground: Option<&'d Ground>,
}

impl Parts<'_> {
    /// Base, tip and others of a contact of solids.
    pub(super) fn read(&self, reader: &Reader<'_, '_>) -> Option<(TwoParts, Vec<Located<NodeReference>>)> {
        let between = two_nodes(reader)?;
        let others = others(reader, &between)?;
        for part in between.iter().chain(&others) {
            self.check(reader, part)?;
        }
        Some((between, others))
    }

    fn has_solids(&self, node: &NodeReference) -> bool {
        let of = |solids: Option<bool>| solids.unwrap_or(true);
        match node {
            NodeReference::Ground => of(self.ground.map(|ground| !ground.solids.is_empty())),
            NodeReference::Body(name) => {
                let body = self.bodies.iter().find(|body| body.name.value == *name);
                of(body.map(|body| !body.solids.is_empty()))
            }
            NodeReference::PointMass(name) => {
                let mass = self.point_masses.iter().find(|mass| mass.name.value == *name);
                of(mass.map(|mass| !mass.solids.is_empty()))
            }
            _ => false,
        }
    }

    /// Reports a part that has no solid.
    pub(super) fn check(&self, reader: &Reader<'_, '_>, part: &Located<NodeReference>) -> Option<()> {
        let context = reader.context;
        if !matches!(part.value, NodeReference::Ground | NodeReference::Body(_) | NodeReference::PointMass(_))
        {
            let message = format!("{} names a node that is no body", reader.what);
            return context.fail(part.span, message, "name bodies, point masses or \"ground\"");
        }
        if self.has_solids(&part.value) {
            return Some(());
        }
        let message = format!("{} has no solid that could touch", words(&part.value));
        let help = match part.value {
            NodeReference::Ground => "add [ground] with shape = { kind = \"plane\" }",
            _ => {
                "add a `shape` to it, such as { kind = \"sphere\", radius = 0.1 }; one with `touches = false` is only drawn"
            }
        };
        context.fail(part.span, message, help)
    }
}

/// Further parts of a contact, each named once.
fn others(reader: &Reader<'_, '_>, between: &TwoParts) -> Option<Vec<Located<NodeReference>>> {
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

/// Groups of parts that do not touch each other, by their positions among base, tip and others.
pub(super) fn exceptions(
    reader: &Reader<'_, '_>,
    between: &TwoParts,
    others: &[Located<NodeReference>],
) -> Option<Vec<Vec<usize>>> {
    let Some(node) = reader.node("except") else { return Some(Vec::new()) };
    let (context, what) = (reader.context, reader.words("except"));
    let Value::List(lists) = &node.value else { return context.wrong_type(node, &what, "lists of parts") };
    let mut places = BTreeMap::new();
    for (place, part) in between.iter().chain(others).enumerate() {
        places.insert(words(&part.value), place);
    }
    let mut groups = Vec::new();
    for list in lists {
        let Value::List(entries) = &list.value else {
            return context.wrong_type(list, &format!("each entry of {what}"), "a list of parts");
        };
        let mut group = Vec::new();
        for entry in entries {
            let part = context.node(entry, &format!("each part of {what}"))?;
            let Some(&place) = places.get(&words(&part.value)) else {
                let message = format!(
                    "`except` of {} names {}, which is no part of it",
                    reader.what,
                    words(&part.value)
                );
                return context.fail(part.span, message, "name parts among `base`, `tip` and `others`");
            };
            if group.contains(&place) {
                let message =
                    format!("a list of `except` of {} names {} twice", reader.what, words(&part.value));
                return context.fail(part.span, message, "remove one of them");
            }
            group.push(place);
        }
        if group.len() < 2 {
            let message = format!("a list of `except` of {} has fewer than two parts", reader.what);
            return context.fail(list.span, message, "name at least two parts that do not touch each other");
        }
        groups.push(group);
    }
    Some(groups)
}

/// A part in words.
fn words(node: &NodeReference) -> String {
    match node {
        NodeReference::Body(name) | NodeReference::PointMass(name) => format!("`{name}`"),
        _ => "the ground".to_owned(),
    }
}
