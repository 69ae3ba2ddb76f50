//! A solid element in its stress-free state: gradients of its functions at the points of quadrature.

use lissom_motion::{Matrix3, Vector3};

use super::shape::{Functions, Natural};

/// An element whose nodes enclose no volume, or a negative one, somewhere.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("volume per natural coordinates is {volume:.3e} m³ at [{:.4}, {:.4}, {:.4}]", position.x, position.y, position.z)]
pub struct Inverted {
    /// Where [m].
    pub position: Vector3,
    /// Determinant of the derivatives of the position there [m³].
    pub volume: f64,
}

/// The stress-free state.
#[derive(Clone, Debug)]
pub(super) struct Reference<const NODES: usize, const POINTS: usize> {
    /// Positions of the nodes [m].
    pub positions: [Vector3; NODES],
    /// Derivatives of the functions with respect to the position, at each point of quadrature [1/m].
    pub gradients: [[Vector3; NODES]; POINTS],
    /// Volume of each point [m³].
    pub volumes: [f64; POINTS],
    /// The volume [m³].
    pub volume: f64,
}

/// Derivatives of the functions with respect to the position, and the volume per natural coordinates.
pub(super) fn gradients<const NODES: usize>(
    functions: &Functions<NODES>,
    positions: &[Vector3; NODES],
) -> Result<([Vector3; NODES], f64), Inverted> {
    let slope: Matrix3 =
        positions.iter().zip(&functions.slopes).map(|(x, slope)| x * slope.transpose()).sum();
    let volume = slope.determinant();
    match slope.try_inverse() {
        Some(inverse) if volume > 0.0 => Ok((functions.slopes.map(|slope| inverse.tr_mul(&slope)), volume)),
        _ => {
            let position = positions.iter().zip(functions.values).map(|(x, value)| value * x).sum();
            Err(Inverted { position, volume })
        }
    }
}

impl<const NODES: usize, const POINTS: usize> Reference<NODES, POINTS> {
    pub(super) fn new(
        positions: &[Vector3; NODES],
        functions: fn(Natural) -> Functions<NODES>,
        points: [(Natural, f64); POINTS],
    ) -> Result<Box<Self>, Inverted> {
        let mut reference = Box::new(Self {
            positions: *positions,
            gradients: [[Vector3::zeros(); NODES]; POINTS],
            volumes: [0.0; POINTS],
            volume: 0.0,
        });
        for (k, (place, weight)) in points.into_iter().enumerate() {
            let (own, volume) = gradients(&functions(place), positions)?;
            reference.gradients[k] = own;
            reference.volumes[k] = weight * volume;
        }
        reference.volume = reference.volumes.iter().sum();
        Ok(reference)
    }
}

/// The integrals of products of two functions: mass matrix of an element of density 1 [m³].
pub(super) fn mass_matrix<const NODES: usize>(
    positions: &[Vector3; NODES],
    functions: fn(Natural) -> Functions<NODES>,
    points: &[(Natural, f64)],
) -> Result<Box<[[f64; NODES]; NODES]>, Inverted> {
    let mut matrix = Box::new([[0.0; NODES]; NODES]);
    for &(place, weight) in points {
        let functions = functions(place);
        let volume = weight * gradients(&functions, positions)?.1;
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
