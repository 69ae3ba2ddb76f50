//! Surfaces of solids by their signed distance: negative inside. A kind of surface is one file.
//!
//! Legend: y a point in the axes of the solid, φ its distance, n = ∇φ, H = ∇∇φ.

mod cuboid;
mod half_space;
mod height_field;
mod mesh;
mod outline;
mod polygon;
mod ring;
mod rod;
mod rounded;

pub use cuboid::Cuboid;
pub use half_space::HalfSpace;
pub use height_field::HeightField;
pub use mesh::{Mesh, MeshError};
pub use outline::Outline;
pub use polygon::Polygon;
pub use ring::Ring;
pub use rod::Rod;
pub use rounded::Rounded;

use lissom_motion::{Matrix3, Vector3};

/// Distance of a point from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// φ [m].
    pub value: f64,
    /// n, a unit vector that points out of the solid.
    pub normal: Vector3,
    /// H [1/m], symmetric; H n = 0.
    pub curvature: Matrix3,
}

/// The surface of a solid.
pub trait Surface: std::fmt::Debug + Send + Sync {
    /// Distance of the point y [m].
    fn distance(&self, y: &Vector3) -> Distance;

    /// φ [m] alone, equal to that of [`distance`](Self::distance) to the last bit. Default: its derivatives are computed as well.
    fn value(&self, y: &Vector3) -> f64 {
        self.distance(y).value
    }

    /// Depth below the surface at which the nearest point of it changes to the other side [m]; infinite for a plane.
    fn depth(&self) -> f64;

    /// Whether a ball outside can touch two sides of it, which [`sides`](Self::sides) passes. Default: it cannot.
    fn has_hollows(&self) -> bool {
        false
    }

    /// Passes the distances of the point y from the outer side to `visit`: those smaller than `within` [m] at points of the surface
    /// that are nearer to y than all points around them. One may be passed several times. Default: none.
    fn sides(&self, _y: &Vector3, _within: f64, _visit: &mut dyn FnMut(&Distance)) {}

    /// Whether its curvature is zero everywhere, so that the distance of a point is linear in its position. Default: it is not.
    fn is_plane(&self) -> bool {
        false
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/geometry/surfaces/mod.rs"]
mod tests;
