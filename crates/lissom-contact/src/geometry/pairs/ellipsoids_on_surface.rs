//! A smooth convex solid of the tip and a surface of the base. The solid is a sum of ellipsoids: an ellipsoid, the rim of a cylinder,
//! or a crowned cylinder.
//!
//! Legend: Aᵢ semi-axes of a summand as a diagonal matrix, m direction in the axes of the tip, n normal of the base at y, φ distance
//! from the surface, H its second derivative, r rounding.
//!
//! ```text
//! Sᵢ² = m·Aᵢ² m,      c(m) = Σ Aᵢ² m/Sᵢ,      K = ∂c/∂m = Σ (Aᵢ² - Aᵢ² m mᵀ Aᵢ²/Sᵢ²)/Sᵢ
//! g = min φ(y) - r,   y = x + R c(m),      m = -Rᵀ n at the minimum
//! correction of m:    -(I + Rᵀ H R K)⁻¹ (m + Rᵀ n), a direction in which φ decreases
//! δy = (I + R K Rᵀ H)⁻¹ R (η_v + (K skew(m) - skew(c)) η_θ),      δn = H δy,      p = y - φ n
//! ```
//!
//! The rim of a cylinder of radius ρ is an ellipsoid with the semi-axes ρ √(1 + ε²), twice, and ρ ε along the axis. Upright ends are
//! then slightly conical, so that the point of contact moves smoothly from one side to the other, and the radius of a cylinder that
//! rolls is exact to ρ ε²/2. A long thin ellipsoid added to a rim is a crowned cylinder.

use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3, skew};

use super::curve_on_surface::MAX_CORRECTIONS;
use crate::geometry::gap::{Gap, Pair, side_by_side};
use crate::geometry::surfaces::{Distance, Surface};
use lissom_mechanics::round_off;

/// ε: the inclination at which the end of a cylinder stands on its rim, and that of a crowned side at its ends [rad].
const INCLINATION: f64 = 1e-3;

/// Ellipsoids about the tip's origin, of which the solid is the sum, and a surface of the base.
#[derive(Clone, Debug)]
pub struct EllipsoidsOnSurface {
    /// Semi-axes along the axes of the tip, of each summand [m].
    pub semi_axes: Vec<[f64; 3]>,
    /// Radius of the rounding, r [m].
    pub rounding: f64,
    /// Penetration into a plane at which the solid is within it [m].
    pub depth: f64,
    /// Surface of the base.
    pub surface: Arc<dyn Surface>,
}

/// A point of the solid.
#[derive(Clone)]
struct Candidate {
    /// m.
    direction: Vector3,
    /// c.
    point: Vector3,
    /// K.
    bend: Matrix3,
    /// y.
    place: Vector3,
    distance: Distance,
}

impl EllipsoidsOnSurface {
    /// Semi-axes of the rim of a cylinder of this radius [m]. The last one is its distance from the end, so that the cylinder stands
    /// on its end.
    pub fn rim(radius: f64) -> [f64; 3] {
        let wide = radius * 1.0_f64.hypot(INCLINATION);
        [wide, wide, INCLINATION * radius]
    }

    /// Summands of a crowned cylinder of this radius between two rims at a distance of `half` from its middle [m].
    pub fn side(radius: f64, half: f64) -> Vec<[f64; 3]> {
        let [wide, _, bulge] = Self::rim(radius);
        let crown = (INCLINATION * half).min(0.5 * wide);
        // Behind the rims at both ends.
        vec![[wide - crown, wide - crown, bulge], [crown, crown, half * (1.0 - INCLINATION)]]
    }

    /// φ of a plane, whose normal is the third axis: x₃ - Σ Sᵢ(m).
    fn on_plane(&self, x: &Vector3, rotation: &Matrix3) -> Option<f64> {
        let normal = rotation.row(2);
        let support = |axes: &[f64; 3]| {
            (0..3).map(|k| (axes[k] * normal[k]) * (axes[k] * normal[k])).sum::<f64>().sqrt()
        };
        self.surface.is_plane().then(|| x.z - self.semi_axes.iter().map(support).sum::<f64>())
    }

    fn candidate(&self, direction: Vector3, x: &Vector3, rotation: &Matrix3) -> Candidate {
        let (mut point, mut bend) = (Vector3::zeros(), Matrix3::zeros());
        for axes in &self.semi_axes {
            let squares = Vector3::from(*axes).map(|axis| axis * axis);
            let stretched = direction.component_mul(&squares);
            let support = direction.dot(&stretched).sqrt();
            point += stretched / support;
            bend += (Matrix3::from_diagonal(&squares)
                - stretched * stretched.transpose() / (support * support))
                / support;
        }
        let place = x + rotation * point;
        Candidate { direction, point, bend, place, distance: self.surface.distance(&place) }
    }

    /// The nearest point, by Newton's method. Where the solids are so deep within each other that none is found, it is the deepest of
    /// points within the tip.
    fn nearest(&self, x: &Vector3, rotation: &Matrix3) -> Candidate {
        let of = |direction: Vector3| self.candidate(direction, x, rotation);
        let mut at = of(-rotation.tr_mul(&self.surface.distance(x).normal));
        if self.surface.is_plane() {
            return at;
        }
        let size = self.reach();
        for _ in 0..MAX_CORRECTIONS {
            let normal = rotation.tr_mul(&at.distance.normal);
            let inverse = flexibility(&(rotation.tr_mul(&at.distance.curvature) * rotation), &at.bend);
            let correction = -inverse * (at.direction + normal);
            let travel = at.bend * correction;
            if travel.norm() <= round_off::SUM * size && at.direction.dot(&normal) < 0.0 {
                // Where the solid has a sharp edge the direction may still change.
                return if correction.norm() <= round_off::SUM { at } else { of(-normal) };
            }
            let limit =
                |share: f64| at.distance.value + 1e-4 * share * travel.dot(&normal) + round_off::SUM * size;
            let shares = std::iter::successors(Some(1.0), |share| Some(0.5 * share)).take(MAX_CORRECTIONS);
            let mut steps = shares.filter_map(|share| {
                Some((share, of((at.direction + share * correction).try_normalize(0.0)?)))
            });
            let Some((_, next)) = steps.find(|(share, next)| next.distance.value <= limit(*share)) else {
                break;
            };
            at = next;
        }
        let within = |k: i32| {
            let point = f64::from(k) / 16.0 * at.point;
            let place = x + rotation * point;
            Candidate { point, place, distance: self.surface.distance(&place), ..at.clone() }
        };
        let deeper = |one: Candidate, other: Candidate| {
            if other.distance.value < one.distance.value { other } else { one }
        };
        (0..16).map(within).fold(at.clone(), deeper)
    }
}

/// (I + H K)⁻¹ of two symmetric matrices that are not negative.
fn flexibility(curvature: &Matrix3, bend: &Matrix3) -> Matrix3 {
    (Matrix3::identity() + curvature * bend).try_inverse().unwrap_or_else(Matrix3::identity)
}

impl Pair for EllipsoidsOnSurface {
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap {
        let Candidate { direction, point, bend, place, distance } = self.nearest(x, rotation);
        let Distance { value, normal, curvature } = distance;
        let on_plane = self.on_plane(x, rotation);
        let (value, moved) = if let Some(value) = on_plane {
            (value, *rotation)
        } else {
            let own = rotation.tr_mul(&curvature) * rotation;
            (value, rotation * flexibility(&own, &bend).transpose())
        };
        let place_by = side_by_side(&moved, &(moved * (bend * skew(&direction) - skew(&point))));
        let normal_by = curvature * place_by;
        Gap {
            value: value - self.rounding,
            normal,
            point: place - value * normal,
            normal_by,
            point_by: place_by - normal * (normal.transpose() * place_by) - value * normal_by,
        }
    }

    fn value(&self, x: &Vector3, rotation: &Matrix3) -> f64 {
        let value = self.on_plane(x, rotation);
        value.unwrap_or_else(|| self.nearest(x, rotation).distance.value) - self.rounding
    }

    fn deepest(&self) -> f64 {
        (self.rounding + self.surface.depth()).min(self.depth)
    }

    fn reach(&self) -> f64 {
        self.semi_axes.iter().map(|axes| axes.iter().copied().fold(0.0, f64::max)).sum()
    }

    fn is_on_plane(&self) -> bool {
        self.surface.is_plane()
    }
}
