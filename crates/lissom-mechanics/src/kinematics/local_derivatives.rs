//! Derivatives of several numbers with respect to nodes, coordinates and multipliers, and local matrices.

use nalgebra::SVector;

use super::{CoordinateId, NodeId};

/// Derivatives of `N` numbers, such as the force and moment of a joint: a column for each local unknown.
#[derive(Clone, Debug)]
pub struct LocalDerivatives<const N: usize> {
    /// Nodes; one may be named several times.
    pub nodes: Vec<NodeId>,
    /// Coordinates.
    pub coordinates: Vec<CoordinateId>,
    /// With respect to positions: six columns for each node, as body variations, then one for each coordinate.
    pub by_place: Vec<SVector<f64, N>>,
    /// Derivatives with respect to twists and rates, in the same columns.
    pub by_rate: Vec<SVector<f64, N>>,
    /// With respect to multipliers, from the first one of the joint.
    pub by_multiplier: Vec<SVector<f64, N>>,
}

impl<const N: usize> LocalDerivatives<N> {
    /// All zero.
    pub fn zero(nodes: Vec<NodeId>, coordinates: Vec<CoordinateId>, multipliers: usize) -> Self {
        let columns = vec![SVector::zeros(); 6 * nodes.len() + coordinates.len()];
        let by_multiplier = vec![SVector::zeros(); multipliers];
        Self { nodes, coordinates, by_place: columns.clone(), by_rate: columns, by_multiplier }
    }

    /// Passes every column to `change`.
    pub(crate) fn each(&mut self, change: impl Fn(&mut SVector<f64, N>)) {
        let columns = self.by_place.iter_mut().chain(&mut self.by_rate).chain(&mut self.by_multiplier);
        columns.for_each(change);
    }
}

/// Adds `block` to the local matrix at local rows from `row` and columns from `column`.
pub fn add_block<const R: usize, const C: usize>(
    matrix: &mut [f64],
    size: usize,
    (row, column): (usize, usize),
    block: &nalgebra::SMatrix<f64, R, C>,
) {
    for i in 0..R {
        for j in 0..C {
            matrix[(row + i) * size + column + j] += block[(i, j)];
        }
    }
}
