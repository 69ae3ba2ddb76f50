//! A prism with a smooth outline, without ends: a cam.
//!
//! Legend: c(t) the outline, T its unit tangent, N = T × e₃ its normal outwards, κ its curvature, positive where it is convex; foot
//! c(t) of y where (y - c)·c' = 0.
//!
//! ```text
//! φ = N·(y - c),      n = N,      H = κ/(1 + κ φ) T Tᵀ
//! ```

use lissom_motion::Vector3;
use nalgebra::Vector2;

use super::{Distance, Surface};
use crate::geometry::curves::{Curve, Spline};
use lissom_mechanics::round_off;

/// Bisections after which the foot of a point is known to all digits.
const MAX_CORRECTIONS: usize = 60;

/// A prism along the third axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    curve: Spline,
    depth: f64,
    /// Largest distance between two neighbouring points [m].
    spacing: f64,
}

impl Outline {
    /// With this outline.
    pub fn new(curve: Spline) -> Self {
        let depth = inner_radius(&curve);
        let next = curve.points().iter().cycle().skip(1);
        let spacing = curve.points().iter().zip(next).map(|(p, q)| (q - p).norm()).fold(0.0, f64::max);
        Self { curve, depth, spacing }
    }

    /// The outline.
    pub fn curve(&self) -> &Spline {
        &self.curve
    }

    /// The foot of a point between two parameters around a sample.
    fn foot(&self, y: &Vector2<f64>, sample: usize) -> f64 {
        let (mut low, mut high) = self.curve.beside(sample);
        let mut t = self.curve.samples()[sample];
        for _ in 0..MAX_CORRECTIONS {
            let [p, first, second] = self.curve.at(t);
            let slope = -(y - p).dot(&first);
            let bend = first.norm_squared() - (y - p).dot(&second);
            let newton = t - slope / bend;
            // At the solution Newton's correction is round-off, and a bisection would leave it.
            if slope == 0.0 || (newton - t).abs() <= round_off::CURVE_PARAMETER * self.curve.length() {
                break;
            }
            if slope < 0.0 {
                low = t;
            } else {
                high = t;
            }
            let is_inside = bend > 0.0 && newton > low && newton < high;
            t = if is_inside { newton } else { 0.5 * (low + high) };
        }
        t
    }

    /// Passes the parameters of all points that are nearer to y than those around them to `visit`, of those nearer than `within` [m].
    fn feet(&self, y: &Vector2<f64>, within: f64, mut visit: impl FnMut(f64)) {
        let points = self.curve.points();
        let count = points.len();
        let squared = |k: usize| (points[k] - y).norm_squared();
        // The foot of a point is at most a chord nearer than the points beside it.
        let most = (within + self.spacing).powi(2);
        let [mut before, mut at] = [squared(count - 1), squared(0)];
        for k in 0..count {
            let after = squared((k + 1) % count);
            let is_candidate = at <= most && at <= after && at <= before;
            (before, at) = (at, after);
            if is_candidate {
                visit(self.foot(y, k));
            }
        }
    }

    /// Distance of y from the tangent at a foot.
    fn distance_at(&self, foot: f64, y: &Vector2<f64>) -> Distance {
        let [p, first, second] = self.curve.at(foot);
        let speed = first.norm();
        let tangent = first / speed;
        let normal = Vector2::new(tangent.y, -tangent.x);
        let value = normal.dot(&(y - p));
        let bend = -normal.dot(&second) / (speed * speed);
        let along = Vector3::new(tangent.x, tangent.y, 0.0);
        Distance {
            value,
            normal: Vector3::new(normal.x, normal.y, 0.0),
            curvature: along * along.transpose() * (bend / (1.0 + bend * value)),
        }
    }
}

/// The smallest radius of a circle within the outline that touches it at one of its points and at another [m].
fn inner_radius(curve: &Spline) -> f64 {
    let mut least = f64::INFINITY;
    for (point, &t) in curve.points().iter().zip(curve.samples()) {
        let tangent = curve.at(t)[1].normalize();
        let inwards = Vector2::new(-tangent.y, tangent.x);
        for other in curve.points() {
            let chord = other - point;
            let height = chord.dot(&inwards);
            if height > 0.0 {
                least = least.min(0.5 * chord.norm_squared() / height);
            }
        }
    }
    least
}

impl Surface for Outline {
    fn depth(&self) -> f64 {
        self.depth
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let own = y.xy();
        let points = self.curve.points().iter();
        let least = points.map(|point| (point - own).norm_squared()).fold(f64::INFINITY, f64::min).sqrt();
        let (mut foot, mut nearest) = (0.0, f64::INFINITY);
        self.feet(&own, least, |t| {
            let distance = (self.curve.at(t)[0] - own).norm();
            if distance < nearest {
                (foot, nearest) = (t, distance);
            }
        });
        self.distance_at(foot, &own)
    }

    fn has_hollows(&self) -> bool {
        true
    }

    fn sides(&self, y: &Vector3, within: f64, visit: &mut dyn FnMut(&Distance)) {
        let own = y.xy();
        self.feet(&own, within, |t| {
            let side = self.distance_at(t, &own);
            if side.value > 0.0 && side.value < within {
                visit(&side);
            }
        });
    }
}
