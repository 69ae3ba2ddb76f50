//! Symbols of joints, springs and loads at their positions: solids that nodes carry, and rods between two nodes.

use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use super::dimensions;
use super::kinds::{Drawn, drawn};
use super::places::{Anchor, Places, Table, part_of};
use super::solids::{Axes, Solid};
use crate::document::{Attachment, Component, Document, NodeLocation};
use crate::reading::node_reference::NodeReference;
use crate::sections::Outline;
use crate::text::report::Located;
use lissom_mechanics::kinematics::{GROUND, NodeId};

/// Solids that one node carries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Symbol {
    /// Name of the joint, spring or load.
    pub name: String,
    /// Table of the entry; none in scenes of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// Where it is.
    pub anchor: Anchor,
    /// Half the thickness [m] of the thickest beam that ends there, which a symbol must not hide in.
    pub around: f64,
    /// Length [m] of which sizes and positions of its solids are multiples; none for symbols whose size depends on the picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// Solids of the symbol.
    pub solids: Vec<Solid>,
}

/// A straight rod between two positions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rod {
    /// Name of the joint, spring or load.
    pub name: String,
    /// Table of the entry; none in scenes of earlier versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Table>,
    /// Ends of the rod.
    pub anchors: [Anchor; 2],
    /// Radius of the rod [m]; none for those whose thickness depends on the picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
}

/// Symbols and rods of all components.
pub(super) fn symbols(document: &Document, places: &Places<'_>) -> (Vec<Symbol>, Vec<Rod>) {
    let (mut symbols, mut rods) = (Vec::new(), Vec::new());
    let tables = [
        (Table::Joints, &document.joints),
        (Table::Springs, &document.springs),
        (Table::Loads, &document.loads),
    ];
    let all = tables.into_iter().flat_map(|(table, list)| list.iter().map(move |each| (Some(table), each)));
    for (table, component) in all {
        let Some(kind @ (Drawn::Solids(solids) | Drawn::WithRod(solids))) = drawn(&component.kind.value)
        else {
            continue;
        };
        let Some(ends) = ends(component, document, places) else { continue };
        let dimensioned = dimensions::solids(component, document, places, &ends);
        let is_symbol = dimensioned.is_empty() || !dimensions::replace_symbol(component);
        symbols.extend(dimensioned.into_iter().map(|(anchor, solids)| Symbol {
            name: component.name.value.clone(),
            table,
            anchor,
            around: 0.0,
            unit: Some(1.0),
            solids,
        }));
        let axes = [ends[0].1, ends[ends.len().min(2) - 1].1];
        let [base, tip] = solids(&axes);
        // A relation of several coordinates has its sign at each of them.
        let of_others = if tip.is_empty() { &base } else { &tip };
        for (index, (anchor, _)) in ends.iter().enumerate() {
            let solids = match index {
                0 => &base,
                _ if component.attachment.nodes.is_empty() => of_others,
                _ => &tip,
            };
            let has_radius = component.attachment.nodes.get(index).is_some_and(|own| own.sheave.is_some());
            if is_symbol && !has_radius && !solids.is_empty() {
                symbols.push(Symbol {
                    name: component.name.value.clone(),
                    table,
                    anchor: *anchor,
                    around: thickness(document, places, anchor.node),
                    unit: None,
                    solids: solids.clone(),
                });
            }
        }
        if matches!(kind, Drawn::WithRod(_)) {
            let radius = component.parameters.number("diameter").ok().map(|diameter| 0.5 * diameter);
            let line = dimensions::rope_line(component, document, places)
                .unwrap_or_else(|| ends.iter().map(|(anchor, _)| *anchor).collect());
            rods.extend(line.windows(2).map(|pair| Rod {
                name: component.name.value.clone(),
                table,
                anchors: [pair[0], pair[1]],
                radius,
            }));
        }
    }
    (symbols, rods)
}

pub(super) type End = (Anchor, Axes);

/// Positions of a component with their axes: base and tip, one node, or those of the joints whose coordinates it acts on.
fn ends(component: &Component, document: &Document, places: &Places<'_>) -> Option<Vec<End>> {
    let end =
        |reference: &Located<NodeReference>, at: &Vector3, first: &Vector3, second: Option<&Vector3>| {
            let anchor = places.anchor(reference, at)?;
            let carried = |direction: &Vector3| places.frame(anchor.node).rotation.apply_inverse(direction);
            Some((anchor, Axes::of(&carried(first), second.map(carried).as_ref())))
        };
    let given = |key: &str| component.parameters.vector(key).ok();
    let Attachment { nodes, axes, coordinates, .. } = &component.attachment;
    // What has neither nodes nor coordinates of joints with nodes has no position.
    if nodes.is_empty() {
        let mut joints: Vec<&str> = coordinates.iter().map(|(joint, _)| joint.value.as_str()).collect();
        let of_joint = |joint: &&str| of_joint(joint, document, places);
        if component.ports.joints() > 0 {
            return joints.iter().map(of_joint).collect();
        }
        joints.dedup();
        let found: Vec<End> = joints.iter().filter_map(of_joint).collect();
        return (!found.is_empty()).then_some(found);
    }
    // Without an axis that matters, one that depends on the number of locations.
    let fallback = match (component.ports.connect_two_nodes(), component.ports.locations()) {
        (true, 1) => Vector3::y(),
        (true, _) => Vector3::x(),
        (false, _) => Vector3::z(),
    };
    let axis = |index: usize, key| axes.get(index).map(|axis| axis.value).or_else(|| given(key));
    let first = axis(0, "axis").unwrap_or(fallback);
    let second = axis(1, "second_axis");
    let on_tip = ["tip_axis", "wheel_axis", "axle"].into_iter().find_map(given).unwrap_or(first);
    let mut all = Vec::new();
    for (index, own) in nodes.iter().enumerate() {
        let direction = if index == 0 { first } else { on_tip };
        let own_position = || Some(places.frame(places.node(&own.node.value)?).position);
        let at = match own.at {
            // A wheel of a wheelset is beside the tip's position, outwards along the axle.
            Some(at) if component.kind.value == "wheel_on_rail" && index > 0 => {
                let centre = own_position()?;
                let outwards = on_tip.normalize() * on_tip.dot(&first).signum();
                let above = (at - centre).dot(&outwards);
                centre + component.parameters.number_or("offset", above).ok()? * outwards
            }
            Some(at) => at,
            None => own_position()?,
        };
        all.push(end(&own.node, &at, &direction, second.as_ref())?);
    }
    Some(all)
}

/// The base's position and axes of the joint called `name`.
fn of_joint(name: &str, document: &Document, places: &Places<'_>) -> Option<End> {
    let joint = document.joints.iter().find(|joint| joint.name.value == name)?;
    joint_ends(joint, document, places)?.first().copied()
}

/// Positions and axes of a joint on its base and its tip; none for other constraints.
pub(super) fn joint_ends(joint: &Component, document: &Document, places: &Places<'_>) -> Option<Vec<End>> {
    if joint.ports.connect_two_nodes() { ends(joint, document, places) } else { None }
}

/// Half the thickness of the thickest beam that ends at a node.
fn thickness(document: &Document, places: &Places<'_>, node: NodeId) -> f64 {
    let half = |outline: Outline| match outline {
        Outline::Circle { radius, .. } => radius,
        Outline::Rectangle { width, height } => 0.5 * width.min(height),
        Outline::Ellipse { width, height, .. } => width.min(height),
    };
    let ends_there = |beam: &&crate::document::Beam| {
        let line = places.of.names.lines.get(&beam.name.value);
        node != GROUND
            && line.is_some_and(|line| line.nodes.first() == Some(&node) || line.nodes.last() == Some(&node))
    };
    let beams = document.beams.iter().filter(ends_there);
    let sections =
        beams.flat_map(|beam| &beam.stations).filter_map(|station| document.section(&station.section.value));
    sections.map(|section| half(section.outline)).fold(0.0, f64::max)
}

/// Names of the parts at both ends, and where on them; nothing where a node is missing.
pub(super) fn attached(
    component: &Component,
    places: &Places<'_>,
) -> Option<(Vec<String>, Option<[Anchor; 2]>)> {
    let (true, [base, tip]) = (component.ports.connect_two_nodes(), component.attachment.nodes.as_slice())
    else {
        return Some((Vec::new(), None));
    };
    let names = [base, tip].map(|end| part_of(&end.node.value).to_owned());
    let anchor = |own: &NodeLocation| {
        let at = own.at.map_or_else(|| Some(places.frame(places.node(&own.node.value)?).position), Some)?;
        places.anchor(&own.node, &at)
    };
    Some((names.into(), Some([anchor(base)?, anchor(tip)?])))
}

#[cfg(test)]
#[path = "../../tests/unit/scene/symbols.rs"]
mod tests;
