//! Curves of solids with which they touch surfaces. A kind of curve is one file.

mod segment;
mod spline;

pub use segment::Segment;
pub use spline::Spline;
pub(crate) use spline::area;

use lissom_motion::Vector3;

/// A curve in the axes of a solid.
pub trait Curve: std::fmt::Debug + Send + Sync {
    /// The point c(t) [m], c' and c''.
    fn point(&self, t: f64) -> [Vector3; 3];

    /// Distance w by which the solid is thinner at t than at its thickest point [m], w' and w''. Default: none.
    fn crown(&self, _t: f64) -> [f64; 3] {
        [0.0; 3]
    }

    /// Ascending parameters between which the distance from a surface has at most one minimum; of an open curve with both ends. Two
    /// if the whole curve is such an interval.
    fn samples(&self) -> &[f64];

    /// Parameters around a sample between which it is the only one. Default: those of an open curve.
    fn beside(&self, sample: usize) -> (f64, f64) {
        let samples = self.samples();
        (samples[sample.saturating_sub(1)], samples[(sample + 1).min(samples.len() - 1)])
    }

    /// Whether it has no ends. Default: it has two.
    fn is_closed(&self) -> bool {
        false
    }

    /// Largest distance from the origin [m].
    fn reach(&self) -> f64;
}
