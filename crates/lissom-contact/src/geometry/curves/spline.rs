//! A smooth closed curve through points of a plane: a periodic cubic spline over the sum of chords.
//!
//! Legend: t sum of the chords up to a point, h_k chord from point k to the next, p_k points, M_k second derivatives.
//!
//! ```text
//! h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 ((p_{k+1} - p_k)/h_k - (p_k - p_{k-1})/h_{k-1})
//! ```

use lissom_motion::Vector3;
use nalgebra::Vector2;

use super::Curve;

/// Sweeps after which the diagonally dominant equations of the second derivatives are solved to round-off: each at least halves
/// the error.
const SWEEPS: usize = 60;

/// A closed curve in the plane z = 0, counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    points: Vec<Vector2<f64>>,
    bends: Vec<Vector2<f64>>,
    /// Parameters of the points.
    knots: Vec<f64>,
    length: f64,
}

impl Spline {
    /// Through at least three points, each apart from the next [m]; none otherwise.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let mut points: Vec<Vector2<f64>> = points.iter().copied().map(Vector2::from).collect();
        if area(&points) < 0.0 {
            points.reverse();
        }
        let count = points.len();
        let chords: Vec<f64> = (0..count).map(|k| (points[(k + 1) % count] - points[k]).norm()).collect();
        if count < 3 || chords.iter().any(|chord| !chord.is_normal()) {
            return None;
        }
        let mut bends = vec![Vector2::zeros(); count];
        for _ in 0..SWEEPS {
            for k in 0..count {
                let (before, after) = ((k + count - 1) % count, (k + 1) % count);
                let (chord, next) = (chords[before], chords[k]);
                let slopes = (points[after] - points[k]) / next - (points[k] - points[before]) / chord;
                bends[k] =
                    (6.0 * slopes - chord * bends[before] - next * bends[after]) / (2.0 * (chord + next));
            }
        }
        let mut sum = 0.0;
        let knots = chords.iter().map(|chord| {
            sum += chord;
            sum - chord
        });
        let knots = knots.collect();
        Some(Self { points, bends, knots, length: sum })
    }

    /// The points through which it passes.
    pub fn points(&self) -> &[Vector2<f64>] {
        &self.points
    }

    /// Length of its chords [m].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The point at t, and its first and second derivative.
    pub fn at(&self, t: f64) -> [Vector2<f64>; 3] {
        let t = t.rem_euclid(self.length);
        let k = self.knots.partition_point(|&knot| knot <= t).saturating_sub(1);
        let next = (k + 1) % self.points.len();
        let end = self.knots.get(k + 1).copied().unwrap_or(self.length);
        let chord = end - self.knots[k];
        let (b, a) = ((t - self.knots[k]) / chord, (end - t) / chord);
        let ([p, q], [m, n]) = ([self.points[k], self.points[next]], [self.bends[k], self.bends[next]]);
        [
            a * p + b * q + ((a * a * a - a) * m + (b * b * b - b) * n) * (chord * chord / 6.0),
            (q - p) / chord + ((3.0 * b * b - 1.0) * n - (3.0 * a * a - 1.0) * m) * (chord / 6.0),
            a * m + b * n,
        ]
    }
}

/// Area inside a polygon, negative where it is clockwise [m²].
pub(crate) fn area(points: &[Vector2<f64>]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(p, q)| p.perp(q)).sum::<f64>()
}

impl Curve for Spline {
    fn point(&self, t: f64) -> [Vector3; 3] {
        self.at(t).map(|of| Vector3::new(of.x, of.y, 0.0))
    }

    fn samples(&self) -> &[f64] {
        &self.knots
    }

    fn beside(&self, sample: usize) -> (f64, f64) {
        let last = self.knots.len() - 1;
        let before = if sample > 0 { self.knots[sample - 1] } else { self.knots[last] - self.length };
        let after = if sample < last { self.knots[sample + 1] } else { self.length + self.knots[0] };
        (before, after)
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn reach(&self) -> f64 {
        self.points.iter().map(Vector2::norm).fold(0.0, f64::max)
    }
}

#[cfg(test)]
#[path = "../../../tests/unit/geometry/curves/spline.rs"]
mod tests;
