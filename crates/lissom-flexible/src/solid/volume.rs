//! A body of solid elements: nodes, elements and the nodes' shares of the mass, from a mesh of second order.

use std::sync::Arc;

use lissom_motion::{Matrix3, Motion, Vector3};

use super::law::SolidLaw;
use super::reference::{lumped, mass_matrix};
use super::{Hexahedron, Inverted, Tetrahedron, shape};
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::inertia::Inertia;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::elements::mass_distribution::MassDistribution;
use lissom_mechanics::kinematics::{Freedoms, NodeId};

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

/// Shares of the nodes in a force per volume on a tetrahedron: the integrals of their functions [m³]. Those of corners are negative.
///
/// # Errors
/// If it is inverted somewhere.
pub fn tetrahedron_shares(positions: &[Vector3; 10]) -> Result<[f64; 10], Inverted> {
    super::Reference::new(positions, shape::tetrahedron, shape::tetrahedron_points())?;
    Ok(mass_matrix(positions, shape::tetrahedron, &shape::tetrahedron_fine())?.map(|row| row.iter().sum()))
}

/// The same of a hexahedron.
///
/// # Errors
/// If it is inverted somewhere.
pub fn hexahedron_shares(positions: &[Vector3; 20]) -> Result<[f64; 20], Inverted> {
    super::Reference::new(positions, shape::hexahedron, shape::hexahedron_points())?;
    Ok(mass_matrix(positions, shape::hexahedron, &shape::hexahedron_fine())?.map(|row| row.iter().sum()))
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
    let (mut tetrahedra, mut hexahedra) = (Vec::new(), Vec::new());
    for own in volume.tetrahedra {
        let places = own.map(|node| positions[node]);
        let element_nodes = own.map(|node| nodes[node]);
        let element = Tetrahedron::new(element_nodes, &places, volume.law)?;
        tetrahedra.push(Arc::new(element.clone()));
        let volumes = mass_matrix(&places, shape::tetrahedron, &shape::tetrahedron_fine())?;
        contribution = with_mass(contribution.with(element), element_nodes, volumes, (model, volume.density));
    }
    for own in volume.hexahedra {
        let places = own.map(|node| positions[node]);
        let element_nodes = own.map(|node| nodes[node]);
        let element = Hexahedron::new(element_nodes, &places, volume.law)?;
        hexahedra.push(Arc::new(element.clone()));
        let volumes = mass_matrix(&places, shape::hexahedron, &shape::hexahedron_fine())?;
        contribution = with_mass(contribution.with(element), element_nodes, volumes, (model, volume.density));
    }
    Ok((contribution, SolidVolume { nodes, tetrahedra, hexahedra }))
}

/// With the mass of an element from its mass matrix for a density of 1 [m³]: lumped at its nodes, and the difference.
fn with_mass<const NODES: usize>(
    mut contribution: Contribution,
    nodes: [NodeId; NODES],
    mut matrix: Box<[[f64; NODES]; NODES]>,
    (model, density): (&InitialModel, f64),
) -> Contribution {
    matrix.as_flattened_mut().iter_mut().for_each(|entry| *entry *= density);
    let lumped = lumped(&matrix);
    for (node, own) in nodes.into_iter().zip(lumped) {
        contribution.add_inertia(node, Inertia::of_rigid_body(own, &Vector3::zeros(), &Matrix3::zeros()));
    }
    contribution.with(MassDistribution::of_points(nodes, matrix, &lumped, model.gravity.clone()))
}
