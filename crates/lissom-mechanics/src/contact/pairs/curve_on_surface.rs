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

use crate::contact::curves::Curve;
use crate::contact::gap::{Gap, Pair, carried, side_by_side};
use crate::contact::surfaces::{Distance, Surface};

/// Corrections of t after which it is known to all digits: bisections halve an interval.
const MAX_CORRECTIONS: usize = 60;
/// Corrections below this fraction of the curve's parameter are round-off.
const ROUND_OFF: f64 = 1e-15;

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
        let count = samples.len();
        let of = |t: f64| self.candidate(t, x, rotation);
        let (mut best, mut least) = (0, f64::INFINITY);
        if count > 2 {
            for (index, &t) in samples.iter().enumerate() {
                let value = of(t).value;
                if value < least {
                    (best, least) = (index, value);
                }
            }
        }
        // An interval in which the slope rises through zero; of two samples the curve is one interval.
        let (mut low, mut high) = if count == 2 {
            (of(samples[0]), of(samples[1]))
        } else {
            let (before, after) = self.curve.beside(best);
            (of(before), of(after))
        };
        if low.slope >= 0.0 && !self.curve.is_closed() && low.t <= samples[0] {
            return (low, false);
        }
        if high.slope <= 0.0 && !self.curve.is_closed() && high.t >= samples[count - 1] {
            return (high, false);
        }
        let mut middle = of(if count == 2 { 0.5 * (low.t + high.t) } else { samples[best] });
        for _ in 0..MAX_CORRECTIONS {
            let newton = middle.t - middle.slope / middle.bend;
            if middle.slope < 0.0 {
                low.t = middle.t;
            } else {
                high.t = middle.t;
            }
            let is_inside = middle.bend > 0.0 && newton > low.t && newton < high.t;
            let next = if is_inside { newton } else { 0.5 * (low.t + high.t) };
            let change = (next - middle.t).abs();
            middle = of(next);
            if change <= ROUND_OFF * (1.0 + next.abs()) || middle.slope == 0.0 {
                break;
            }
        }
        (middle, true)
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

    fn deepest(&self) -> f64 {
        let depth = self.surface.depth();
        if depth.is_finite() { self.rounding + depth } else { 2.0 * self.rounding.max(self.curve.reach()) }
    }

    fn reach(&self) -> f64 {
        self.curve.reach()
    }
}
