//! A solid element in its stress-free state: gradients of its functions at the points of quadrature.

use lissom_mesh::kinds::{Functions, Inverted, SolidKind};
use lissom_motion::Vector3;

/// The stress-free state.
#[derive(Clone, Debug)]
pub(super) struct Reference<const NODES: usize, const POINTS: usize> {
    /// Positions of the nodes [m].
    pub positions: [Vector3; NODES],
    /// Derivatives of the functions with respect to the position, at each point of quadrature, over the stretch of the free strain [1/m].
    pub gradients: [[Vector3; NODES]; POINTS],
    /// Volume of each point [m³].
    pub volumes: [f64; POINTS],
    /// The volume [m³].
    pub volume: f64,
    /// Strain without stress at each node, the same in all directions, as of a change of temperature.
    pub free: [f64; NODES],
    /// What it takes from the stretch at each point: free strain over one more than that.
    pub shrinking: [f64; POINTS],
}

impl<const NODES: usize, const POINTS: usize> Reference<NODES, POINTS> {
    /// Reference of an element of a kind with so many nodes and points of quadrature, at these positions before its free strains.
    pub(super) fn new(
        kind: &SolidKind,
        positions: &[Vector3; NODES],
        free: &[f64; NODES],
    ) -> Result<Box<Self>, Inverted> {
        let mut reference = Box::new(Self {
            positions: *positions,
            gradients: [[Vector3::zeros(); NODES]; POINTS],
            volumes: [0.0; POINTS],
            volume: 0.0,
            free: *free,
            shrinking: [0.0; POINTS],
        });
        for k in 0..POINTS {
            let (place, weight) = (kind.points.0)(k);
            let functions = Functions::at(kind.functions, place);
            let (own, volume) = functions.gradients(positions)?;
            let (stretch, shrinking) = reference.stretch(&functions);
            reference.gradients[k] = own.map(|slope| slope / stretch);
            reference.volumes[k] = weight * volume * stretch.powi(3);
            reference.shrinking[k] = shrinking;
        }
        reference.volume = reference.volumes.iter().sum();
        Ok(reference)
    }

    /// The stretch of the free strain at a place, and what it takes from the stretch there.
    pub(super) fn stretch(&self, functions: &Functions<NODES>) -> (f64, f64) {
        let free: f64 = functions.values.iter().zip(&self.free).map(|(value, own)| value * own).sum();
        (1.0 + free, free / (1.0 + free))
    }
}

/// The integrals of products of two functions: mass matrix of an element of density 1 [m³].
pub(super) fn mass_matrix<const NODES: usize>(
    kind: &SolidKind,
    positions: &[Vector3; NODES],
) -> Result<Box<[[f64; NODES]; NODES]>, Inverted> {
    let mut matrix = Box::new([[0.0; NODES]; NODES]);
    for (place, weight) in (0..kind.fine.1).map(kind.fine.0) {
        let functions = Functions::<NODES>::at(kind.functions, place);
        let volume = weight * functions.gradients(positions)?.1;
        for (row, value) in matrix.iter_mut().zip(functions.values) {
            row.iter_mut().zip(functions.values).for_each(|(sum, other)| *sum += volume * value * other);
        }
    }
    Ok(matrix)
}

/// Lumped masses from a mass matrix, all greater than zero: proportional to its diagonal [Hinton, Rock and Zienkiewicz 1976].
pub(super) fn lumped<const NODES: usize>(matrix: &[[f64; NODES]; NODES]) -> [f64; NODES] {
    let whole: f64 = matrix.as_flattened().iter().sum();
    let diagonal: [f64; NODES] = std::array::from_fn(|i| matrix[i][i]);
    let factor = whole / diagonal.iter().sum::<f64>();
    diagonal.map(|own| factor * own)
}
