//! A body of solid elements: nodes, elements and the nodes' shares of the mass, from a mesh of second order.

use std::sync::Arc;

use lissom_mesh::kinds::Inverted;
use lissom_mesh::{Element, MeshedPart};
use lissom_motion::{Motion, Vector3};

use super::kinds::{SolidElement, SolidMaterial, added};
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::kinematics::{Freedoms, NodeId};

/// Description of a body of solid elements.
pub struct VolumeDescription<'a> {
    /// Nodes and elements of second order.
    pub mesh: &'a MeshedPart,
    /// Name of each node.
    pub names: &'a dyn Fn(usize) -> String,
    /// What they consist of.
    pub material: SolidMaterial,
    /// Strain without stress at each node.
    pub free: &'a dyn Fn(usize) -> f64,
}

/// A body of solid elements as built.
#[derive(Clone)]
pub struct SolidVolume {
    /// Nodes of the volume.
    pub nodes: Vec<NodeId>,
    /// Elements of the volume, for outputs.
    pub elements: Vec<Arc<dyn SolidElement>>,
}

/// A body of solid elements.
///
/// # Errors
/// If an element is inverted somewhere.
pub fn solid_volume(
    model: &InitialModel,
    volume: &VolumeDescription<'_>,
) -> Result<(Contribution, SolidVolume), Inverted> {
    let mut contribution = Contribution::to(model);
    let add_node = |(node, position): (usize, &Vector3)| {
        contribution.add_node(&(volume.names)(node), Motion::translation(*position), Freedoms::Translations)
    };
    let nodes: Vec<NodeId> = volume.mesh.positions.iter().enumerate().map(add_node).collect();
    let mut elements = Vec::with_capacity(volume.mesh.elements.len());
    for Element { shape, nodes: own } in &volume.mesh.elements {
        let ids: Vec<NodeId> = own.iter().map(|&node| nodes[node]).collect();
        let positions = volume.mesh.positions_of(own);
        let free = |i: usize| (volume.free)(own[i]);
        let (with, element) =
            added(*shape, (contribution, model), (&ids, &positions, &free), &volume.material)?;
        contribution = with;
        elements.push(element);
    }
    Ok((contribution, SolidVolume { nodes, elements }))
}
