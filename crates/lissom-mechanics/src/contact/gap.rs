//! The gap between two solids where they are nearest, with the point of contact.
//!
//! Legend: x position of the tip's frame, a direction of its third axis, both in the axes of the base's solid; g gap, n normal out of
//! the base's solid, p point of contact on the base's surface.
//!
//! ```text
//! a point with a rounding r at x:      g = φ(x) - r,    p = x - φ n,    ∂n/∂x = H,    ∂p/∂x = I - n nᵀ - φ H
//! the rim of a disc above a plane:     u = 1 - a₃²,     S² = u + ε²,    g = x₃ - ρ (S - ε) - r,    p = x + ρ a₃ a/S in the plane
//! ```
//!
//! With the small number ε the ends of an upright cylinder are slightly conical, so that the point of contact moves smoothly from
//! one side to the other. S and p belong to one convex body: the normal force has an energy.

use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3};

use super::surfaces::Surface;

/// ε: the inclination at which the end of a cylinder stands on its rim [rad].
const END_INCLINATION: f64 = 1e-3;

/// A gap with the derivatives of normal and point of contact.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// g [m]; negative for penetration.
    pub value: f64,
    /// n.
    pub normal: Vector3,
    /// p [m].
    pub point: Vector3,
    /// ∂n/∂x [1/m], and ∂n/∂a.
    pub normal_by: [Matrix3; 2],
    /// ∂p/∂x, and ∂p/∂a [m].
    pub point_by: [Matrix3; 2],
}

/// Two solids that may touch in one point.
#[derive(Clone, Debug)]
pub enum Pair {
    /// The tip's origin, rounded, and a surface of the base.
    PointOnSurface {
        /// Radius of the rounding, r [m].
        rounding: f64,
        /// Surface of the base.
        surface: Arc<dyn Surface>,
    },
    /// A disc perpendicular to the tip's third axis, and the plane z = 0 of the base.
    RimOnPlane {
        /// Radius of the disc, ρ [m].
        radius: f64,
        /// Radius of the rounding of its rim, r [m].
        rounding: f64,
    },
}

impl Pair {
    /// The gap at a relative position x [m] and a direction a.
    pub fn gap(&self, x: &Vector3, a: &Vector3) -> Gap {
        let none = Matrix3::zeros();
        match self {
            Self::PointOnSurface { rounding, surface } => {
                let at = surface.distance(x);
                let (n, bend) = (at.normal, at.curvature);
                Gap {
                    value: at.value - rounding,
                    normal: n,
                    point: x - at.value * n,
                    normal_by: [bend, none],
                    point_by: [Matrix3::identity() - n * n.transpose() - at.value * bend, none],
                }
            }
            Self::RimOnPlane { radius, rounding } => {
                let normal = Vector3::z();
                let cosine = a.z;
                let upright = (1.0 - cosine * cosine + END_INCLINATION * END_INCLINATION).sqrt();
                let in_plane = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
                let side = in_plane * a * (radius / upright);
                // ∂(a₃/S)/∂a₃ = (1 + a₃²/S²)/S.
                let by_cosine = side * (1.0 + cosine * cosine / (upright * upright));
                let point_by_axis = radius * cosine / upright * in_plane + by_cosine * normal.transpose();
                Gap {
                    value: x.z - radius * (upright - END_INCLINATION) - rounding,
                    normal,
                    point: in_plane * x + cosine * side,
                    normal_by: [none, none],
                    point_by: [in_plane, point_by_axis],
                }
            }
        }
    }

    /// Penetration at which the solids are within each other [m]: beyond it the nearest surfaces are those of the other side, or a
    /// sphere is below a plane.
    pub fn deepest(&self) -> f64 {
        match self {
            Self::PointOnSurface { rounding, surface } if surface.depth().is_finite() => {
                rounding + surface.depth()
            }
            // A point may be anywhere below a plane.
            Self::PointOnSurface { rounding, .. } if *rounding == 0.0 => f64::INFINITY,
            Self::PointOnSurface { rounding, .. } => 2.0 * rounding,
            Self::RimOnPlane { radius, .. } => 2.0 * radius,
        }
    }

    /// Largest change of the gap per change of a [m].
    pub fn reach(&self) -> f64 {
        match self {
            Self::PointOnSurface { .. } => 0.0,
            Self::RimOnPlane { radius, .. } => *radius,
        }
    }

    /// Whether the gap is linear in x and independent of a.
    pub fn is_linear(&self) -> bool {
        matches!(self, Self::PointOnSurface { surface, .. } if surface.is_plane())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::surfaces::{Cuboid, HalfSpace, Ring, Rod};
    use lissom_motion::{Rotation, skew};

    fn pairs() -> Vec<Pair> {
        let point = |surface: Arc<dyn Surface>| Pair::PointOnSurface { rounding: 0.1, surface };
        vec![
            point(Arc::new(HalfSpace)),
            point(Arc::new(Rod { half_length: 0.3, radius: 0.4 })),
            point(Arc::new(Cuboid { half_sides: [0.3, 0.5, 0.8] })),
            point(Arc::new(Ring { radii: [0.3, 0.6], half_length: 0.4 })),
            Pair::RimOnPlane { radius: 0.5, rounding: 0.02 },
        ]
    }

    /// Derivatives of normal and point are those of differences, and the gap changes with the velocity of the point of contact along
    /// the normal: its force then does the work of an energy.
    #[test]
    fn derivatives_are_those_of_differences() {
        let step = 1e-6;
        for (index, pair) in pairs().iter().enumerate() {
            for k in 0..50 {
                let share = |factor: f64| (f64::from(k) * factor).fract() * 2.0 - 1.0;
                let x = Vector3::new(share(0.754_877), share(0.569_840), share(0.430_159));
                let turn =
                    Rotation::exponential(&(3.0 * Vector3::new(share(0.31), share(0.77), share(0.13))));
                let a = turn.matrix() * Vector3::z();
                let at = pair.gap(&x, &a);
                for axis in 0..3 {
                    let mut unit = Vector3::zeros();
                    unit[axis] = step;
                    for (by, [before, after]) in [
                        [pair.gap(&(x - unit), &a), pair.gap(&(x + unit), &a)],
                        [pair.gap(&x, &(a - unit)), pair.gap(&x, &(a + unit))],
                    ]
                    .iter()
                    .enumerate()
                    {
                        if (before.normal_by[0] - after.normal_by[0]).norm() > 0.1 {
                            continue;
                        }
                        let normal = (after.normal - before.normal) / (2.0 * step);
                        let point = (after.point - before.point) / (2.0 * step);
                        let (wanted, at_point) =
                            (at.normal_by[by].column(axis), at.point_by[by].column(axis));
                        assert!((normal - wanted).norm() < 1e-6, "{index} {by} {normal} {wanted}");
                        assert!((point - at_point).norm() < 1e-6 * (1.0 + at_point.norm()), "{index} {by}");
                    }
                    // A turn about the axis through x moves the point of contact by ω × (p - x).
                    let turned = |sign: f64| a + sign * skew(&unit) * a;
                    let change =
                        (pair.gap(&x, &turned(1.0)).value - pair.gap(&x, &turned(-1.0)).value) / (2.0 * step);
                    let moved = at.normal.dot(&(unit / step).cross(&(at.point - x)));
                    assert!((change - moved).abs() < 1e-6, "{index} {change} {moved}");
                }
            }
        }
    }
}
