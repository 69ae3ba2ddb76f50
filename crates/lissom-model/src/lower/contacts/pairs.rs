//! The points at which the solids of a contact may touch.

use std::sync::Arc;

use lissom_contact::forms::{Meeting, PlacedSolid, meetings};
use lissom_contact::geometry::gap::Pair;
use lissom_mechanics::kinematics::CarriedFrame;

use super::super::names::Names;
use crate::document::{ContactEntry, Document, NodeLocation};
use crate::reading::node_reference::NodeReference;
use crate::text::report::{Located, Problem};

/// The solids of a part.
pub(super) fn solids<'d>(document: &'d Document, part: &NodeReference) -> &'d [PlacedSolid] {
    let found = match part {
        NodeReference::Body(name) => {
            document.bodies.iter().find(|body| body.name.value == *name).map(|body| &body.solids)
        }
        NodeReference::PointMass(name) => {
            document.point_masses.iter().find(|mass| mass.name.value == *name).map(|mass| &mass.solids)
        }
        _ => Some(&document.ground.solids),
    };
    found.map_or(&[], Vec::as_slice)
}

/// A point at which two solids may touch.
pub(super) struct PointOfSolids<'d> {
    /// Solids of the parts of the contact.
    pub(super) solids: [&'d PlacedSolid; 2],
    pub(super) pair: Arc<dyn Pair>,
    /// Base and tip.
    pub(super) frames: [CarriedFrame; 2],
    /// Which of both frames is of the first part of the contact, if one is.
    pub(super) of_first: Option<usize>,
    /// 1 if the tip is that of the contact, otherwise -1.
    pub(super) sign: f64,
    /// The parts in words, and the number of the point among theirs.
    pub(super) parts: String,
    pub(super) number: usize,
}

/// The points at which the solids of a contact may touch.
pub(super) fn points_of_solids<'d>(
    document: &'d Document,
    entry: &ContactEntry,
    names: &Names,
) -> Result<Vec<PointOfSolids<'d>>, Problem> {
    let name = &entry.name.value;
    let mut all = Vec::new();
    for parts in entry.pairs() {
        check_clamp(document, name, parts)?;
        let nodes = [names.node(parts[0])?, names.node(parts[1])?];
        let words = parts.map(|part| match &part.value {
            NodeReference::Body(name) | NodeReference::PointMass(name) => name.as_str(),
            _ => "ground",
        });
        let [first, second] = parts.map(|part| solids(document, &part.value));
        let mut number = 0;
        for solids in first.iter().flat_map(|one| second.iter().map(move |other| [one, other])) {
            for Meeting { pair, sides, frames, .. } in meetings_of(entry, solids)? {
                let carried = |k: usize| CarriedFrame { node: nodes[sides[k]], offset: frames[k] };
                let sign = if sides == [0, 1] { 1.0 } else { -1.0 };
                let is_first = parts[0].value == entry.between[0].value;
                let of_first = is_first.then(|| usize::from(sides == [1, 0]));
                let (frames, parts) = ([0, 1].map(carried), words.join(" and "));
                all.push(PointOfSolids { solids, pair, frames, of_first, sign, parts, number });
                number += 1;
            }
        }
    }
    Ok(all)
}

/// The points at which two solids of a contact may touch.
pub(super) fn meetings_of(entry: &ContactEntry, solids: [&PlacedSolid; 2]) -> Result<Vec<Meeting>, Problem> {
    let name = &entry.name.value;
    let found = meetings(solids, false).map_err(|error| {
        let message = format!("contact `{name}`: a mesh of its parts is no solid: {error}");
        Problem::error(entry.name.span, message).help("repair the file, or use solids that have its shape")
    })?;
    found.ok_or_else(|| {
        let [one, other] = solids.map(|solid| solid.form.kind().words());
        let message = format!("contact `{name}`: {one} against {other} is not available");
        Problem::error(entry.name.span, message).help("one of them can be made of spheres, or be a plane")
    })
}

/// Rejects a contact of two parts that a clamp makes one.
pub(super) fn check_clamp(
    document: &Document,
    name: &str,
    parts: [&Located<NodeReference>; 2],
) -> Result<(), Problem> {
    let Some(clamp) = clamp_between(document, parts.map(|part| &part.value)) else { return Ok(()) };
    let message = format!("contact `{name}` is between parts that the clamp `{clamp}` makes one rigid part");
    Err(Problem::error(parts[1].span, message)
        .help("remove the contact, or join the parts by a joint that moves"))
}

/// The clamp between two parts, if there is one.
fn clamp_between<'d>(document: &'d Document, parts: [&NodeReference; 2]) -> Option<&'d str> {
    let joins =
        |nodes: &[NodeLocation]| parts.iter().all(|part| nodes.iter().any(|at| at.node.value == **part));
    let mut clamps = document.joints.iter().filter(|joint| joint.kind.value == "clamp");
    clamps.find(|clamp| joins(&clamp.attachment.nodes)).map(|clamp| clamp.name.value.as_str())
}
