//! Kinds of pairs of solids that touch in one point.

mod curve_on_surface;
mod ellipsoid_on_plane;
mod point_on_surface;
mod rim_on_plane;

pub use curve_on_surface::CurveOnSurface;
pub use ellipsoid_on_plane::EllipsoidOnPlane;
pub use point_on_surface::PointOnSurface;
pub use rim_on_plane::RimOnPlane;
