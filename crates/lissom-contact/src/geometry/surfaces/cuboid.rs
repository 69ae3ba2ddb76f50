//! A box.
//!
//! Legend: q_i = |y_i| - a_i beyond the faces, m = max(q, 0).
//!
//! ```text
//! outside: φ = |m|, n = m/φ, H = (D - n nᵀ)/φ with D the directions in which m > 0;    inside: φ = max q
//! ```

use lissom_motion::{Matrix3, Vector3};

use super::{Distance, Surface};

/// A box about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Half its sides, a [m].
    pub half_sides: [f64; 3],
}

impl Surface for Cuboid {
    fn depth(&self) -> f64 {
        self.half_sides.into_iter().fold(f64::INFINITY, f64::min)
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let beyond = y.abs() - Vector3::from(self.half_sides);
        let sign = y.map(|y| 1.0_f64.copysign(y));
        let outside = beyond.map(|q| q.max(0.0));
        let length = outside.norm();
        let count = outside.iter().filter(|m| **m > 0.0).count();
        if count < 2 {
            // Above a face, or inside, where the nearest face decides.
            let face = beyond.imax();
            let mut normal = Vector3::zeros();
            normal[face] = sign[face];
            return Distance { value: beyond[face], normal, curvature: Matrix3::zeros() };
        }
        let normal = outside.component_mul(&sign) / length;
        let directions = Matrix3::from_diagonal(&outside.map(|m| f64::from(u8::from(m > 0.0))));
        Distance { value: length, normal, curvature: (directions - normal * normal.transpose()) / length }
    }
}
