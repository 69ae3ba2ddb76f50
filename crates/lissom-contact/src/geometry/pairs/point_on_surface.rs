//! A rounded point of the tip and a surface of the base.
//!
//! Legend: φ distance from the surface, H its second derivative, r rounding.
//!
//! ```text
//! g = φ(x) - r,    p = x - φ n,    δn = H δx,    δp = (I - n nᵀ - φ H) δx
//! ```

use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3};

use crate::geometry::gap::{Gap, Pair, side_by_side};
use crate::geometry::hollow::{Hollow, hollow};
use crate::geometry::surfaces::Surface;

/// The tip's origin and a surface of the base: a sphere, or a corner.
#[derive(Clone, Debug)]
pub struct PointOnSurface {
    /// Radius of the rounding, r [m].
    pub rounding: f64,
    /// Surface of the base.
    pub surface: Arc<dyn Surface>,
}

impl Pair for PointOnSurface {
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap {
        let at = self.surface.distance(x);
        let (n, bend) = (at.normal, at.curvature);
        let point_by = Matrix3::identity() - n * n.transpose() - at.value * bend;
        let of = |by: &Matrix3| side_by_side(&(by * rotation), &Matrix3::zeros());
        Gap {
            value: at.value - self.rounding,
            normal: n,
            point: x - at.value * n,
            normal_by: of(&bend),
            point_by: of(&point_by),
        }
    }

    fn value(&self, x: &Vector3, _: &Matrix3) -> f64 {
        self.surface.value(x) - self.rounding
    }

    fn deepest(&self) -> f64 {
        let depth = self.surface.depth();
        if depth.is_finite() {
            self.rounding + depth
        } else if self.rounding == 0.0 {
            // A point may be anywhere below a plane.
            f64::INFINITY
        } else {
            2.0 * self.rounding
        }
    }

    fn reach(&self) -> f64 {
        0.0
    }

    fn hollow(&self, x: &Vector3) -> Option<Hollow> {
        hollow(&*self.surface, x, self.rounding)
    }

    fn is_on_plane(&self) -> bool {
        self.surface.is_plane()
    }
}
