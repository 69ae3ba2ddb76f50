//! Shapes that are drawn: the box that has the inertia of a body.

use lissom_motion::{Matrix3, Rotation, Vector3};
use serde::{Deserialize, Serialize};

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
#[path = "../../tests/unit/scene/shapes.rs"]
mod tests;
