//! A cylinder, hollow where its inner radius is not zero: its wall and its bore.
//!
//! Legend: ρ distance from the axis, (ρ, z) the half-plane through y, in which the ring is a rectangle of centre ρ_m and half the
//! sides w and h; q_ρ = |ρ - ρ_m| - w and q_z = |z| - h beyond its sides.
//!
//! ```text
//! H = Σ (second derivatives in the half-plane) + φ_ρ/ρ e_φ e_φᵀ
//! ```

use lissom_motion::{Matrix3, Vector3};

use super::{Distance, Surface};

/// A ring about the third axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner and outer radius [m]; a solid cylinder has no inner one, zero.
    pub radii: [f64; 2],
    /// Half its length, h [m].
    pub half_length: f64,
}

impl Surface for Ring {
    fn depth(&self) -> f64 {
        let [inner, outer] = self.radii;
        let wall = if inner > 0.0 { 0.5 * (outer - inner) } else { outer };
        wall.min(self.half_length)
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let [inner, outer] = self.radii;
        let radius = y.xy().norm();
        let outward = if radius > 0.0 { Vector3::new(y.x, y.y, 0.0) / radius } else { Vector3::x() };
        let around = Vector3::z().cross(&outward);
        let along = Vector3::new(0.0, 0.0, 1.0_f64.copysign(y.z));
        // A solid cylinder has no inner wall.
        let is_bore = inner > 0.0 && radius < 0.5 * (inner + outer);
        let (beyond_wall, radial) =
            if is_bore { (inner - radius, -outward) } else { (radius - outer, outward) };
        let beyond_end = y.z.abs() - self.half_length;
        // φ, its slope along `radial` and the curvature in the half-plane.
        let (value, normal, mut curvature) = if beyond_wall > 0.0 && beyond_end > 0.0 {
            let value = beyond_wall.hypot(beyond_end);
            let normal = (beyond_wall * radial + beyond_end * along) / value;
            let across = normal.cross(&around);
            (value, normal, across * across.transpose() / value)
        } else if beyond_wall > beyond_end {
            (beyond_wall, radial, Matrix3::zeros())
        } else {
            (beyond_end, along, Matrix3::zeros())
        };
        if radius > 0.0 {
            curvature += normal.dot(&outward) / radius * around * around.transpose();
        }
        Distance { value, normal, curvature }
    }
}
