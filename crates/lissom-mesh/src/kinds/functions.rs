//! Functions of the nodes of an element.

use lissom_motion::{Matrix3, Vector3};

/// Natural coordinates: of a hexahedron from -1 to 1, of a tetrahedron three of its four volume coordinates, of a wedge two of the area
/// coordinates of its triangle and one from -1 to 1.
pub type Natural = [f64; 3];

/// Writes values and derivatives with respect to the natural coordinates, each as many as there are nodes.
pub type Fill = fn(Natural, &mut [f64], &mut [Vector3]);

/// Points of quadrature with their weights, and their number.
pub type Rule = (fn(usize) -> (Natural, f64), usize);

/// Functions of the nodes at a place.
#[derive(Clone, Copy, Debug)]
pub struct Functions<const NODES: usize> {
    /// Values.
    pub values: [f64; NODES],
    /// Derivatives with respect to the natural coordinates.
    pub slopes: [Vector3; NODES],
}

/// An element whose nodes enclose no volume, or a negative one, somewhere.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("volume per natural coordinates is {volume:.3e} m³ at [{:.4}, {:.4}, {:.4}]", position.x, position.y, position.z)]
pub struct Inverted {
    /// Where [m].
    pub position: Vector3,
    /// Determinant of the derivatives of the position there [m³].
    pub volume: f64,
}

impl<const NODES: usize> Functions<NODES> {
    /// Functions of a kind that has `NODES` nodes.
    pub fn at(fill: Fill, place: Natural) -> Self {
        let mut functions = Self { values: [0.0; NODES], slopes: [Vector3::zeros(); NODES] };
        fill(place, &mut functions.values, &mut functions.slopes);
        functions
    }

    /// Derivatives of the functions with respect to the position, and the volume per natural coordinates.
    ///
    /// # Errors
    /// If the element is inverted there.
    pub fn gradients(&self, positions: &[Vector3; NODES]) -> Result<([Vector3; NODES], f64), Inverted> {
        let volume = volume((&self.values, &self.slopes), positions)?;
        let inverse = slope(&self.slopes, positions).try_inverse().unwrap_or_else(Matrix3::zeros);
        Ok((self.slopes.map(|slope| inverse.tr_mul(&slope)), volume))
    }
}

/// Derivatives of the position with respect to the natural coordinates.
fn slope(slopes: &[Vector3], positions: &[Vector3]) -> Matrix3 {
    positions.iter().zip(slopes).map(|(x, slope)| x * slope.transpose()).sum()
}

/// The volume per natural coordinates.
pub(super) fn volume((values, slopes): (&[f64], &[Vector3]), positions: &[Vector3]) -> Result<f64, Inverted> {
    let volume = slope(slopes, positions).determinant();
    if volume > 0.0 {
        return Ok(volume);
    }
    let position = positions.iter().zip(values).map(|(x, value)| *value * x).sum();
    Err(Inverted { position, volume })
}
