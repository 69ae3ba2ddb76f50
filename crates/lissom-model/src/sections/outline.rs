//! Outlines of cross sections, as they are drawn and touch.

use lissom_motion::Matrix6;
use serde::{Deserialize, Serialize};

/// The outline of a cross section in its axes 2 and 3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "snake_case")]
pub enum Outline {
    /// Rectangle about the reference line.
    Rectangle {
        /// Side along axis 2 [m].
        width: f64,
        /// Side along axis 3 [m].
        height: f64,
    },
    /// Circle, or a tube where the inner radius is above zero.
    Circle {
        /// Outer radius [m].
        radius: f64,
        /// Inner radius [m].
        inner: f64,
    },
    /// The ellipse whose second moments of mass are those of the section: for sections given by numbers.
    Ellipse {
        /// Semi-axis along axis 2 [m].
        width: f64,
        /// Semi-axis along axis 3 [m].
        height: f64,
        /// Centre of mass along axes 2 and 3 [m].
        center: [f64; 2],
    },
}

impl Outline {
    /// From the mass matrix of a slice, whose upper right block is -m c̃ and whose lower right block is J - m c̃². A
    /// homogeneous ellipse of semi-axes w and h has J₂₂ = m h²/4 and J₃₃ = m w²/4.
    pub(crate) fn of_mass(m: &Matrix6) -> Self {
        let mass = m[(0, 0)];
        let center = [-m[(0, 5)] / mass, m[(0, 4)] / mass];
        let semi_axis = |moment: f64, offset: f64| 2.0 * (moment / mass - offset * offset).max(0.0).sqrt();
        Self::Ellipse {
            width: semi_axis(m[(5, 5)], center[0]),
            height: semi_axis(m[(4, 4)], center[1]),
            center,
        }
    }
}

#[cfg(test)]
mod tests {
    use lissom_motion::{Matrix3, Vector3};

    use super::super::mass_matrix;
    use super::*;

    #[test]
    fn an_ellipse_comes_back_from_its_mass() {
        let (a, b, mass, center) = (0.02_f64, 0.05_f64, 3.0, [0.01, -0.03]);
        let inertia = Vector3::new(a * a + b * b, b * b, a * a) * (mass / 4.0);
        let mass = mass_matrix(mass, &Matrix3::from_diagonal(&inertia), center);
        let Outline::Ellipse { width, height, center: found } = Outline::of_mass(&mass) else {
            panic!("sections given by numbers are drawn as ellipses")
        };
        assert!((width - a).abs() < 1e-12 && (height - b).abs() < 1e-12, "{width} {height}");
        assert!((found[0] - center[0]).abs() < 1e-14 && (found[1] - center[1]).abs() < 1e-14);
    }
}
