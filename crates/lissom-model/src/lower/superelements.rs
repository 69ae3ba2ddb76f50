//! Superelements as nodes, modal coordinates and elements.

use std::sync::Arc;

use lissom_flexible::superelement::{InterfacePlace, SuperelementDescription, superelement};
use lissom_mechanics::kinematics::NodeId;
use lissom_motion::{Motion, Rotation};
use lissom_system::Builder;

use super::names::Names;
use super::order::by_name;
use crate::document::Document;
use crate::outputs::Deformed;
use crate::reading::node_reference::interface_name;
use crate::text::report::Problem;

/// Adds all superelements to the system.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for element in by_name(&document.superelements, |element| &element.name.value) {
        let name = &element.name.value;
        let interfaces: Vec<InterfacePlace> = element
            .interfaces
            .iter()
            .map(|own| InterfacePlace { name: interface_name(name, &own.name), place: own.place })
            .collect();
        let description = SuperelementDescription {
            name,
            frame: Motion::new(Rotation::from_matrix(&element.axes), element.position),
            interfaces: &interfaces,
            floating: element.floating,
            matrices: element.matrices.clone(),
        };
        match superelement(builder.model(), &description) {
            Ok((contribution, unknowns)) => {
                builder.add(contribution);
                let nodes = unknowns.nodes().to_vec();
                let own: Vec<NodeId> = nodes.clone();
                let deformed = Deformed { unknowns: Arc::new(unknowns), recovery: element.recovery.clone() };
                names.deformations.insert(name.clone(), deformed);
                names.superelements.insert(name.clone(), own);
                names.nodes.extend(interfaces.into_iter().map(|interface| interface.name).zip(nodes));
            }
            Err(error) => problems.push(Problem::error(element.name.span, format!("`{name}`: {error}"))),
        }
    }
}
