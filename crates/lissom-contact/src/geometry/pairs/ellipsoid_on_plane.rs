//! An ellipsoid of the tip and a plane of the base.
//!
//! Legend: A semi-axes as a diagonal matrix, m = Rᵀ e₃ the normal of the plane in the axes of the tip.
//!
//! ```text
//! S² = m·A² m,      c = -A² m/S,      y = x + R c,      g = x₃ - S,      δm = m × η_θ
//! ```

use lissom_motion::{Matrix3, Vector3, skew};

use crate::geometry::gap::{Gap, Matrix3x6, Pair, carried, side_by_side};

/// An ellipsoid about the tip's origin, and the plane z = 0 of the base.
#[derive(Clone, Copy, Debug)]
pub struct EllipsoidOnPlane {
    /// Semi-axes along the axes of the tip [m].
    pub semi_axes: [f64; 3],
}

impl EllipsoidOnPlane {
    /// A² m and S.
    fn support(&self, own: &Vector3) -> (Vector3, f64) {
        let stretched = own.component_mul(&Vector3::from(self.semi_axes).map(|axis| axis * axis));
        (stretched, own.dot(&stretched).sqrt())
    }
}

impl Pair for EllipsoidOnPlane {
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap {
        let squares = Matrix3::from_diagonal(&Vector3::from(self.semi_axes).map(|axis| axis * axis));
        let normal = Vector3::z();
        let own: Vector3 = rotation.tr_mul(&normal);
        let (stretched, support) = self.support(&own);
        let point = -stretched / support;
        let place = x + rotation * point;
        let point_by_normal = (stretched * stretched.transpose() / (support * support) - squares) / support;
        let moved = side_by_side(&Matrix3::zeros(), &(rotation * point_by_normal * skew(&own)));
        let place_by = carried(rotation, &point) + moved;
        let in_plane = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
        Gap {
            value: x.z - support,
            normal,
            point: in_plane * place,
            normal_by: Matrix3x6::zeros(),
            point_by: in_plane * place_by,
        }
    }

    fn value(&self, x: &Vector3, rotation: &Matrix3) -> f64 {
        x.z - self.support(&rotation.tr_mul(&Vector3::z())).1
    }

    fn deepest(&self) -> f64 {
        2.0 * self.semi_axes.into_iter().fold(f64::INFINITY, f64::min)
    }

    fn reach(&self) -> f64 {
        self.semi_axes.into_iter().fold(0.0, f64::max)
    }

    fn is_on_plane(&self) -> bool {
        true
    }
}
