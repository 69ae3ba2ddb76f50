//! The rim of a disc of the tip and a plane of the base.
//!
//! Legend: a direction of the tip's third axis, ρ radius of the disc, r rounding.
//!
//! ```text
//! u = 1 - a₃²,     S² = u + ε²,    g = x₃ - ρ S - r,    p = x + ρ a₃ a/S in the plane
//! ```
//!
//! With the small number ε the ends of an upright cylinder are slightly conical, so that the point of contact moves smoothly from
//! one side to the other. S and p belong to one convex body. Its rim bulges out of the disc by ρ ε along the axis: the disc of a
//! cylinder is inside its end by as much. The radius of a cylinder that rolls is then exact to ρ ε²/2.

use lissom_motion::{Matrix3, Vector3, skew};

use crate::geometry::gap::{Gap, Matrix3x6, Pair, side_by_side};

/// ε: the inclination at which the end of a cylinder stands on its rim [rad].
const END_INCLINATION: f64 = 1e-3;

/// A disc perpendicular to the tip's third axis, and the plane z = 0 of the base.
#[derive(Clone, Debug)]
pub struct RimOnPlane {
    /// Radius of the disc, ρ [m].
    pub radius: f64,
    /// Radius of the rounding of its rim, r [m].
    pub rounding: f64,
}

impl RimOnPlane {
    /// Distance of the disc from the end of a cylinder of this radius, so that the cylinder stands on its end [m].
    pub fn inset(radius: f64) -> f64 {
        END_INCLINATION * radius
    }

    /// S, for the cosine a₃.
    fn upright(cosine: f64) -> f64 {
        (1.0 - cosine * cosine + END_INCLINATION * END_INCLINATION).sqrt()
    }
}

impl Pair for RimOnPlane {
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap {
        let Self { radius, rounding } = self;
        let a: Vector3 = rotation.column(2).into();
        let normal = Vector3::z();
        let cosine = a.z;
        let upright = Self::upright(cosine);
        let in_plane = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
        let side = in_plane * a * (radius / upright);
        // ∂(a₃/S)/∂a₃ = (1 + a₃²/S²)/S.
        let by_cosine = side * (1.0 + cosine * cosine / (upright * upright));
        let point_by_axis = radius * cosine / upright * in_plane + by_cosine * normal.transpose();
        // δa = R (η_θ × e₃).
        let axis_by = -rotation * skew(&Vector3::z());
        Gap {
            value: x.z - radius * upright - rounding,
            normal,
            point: in_plane * x + cosine * side,
            normal_by: Matrix3x6::zeros(),
            point_by: side_by_side(&(in_plane * rotation), &(point_by_axis * axis_by)),
        }
    }

    fn value(&self, x: &Vector3, rotation: &Matrix3) -> f64 {
        x.z - self.radius * Self::upright(rotation[(2, 2)]) - self.rounding
    }

    fn deepest(&self) -> f64 {
        2.0 * self.radius
    }

    fn reach(&self) -> f64 {
        self.radius
    }

    fn is_on_plane(&self) -> bool {
        true
    }
}
