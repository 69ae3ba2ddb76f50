//! Deformation of a superelement, in the unknowns of its given matrices: for outputs.

use lissom_motion::{Motion, Vector3};
use nalgebra::DMatrix;

use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, Kinematics, NodeId};
use lissom_mechanics::signals::frame_quantity::{FrameQuantity, Of};
use lissom_mechanics::signals::measurement::Measurement;

/// Location of the unknowns of a superelement's matrices.
#[derive(Clone, Debug)]
pub struct Deformation {
    /// Nodes of the interfaces.
    pub(super) nodes: Vec<NodeId>,
    /// Index of the interface that carries the floating frame.
    pub(super) floating: usize,
    /// Positions of the interfaces in the undeformed part [m].
    pub(super) places: Vec<Vector3>,
    /// Modal coordinates, and the factors from them to those of the matrices.
    pub(super) modes: Vec<(CoordinateId, f64)>,
}

impl Deformation {
    /// Nodes of the interfaces, in the order of the matrices.
    pub fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    /// Modal coordinates, in the order of the matrices.
    pub fn coordinates(&self) -> impl ExactSizeIterator<Item = CoordinateId> + '_ {
        self.modes.iter().map(|(coordinate, _)| *coordinate)
    }

    /// Number of unknowns: six of each interface and the modal coordinates.
    pub fn size(&self) -> usize {
        6 * self.nodes.len() + self.modes.len()
    }

    /// Modal coordinates, and the factor of each to the units of the matrices.
    pub fn modal(&self) -> impl Iterator<Item = (CoordinateId, f64)> + '_ {
        self.modes.iter().copied()
    }

    /// u: displacement [m] and rotation vector [rad] of each interface relative to the floating frame and in its axes, then the
    /// modal coordinates.
    pub fn unknowns(&self, at: &Kinematics) -> Vec<f64> {
        let base = &at.nodes[self.nodes[self.floating]].frame;
        let mut all = Vec::with_capacity(self.size());
        for (i, (&node, place)) in self.nodes.iter().zip(&self.places).enumerate() {
            let relative =
                if i == self.floating { Motion::IDENTITY } else { at.nodes[node].frame.relative_to(base) };
            let moved = relative.position - (place - self.places[self.floating]);
            all.extend(moved.iter().chain(relative.rotation.logarithm().iter()));
        }
        all.extend(self.modal().map(|(own, factor)| factor * at.coordinates[own].value));
        all
    }

    /// Derivatives of u with respect to the positions of the interfaces, as body variations, and to the modal coordinates.
    pub fn gradient(&self, at: &Kinematics) -> DMatrix<f64> {
        let mut gradient = DMatrix::zeros(self.size(), self.size());
        let observer = CarriedFrame::of_node(self.nodes[self.floating]);
        for (i, &node) in self.nodes.iter().enumerate().filter(|&(i, _)| i != self.floating) {
            let own = CarriedFrame::of_node(node);
            let pose = FrameQuantity::new(Of::Pose, own, Some(observer), None, Motion::IDENTITY);
            for component in 0..6 {
                let found = pose.gradient(component, at);
                for k in 0..6 {
                    gradient[(6 * i + component, 6 * i + k)] += found.by_place[k];
                    gradient[(6 * i + component, 6 * self.floating + k)] += found.by_place[6 + k];
                }
            }
        }
        let first = 6 * self.nodes.len();
        for (k, (_, factor)) in self.modal().enumerate() {
            gradient[(first + k, first + k)] = factor;
        }
        gradient
    }
}

#[cfg(test)]
#[path = "../../tests/unit/superelement/deformation.rs"]
mod tests;
