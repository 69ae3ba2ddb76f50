//! Solid elements of second order whose nodes have positions only, of the kinds of `lissom-mesh`. Elastic forces; their inertia is added by
//! `volume`.
//!
//! Legend: x_I position of node I, G_I derivative of its function with respect to the position at rest, w volume of a point of
//! quadrature, P first Piola-Kirchhoff stress, see `law`.
//!
//! ```text
//! F = Σ x_I G_Iᵀ,      f_I = Σ w P(F) G_I
//! ```
//!
//! Everything refers to the stress-free state: there is no history. Nodes have no rotation, and their axes are global.

pub mod damping;
mod deformation;
mod kinds;
pub mod law;
mod reference;
mod stage_forces;
mod stress;
mod tangent;
pub mod volume;

use std::sync::Arc;

use lissom_mesh::kinds::SolidKind;
use lissom_motion::{Matrix3, Vector3};

use self::deformation::Deformation;
use self::law::{SolidLaw, SolidModel};
use self::reference::Reference;
use lissom_mechanics::elements::{Capabilities, Deformable, Element, Energy, Tangents, Unknowns};
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages};
use lissom_mechanics::kinematics::{Kinematics, NodeId, Stressed};

pub use self::kinds::{SolidElement, SolidMaterial, element};
pub use self::stress::{CauchyStress, principal, von_mises};

/// A solid element. Constants are shared by copies.
#[derive(Clone, Debug)]
pub struct Solid<const NODES: usize, const POINTS: usize> {
    kind: &'static SolidKind,
    nodes: [NodeId; NODES],
    reference: Arc<Reference<NODES, POINTS>>,
    law: SolidLaw,
}

/// The deformation at all points of quadrature.
struct Deformed<const POINTS: usize> {
    points: [Deformation; POINTS],
    /// Pressure of the mean dilatation, positive in tension [Pa].
    mean: f64,
}

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    /// Nodes of the element, in the order of Abaqus.
    pub fn nodes(&self) -> &[NodeId; NODES] {
        &self.nodes
    }

    /// Elastic law of the element.
    pub fn law(&self) -> &SolidLaw {
        &self.law
    }

    /// Positions of its nodes [m].
    pub fn positions(&self, at: &Kinematics) -> [Vector3; NODES] {
        self.nodes.map(|node| at.nodes[node].frame.position)
    }

    /// Displacements relative to that of the first node.
    fn displacements(&self, positions: &[Vector3; NODES]) -> [Vector3; NODES] {
        let shift = |i: usize| positions[i] - self.reference.positions[i];
        let first = shift(0);
        std::array::from_fn(|i| shift(i) - first)
    }

    fn deformed(&self, at: &Kinematics) -> Deformed<POINTS> {
        self.deformed_to(&self.positions(at))
    }

    fn deformed_to(&self, positions: &[Vector3; NODES]) -> Deformed<POINTS> {
        let displacements = self.displacements(positions);
        let Reference { gradients, shrinking, .. } = &*self.reference;
        let points = std::array::from_fn(|p| Deformation::new(&displacements, &gradients[p], shrinking[p]));
        let mean = self.law.bulk_of_mean() * self.mean_dilatation(&points);
        Deformed { points, mean }
    }

    /// Velocities of the nodes, global axes [m/s].
    fn velocities_at_nodes(&self, at: &Kinematics) -> [Vector3; NODES] {
        self.nodes.map(|node| {
            let own = &at.nodes[node];
            own.frame.rotation.apply(&own.twist.fixed_rows::<3>(0).into())
        })
    }

    /// V/V₀ - 1.
    fn mean_dilatation(&self, points: &[Deformation; POINTS]) -> f64 {
        let volumes = self.reference.volumes.iter();
        points.iter().zip(volumes).map(|(point, volume)| volume * point.dilatation()).sum::<f64>()
            / self.reference.volume
    }

    /// Derivatives of its volume by the positions of its nodes [m²].
    fn volume_slopes(&self, points: &[Deformation; POINTS]) -> [Vector3; NODES] {
        let mut sums = [Vector3::zeros(); NODES];
        for ((point, slopes), volume) in
            points.iter().zip(&self.reference.gradients).zip(&self.reference.volumes)
        {
            for (sum, slope) in sums.iter_mut().zip(slopes) {
                *sum += volume * point.determinant * (point.inverse_transpose * slope);
            }
        }
        sums
    }

    /// Strain energy with its nodes at these positions [J].
    pub fn strain_energy(&self, positions: &[Vector3; NODES]) -> f64 {
        let Deformed { points, mean } = self.deformed_to(positions);
        let volumes = self.reference.volumes.iter();
        let at_points: f64 = points.iter().zip(volumes).map(|(point, w)| w * self.law.energy(point)).sum();
        at_points + 0.5 * mean * self.mean_dilatation(&points) * self.reference.volume
    }

    /// Adds Σ w P G_I.
    fn add_forces(&self, stresses: impl Iterator<Item = Matrix3>, out: &mut [f64]) {
        let Reference { gradients, volumes, .. } = &*self.reference;
        for ((stress, slopes), volume) in stresses.zip(gradients).zip(volumes) {
            let stress = *volume * stress;
            for (slope, out) in slopes.iter().zip(out.chunks_exact_mut(6)) {
                out.iter_mut().zip(&(stress * slope)).for_each(|(sum, value)| *sum += value);
            }
        }
    }
}

impl<const NODES: usize, const POINTS: usize> Element for Solid<NODES, POINTS> {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns::of_nodes(&self.nodes)
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let Deformed { points, mean } = self.deformed(at);
        self.add_forces(points.iter().map(|point| self.law.first_stress(point, mean)), out);
    }

    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        match self.law.model {
            SolidModel::StVenantKirchhoff => self.add_forces_of_strains(step, out),
            SolidModel::Rubber => self.add_forces_of_energy(step, out),
        }
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        self.linearize_stressed(at, at.into(), out);
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        Energy { strain: self.strain_energy(&self.positions(at)), ..Energy::default() }
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { deformation: Some(self), ..Capabilities::default() }
    }
}

impl<const NODES: usize, const POINTS: usize> Deformable for Solid<NODES, POINTS> {
    fn linearize_stressed(&self, at: &Kinematics, stressed: Stressed<'_>, out: &mut Tangents) {
        self.add_tangent(at, stressed, out);
    }

    fn predicts_stresses(&self) -> bool {
        true
    }

    /// The largest strain rate at a point.
    fn deformation_rate(&self, at: &Kinematics) -> Option<(f64, NodeId)> {
        let velocities = self.velocities_at_nodes(at);
        let rate = |(point, slopes): (&Deformation, &[Vector3; NODES])| {
            let rate: Matrix3 = velocities.iter().zip(slopes).map(|(v, slope)| v * slope.transpose()).sum();
            let rate = rate * point.inverse_transpose.transpose();
            0.5 * (rate + rate.transpose()).norm()
        };
        let points = self.deformed(at).points;
        let rates = points.iter().zip(&self.reference.gradients).map(rate);
        Some((rates.fold(0.0, f64::max), self.nodes[0]))
    }

    fn max_relative_rotation(&self, _: &Kinematics) -> Option<(f64, [NodeId; 2])> {
        None
    }
}
