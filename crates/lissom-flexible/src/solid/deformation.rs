//! The deformation at a point of a solid.

use lissom_motion::{Matrix3, Vector3};

/// A deformation relative to the state without stress. All is NaN where the solid is turned inside out, J ≤ 0, so that no iteration converges there and the step is repeated
/// with half its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deformation {
    /// Derivatives of the displacement with respect to the position at rest, H = F - 1.
    pub displacement: Matrix3,
    /// Derivatives of the position, F.
    pub gradient: Matrix3,
    /// J = det F.
    pub determinant: f64,
    /// F⁻ᵀ.
    pub inverse_transpose: Matrix3,
}

impl Deformation {
    /// With slopes over the stretch 1 + a of a free strain a: F = (1 + H)/(1 + a), of which `shrinking`, a/(1 + a), is missing.
    pub(super) fn new<const NODES: usize>(
        displacements: &[Vector3; NODES],
        slopes: &[Vector3; NODES],
        shrinking: f64,
    ) -> Self {
        let displacement: Matrix3 =
            displacements.iter().zip(slopes).map(|(shift, slope)| shift * slope.transpose()).sum();
        let displacement = displacement - Matrix3::from_diagonal_element(shrinking);
        let gradient = Matrix3::identity() + displacement;
        let determinant = gradient.determinant();
        let nowhere = Matrix3::repeat(f64::NAN);
        let inside_out = Self {
            displacement: nowhere,
            gradient: nowhere,
            determinant: f64::NAN,
            inverse_transpose: nowhere,
        };
        match gradient.try_inverse() {
            Some(inverse) if determinant > 0.0 => {
                Self { displacement, gradient, determinant, inverse_transpose: inverse.transpose() }
            }
            _ => inside_out,
        }
    }

    /// J - 1 without cancellation: tr H + (tr²H - tr H²)/2 + det H.
    pub(super) fn dilatation(&self) -> f64 {
        let slopes = &self.displacement;
        let first = slopes.trace();
        first + 0.5 * (first * first - (slopes * slopes).trace()) + slopes.determinant()
    }

    /// Green-Lagrange strain (H + Hᵀ + HᵀH)/2.
    pub(super) fn strain(&self) -> Matrix3 {
        let slopes = &self.displacement;
        0.5 * (slopes + slopes.transpose() + slopes.tr_mul(slopes))
    }
}
