//! Shapes that are drawn: outlines of cross sections, and the box that has the inertia of a body.

use lissom_motion::{Matrix3, Rotation, Vector3};
use serde::{Deserialize, Serialize};

use crate::sections::SectionProperties;

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
    pub(crate) fn of_mass(properties: &SectionProperties) -> Self {
        let m = &properties.mass;
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

/// The homogeneous box that has the mass and the inertia of a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InertiaBox {
    /// Centre of mass in body axes [m].
    pub center: [f64; 3],
    /// Principal axes in body axes: quaternion, scalar first.
    pub quaternion: [f64; 4],
    /// Sides along the principal axes [m]; zero where the inertia leaves none.
    pub sides: [f64; 3],
}

impl InertiaBox {
    /// From mass [kg], inertia about the centre of mass [kg m²] and centre of mass [m], in body axes: I₁ = m(b² + c²)/12.
    pub(super) fn of(mass: f64, inertia: &Matrix3, center: &Vector3) -> Self {
        let diagonal = Matrix3::from_diagonal(&inertia.diagonal());
        // Inertias that are diagonal keep their axes; others are turned to their principal axes.
        let (moments, axes) = if *inertia == diagonal {
            (inertia.diagonal(), Matrix3::identity())
        } else {
            let principal = inertia.symmetric_eigen();
            let mut axes = principal.eigenvectors;
            if axes.determinant() < 0.0 {
                axes.neg_mut();
            }
            (principal.eigenvalues, axes)
        };
        let whole = moments.sum();
        let side = |k: usize| (6.0 * (whole - 2.0 * moments[k]) / mass).max(0.0).sqrt();
        Self {
            center: (*center).into(),
            quaternion: Rotation::from_matrix(&axes).quaternion(),
            sides: [side(0), side(1), side(2)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sections::mass_matrix;

    #[test]
    fn a_box_comes_back_from_its_inertia() {
        let (a, b, c, mass) = (0.1_f64, 0.3_f64, 0.7_f64, 2.5);
        let moments = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 12.0);
        let turn = Rotation::exponential(&Vector3::new(0.3, -0.2, 0.9)).matrix();
        for axes in [Matrix3::identity(), turn] {
            let inertia = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
            let found = InertiaBox::of(mass, &inertia, &Vector3::x());
            let mut sides = found.sides;
            sides.sort_by(f64::total_cmp);
            for (side, wanted) in sides.iter().zip([a, b, c]) {
                assert!((side - wanted).abs() < 1e-12, "{found:?}");
            }
            // The longest side is along the third axis.
            let longest = found.sides.iter().position(|side| (side - c).abs() < 1e-12).unwrap();
            let principal = Rotation::from_quaternion(found.quaternion).unwrap().matrix();
            assert!((principal.column(longest).dot(&axes.column(2)).abs() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn an_ellipse_comes_back_from_its_mass() {
        let (a, b, mass, center) = (0.02_f64, 0.05_f64, 3.0, [0.01, -0.03]);
        let inertia = Vector3::new(a * a + b * b, b * b, a * a) * (mass / 4.0);
        let properties = SectionProperties {
            stiffness: lissom_motion::Matrix6::identity(),
            mass: mass_matrix(mass, &Matrix3::from_diagonal(&inertia), center),
            damping: 0.0,
        };
        let Outline::Ellipse { width, height, center: found } = Outline::of_mass(&properties) else {
            panic!("sections given by numbers are drawn as ellipses")
        };
        assert!((width - a).abs() < 1e-12 && (height - b).abs() < 1e-12, "{width} {height}");
        assert!((found[0] - center[0]).abs() < 1e-14 && (found[1] - center[1]).abs() < 1e-14);
    }
}
