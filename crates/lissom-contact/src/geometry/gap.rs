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

/// Two solids that may touch in one point. A kind of pair is one file of `geometry/pairs`.
pub trait Pair: Debug + Send + Sync {
    /// The gap at a relative position x [m] and a relative rotation R.
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap;

    /// The value of the gap alone [m], equal to that of [`gap`](Self::gap) to the last bit: events need no derivatives.
    /// Default: they are computed as well.
    fn value(&self, x: &Vector3, rotation: &Matrix3) -> f64 {
        self.gap(x, rotation).value
    }

    /// Penetration at which the solids are within each other [m]: beyond it the nearest surfaces are those of the other side, or a
    /// sphere is below a plane.
    fn deepest(&self) -> f64;

    /// Largest change of the gap per change of the norm of R [m]; zero where it does not depend on R.
    fn reach(&self) -> f64;

    /// The penetration of a second side of the base, which the gap does not contain. Default: there is none.
    fn hollow(&self, _x: &Vector3) -> Option<Hollow> {
        None
    }

    /// Whether the base is the plane z = 0: the gap is then x₃ and a function of the third row of R. Default: it is not.
    fn is_on_plane(&self) -> bool {
        false
    }
}

/// Largest number of [`arguments`](dyn Pair::arguments).
pub(crate) const MAX_ARGUMENTS: usize = 12;

impl dyn Pair + '_ {
    /// Whether the gap is linear in x and independent of R.
    pub(crate) fn is_linear(&self) -> bool {
        self.is_on_plane() && self.reach() == 0.0
    }

    /// Number of components of x and, unless the gap is independent of it, of R, column by column, as arguments of a law.
    pub(crate) fn arguments(&self) -> usize {
        if self.reach() == 0.0 { 3 } else { MAX_ARGUMENTS }
    }

    /// The gap at these arguments.
    pub(crate) fn gap_at(&self, arguments: &[f64]) -> f64 {
        let (x, rotation) = arguments.split_at(3);
        let rotation =
            if rotation.is_empty() { Matrix3::identity() } else { Matrix3::from_column_slice(rotation) };
        self.value(&Vector3::from_column_slice(x), &rotation)
    }

    /// Range of the gap over ranges of the arguments: it changes by no more than x does and `reach` times R, and above a plane by no
    /// more than the height and the third row.
    pub(crate) fn range(&self, arguments: &[[f64; 2]]) -> [f64; 2] {
        let middle: [f64; MAX_ARGUMENTS] =
            std::array::from_fn(|k| arguments.get(k).map_or(0.0, |[low, high]| 0.5 * (low + high)));
        let gap = self.gap_at(&middle[..arguments.len()]);
        let counts = |k: &usize| !self.is_on_plane() || k % 3 == 2;
        let half = |all: &[[f64; 2]]| {
            let squares = (0..all.len()).filter(counts).map(|k| 0.25 * (all[k][1] - all[k][0]).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let change = half(&arguments[..3]) + self.reach() * half(&arguments[3..]);
        [gap - change, gap + change]
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
