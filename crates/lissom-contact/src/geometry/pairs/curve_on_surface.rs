//! A rounded curve of the tip, such as the axis of a capsule or the edge of a box, and a surface of the base.
//!
//! Legend: c(t) the curve in the axes of the tip with its crown w(t), c' and c'' its derivatives, y = x + R c; φ distance from the
//! surface, H its second derivative, r rounding; Y = ∂y/∂η at constant t.
//!
//! ```text
//! F(t) = φ(y) + w,      g = min F - r,      F' = n·R c' + w' = 0 unless an end is nearest
//! F'' = R c'·H R c' + n·R c'' + w'',      ∂t/∂η = -((R c')ᵀ H Y - nᵀ R [0, skew(c')])/F'',   0 at an end
//! p = y - φ n,      δy = Y η + R c' δt,      δn = H δy,      δp = δy - n (n·δy) - φ H δy
//! ```

use std::sync::Arc;

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::RowVector6;

use crate::geometry::curves::Curve;
use crate::geometry::gap::{Gap, Pair, carried, side_by_side};
use crate::geometry::surfaces::{Distance, Surface};
use lissom_mechanics::round_off;

/// Corrections of t after which it is known to all digits: bisections halve an interval.
pub(super) const MAX_CORRECTIONS: usize = 60;

/// A curve of the tip and a surface of the base.
#[derive(Clone, Debug)]
pub struct CurveOnSurface {
    /// The curve.
    pub curve: Arc<dyn Curve>,
    /// Radius of the rounding, r [m].
    pub rounding: f64,
    /// Surface of the base.
    pub surface: Arc<dyn Surface>,
}

/// The function that is least at the point of contact, at a parameter.
struct Candidate {
    t: f64,
    value: f64,
    slope: f64,
    bend: f64,
    distance: Distance,
    /// y.
    place: Vector3,
    /// c and R c'.
    point: Vector3,
    tangent: Vector3,
    /// c'.
    own_tangent: Vector3,
}

impl CurveOnSurface {
    fn candidate(&self, t: f64, x: &Vector3, rotation: &Matrix3) -> Candidate {
        let ([point, own_tangent, bend], crown) = (self.curve.point(t), self.curve.crown(t));
        let place = x + rotation * point;
        let distance = self.surface.distance(&place);
        let tangent = rotation * own_tangent;
        Candidate {
            t,
            value: distance.value + crown[0],
            slope: distance.normal.dot(&tangent) + crown[1],
            bend: tangent.dot(&(distance.curvature * tangent))
                + distance.normal.dot(&(rotation * bend))
                + crown[2],
            distance,
            place,
            point,
            tangent,
            own_tangent,
        }
    }

    /// The nearest point, and whether it is between the ends of the curve.
    fn nearest(&self, x: &Vector3, rotation: &Matrix3) -> (Candidate, bool) {
        let samples = self.curve.samples();
        let of = |t: f64| self.candidate(t, x, rotation);
        if let [first, last] = *samples {
            return self.between((first, last), 0.5 * (first + last), (x, rotation));
        }
        let count = samples.len();
        let value = |k: usize| of(samples[k % count]).value;
        let point = |k: usize| self.curve.point(samples[k % count])[0];
        // A distance changes by at most the distance between two points, so that samples far from the surface bound those beside them.
        let coarse = (0..count).step_by(count.isqrt());
        let mut least = coarse.map(value).fold(f64::INFINITY, f64::min);
        let mut last = (0, f64::NEG_INFINITY);
        for k in 0..count {
            if last.1 - (point(k) - point(last.0)).norm() <= least {
                last = (k, value(k));
                least = least.min(last.1);
            }
        }
        let mut best: Option<(Candidate, bool)> = None;
        // Sample and value, of the last sample evaluated.
        let mut last = (count - 1, value(count - 1));
        for k in 0..count {
            let interval = self.curve.beside(k);
            // Between samples the distance is smaller by at most the length of the curve there.
            let most = least + (interval.1 - interval.0);
            if last.1 - (point(k) - point(last.0)).norm() > most {
                continue;
            }
            let previous = (k + count - 1) % count;
            let before = if last.0 == previous { last.1 } else { value(previous) };
            last = (k, value(k));
            if last.1 <= most && last.1 <= before && last.1 <= value(k + 1) {
                let found = self.between(interval, samples[k], (x, rotation));
                if best.as_ref().is_none_or(|(best, _)| found.0.value < best.value) {
                    best = Some(found);
                }
            }
        }
        best.unwrap_or_else(|| (of(samples[0]), false))
    }

    /// The nearest point between two parameters, from `start` on, and whether it is between the ends of the curve.
    fn between(
        &self,
        (first, last): (f64, f64),
        start: f64,
        (x, rotation): (&Vector3, &Matrix3),
    ) -> (Candidate, bool) {
        let of = |t: f64| self.candidate(t, x, rotation);
        let (low, high) = (of(first), of(last));
        if low.slope >= 0.0 && !self.curve.is_closed() {
            return (low, false);
        }
        if high.slope <= 0.0 && !self.curve.is_closed() {
            return (high, false);
        }
        let (mut low, mut high, mut at) = (first, last, of(start));
        for _ in 0..MAX_CORRECTIONS {
            let newton = at.t - at.slope / at.bend;
            // At the solution Newton's correction is round-off, and a bisection would leave it.
            if at.slope == 0.0 || (newton - at.t).abs() <= round_off::CURVE_PARAMETER * (1.0 + at.t.abs()) {
                break;
            }
            if at.slope < 0.0 {
                low = at.t;
            } else {
                high = at.t;
            }
            let is_inside = at.bend > 0.0 && newton > low && newton < high;
            at = of(if is_inside { newton } else { 0.5 * (low + high) });
        }
        (at, true)
    }
}

impl Pair for CurveOnSurface {
    fn gap(&self, x: &Vector3, rotation: &Matrix3) -> Gap {
        let (at, is_between) = self.nearest(x, rotation);
        let (n, bend) = (at.distance.normal, at.distance.curvature);
        let mut place_by = carried(rotation, &at.point);
        if is_between && at.bend > 0.0 {
            let turned = side_by_side(&Matrix3::zeros(), &(rotation * skew(&at.own_tangent)));
            let along: RowVector6<f64> =
                (at.tangent.transpose() * bend * place_by - n.transpose() * turned) / -at.bend;
            place_by += at.tangent * along;
        }
        let value = at.distance.value;
        let normal_by = bend * place_by;
        Gap {
            value: at.value - self.rounding,
            normal: n,
            point: at.place - value * n,
            normal_by,
            point_by: place_by - n * (n.transpose() * place_by) - value * normal_by,
        }
    }

    fn value(&self, x: &Vector3, rotation: &Matrix3) -> f64 {
        self.nearest(x, rotation).0.value - self.rounding
    }

    fn deepest(&self) -> f64 {
        let depth = self.surface.depth();
        if depth.is_finite() { self.rounding + depth } else { 2.0 * self.rounding.max(self.curve.reach()) }
    }

    fn reach(&self) -> f64 {
        self.curve.reach()
    }

    fn is_on_plane(&self) -> bool {
        self.surface.is_plane()
    }
}
