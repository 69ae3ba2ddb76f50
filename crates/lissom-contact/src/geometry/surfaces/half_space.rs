//! Everything below a plane.

use lissom_motion::{Matrix3, Vector3};

use super::{Distance, Surface};

/// The half-space below the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HalfSpace;

impl Surface for HalfSpace {
    fn depth(&self) -> f64 {
        f64::INFINITY
    }

    fn distance(&self, y: &Vector3) -> Distance {
        Distance { value: y.z, normal: Vector3::z(), curvature: Matrix3::zeros() }
    }

    fn value(&self, y: &Vector3) -> f64 {
        y.z
    }

    fn is_plane(&self) -> bool {
        true
    }
}
