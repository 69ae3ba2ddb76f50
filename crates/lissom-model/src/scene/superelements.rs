//! Drawing of superelements: their interfaces, connected by lines to the one with the floating frame.

use lissom_motion::Vector3;

use super::connections::Joint;
use super::places::{Anchor, Places, Table};
use super::solids::{Axes, Tone};
use super::symbols::{Rod, Symbol};
use crate::document::Document;

/// Their entries, symbols of the interfaces, and the lines between them.
pub(super) fn superelements(document: &Document, places: &Places<'_>) -> (Vec<Joint>, Vec<Symbol>, Vec<Rod>) {
    let (mut joints, mut symbols, mut rods) = (Vec::new(), Vec::new(), Vec::new());
    let axes = Axes::of(&Vector3::x(), None);
    let table = Some(Table::Superelements);
    for element in &document.superelements {
        let name = &element.name.value;
        let Some(nodes) = places.of.names.superelements.get(name) else { continue };
        joints.push(Joint {
            name: name.clone(),
            kind: "superelement".to_owned(),
            parts: Vec::new(),
            anchors: None,
            axes: Vec::new(),
            joint: None,
        });
        let anchors: Vec<Anchor> = nodes.iter().map(|&node| Anchor { node, position: [0.0; 3] }).collect();
        for (index, &anchor) in anchors.iter().enumerate() {
            let is_floating = index == element.floating;
            let solid = if is_floating {
                axes.block([0.9, 0.9, 0.9], [0.0; 3], Tone::Light)
            } else {
                axes.ball(0.5, [0.0; 3], Tone::Light)
            };
            symbols.push(Symbol {
                name: name.clone(),
                table,
                anchor,
                around: 0.0,
                unit: None,
                solids: vec![solid],
            });
            if !is_floating {
                let anchors = [anchors[element.floating], anchor];
                rods.push(Rod { name: name.clone(), table, anchors, radius: None });
            }
        }
    }
    (joints, symbols, rods)
}
