//! Elements of each kind, by their numbers of nodes and points of quadrature, and what is common to all.

use std::sync::Arc;

use lissom_mesh::MeshShape;
use lissom_mesh::kinds::{Inverted, SOLID_KINDS, SolidKind};
use lissom_motion::{Matrix3, Vector3};

use super::Solid;
use super::damping::SolidDamping;
use super::law::SolidLaw;
use super::reference::{Reference, lumped, mass_matrix};
use super::stress::CauchyStress;
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::inertia::Inertia;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::elements::mass_distribution::MassDistribution;
use lissom_mechanics::kinematics::{Kinematics, NodeId};

/// A solid element of any kind, as outputs, pictures and files need it.
pub trait SolidElement: Send + Sync {
    /// Nodes of the element, in the order of Abaqus.
    fn node_ids(&self) -> &[NodeId];

    /// Volume of the element at rest, before its free strains [m³].
    fn volume(&self) -> f64;

    /// Strain energy of the element [J].
    fn strain(&self, at: &Kinematics) -> f64;

    /// Visits the stresses at its nodes, each with the place of the node among its own.
    fn visit_stresses(&self, at: &Kinematics, visit: &mut dyn FnMut(usize, &CauchyStress));
}

impl<const NODES: usize, const POINTS: usize> SolidElement for Solid<NODES, POINTS> {
    fn node_ids(&self) -> &[NodeId] {
        &self.nodes
    }

    fn volume(&self) -> f64 {
        let Reference { volumes, shrinking, .. } = &*self.reference;
        volumes.iter().zip(shrinking).map(|(volume, shrinking)| volume * (1.0 - shrinking).powi(3)).sum()
    }

    fn strain(&self, at: &Kinematics) -> f64 {
        self.strain_energy(&self.positions(at))
    }

    fn visit_stresses(&self, at: &Kinematics, visit: &mut dyn FnMut(usize, &CauchyStress)) {
        let stresses = self.nodal_stresses(&self.positions(at));
        stresses.iter().enumerate().for_each(|(node, stress)| visit(node, stress));
    }
}

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    /// An element of a kind with so many nodes and points of quadrature, stress-free with its nodes at `positions` [m] except for the
    /// strains `free` at them, the same in all directions.
    ///
    /// # Errors
    /// If it is inverted somewhere.
    pub fn new(
        kind: &'static SolidKind,
        nodes: [NodeId; NODES],
        (positions, free): (&[Vector3; NODES], &[f64; NODES]),
        law: SolidLaw,
    ) -> Result<Self, Inverted> {
        Ok(Self { kind, nodes, reference: Reference::new(kind, positions, free)?.into(), law })
    }

    fn of(
        kind: &'static SolidKind,
        nodes: &[NodeId],
        (positions, free): (&[Vector3], &dyn Fn(usize) -> f64),
        law: SolidLaw,
    ) -> Result<Self, Inverted> {
        let places = std::array::from_fn(|i| positions[i]);
        Self::new(kind, std::array::from_fn(|i| nodes[i]), (&places, &std::array::from_fn(free)), law)
    }
}

/// What elements consist of.
#[derive(Clone, Copy, Debug)]
pub struct SolidMaterial {
    /// Elastic law.
    pub law: SolidLaw,
    /// Mass density [kg/m³].
    pub density: f64,
    /// Damping in proportion to the stiffness [s].
    pub damping: f64,
}

/// Calls a function with the numbers of nodes and points of a kind.
macro_rules! for_kind {
    ($kind:expr, $of:ident($($argument:expr),*)) => {
        match $kind.node_count() {
            10 => $of::<10, 4>($kind, $($argument),*),
            15 => $of::<15, 9>($kind, $($argument),*),
            _ => $of::<20, 21>($kind, $($argument),*),
        }
    };
}

fn shared<const NODES: usize, const POINTS: usize>(
    kind: &'static SolidKind,
    nodes: &[NodeId],
    reference: (&[Vector3], &dyn Fn(usize) -> f64),
    law: SolidLaw,
) -> Result<Arc<dyn SolidElement>, Inverted> {
    Ok(Arc::new(Solid::<NODES, POINTS>::of(kind, nodes, reference, law)?))
}

/// The element of a kind by its name, with positions of its nodes and free strains there; none if there is no such kind, or if it is
/// inverted.
pub fn element(
    kind: &str,
    nodes: &[NodeId],
    reference: (&[Vector3], &dyn Fn(usize) -> f64),
    law: SolidLaw,
) -> Option<Arc<dyn SolidElement>> {
    let kind = *SOLID_KINDS.iter().find(|own| own.word == kind && own.node_count() == nodes.len())?;
    for_kind!(kind, shared(nodes, reference, law)).ok()
}

/// The element of a shape, added to a contribution with its mass: lumped at its nodes, and the difference.
pub(super) fn added(
    shape: MeshShape,
    into: (Contribution, &InitialModel),
    places: (&[NodeId], &[Vector3], &dyn Fn(usize) -> f64),
    material: &SolidMaterial,
) -> Result<(Contribution, Arc<dyn SolidElement>), Inverted> {
    let kind = shape.solid_kind().map_or(SOLID_KINDS[0], |(kind, _)| kind);
    for_kind!(kind, with_mass(into, places, material))
}

fn with_mass<const NODES: usize, const POINTS: usize>(
    kind: &'static SolidKind,
    (mut contribution, model): (Contribution, &InitialModel),
    (nodes, positions, free): (&[NodeId], &[Vector3], &dyn Fn(usize) -> f64),
    material: &SolidMaterial,
) -> Result<(Contribution, Arc<dyn SolidElement>), Inverted> {
    let element = Solid::<NODES, POINTS>::of(kind, nodes, (positions, free), material.law)?;
    let mut matrix = mass_matrix(kind, &element.reference.positions)?;
    matrix.as_flattened_mut().iter_mut().for_each(|entry| *entry *= material.density);
    let lumped = lumped(&matrix);
    for (node, own) in element.nodes.into_iter().zip(lumped) {
        contribution.add_inertia(node, Inertia::of_rigid_body(own, &Vector3::zeros(), &Matrix3::zeros()));
    }
    let mass = MassDistribution::of_points(element.nodes, matrix, &lumped, model.gravity.clone());
    contribution = contribution.with(element.clone()).with(mass);
    if material.damping > 0.0 {
        contribution = contribution.with(SolidDamping::new(element.clone(), material.damping));
    }
    Ok((contribution, Arc::new(element)))
}
