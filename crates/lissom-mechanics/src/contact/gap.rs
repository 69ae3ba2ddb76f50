//! The gap between two solids where they are nearest, with the point of contact.
//!
//! Legend: (R, x) tip's frame in the axes of the base's solid; g gap, n normal out of the base's solid, p point of contact on the
//! base's surface; η variation of the tip's frame in its own axes, δx = R η_v, δR = R skew(η_θ).
//!
//! ```text
//! δg = n·R (η_v + η_θ × d),      d = Rᵀ(p - x)
//! ```
//!
//! The normal force is then the derivative of an energy.

use std::fmt::Debug;

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::SMatrix;

use super::hollow::Hollow;

/// Derivatives of a vector with respect to η.
pub type Matrix3x6 = SMatrix<f64, 3, 6>;

/// A gap with the derivatives of normal and point of contact.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// g [m]; negative for penetration.
    pub value: f64,
    /// n.
    pub normal: Vector3,
    /// p [m].
    pub point: Vector3,
    /// ∂n/∂η.
    pub normal_by: Matrix3x6,
    /// ∂p/∂η.
    pub point_by: Matrix3x6,
}

/// Two solids that may touch in one point. A kind of pair is one file of `contact/pairs`.
pub trait Pair: Debug + Send + Sync {
    /// The gap at a relative position x [m] and a relative rotation R.
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap;

    /// Penetration at which the solids are within each other [m]: beyond it the nearest surfaces are those of the other side, or a
    /// sphere is below a plane.
    fn deepest(&self) -> f64;

    /// Largest change of the gap per change of the norm of R [m]; zero where it does not depend on R.
    fn reach(&self) -> f64;

    /// The penetration of a second side of the base, which the gap does not contain. Default: there is none.
    fn hollow(&self, _x: &Vector3) -> Option<Hollow> {
        None
    }

    /// Whether the gap is linear in x and independent of R. Default: it is not.
    fn is_linear(&self) -> bool {
        false
    }
}

/// ∂y/∂η of a point y = x + R c of the tip.
pub(super) fn carried(rotation: &Matrix3, point: &Vector3) -> Matrix3x6 {
    side_by_side(rotation, &(-rotation * skew(point)))
}

/// Two blocks of columns.
pub(crate) fn side_by_side(left: &Matrix3, right: &Matrix3) -> Matrix3x6 {
    let mut both = Matrix3x6::zeros();
    both.fixed_columns_mut::<3>(0).copy_from(left);
    both.fixed_columns_mut::<3>(3).copy_from(right);
    both
}
