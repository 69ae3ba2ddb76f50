//! Contacts of shells: their keys, and what these say of the law of contact.

use lissom_contact::elastic::ContactFriction;
use lissom_mechanics::compliance::Compliance;

use super::NodeReference;
use super::beam_contacts::beam_of;
use super::contacts::{check_law, friction};
use crate::format::keys::{Key, Shape, optional};
use crate::reading::mesh_nodes::ALL;
use crate::reading::node_reference::MeshPlace;
use crate::reading::reader::Reader;
use crate::text::Value;
use crate::text::report::Located;

/// Where a shell touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchingShell {
    /// At its nodes: force per area at a penetration of 1 m [N/mⁿ⁺²].
    Nodes(f64),
    /// Where it is nearest: force at a penetration of 1 m [N/mⁿ].
    Nearest(f64),
}

/// A contact of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellContactEntry {
    /// The tip.
    pub shell: Located<String>,
    /// Where they touch.
    pub touching: TouchingShell,
    /// Exponent n of the penetration.
    pub exponent: f64,
    /// Relative increase of the normal force per penetration velocity [s/m].
    pub dissipation: f64,
    /// Its friction, whose bristles are added with its points.
    pub friction: Option<ContactFriction>,
}

/// Keys that shells do not have, with remedies.
pub(super) const NOT_OF_SHELLS: [(&str, &str); 9] = [
    ("others", "write a contact for each part that the shell touches"),
    ("material", "give `stiffness` or `stiffness_per_area` instead"),
    ("tip_material", "give `stiffness` or `stiffness_per_area` instead"),
    ("restitution", "give `dissipation` instead: waves in the shell determine how it rebounds"),
    ("rest_velocity", "remove it, and give `dissipation`"),
    ("restitution_law", "remove it, and give `dissipation`"),
    ("rigid", "give `stiffness` or `stiffness_per_area` instead"),
    ("rolling_friction", "remove it"),
    ("torsional_friction", "remove it"),
];

/// The key that only shells have.
pub(super) const OF_SHELLS: &str = "stiffness_per_area";

/// Further keys of a contact.
pub(super) fn keys() -> [Key; 1] {
    [optional(
        OF_SHELLS,
        Shape::Positive,
        "N/m^(n+2)",
        "of a shell as tip, instead of `stiffness`: it touches at its nodes, with this normal force per area at a penetration of 1 m",
    )]
}

/// The shell that a key names, if it does.
pub(super) fn shell_of(reader: &Reader<'_, '_>, key: &str) -> Option<Located<String>> {
    let node = reader.node(key)?;
    let Value::Text(text) = &node.value else { return None };
    let name = reader.context.entry_named("shells", text, node, &reader.words(key))?;
    reader.context.has("shells", &name).then(|| Located::new(name, node.span))
}

/// Base and tip of a contact of a shell, and its law.
pub(super) fn entry(
    reader: &Reader<'_, '_>,
    shell: Located<String>,
    is_solid: &dyn Fn(&Located<NodeReference>) -> Option<()>,
) -> Option<([Located<NodeReference>; 2], ShellContactEntry)> {
    let context = reader.context;
    let given = |key: &str| reader.node(key).map(|node| node.span);
    if let Some(other) = shell_of(reader, "base").or_else(|| beam_of(reader, "base")) {
        let message = format!("{} is between two flexible parts", reader.what);
        let help = "shells touch bodies, point masses and the ground: clamp bodies with a `shape` to the other part, and write a contact for each";
        return context.fail(other.span, message, help);
    }
    let base = context.node(reader.node("base")?, &reader.words("base"))?;
    is_solid(&base)?;
    let touching = match (given("stiffness"), given(OF_SHELLS)) {
        (Some(_), None) => TouchingShell::Nearest(reader.number("stiffness")?.value),
        (None, Some(_)) => TouchingShell::Nodes(reader.number(OF_SHELLS)?.value),
        (Some(span), Some(_)) => {
            let message = format!("{} has both `stiffness` and `{OF_SHELLS}`", reader.what);
            return context.fail(span, message, "remove one of them");
        }
        (None, None) => {
            let message = format!("{} has neither `stiffness` nor `{OF_SHELLS}`", reader.what);
            let help = "add `stiffness_per_area` for contact at the nodes of the shell, or `stiffness` for a ball where it is nearest";
            return context.fail(reader.name, message, help);
        }
    };
    let entry = ShellContactEntry {
        touching,
        exponent: reader.number("exponent")?.value,
        dissipation: if reader.has("dissipation") { reader.number("dissipation")?.value } else { 0.0 },
        friction: friction(reader),
        shell,
    };
    let (TouchingShell::Nodes(stiffness) | TouchingShell::Nearest(stiffness)) = touching;
    let law = Compliance { stiffness, exponent: entry.exponent };
    check_law(reader, (Some(law), entry.friction.as_ref()))?;
    let node = NodeReference::Mesh { part: entry.shell.value.clone(), place: MeshPlace::Set(ALL.to_owned()) };
    let tip = Located::new(node, entry.shell.span);
    Some(([base, tip], entry))
}
