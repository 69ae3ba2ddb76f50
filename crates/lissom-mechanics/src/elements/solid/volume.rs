//! A body of solid elements: nodes, elements and the nodes' shares of the mass, from a mesh of second order.

use std::sync::Arc;

use lissom_motion::{Matrix3, Motion, Vector3};

use super::law::SolidLaw;
use super::reference::lumped_volumes;
use super::{Hexahedron, Inverted, Tetrahedron, shape};
use crate::elements::contribution::Contribution;
use crate::elements::inertia::Inertia;
use crate::elements::initial_model::InitialModel;
use crate::kinematics::{Freedoms, NodeId};

/// Description of a body of solid elements.
pub struct VolumeDescription<'a> {
    /// Position of each node [m].
    pub positions: &'a [Vector3],
    /// Name of each node.
    pub names: &'a dyn Fn(usize) -> String,
    /// Nodes of each tetrahedron, in the order of Abaqus.
    pub tetrahedra: &'a [[usize; 10]],
    /// Nodes of each hexahedron.
    pub hexahedra: &'a [[usize; 20]],
    /// Elastic law.
    pub law: SolidLaw,
    /// Mass density [kg/m³].
    pub density: f64,
}

/// A body of solid elements as built.
#[derive(Clone, Debug)]
pub struct SolidVolume {
    /// Its nodes.
    pub nodes: Vec<NodeId>,
    /// Its tetrahedra, for outputs.
    pub tetrahedra: Vec<Arc<Tetrahedron>>,
    /// Its hexahedra.
    pub hexahedra: Vec<Arc<Hexahedron>>,
}

/// Volumes of the nodes of a tetrahedron [m³]: their shares of its mass.
///
/// # Errors
/// If it is inverted somewhere.
pub fn tetrahedron_shares(positions: &[Vector3; 10]) -> Result<[f64; 10], Inverted> {
    super::Reference::new(positions, shape::tetrahedron, shape::tetrahedron_points())?;
    lumped_volumes(positions, shape::tetrahedron, &shape::tetrahedron_fine())
}

/// The same of a hexahedron.
///
/// # Errors
/// If it is inverted somewhere.
pub fn hexahedron_shares(positions: &[Vector3; 20]) -> Result<[f64; 20], Inverted> {
    super::Reference::new(positions, shape::hexahedron, shape::hexahedron_points())?;
    lumped_volumes(positions, shape::hexahedron, &shape::hexahedron_fine())
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
    let positions = volume.positions;
    let add_node = |(node, position): (usize, &Vector3)| {
        contribution.add_node(&(volume.names)(node), Motion::translation(*position), Freedoms::Translations)
    };
    let nodes: Vec<NodeId> = positions.iter().enumerate().map(add_node).collect();
    let mut volumes = vec![0.0; nodes.len()];
    let (mut tetrahedra, mut hexahedra) = (Vec::new(), Vec::new());
    for own in volume.tetrahedra {
        let places = own.map(|node| positions[node]);
        let element = Tetrahedron::new(own.map(|node| nodes[node]), &places, volume.law)?;
        let shares = tetrahedron_shares(&places)?;
        own.iter().zip(shares).for_each(|(&node, share)| volumes[node] += share);
        tetrahedra.push(Arc::new(element.clone()));
        contribution = contribution.with(element);
    }
    for own in volume.hexahedra {
        let places = own.map(|node| positions[node]);
        let element = Hexahedron::new(own.map(|node| nodes[node]), &places, volume.law)?;
        let shares = hexahedron_shares(&places)?;
        own.iter().zip(shares).for_each(|(&node, share)| volumes[node] += share);
        hexahedra.push(Arc::new(element.clone()));
        contribution = contribution.with(element);
    }
    for (&node, own) in nodes.iter().zip(volumes) {
        let mass = Inertia::of_rigid_body(volume.density * own, &Vector3::zeros(), &Matrix3::zeros());
        contribution.add_inertia(node, mass);
    }
    Ok((contribution, SolidVolume { nodes, tetrahedra, hexahedra }))
}
