//! The kinds of contacts. Without `kind` an entry has the one that its parts and keys imply.

use std::borrow::Cow;

use super::entry::Touching;
use super::flexible::FlexiblePart;
use super::law::STIFFNESSES;
use super::parts::Parts;
use super::{compliant, flexible, rigid};
use crate::format::keys::{Key, Shape, required, unitless};
use crate::format::suggest;
use crate::format::top_level::{Variant, Variants};
use crate::parts::context::Context;
use crate::reading::reader::{Reader, tag};
use crate::text::report::Span;
use crate::text::{Node, Table, Value};

/// A kind of contact.
pub(super) struct ContactKind {
    pub(super) word: &'static str,
    summary: &'static str,
    /// Keys of the kind besides `kind`, `base` and `tip`.
    pub(super) own_keys: fn() -> Vec<Key>,
    /// Keys of other kinds, with what replaces them.
    instead: &'static [(&'static str, &'static str)],
    pub(super) read: fn(&Reader<'_, '_>, &Parts<'_>) -> Option<Touching>,
}

/// What replaces keys of other kinds where a flexible part touches.
const OF_FLEXIBLE: &[(&str, &str)] = &[
    ("others", "write a contact for each part that it touches"),
    ("material", "give a stiffness instead"),
    ("tip_material", "give a stiffness instead"),
    ("restitution", "give `dissipation` instead: waves in the flexible part determine how it rebounds"),
];

/// The kind of bodies with a stiffness.
pub(super) const COMPLIANT: &str = "compliant";

/// All kinds.
pub(super) static KINDS: [ContactKind; 5] = [
    ContactKind {
        word: COMPLIANT,
        summary: "Bodies whose shapes push each other by a force over the penetration; the default between bodies.",
        own_keys: compliant::keys,
        instead: &[],
        read: compliant::read,
    },
    ContactKind {
        word: "rigid",
        summary: "Bodies whose shapes touch without penetration, with impacts; also by `rigid = true`.",
        own_keys: rigid::keys,
        instead: &[],
        read: rigid::read,
    },
    ContactKind {
        word: "along",
        summary: "A beam that touches along its length, at points that are fixed to it; the default with `stiffness_per_length`.",
        own_keys: flexible::keys_along,
        instead: OF_FLEXIBLE,
        read: flexible::along,
    },
    ContactKind {
        word: "nearest",
        summary: "A beam or a shell that touches where it is nearest to balls, or a beam to capsules and beams; the default of both with `stiffness`.",
        own_keys: flexible::keys_nearest,
        instead: OF_FLEXIBLE,
        read: flexible::nearest,
    },
    ContactKind {
        word: "nodes",
        summary: "A shell or an elastic solid that touches bodies, or a shell, also itself, at its nodes; the default with `stiffness_per_area`.",
        own_keys: flexible::keys_nodes,
        instead: OF_FLEXIBLE,
        read: flexible::at_nodes,
    },
];

impl ContactKind {
    /// All its keys.
    pub(super) fn keys(&self) -> Vec<Key> {
        let words = KINDS.iter().map(|kind| kind.word).collect();
        let mut keys = vec![
            unitless("kind", Shape::Choice(Cow::Owned(words)), "its kind; default by its parts and keys"),
            required(
                "base",
                Shape::Node,
                "",
                "a body or point mass with a `shape`, or \"ground\"; or a beam if the tip is one; or a shell, with `stiffness_per_area`",
            ),
            required(
                "tip",
                Shape::Node,
                "",
                "the other part that may touch it; or the name of a beam, a shell or a solid",
            ),
        ];
        keys.extend((self.own_keys)());
        keys
    }
}

/// The forms of a contact.
pub(in super::super) fn variants() -> Variants {
    let all = KINDS.iter().map(|kind| Variant { word: kind.word, summary: kind.summary, keys: kind.keys() });
    Variants { tag: Some("kind"), is_inferred: true, all: all.collect() }
}

/// The kind of an entry, which has none of the keys of others.
pub(super) fn of(
    context: &Context<'_>,
    node: &Node,
    (what, name): (&str, Span),
) -> Option<&'static ContactKind> {
    let Value::Table(table) = &node.value else {
        return context.wrong_type(node, what, "a table");
    };
    let word = if table.contains_key("kind") {
        let words: Vec<&str> = KINDS.iter().map(|kind| kind.word).collect();
        tag(context, node, "kind", (&words, |_| None), (what, name))?.value
    } else {
        inferred(context, table, (what, name))?
    };
    let kind = KINDS.iter().find(|kind| kind.word == word)?;
    let has = |kind: &ContactKind, word: &str| kind.keys().iter().any(|key| key.name == word);
    for (key, entry) in table.iter().filter(|(key, _)| !has(kind, key)) {
        let others: Vec<&str> =
            KINDS.iter().filter(|other| has(other, key)).map(|other| other.word).collect();
        if !others.is_empty() {
            let message = format!("{what} is of kind `{word}`, which has no `{key}`");
            let instead = kind.instead.iter().find(|(replaced, _)| replaced == key);
            let help = instead.map_or_else(
                || format!("remove it: it is for kind {}", suggest::list(others.iter().copied())),
                |(_, instead)| (*instead).to_owned(),
            );
            return context.fail(entry.key, message, help);
        }
    }
    Some(kind)
}

/// The kind of an entry that does not name it.
fn inferred(context: &Context<'_>, table: &Table, (what, name): (&str, Span)) -> Option<&'static str> {
    let [base, tip] = ["base", "tip"].map(|key| {
        let node = &table.get(key)?.node;
        FlexiblePart::named(context, node, &format!("`{key}` of {what}"))
    });
    let Some(tip) = tip else {
        if let Some(base) = base {
            let own = base.words();
            let message = format!("{what} has {own} as `base`, and none as `tip`");
            let help = format!("exchange `base` and `tip`: {} is the tip", own.replace("a ", "the "));
            return context.fail(base.name().span, message, help);
        }
        let is_rigid = table.get("rigid").is_some_and(|entry| matches!(entry.node.value, Value::Flag(true)));
        return Some(if is_rigid { "rigid" } else { COMPLIANT });
    };
    let given: Vec<_> = STIFFNESSES.iter().filter(|(key, _)| table.contains_key(*key)).collect();
    match given[..] {
        [(_, word)] => Some(word),
        [] => {
            let own = tip.stiffness();
            let message = format!("{what} has neither `stiffness` nor `{own}`");
            let help = format!(
                "add `{own}` for contact at points of {}, or `stiffness` where it is nearest",
                tip.words()
            );
            context.fail(name, message, help)
        }
        [(one, _), (other, _), ..] => {
            context.fail(name, format!("{what} has both `{one}` and `{other}`"), "remove one of them")
        }
    }
}
