//! Volume and inertia of homogeneous solids.

use lissom_motion::{Matrix3, Vector3};

/// A homogeneous solid about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// Sides along the axes [m].
    Box([f64; 3]),
    /// A circular cylinder, hollow where the inner radius is not zero [m].
    Tube {
        /// Outer radius.
        outer: f64,
        /// Inner radius.
        inner: f64,
        /// Length along the axis.
        length: f64,
        /// Direction of the axis, a unit vector.
        axis: Vector3,
    },
    /// Radius [m].
    Sphere(f64),
    /// A rod with hemispherical ends.
    Capsule {
        /// Radius [m].
        radius: f64,
        /// Length between the centres of the ends [m].
        length: f64,
        /// Direction of the axis, a unit vector.
        axis: Vector3,
    },
    /// Semi-axes [m].
    Ellipsoid([f64; 3]),
}

impl Solid {
    /// Whether its lengths are valid.
    pub fn is_solid(&self) -> bool {
        match *self {
            Self::Box(sides) => sides.iter().all(|side| *side > 0.0),
            Self::Tube { outer, inner, length, .. } => inner >= 0.0 && outer > inner && length > 0.0,
            Self::Sphere(radius) => radius > 0.0,
            Self::Capsule { radius, length, .. } => radius > 0.0 && length > 0.0,
            Self::Ellipsoid(axes) => axes.iter().all(|axis| *axis > 0.0),
        }
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        match *self {
            Self::Box([a, b, c]) => a * b * c,
            Self::Tube { outer, inner, length, .. } => {
                std::f64::consts::PI * (outer * outer - inner * inner) * length
            }
            Self::Sphere(radius) => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
            Self::Capsule { radius, length, .. } => {
                std::f64::consts::PI * radius * radius * (length + 4.0 / 3.0 * radius)
            }
            Self::Ellipsoid([a, b, c]) => 4.0 / 3.0 * std::f64::consts::PI * a * b * c,
        }
    }

    /// Inertia about the centre per mass [m²].
    pub fn inertia(&self) -> Matrix3 {
        let moments = match *self {
            Self::Box([a, b, c]) => Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) / 12.0,
            Self::Tube { outer, inner, length, axis } => {
                let radii = outer * outer + inner * inner;
                let across = (3.0 * radii + length * length) / 12.0;
                let along = axis * axis.transpose();
                return across * (Matrix3::identity() - along) + 0.5 * radii * along;
            }
            Self::Sphere(radius) => Vector3::repeat(0.4 * radius * radius),
            Self::Ellipsoid([a, b, c]) => Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) / 5.0,
            Self::Capsule { radius, length, axis } => {
                // Cylinder and two half balls, whose centres are 3/8 of the radius from their faces.
                let ends = 4.0 / 3.0 * radius / (length + 4.0 / 3.0 * radius);
                let square = radius * radius;
                let rod = (1.0 - ends) * (square / 4.0 + length * length / 12.0);
                let balls = ends * (0.4 * square + 0.25 * length * length + 0.375 * length * radius);
                let spin = square * ((1.0 - ends) / 2.0 + 0.4 * ends);
                let along = axis * axis.transpose();
                return (rod + balls) * (Matrix3::identity() - along) + spin * along;
            }
        };
        Matrix3::from_diagonal(&moments)
    }
}

#[cfg(test)]
#[path = "../../tests/unit/forms/solid.rs"]
mod tests;
