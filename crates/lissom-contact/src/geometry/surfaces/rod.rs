//! A rod with hemispherical ends: a capsule, and a sphere where its length is zero.
//!
//! ```text
//! d = y - (0, 0, clamp(y₃, -h, h)),   φ = |d| - ρ,   n = d/|d|,   H = (I - n nᵀ - e₃ e₃ᵀ)/|d|, at the ends without e₃ e₃ᵀ
//! ```

use lissom_motion::{Matrix3, Vector3};

use super::{Distance, Surface};

/// A rod along the third axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// Half the length between the centres of its ends, h [m].
    pub half_length: f64,
    /// Radius ρ [m].
    pub radius: f64,
}

impl Rod {
    /// d.
    fn offset(&self, y: &Vector3) -> Vector3 {
        Vector3::new(y.x, y.y, y.z - y.z.clamp(-self.half_length, self.half_length))
    }
}

impl Surface for Rod {
    fn depth(&self) -> f64 {
        self.radius
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let is_beside = y.z.abs() < self.half_length;
        let from_axis = self.offset(y);
        // On the axis every direction is nearest.
        let length = from_axis.norm();
        let (normal, length) =
            if length > 0.0 { (from_axis / length, length) } else { (Vector3::x(), self.radius) };
        let mut across = Matrix3::identity() - normal * normal.transpose();
        if is_beside {
            across[(2, 2)] -= 1.0;
        }
        Distance { value: from_axis.norm() - self.radius, normal, curvature: across / length }
    }

    fn value(&self, y: &Vector3) -> f64 {
        self.offset(y).norm() - self.radius
    }
}
