//! Kinds of pairs of solids that touch in one point.

mod curve_on_surface;
mod ellipsoids_on_surface;
mod point_on_surface;

pub use curve_on_surface::CurveOnSurface;
pub use ellipsoids_on_surface::EllipsoidsOnSurface;
pub use point_on_surface::PointOnSurface;
